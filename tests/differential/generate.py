"""Random first-order formulas from a seed, biased to the corners where eliminations go wrong.

A ``Shape`` bounds the size. Coefficients are mostly small so that roots coincide, leading coefficients vanish and
polynomials share factors often; a part of the polynomials are products, squares or shifts of one another. A few
coefficients are huge, and a few polynomials have roots closer than any fixed precision tells apart.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.syntax import Atom, Exists, ForAll, Formula, Relation
from qe.formula.traverse import map_atoms

NAMES = ("a", "b", "x", "y", "z")
HUGE = (10**20, -(10**30) - 1, 10**40 + 3)


@dataclass(frozen=True, slots=True)
class Shape:
    """Bounds: ``free`` and ``bound`` variables, total ``degree`` of a polynomial, number of ``atoms``."""

    free: int
    bound: int
    degree: int
    atoms: int
    prenex: bool = True


SMALL = (Shape(0, 1, 4, 3), Shape(1, 1, 3, 3), Shape(0, 2, 2, 3), Shape(1, 1, 2, 4), Shape(0, 2, 3, 2))
NESTED = (Shape(1, 2, 2, 3, prenex=False), Shape(0, 2, 2, 4, prenex=False), Shape(0, 3, 2, 4, prenex=False))
LARGE = (Shape(1, 2, 3, 3), Shape(0, 3, 2, 3), Shape(2, 1, 3, 3), Shape(1, 2, 2, 4), Shape(2, 2, 2, 2))


def random_poly(rng: random.Random, ring: Ring, names: tuple[str, ...], degree: int) -> Poly:
    """A polynomial in some of ``names``; one in six is a product or a square, one in forty has two close roots."""
    if degree >= 2 and rng.random() < 0.025:
        x, q = ring.var(rng.choice(names)), rng.choice(HUGE)
        p = rng.randint(-2, 2) * q + rng.randint(-2, 2)
        return (q * x - p) * (q * x - p - 1)
    if degree >= 2 and rng.random() < 0.17:
        left = random_poly(rng, ring, names, degree // 2)
        return left * (left if rng.random() < 0.4 else random_poly(rng, ring, names, degree // 2))
    total = ring.constant(rng.choice((0, 0, 1, -1, 2, -3)))
    for _ in range(rng.randint(1, 3)):
        huge = rng.random() < 0.03
        term = ring.constant(rng.choice(HUGE) if huge else rng.choice((1, 1, -1, -1, 2, -2, 3)))
        for _ in range(rng.randint(1, degree)):
            term = term * ring.var(rng.choice(names))
        total = total + term
    return total


def random_formula(rng: random.Random, shape: Shape) -> Formula:
    """A formula with at most the variables of ``shape``; free ones are named a, b, bound ones x, y, z."""
    free, bound = NAMES[: shape.free], NAMES[2 : 2 + shape.bound]
    ring = Ring.of(free + bound)
    if shape.prenex:
        return _quantify(rng, bound, _matrix(rng, ring, free + bound, shape.degree, shape.atoms))
    return _nested(rng, ring, free, bound, shape)


def random_alternation(rng: random.Random) -> Formula:
    """Two to four blocks of alternating quantifiers over low degrees, with at most one free variable."""
    free, bound = NAMES[: rng.choice((0, 0, 0, 1))], (*NAMES[2:], "w")[: rng.randint(2, 4)]
    ring = Ring.of(free + bound)
    degree, atoms = (2, rng.randint(2, 3)) if len(bound) < 4 else (1, rng.randint(3, 6))
    formula, universal = _matrix(rng, ring, free + bound, degree, atoms), rng.random() < 0.5
    for name in reversed(bound):
        formula = (forall if universal else exists)((name,), formula)
        universal = not universal
    return formula


def _matrix(rng: random.Random, ring: Ring, names: tuple[str, ...], degree: int, atoms: int) -> Formula:
    if atoms <= 1:
        return atom(random_poly(rng, ring, names, degree), rng.choice(list(Relation)))
    left = rng.randint(1, atoms - 1)
    parts = (_matrix(rng, ring, names, degree, left), _matrix(rng, ring, names, degree, atoms - left))
    joined = (conj if rng.random() < 0.6 else disj)(parts)
    return neg(joined) if rng.random() < 0.15 else joined


def _quantify(rng: random.Random, names: tuple[str, ...], body: Formula) -> Formula:
    for name in reversed(names):
        body = (exists if rng.random() < 0.6 else forall)((name,), body)
    return body


def _nested(rng: random.Random, ring: Ring, scope: tuple[str, ...], bound: tuple[str, ...], shape: Shape) -> Formula:
    """Quantifiers inside the Boolean structure; the names of siblings and of inner scopes may coincide."""
    plain = _matrix(rng, ring, scope, shape.degree, rng.randint(1, 2)) if scope else None
    if not bound:
        return plain if plain is not None else atom(ring.constant(rng.choice((0, 1))), Relation.EQ)
    parts = [] if plain is None else [plain]
    for _ in range(rng.randint(1, 2)):
        name = rng.choice(bound)
        inner = tuple(b for b in bound if b != name)[: rng.randint(0, len(bound) - 1)]
        names = tuple(dict.fromkeys((*scope, name)))
        body = _nested(rng, ring, names, inner, shape)
        parts.append((exists if rng.random() < 0.6 else forall)((name,), body))
    joined = (conj if rng.random() < 0.5 else disj)(parts)
    return neg(joined) if rng.random() < 0.2 else joined


def random_point(rng: random.Random, formula: Formula) -> dict[str, Fraction]:
    """Small values for the free variables; integers and zero are likely, where special cases sit."""
    pick = (
        0,
        0,
        1,
        -1,
        2,
        -2,
        3,
        Fraction(1, 2),
        Fraction(-1, 3),
        Fraction(7, 4),
        -5,
        HUGE[0],
        1 + Fraction(1, HUGE[1]),
    )
    return {name: Fraction(rng.choice(pick)) for name in formula.free}


def at_point(formula: Formula, point: dict[str, Fraction]) -> Formula:
    """The formula with its free variables set to rational values (names bound inside are left alone)."""
    match formula:
        case Exists(names, body):
            return exists(names, at_point(body, {k: v for k, v in point.items() if k not in names}))
        case ForAll(names, body):
            return forall(names, at_point(body, {k: v for k, v in point.items() if k not in names}))
        case Atom(poly, relation):
            for name, value in point.items():
                if name in poly.ring.index:
                    poly = poly.at_rational(poly.ring.index[name], value)
            return atom(poly, relation)
    return _children_at(formula, point)


def _children_at(formula: Formula, point: dict[str, Fraction]) -> Formula:
    from qe.formula.syntax import And, Not, Or

    match formula:
        case And(args):
            return conj(at_point(a, point) for a in args)
        case Or(args):
            return disj(at_point(a, point) for a in args)
        case Not(arg):
            return neg(at_point(arg, point))
    return map_atoms(formula, lambda a: a)
