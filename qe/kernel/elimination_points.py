"""The test points of an elimination set as they are read, and that each of them implies what it was made from."""

from __future__ import annotations

from dataclasses import dataclass

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import FALSE, TRUE, And, Atom, Formula, Or, Relation
from qe.formula.traverse import atoms, conjuncts, disjuncts
from qe.kernel.turning_points import vanishing
from qe.kernel.virtual_substitution import TestPoint, put
from qe.proof.entry import Entry, formula_from_json

EQ, NE, LT, GT, GE = Relation.EQ, Relation.NE, Relation.LT, Relation.GT, Relation.GE

BRANCHES = {0: (0,), 2: (0,), 3: (-1, 1)}
"""The roots that are told apart, by the number of coefficients."""


@dataclass(frozen=True, slots=True)
class Tried:
    """``formula`` is tried at ``point`` where ``guard`` holds (no point: for all x, which stays quantified)."""

    point: TestPoint | None
    guard: Formula
    formula: Formula
    settled: frozenset[Formula]

    def result(self, x: int) -> Formula:
        """What it adds to the disjunction."""
        assert self.point is not None
        return conj((self.guard, put(self.formula, x, self.point, self.settled)))


def implies(strong: Formula, weak: Formula) -> bool:
    """Whether the shapes show that ``strong`` implies ``weak``: conjuncts left out, disjuncts added."""
    if strong in (weak, FALSE) or weak == TRUE:
        return True
    if isinstance(weak, And):
        return all(implies(strong, w) for w in weak.args)
    if isinstance(strong, Or):
        return all(implies(s, weak) for s in strong.args)
    members = conjuncts(strong)
    if weak in members:
        return True
    if isinstance(weak, Or) and any(implies(strong, w) for w in weak.args):
        return True
    return isinstance(weak, Or) and any(implies(s, weak) for s in members if isinstance(s, Or))


def read_points(points: Entry, body: Formula, x: int, ring: Ring) -> list[Tried]:
    """The points; each is real where its guard holds, and its formula implies the body."""
    return [_tried(entry, body, x, ring) for entry in points.items()]


def _tried(entry: Entry, body: Formula, x: int, ring: Ring) -> Tried:
    point, guard, formula, settled = entry.fields("point", "guard", "formula", "settled")
    where = None if point.value is None else _point(point, x, ring)
    condition = formula_from_json(guard, ring)
    if not is_free_of(condition, x):
        raise guard.fail("expected a condition on the other variables")
    kept = body if formula.value is None else formula_from_json(formula, ring)
    if where is not None and any(not isinstance(a, Atom) and ring.names[x] in a.free for a in atoms(kept)):
        raise formula.fail("no test point is put into root atoms")  # the variable would be left, and mean another one
    found = Tried(where, condition, kept, frozenset(formula_from_json(s, ring) for s in settled.items()))
    _check_implication(found, body, x, formula)
    if where is not None and not is_real(where, conj((condition, *conjuncts(kept)))):
        raise guard.fail("the point may be none here")
    strict = all(isinstance(s, Atom) and s.relation.is_strict and s in conjuncts(kept) for s in found.settled)
    if found.settled and (not strict or where is None or not where.coefficients or not where.shift):
        raise settled.fail("expected strict conjuncts of the formula, for a point next to a root")
    return found


def _point(entry: Entry, x: int, ring: Ring) -> TestPoint:
    coefficients, branch, shift = entry.fields("coefficients", "branch", "shift")
    parts = tuple(c.polynomial(ring) for c in coefficients.items())
    b, s = branch.integer(-1), shift.integer(-1)
    if len(parts) not in BRANCHES or any(p.degree(x) for p in parts):
        raise coefficients.fail("expected two or three polynomials in the other variables, or none")
    if b not in BRANCHES[len(parts)]:
        raise branch.fail("expected 1 or -1 for a root of a quadratic, 0 otherwise")
    point = TestPoint(parts, b, s)
    if s > 1 or (not parts and not s):
        raise shift.fail("expected -1, 0 or 1, not 0 for infinity")
    return point


def is_free_of(formula: Formula, x: int) -> bool:
    """Whether the variable does not occur; False for formulas with quantifiers."""
    ring = formula.ring
    return formula.is_quantifier_free and (ring is None or ring.names[x] not in formula.free)


def is_real(point: TestPoint, known: Formula) -> bool:
    """Whether known conjuncts say that the leading coefficient is not 0, and what is needed of the discriminant."""
    if not point.coefficients:
        return True
    members = conjuncts(known)
    if not any(_excludes_zero(m, point.coefficients[-1]) for m in (TRUE, *members)):
        return False
    if len(point.coefficients) == 2:
        return True
    c, b, a = point.coefficients
    real = atom(b * b - 4 * (a * c), GE)
    return real == TRUE or real in members


def _excludes_zero(member: Formula, a: Poly) -> bool:
    """A product that is not 0 has no factor that is."""
    if a.is_constant:
        return bool(a)
    if not isinstance(member, Atom) or member.relation not in (NE, LT, GT):
        return False
    return member.poly.gcd(a).normal()[1] == a.normal()[1]


def _check_implication(tried: Tried, whole: Formula, x: int, entry: Entry) -> None:
    for member in conjuncts(whole):
        if not implies(tried.formula, member) and (tried.point is not None or not _holds(member, tried.guard, x)):
            raise entry.fail("does not imply the formula")


def _holds(member: Formula, guard: Formula, x: int) -> bool:
    """Whether the guard says that an equation, or one of several joined by "or", vanishes identically in x."""
    return any(
        isinstance(e, Atom) and e.relation is EQ and e.poly.degree(x) > 0 and implies(guard, vanishing(e.poly, x))
        for e in disjuncts(member)
    )
