"""Where an atom can turn true: every place where it does is among the points, under conditions that hold there."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product
from math import lcm

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.ring import Poly
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, Atom, Relation
from qe.kernel.turning_points import factored, inside, turns, vanishing
from tests.unit.certify.claims import RING, formula, poly
from tests.unit.elimination.vs.line import holds, samples, specialise

X = RING.index["x"]
POLYS = (
    "a*x - b",
    "a*x^2 + b*x + 1",
    "b*(x - a)",
    "(a - b)*(x^2 - a)",
    "b*(x - a)^3",
    "(x - a)^2",
    "(x - a)*(x - b)",
    "a*b*x",
    "(x^2 + a*x + b)^2*(x - a)",
    "a*x^3 - b*x^2",
)
VALUES = [Fraction(v) for v in (-2, -1, 0, 1, 2)]


def place_of(point: object, values: dict[str, Fraction]) -> RealAlgebraic | None:
    """The number that a test point is, for values of the parameters."""
    at = [Fraction(c.evaluate([values.get(n, Fraction(0)) for n in RING.names])) for c in point.coefficients]  # type: ignore[attr-defined]
    if len(at) == 2:
        return RealAlgebraic.rational(-at[0] / at[1]) if at[1] else None
    if not at[2] or at[1] ** 2 < 4 * at[0] * at[2]:
        return None
    scale = lcm(*(c.denominator for c in at))
    line = sum((RING.gen(X) ** k * int(c * scale) for k, c in enumerate(at)), RING.constant(0))
    roots = sorted(real_roots(line.to_univariate(X)))
    return roots[-1] if (point.branch > 0) is (at[2] > 0) else roots[0]  # type: ignore[attr-defined]


@settings(max_examples=60)
@given(st.sampled_from(POLYS), st.sampled_from(tuple(Relation)), st.sampled_from((-1, 1)), st.data())
def test_no_place_is_missed(text: str, relation: Relation, side: int, data: st.DataObject) -> None:
    given_ = Atom(poly(text).normal()[1], relation)
    values = dict(zip("ab", data.draw(st.tuples(st.sampled_from(VALUES), st.sampled_from(VALUES)))))
    fixed = specialise(given_, values)
    if not isinstance(fixed, Atom):
        return
    listed = turns(given_, X, side)
    assert listed is not None
    met = {(place_of(t.point, values), t.point.shift) for t in listed if all(holds_at(c, values) for c in t.conditions)}
    cells = samples([fixed.poly], X)
    roots = set(real_roots(fixed.poly.to_univariate(X)))
    for before, here in pairwise(cells if side > 0 else cells[::-1]):
        if holds(fixed, X, here) and not holds(fixed, X, before):
            expected = (here, 0) if here in roots else (before, side)
            assert expected in met, (values, expected)


@pytest.mark.parametrize(
    ("text", "side", "points"),
    [
        ("x - a > 0", 1, [("-a", 1, "true")]),
        ("x - a > 0", -1, []),  # it falls on the way to the left
        ("x - a < 0", -1, [("-a", -1, "true")]),
        ("x - a >= 0", 1, [("-a", 0, "true")]),
        ("x - a = 0", 1, [("-a", 0, "true")]),
        ("x - a = 0", -1, [("-a", 0, "true")]),
        ("x - a /= 0", 1, [("-a", 1, "true")]),
        ("b*(x - a) >= 0", 1, [("-a", 0, "b > 0")]),
        ("b*(x - a) >= 0", -1, [("-a", 0, "b < 0")]),
        ("b*(x - a)^2 > 0", 1, [("-a", 1, "true")]),
    ],
)
def test_places_of_linear_factors(text: str, side: int, points: list[tuple[str, int, str]]) -> None:
    given_ = formula(text)
    assert isinstance(given_, Atom)
    found = turns(given_, X, side)
    assert found is not None
    assert all(t.point.branch == 0 for t in found)
    told = [(t.point.coefficients[0], t.point.shift, *t.conditions) for t in found]
    signs = {True: 1, False: -1}
    wanted = []
    for (root, shift, condition), t in zip(points, found, strict=True):
        unit = signs[t.point.coefficients[1].constant_value() > 0]
        wanted.append((poly(root) * unit if root != "-a" else -RING.gen(0) * unit, shift, formula(condition)))
    assert told == wanted


def test_a_degree_above_two_is_refused() -> None:
    for text, known in (
        ("x^3 - a*x + 1 > 0", False),
        ("(x - a)^3 > 0", True),
        ("a^5*x > b^7", True),
    ):
        given_ = formula(text)
        assert isinstance(given_, Atom)
        assert (turns(given_, X, 1) is not None) is known


def test_factors_multiply_out() -> None:
    p = poly("3*a^2*(x - a)^2*(x^2 + b)*(b - 1)")
    product_ = RING.constant(1)
    for factor, exponent in factored(p):
        product_ = product_ * factor**exponent
    assert product_.normal()[1] == p.normal()[1]
    assert sorted((str(f), m) for f, m in inside(p, X)) == sorted(
        (str(poly(f).normal()[1]), m) for f, m in (("x - a", 2), ("x^2 + b", 1))
    )


@pytest.mark.parametrize("text", POLYS)
def test_a_polynomial_vanishes_identically_where_all_coefficients_do(text: str) -> None:
    p: Poly = poly(text)
    condition = vanishing(p, X)
    for a, b in product(VALUES, repeat=2):
        at = p.at_rational(0, a).at_rational(1, b)
        assert (condition != FALSE and holds_at(condition, {"a": a, "b": b})) is (not at), (a, b)


@pytest.mark.parametrize("text", ["x^4 + a", "x*(x^4 + a*x + b)", "(x^2 - b)*(x^4 + a)^2"])
def test_one_factor_of_a_higher_degree_is_too_many(text: str) -> None:
    """Its roots are no test points, however low the degrees of the others."""
    for relation in Relation:
        assert turns(Atom(poly(text), relation), X, 1) is None
