"""Random polynomials, formulas and questions; formulas with one thing changed, and with others for parts."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence

from qe.engine.run import solve
from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import children
from qe.options import Budget, Options
from qe.proof.step import Place

NAMES = ("a", "b", "x", "y")
GRID = (-3, -2, -1, 0, 1, 2, 3)


def polynomial(rng: random.Random, ring: Ring) -> Poly:
    """A small polynomial, often linear, sometimes a product or a sum of squares."""
    shape = rng.random()
    if shape < 0.15:
        return simple(rng, ring) * simple(rng, ring)
    if shape < 0.2:
        p, q = simple(rng, ring), simple(rng, ring)
        return p * p + q * q
    return simple(rng, ring)


def simple(rng: random.Random, ring: Ring) -> Poly:
    """One or two monomials and a constant."""
    total = ring.constant(rng.randint(-2, 2))
    for _ in range(rng.randint(1, 2)):
        i, e = rng.randrange(ring.size), rng.choice((1, 1, 1, 1, 2, 2, 3))
        total = total + ring.gen(i) ** e * rng.choice((-2, -1, 1, 1, 3))
    return total


def formula(rng: random.Random, ring: Ring, depth: int) -> Formula:
    """A quantifier-free formula."""
    if depth == 0 or rng.random() < 0.2:
        return atom(polynomial(rng, ring), rng.choice((*Relation, Relation.EQ)))
    parts = [formula(rng, ring, depth - 1) for _ in range(rng.randint(2, 3))]
    return conj(parts) if rng.random() < 0.7 else disj(parts)


def question(rng: random.Random) -> Formula:
    """A formula with one block, sometimes with another inside or beside it."""
    ring = Ring.of(NAMES)
    body = formula(rng, ring, 2)
    if rng.random() < 0.2:
        body = conj((body, forall(("y",), formula(rng, ring, 1))))
    block = (exists if rng.random() < 0.7 else forall)(("x", "y"), body)
    return conj((block, formula(rng, ring, 1))) if rng.random() < 0.3 else block


def altered(rng: random.Random, given: Formula) -> Formula:
    """The formula with one thing changed."""
    match given:
        case Atom(poly, relation):
            if rng.random() < 0.5:
                return Atom(poly, rng.choice([r for r in Relation if r is not relation]))
            return atom(poly + rng.choice((-1, 1)), relation)
        case And(args) | Or(args):
            shape, k = rng.random(), rng.randrange(len(args))
            join, other = (conj, disj) if isinstance(given, And) else (disj, conj)
            if shape < 0.2:
                return join(args[:k] + args[k + 1 :])
            if shape < 0.3:
                return other(args)
            return join((*args[:k], altered(rng, args[k]), *args[k + 1 :]))
        case Exists(variables, body) | ForAll(variables, body):
            if rng.random() < 0.1:
                return (forall if isinstance(given, Exists) else exists)(variables, body)
            return (exists if isinstance(given, Exists) else forall)(variables, altered(rng, body))
        case Constant(value):
            return FALSE if value else TRUE
    return given


def eliminated(given: Formula) -> Formula | None:
    """The formula without quantifiers, if that is cheap."""
    if given.is_quantifier_free:
        return given
    try:
        return solve(given, Options(), Budget(0.5)).formula
    except Unable:
        return None


def differs(rng: random.Random, left: Formula, right: Formula, known: Formula) -> bool:
    """Whether two quantifier-free formulas are seen to differ at some point where ``known`` holds."""
    free = sorted({*left.free, *right.free, *known.free})
    for _ in range(60):
        at = {name: rng.choice(GRID) for name in free}
        if holds_at(known, at) and holds_at(left, at) != holds_at(right, at):
            return True
    return False


def places(formula: Formula, path: Place = ()) -> Iterator[tuple[Place, Formula]]:
    """All parts of a formula, with the way down to them."""
    yield path, formula
    for k, child in enumerate(children(formula)):
        yield from places(child, (*path, k))


def put(formula: Formula, place: Place, new: Formula) -> Formula:
    """The formula with another part at a place."""
    if not place:
        return new
    match formula:
        case And(args) | Or(args):
            k = place[0]
            join = conj if isinstance(formula, And) else disj
            return join((*args[:k], put(args[k], place[1:], new), *args[k + 1 :]))
        case Not(arg):
            inner = put(arg, place[1:], new)
            return neg(inner) if isinstance(inner, Constant) else Not(inner)
        case Exists(variables, body) | ForAll(variables, body):
            return same(formula)(variables, put(body, place[1:], new))
    raise AssertionError(formula)


def same(f: Exists | ForAll) -> Callable[[Sequence[str], Formula], Formula]:
    """The builder of the quantifier that the formula begins with."""
    return exists if isinstance(f, Exists) else forall
