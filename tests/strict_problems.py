"""Convex conditions that are narrow, strict, degenerate or large: not every point of the closed set satisfies them."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom
from qe.formula.syntax import Formula, Relation

WEAK_AND_STRICT = st.sampled_from((Relation.LE, Relation.LT, Relation.LT))
NARROW = st.sampled_from((Fraction(0), Fraction(1, 4), Fraction(1, 1000), Fraction(1, 10**9)))
SMALL = st.integers(-3, 3)
EDGES = st.sampled_from((0, 0, 0, 1, -1))
HUGE = st.one_of(EDGES, st.builds(lambda s, e, d: s * 10**e + d, st.sampled_from((1, -1)), st.integers(20, 40), SMALL))


def scaled(poly: Poly, constant: Fraction) -> Poly:
    """A positive multiple of poly + constant with whole coefficients."""
    return poly * constant.denominator + constant.numerator


@st.composite
def linear(draw: st.DrawFn, ring: Ring, coefficients: st.SearchStrategy[int] = SMALL) -> Poly:
    """A linear polynomial, also a constant one."""
    total = ring.constant(draw(EDGES))
    for i in range(ring.size):
        total = total + draw(coefficients) * ring.gen(i)
    return total


@st.composite
def ranges(draw: st.DrawFn, ring: Ring, huge: bool) -> list[Formula]:
    """A narrow range for one variable, seen from another one or not; with equal ends a point or nothing."""
    i = draw(st.integers(0, ring.size - 1))
    off = ring.gen(draw(st.integers(0, ring.size - 1))) * draw(EDGES)
    width = draw(NARROW) / (draw(st.sampled_from((1, 10**20, 10**40))) if huge else 1)
    middle = Fraction(draw(EDGES))
    base = ring.gen(i) - (off if i not in off.variables else 0)
    low, high = scaled(-base, middle), scaled(base, -middle - width)
    found = [atom(low, draw(WEAK_AND_STRICT))]
    return [*found, atom(high, draw(WEAK_AND_STRICT))] if draw(st.integers(0, 3)) else found


@st.composite
def curved(draw: st.DrawFn, ring: Ring) -> Formula:
    """A sum of up to two squares and a linear polynomial, compared with a small number."""
    total = draw(linear(ring)) * draw(st.sampled_from((0, 0, 1)))
    for _ in range(draw(st.integers(1, 2))):
        part = draw(linear(ring, EDGES))
        total = total + part * part
    return atom(total - draw(st.sampled_from((0, 0, 1, 3))), draw(WEAK_AND_STRICT))


@st.composite
def conditions(draw: st.DrawFn, ring: Ring, *, huge: bool = False, bent: bool = True) -> list[Formula]:
    """One to six conditions; constants among them are kept."""
    found: list[Formula] = []
    if bent and draw(st.integers(0, 2)) == 0:  # a ball of irrational radius: irrational optima
        some = [ring.gen(i) for i in range(ring.size)][: draw(st.integers(1, ring.size))]
        squares = sum((x * x for x in some), start=ring.constant(0))
        found.append(atom(squares - draw(st.sampled_from((2, 3, 5))), Relation.LE))
    for _ in range(draw(st.integers(1, 2))):
        found += draw(ranges(ring, huge))
    for _ in range(draw(st.integers(0, 2))):
        if bent and draw(st.booleans()):
            found.append(draw(curved(ring)))
        else:
            relation = draw(st.sampled_from((Relation.LE, Relation.LT, Relation.EQ)))
            found.append(atom(draw(linear(ring, HUGE if huge else EDGES)), relation))
    return found


@st.composite
def objectives(draw: st.DrawFn, ring: Ring, *, huge: bool = False, bent: bool = True) -> Poly:
    """Linear, often in few of the variables or constant; sometimes with a square."""
    kind = draw(st.integers(0, 5))
    if kind == 0:
        return ring.constant(draw(EDGES))
    if kind <= 2:
        return ring.gen(draw(st.integers(0, ring.size - 1))) * draw(st.sampled_from((1, -1)))
    total = draw(linear(ring, HUGE if huge else EDGES))
    part = draw(linear(ring, EDGES))
    return total + part * part if bent and kind == 5 else total
