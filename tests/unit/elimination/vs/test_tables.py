"""Each row of the substitution tables against the numbers themselves."""

from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from qe.elimination.vs.points import Infinity, LinearRoot, QuadraticRoot, TestPoint
from qe.elimination.vs.substitute import Substitution
from qe.elimination.vs.tables import root_condition
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, Relation
from qe.simplifier.factors import atom_under
from qe.simplifier.facts import NOTHING
from tests.strategies import polynomials, rationals
from tests.unit.elimination.vs.line import between, samples, sign_at, specialise

RING = Ring.of(("a", "b", "x"))
X = 2
SMALL = st.integers(-4, 4)


@given(SMALL, SMALL, st.integers(0, 9), st.sampled_from(tuple(Relation)))
def test_root_condition_is_the_relation(a: int, b: int, r: int, relation: Relation) -> None:
    if r == 0:
        value = (a > 0) - (a < 0)
    else:
        # a + b*sqrt(r) compared with zero through the real root of z^2 - r
        root = real_roots((RING.gen(X) ** 2 - r).to_univariate(X))[-1]
        value = (root * b + a).sign()
    ring = RING
    found = root_condition(ring.constant(a), ring.constant(b), ring.constant(a * a - b * b * r), relation, atom)
    assert found == (TRUE if relation.holds(value) else FALSE)


def actual_sign(f: Poly, point: TestPoint, values: dict[str, Fraction]) -> int | None:
    """The sign of f at the point for these parameters, from real roots; None where the guard fails."""
    here = specialise_poly(f, values)
    if isinstance(point, Infinity):
        marks = samples([here], X)
        return sign_at(here, X, marks[-1 if point.sign > 0 else 0])
    if isinstance(point, LinearRoot):
        a, b = specialise_poly(point.a, values), specialise_poly(point.b, values)
        if not a:
            return None
        e = RealAlgebraic.rational(Fraction(-b.constant_value(), a.constant_value()))
    else:
        x = RING.gen(X)
        g = specialise_poly(point.a * x**2 + point.b * x + point.c, values)
        if g.degree(X) < 2:
            return None
        roots = real_roots(g.to_univariate(X))
        if not roots:
            return None
        e = roots[-1] if (point.branch > 0) == (g.leading(X).constant_value() > 0) else roots[0]
    if not point.epsilon:
        return sign_at(here, X, e)
    others = sorted({*real_roots(here.to_univariate(X))} - {e}) if here.degree(X) else []
    if point.epsilon > 0:
        end = next((r for r in others if r > e), e + 1)
        return sign_at(here, X, RealAlgebraic.rational(between(e, end)))
    end = next((r for r in reversed(others) if r < e), e - 1)
    return sign_at(here, X, RealAlgebraic.rational(between(end, e)))


def specialise_poly(f: Poly, values: dict[str, Fraction]) -> Poly:
    """A positive multiple of f at the parameter values; the multiplier depends on the values and degrees only."""
    scale = Fraction(1)
    for name, value in values.items():
        scale *= Fraction(value.denominator) ** f.degree(RING.index[name])
        f = f.at_rational(RING.index[name], value)
    assert scale > 0
    return f


PARAMETER = st.fixed_dictionaries({"a": rationals(3, 2), "b": rationals(3, 2)})
COEFFICIENT = polynomials(Ring.of(("a", "b")), max_degree=1, max_terms=2, max_coefficient=3).map(
    lambda p: p.convert(RING)
)


@given(
    polynomials(RING, max_degree=3, max_terms=4, max_coefficient=3),
    COEFFICIENT,
    COEFFICIENT,
    st.sampled_from((-1, 0, 1)),
    st.sampled_from(tuple(Relation)),
    PARAMETER,
)
def test_linear_root(f: Poly, a: Poly, b: Poly, epsilon: int, relation: Relation, values: dict[str, Fraction]) -> None:
    assume(a)
    # at_rational clears denominators by degree, so -b/a keeps its value only for integer parameters
    integers = {name: Fraction(value.numerator) for name, value in values.items()}
    check(f, LinearRoot(a, b, epsilon), relation, integers)


@given(
    polynomials(RING, max_degree=3, max_terms=4, max_coefficient=3),
    COEFFICIENT,
    COEFFICIENT,
    COEFFICIENT,
    st.sampled_from((-1, 1)),
    st.sampled_from((-1, 0, 1)),
    st.sampled_from(tuple(Relation)),
    PARAMETER,
)
def test_quadratic_root(
    f: Poly,
    a: Poly,
    b: Poly,
    c: Poly,
    branch: int,
    epsilon: int,
    relation: Relation,
    values: dict[str, Fraction],
) -> None:
    assume(a)
    check(f, QuadraticRoot(a, b, c, branch, epsilon), relation, values)


@given(
    polynomials(RING, max_degree=4, max_terms=4),
    st.sampled_from((-1, 1)),
    st.sampled_from(tuple(Relation)),
    PARAMETER,
)
def test_infinity(f: Poly, side: int, relation: Relation, values: dict[str, Fraction]) -> None:
    check(f, Infinity(side), relation, values)


def check(f: Poly, point: TestPoint, relation: Relation, values: dict[str, Fraction]) -> None:
    sign = actual_sign(f, point, values)
    assume(sign is not None)
    assert sign is not None
    result = Substitution(X, point, NOTHING)(atom(f, relation))
    assert all(not p.degree(X) for p in _polys(result))
    assert holds_at(result, values) == relation.holds(sign)


def _polys(formula: object) -> list[Poly]:
    from qe.formula.traverse import polynomials as listed

    return listed(formula)  # type: ignore[arg-type]


@given(polynomials(RING, max_degree=4), st.sampled_from(tuple(Relation)), PARAMETER)
def test_reduced_atom_means_the_same(f: Poly, relation: Relation, values: dict[str, Fraction]) -> None:
    point = {**values, "x": values["a"] + 1}
    assert holds_at(atom_under(f, relation, NOTHING), point) == holds_at(atom(f, relation), point)


@given(
    polynomials(RING, max_degree=3),
    COEFFICIENT,
    st.sampled_from(tuple(Relation)),
    st.sampled_from(tuple(Relation)),
    PARAMETER,
)
def test_reduced_atom_under_facts(
    f: Poly, g: Poly, relation: Relation, known: Relation, values: dict[str, Fraction]
) -> None:
    fact = atom(g, known)
    point = {**values, "x": Fraction(1)}
    assume(holds_at(fact, point))
    product = f * g
    assert holds_at(atom_under(product, relation, NOTHING.extended((fact,))), point) == holds_at(
        atom(product, relation), point
    )


@pytest.mark.parametrize("relation", list(Relation))
def test_sum_of_squares(relation: Relation) -> None:
    a, b = RING.gen(0), RING.gen(1)
    for values in ((0, 0), (1, 0), (0, -2), (3, 1)):
        point = {"a": values[0], "b": values[1], "x": 0}
        for p in (a**2 + b**2, -(a**2) - 3 * a**4 * b**2, a**2 + b**2 + 1):
            assert holds_at(atom_under(p, relation, NOTHING), point) == holds_at(atom(p, relation), point)


def test_specialise_is_substitution() -> None:
    f = atom(RING.gen(0) * RING.gen(X) - RING.gen(1), Relation.LT)
    assert specialise(f, {"a": Fraction(2), "b": Fraction(-2)}) == atom(RING.gen(X) + 1, Relation.LT)
