"""Cases of parametric ideals against the same ideals at points, and signatures by characteristic polynomials."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.ideal import Ideal, TraceForms, terms_of
from qe.expert.arithmetic.parametric import Case, Conditions, Terms, cases, irreducible
from qe.expert.arithmetic.parametric_forms import ParametricForms
from qe.expert.classification import _signatures
from qe.formula.evaluate import holds_at
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("a", "b"))
A, B = RING.gen(0), RING.gen(1)
NUMBERS = st.integers(-2, 2).map(Fraction)
SYSTEMS = st.lists(
    st.dictionaries(
        st.tuples(st.integers(0, 2), st.integers(0, 1)),
        polynomials(RING, max_degree=1).filter(bool),
        min_size=1,
        max_size=3,
    ),
    min_size=1,
    max_size=2,
)


def tick() -> None:
    """No limit."""


def at_most(count: int) -> Callable[[], None]:
    """A limit on the work of one example."""
    left = iter(range(count))

    def step() -> None:
        if next(left, None) is None:
            raise Unable("too long for a test")

    return step


def holds(where: Conditions, point: list[Fraction]) -> bool:
    return not any(p.evaluate(point) for p in where.equal) and all(p.evaluate(point) for p in where.nonzero)


def special(p: Terms, point: list[Fraction]) -> dict[tuple[int, ...], object]:
    ring = Ring.of(("x", "y"))
    values = {e: c.evaluate(point) for e, c in p.items()}
    scale = 1
    for v in values.values():
        scale *= v.denominator
    return dict(terms_of(ring.from_terms({e: int(v * scale) for e, v in values.items() if v})))


def case_at(polys: list[Terms], point: list[Fraction], where: Conditions | None = None) -> Case:
    (found,) = [c for c in cases(polys, 2, where or Conditions.of(RING, (), (), tick)) if holds(c.where, point)]
    return found


@settings(max_examples=25)
@given(SYSTEMS, NUMBERS, NUMBERS)
def test_every_point_has_one_case_with_the_ideal_there(system: list[Terms], a: Fraction, b: Fraction) -> None:
    """Leading monomials, and signatures where there are finitely many solutions, are those of the system at the
    point."""
    try:
        found = case_at(system, [a, b], Conditions.of(RING, (), (), at_most(1500)))
    except Unable:
        return
    there = Ideal([special(p, [a, b]) for p in system], [1, 1], tick)  # type: ignore[misc]
    leads = {lead for lead, _ in there.basis}
    assert all(any(all(i <= j for i, j in zip(m, n, strict=True)) for m in leads) for n, _ in found.basis)
    assert all(any(all(i <= j for i, j in zip(m, n, strict=True)) for m, _ in found.basis) for n in leads)
    assert found.is_finite == there.is_finite or found.is_unit
    if not found.is_finite or not found.monomials or len(found.monomials) > 5:
        return
    h: Terms
    for h in ({(0, 0): RING.constant(1)}, {(1, 0): RING.constant(1), (0, 1): A, (0, 0): B}):
        own = special(h, [a, b])
        try:
            forms = ParametricForms(found)
            conditions = _signatures(forms.coefficients(forms.matrix(h)), len(found.monomials))
        except Unable:
            return
        values = [value for value, f in conditions.items() if holds_at(f, {"a": a, "b": b})]
        assert values == [TraceForms(there).signature(own)]  # type: ignore[arg-type]


def test_conditions_are_kept() -> None:
    where = Conditions.of(RING, (A * B,), (A,), tick)
    found = list(cases([{(1, 0): B, (0, 0): A}], 2, where))
    assert len(found) == 1 and not found[0].monomials  # b = 0, and a does not vanish


def test_a_third_leading_monomial_alone_spares_no_pair() -> None:
    one = RING.constant(1)
    polys: list[Terms] = [
        {(1, 1, 0): one, (0,) * 3: -A},
        {(1, 0, 1): one, (0,) * 3: -B},
        {(0, 1, 1): one, (0,) * 3: -one},
    ]
    (found,) = [c for c in cases(polys, 3, Conditions.of(RING, (), (A, B), tick)) if not c.where.equal]
    assert found.is_finite and len(found.monomials) == 2  # x^2 = a b, y = a/x, z = b/x


@each(True, False)
def test_a_remainder_is_whole_or_has_an_irreducible_first_monomial(whole: bool) -> None:
    one = RING.constant(1)
    (found,) = cases([{(2, 0): one, (0, 0): -A}], 2, Conditions.of(RING, (), (), tick))
    scale, rest = found.remainder({(1, 3): one, (2, 1): B}, whole=whole)
    assert scale.is_constant and rest == {(1, 3): scale, **({(0, 1): scale * A * B} if whole else {(2, 1): scale * B})}


def test_empty_cases_are_left_out() -> None:
    assert Conditions.of(RING, (A * B - 1, B), (), tick).is_empty
    assert Conditions.of(RING, (A * B,), (A, B), tick).is_empty
    assert not Conditions.of(RING, (A * B,), (A,), tick).is_empty
    assert not Conditions.of(RING, (), (A,), tick).is_empty


def test_a_factor_that_was_given_as_a_product() -> None:
    where = Conditions.of(RING, (), (A * (A - B) ** 2,), tick)
    assert where.undecided(A**3 * (A - B)) is None and where.undecided(A * (A + B)) == A + B
    assert irreducible(-2 * A**2 * B) in ([A, B], [B, A])


@each(A**2 - 2, RING.constant(3))
def test_reduction_keeps_common_multiples(poly: Poly) -> None:
    where = Conditions.of(RING, (2 * A - B,), (), tick)
    one, other, rest = where.reduced([A, poly, 2 * A - B])
    assert not rest and one.evaluate([Fraction(0), Fraction(1)]) > 0
    ratio = one.evaluate([Fraction(0), Fraction(1)]) / Fraction(1, 2)
    assert other.evaluate([Fraction(0), Fraction(2)]) == ratio * poly.evaluate([Fraction(1), Fraction(2)])


def test_limits() -> None:
    where = Conditions.of(RING, (), (), tick)
    long: list[Terms] = [{(70, 0): RING.constant(1), (0, 0): A}, {(0, 1): RING.constant(1)}]
    (found,) = cases(long, 2, where)
    with pytest.raises(Unable, match="complex solutions"):
        assert found.monomials
