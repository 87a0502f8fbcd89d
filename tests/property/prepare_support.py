"""Random formulas and their exact truth at rational points, for the tests of qe.prepare."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, neg
from qe.formula.syntax import And, Atom, Constant, Formula, Not, Or, Relation
from qe.formula.traverse import atoms
from tests.strategies import integers

RING = Ring.of(("a", "b", "x", "y"))
VALUES = (-3, -2, Fraction(-3, 2), -1, Fraction(-1, 2), 0, Fraction(1, 3), Fraction(1, 2), 1, Fraction(3, 2), 2, 3)

rationals = st.sampled_from(VALUES).map(Fraction)
points = st.tuples(*[rationals] * RING.size)


def holds(formula: Formula, point: Mapping[str, Fraction]) -> bool:
    """The truth of a quantifier-free formula at a rational point, by plain evaluation."""
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            value = poly.evaluate([point[name] for name in poly.ring.names])
            return relation.holds((value > 0) - (value < 0))
        case And(args):
            return all(holds(a, point) for a in args)
        case Or(args):
            return any(holds(a, point) for a in args)
        case Not(arg):
            return not holds(arg, point)
    raise AssertionError(f"quantifier-free formula expected: {formula!r}")


def named(ring: Ring, values: tuple[Fraction, ...]) -> dict[str, Fraction]:
    """A point as a mapping."""
    return dict(zip(ring.names, values, strict=True))


def weight(formula: Formula) -> int:
    """The size measure of the simplifier: total degree times number of variables, over the atoms."""
    return sum(found.poly.total_degree * len(found.poly.variables) for found in atoms(formula))


@st.composite
def polynomials(draw: st.DrawFn, ring: Ring = RING, degree: int = 2, terms: int = 3) -> Poly:
    """A sparse polynomial with small coefficients."""
    exponent = st.lists(st.integers(0, ring.size - 1), max_size=degree)
    found: dict[tuple[int, ...], int] = {}
    for variables in draw(st.lists(exponent, min_size=1, max_size=terms)):
        vector = [0] * ring.size
        for v in variables:
            vector[v] += 1
        found[tuple(vector)] = draw(integers(2, rarity=24))
    return ring.from_terms(found)


def interesting(ring: Ring = RING) -> st.SearchStrategy[Poly]:
    """Polynomials biased to what the rules look at: shared keys, squares, products, bare variables."""
    plain = polynomials(ring)
    bare = st.integers(0, ring.size - 1).map(ring.gen)
    shifted = st.tuples(bare, st.integers(-2, 2)).map(lambda t: t[0] + t[1])
    squares = st.tuples(bare, bare, st.integers(-2, 2)).map(lambda t: t[0] ** 2 + t[1] ** 2 + t[2])
    product = st.tuples(shifted, plain, st.integers(1, 3)).map(lambda t: t[0] ** t[2] * t[1])
    return st.one_of(shifted, squares, plain, product)


def literals(ring: Ring = RING) -> st.SearchStrategy[Formula]:
    """Atoms over ``interesting`` polynomials."""
    return st.builds(atom, interesting(ring), st.sampled_from(Relation))


def formulas(ring: Ring = RING, leaves: int = 8) -> st.SearchStrategy[Formula]:
    """Quantifier-free formulas with nested and, or, not."""
    return st.recursive(
        literals(ring),
        lambda inner: st.one_of(
            st.lists(inner, min_size=1, max_size=4).map(conj),
            st.lists(inner, min_size=1, max_size=4).map(disj),
            inner.map(neg),
        ),
        max_leaves=leaves,
    )
