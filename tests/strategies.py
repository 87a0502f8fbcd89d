"""Hypothesis strategies for polynomials and formulas, biased to small and degenerate ones.

A part of the coefficients is huge, and some polynomials have roots closer than any fixed precision tells apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg, root_atom
from qe.formula.syntax import FALSE, TRUE, Formula, Relation

NAMES = ("x", "y", "z", "w")
RELATIONS = st.sampled_from(tuple(Relation))


HUGE = (10**20, 10**20 + 1, 10**25 - 1, 10**30 + 1, 10**40, 10**40 + 3)


@st.composite
def integers(draw: st.DrawFn, bound: int = 5, *, rarity: int = 16) -> int:
    """Integers up to ``bound`` in absolute value; one in ``rarity`` is huge."""
    if draw(st.integers(1, rarity)) == rarity:
        return draw(st.sampled_from((1, -1))) * draw(st.sampled_from(HUGE))
    return draw(st.integers(-bound, bound))


@st.composite
def rationals(draw: st.DrawFn, bound: int = 4, denominator: int = 3) -> Fraction:
    """Small rational numbers; one in sixteen is huge, or differs from a small one by almost nothing."""
    number = Fraction(draw(st.integers(-bound * denominator, bound * denominator)), draw(st.integers(1, denominator)))
    kind = draw(st.integers(1, 32))
    if kind >= 31:
        huge = draw(st.sampled_from(HUGE))
        return number + (huge if kind == 31 else Fraction(1, huge))
    return number


@st.composite
def close_roots(draw: st.DrawFn, ring: Ring) -> Poly:
    """A polynomial in one variable of the ring with two roots p/q and (p+1)/q, or c - sqrt(d)/q and c + sqrt(d)/q."""
    x, q = ring.gen(draw(st.integers(0, ring.size - 1))), draw(st.sampled_from(HUGE))
    p = draw(st.integers(-2, 2)) * q + draw(st.integers(-2, 2))
    if draw(st.booleans()):
        return (q * x - p) * (q * x - p - 1)
    c = draw(st.sampled_from((-1, 0, 1, HUGE[0], -HUGE[-1])))
    return q**2 * (x - c) ** 2 - draw(st.sampled_from((2, 3, 4)))


@st.composite
def polynomials(
    draw: st.DrawFn, ring: Ring, *, max_degree: int = 2, max_terms: int = 4, max_coefficient: int = 5
) -> Poly:
    """Elements of ``ring`` of total degree at most ``max_degree``; constants and zero included."""
    if max_degree >= 2 and ring.size and draw(st.integers(1, 24)) == 24:
        return draw(close_roots(ring))
    terms: dict[tuple[int, ...], int] = {}
    for _ in range(draw(st.integers(1, max_terms))):
        chosen = draw(st.lists(st.integers(0, ring.size - 1), max_size=max_degree)) if ring.size else []
        exponents = tuple(chosen.count(i) for i in range(ring.size))
        terms[exponents] = draw(integers(max_coefficient))
    return ring.from_terms(terms)


@st.composite
def atoms(draw: st.DrawFn, ring: Ring, *, max_degree: int = 2, root_atoms: bool = False) -> Formula:
    """One atom (TRUE or FALSE where the polynomial comes out constant)."""
    poly = draw(polynomials(ring, max_degree=max_degree))
    relation = draw(RELATIONS)
    if root_atoms and poly.variables and draw(st.booleans()):
        variable = ring.names[draw(st.sampled_from(poly.variables))]
        return root_atom(variable, relation, poly, draw(st.sampled_from((1, 2, -1, -2))))
    return atom(poly, relation)


@st.composite
def formulas(
    draw: st.DrawFn,
    *,
    names: Sequence[str] = NAMES[:3],
    max_degree: int = 2,
    max_quantifiers: int = 0,
    max_depth: int = 3,
    max_width: int = 3,
    root_atoms: bool = False,
) -> Formula:
    """Formulas over ``names``: any Boolean structure, quantifiers anywhere (also vacuous, repeated, shadowing)."""
    ring = Ring.of(tuple(names))
    budget = [max_quantifiers]

    def build(depth: int) -> Formula:
        kinds = ["atom", "atom"] if depth else ["atom"]
        if depth:
            kinds += ["and", "or", "not", "constant"]
            kinds += ["ex", "all", "ex"] if budget[0] else []
        kind = draw(st.sampled_from(kinds))
        if kind in ("and", "or"):
            parts = [build(depth - 1) for _ in range(draw(st.integers(2, max_width)))]
            return conj(parts) if kind == "and" else disj(parts)
        if kind == "not":
            return neg(build(depth - 1))
        if kind in ("ex", "all"):
            bound = draw(st.lists(st.sampled_from(tuple(names)), min_size=1, max_size=budget[0]))
            budget[0] -= len(bound)
            body = build(depth - 1)
            return exists(bound, body) if kind == "ex" else forall(bound, body)
        if kind == "constant":
            return draw(st.sampled_from((TRUE, FALSE)))
        return draw(atoms(ring, max_degree=max_degree, root_atoms=root_atoms))

    return build(max_depth)


@st.composite
def sentences(draw: st.DrawFn, *, names: Sequence[str] = NAMES[:2], max_degree: int = 2, max_depth: int = 2) -> Formula:
    """Formulas without free variables: a random prefix in front of a random quantifier-free matrix."""
    formula = draw(formulas(names=names, max_degree=max_degree, max_depth=max_depth))
    for name in draw(st.permutations(list(names))):
        quantify = draw(st.sampled_from((exists, forall)))
        formula = quantify([name], formula)
    assert not formula.free
    return formula


def points(names: Sequence[str]) -> st.SearchStrategy[dict[str, Fraction]]:
    """A rational value for every name."""
    return st.fixed_dictionaries({name: rationals() for name in names})
