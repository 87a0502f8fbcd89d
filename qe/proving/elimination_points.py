"""The test points of an elimination set as evidence: the engine's points for the theorem's needs, and what is kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.elimination.vs.points import CubicRoot, Infinity, LinearRoot, QuadraticRoot, SymbolicPoint
from qe.elimination.vs.radical_free import convex_family, lone_quadratic
from qe.elimination.vs.trace import Attempt, Substituted, Trace
from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.elimination_points import Tried, implies, is_real
from qe.kernel.elimination_set import require_cover
from qe.kernel.step import Limits
from qe.kernel.turning_cover import Around, Cover, Met
from qe.kernel.turning_points import Turn
from qe.kernel.virtual_substitution import TestPoint
from qe.proof.derivation import moved
from qe.proof.entry import Json, formula_to_json, poly_to_text
from qe.proving.shifts import low
from qe.simplifier.facts import NOTHING
from qe.simplifier.simplify import simplify


@dataclass(frozen=True, slots=True)
class Point:
    """What is tried, what the engine made of it, simplified, and the answer there with its trace.

    No trace: the engine knew that nothing holds there. Not ``needed``: it did not look, because the answer was known.
    """

    tried: Tried
    result: Formula = FALSE
    simple: Formula = FALSE
    answer: Formula = FALSE
    trace: Trace | None = None
    needed: bool = True


def point_entry(tried: Tried, body: Formula) -> Json:
    """A point that is tried in a body, as evidence."""
    point = tried.point
    return {
        "point": None
        if point is None
        else {
            "coefficients": [poly_to_text(p) for p in point.coefficients],
            "branch": point.branch,
            "shift": point.shift,
        },
        "guard": formula_to_json(tried.guard),
        "formula": None if tried.formula == body else formula_to_json(tried.formula),
        "settled": [formula_to_json(a) for a in conjuncts(tried.formula) if a in tried.settled],
    }


class Points:
    """The points of one variable's elimination, over the ring of the derivation."""

    def __init__(self, block: Exists, trace: Substituted, ring: Ring, limits: Limits, *, complete: bool) -> None:
        given = trace.formula.ring
        assert given is not None
        self.ring, self.plan = ring, trace.plan
        self.name = given.names[trace.plan.x]
        self.x = ring.index[self.name]
        self.body = block.body
        infinities = trace.plan.infinities
        self.side = 0 if len(infinities) == 2 else -infinities[0].sign if infinities else 1
        self.quadratics: list[Poly] = [] if self.side else self._quadratics()
        decided = bool(trace.parts) and trace.parts[-1][0] == TRUE
        attempts = list(enumerate(trace.attempts))[-1 if decided and not complete else 0 :]
        tried = [self._tried(attempt) for _, attempt in attempts]
        count = len(tried)
        if decided and complete:
            tried += self._untried(tried)
        untried = len(tried)
        if complete or not decided:
            tried = self._guarded(tried, limits)
        self.listed = [
            Point(t, self.moved(a.result), self.moved(a.simple), self.moved(trace.parts[k][0]), trace.parts[k][1])
            for t, (k, a) in zip(tried, attempts, strict=False)
        ]
        self.listed += [Point(t, t.result(self.x), needed=False) for t in tried[count:untried]]
        self.listed += [Point(t) for t in tried[untried:]]

    def _untried(self, tried: Sequence[Tried]) -> list[Tried]:
        """The points of the plan that were not looked at, with nothing settled."""
        infinities = [
            Attempt(point, self.plan.infinity_guard or TRUE, self.plan.formula, frozenset(), TRUE, TRUE)
            for point in self.plan.infinities
        ]
        others = [Attempt(c.point, c.guard, c.formula, frozenset(), TRUE, TRUE) for c in self.plan.candidates]
        known = {(t.point, t.guard, t.formula) for t in tried}
        others_tried = dict.fromkeys(self._tried(attempt) for attempt in (*infinities, *others))
        return [t for t in others_tried if (t.point, t.guard, t.formula) not in known]

    def moved(self, formula: Formula) -> Formula:
        return moved(formula, self.ring)

    def evidence(self, parts: Sequence[Json]) -> Json:
        """The evidence of the rule "elimination set"."""
        return {
            "variable": self.name,
            "side": self.side,
            "quadratics": [poly_to_text(q) for q in self.quadratics],
            "points": [point_entry(p.tried, self.body) for p in self.listed],
            "parts": list(parts),
        }

    def _quadratics(self) -> list[Poly]:
        formula, x = self.plan.formula, self.plan.x
        family = convex_family(formula, x, NOTHING.extended(conjuncts(formula)))
        lone = None if family else lone_quadratic(formula, x)
        if lone is not None:
            return [lone.convert(self.ring).normal()[1]]
        return [p.f.convert(self.ring) for p in family]

    def _tried(self, attempt: Attempt) -> Tried:
        """The point with a guard that makes it real; ``_guarded`` finds the guard of the theorem."""
        settled = frozenset(self.moved(a) for a in attempt.settled)
        if attempt.point is None:
            known = conjuncts(low(self.moved(attempt.formula), self.x, self.plan.exponent))
            return Tried(None, TRUE, conj(m for m in conjuncts(self.body) if m in known), settled)
        point = _as_checked(attempt.point, self.ring)
        guard = conj((*_real(point), self.moved(attempt.guard)))
        return Tried(point, guard, self.moved(attempt.formula), settled)

    def _guarded(self, tried: list[Tried], limits: Limits) -> list[Tried]:
        """The points with the conditions of the theorem as guards, and those at which the problem is kept."""
        needs = _Needs(self.x, self.body, tried, limits)
        used: dict[int, list[tuple[Formula, ...]]] = {}
        kept: dict[Formula, None] = {}
        for k, condition in require_cover(needs, self.body, self.side, self.quadratics):
            if k < 0:
                kept[condition] = None
            else:
                used.setdefault(k, []).append(conjuncts(condition))
        out = []
        for k, t in enumerate(tried):
            conditions, point = used.get(k, []), needs.points.get(k, t.point)
            tried_so = point is not None and point == t.point and all(implies(conj(c), t.guard) for c in conditions)
            asked = conditions and not tried_so
            guard = _common(conditions) if asked else t.guard
            if asked and point is not None and not is_real(point, conj((guard, *conjuncts(t.formula)))):
                # conditions that contradict themselves have nothing in common with the others, and need no point
                impossible = [c for c in conditions if needs.is_impossible(c)]
                kept |= dict.fromkeys(conj(c) for c in impossible)
                conditions = [c for c in conditions if c not in impossible]
                guard = _common(conditions) if conditions else t.guard
            out.append(Tried(point, guard, t.formula, t.settled))
        return out + [Tried(None, condition, self.body, frozenset()) for condition in kept]


class _Needs(Cover):
    """What the theorem asks for, met by points whatever their guards, or known by the engine to be impossible."""

    def __init__(self, x: int, original: Formula, tried: Sequence[Tried], limits: Limits) -> None:
        super().__init__(x, original, tried, limits)
        self.points: dict[int, TestPoint] = {}
        self._places: dict[TestPoint | None, list[int]] = {}
        for k, t in enumerate(tried):
            self._places.setdefault(None if t.point is None else _one_sign(t.point), []).append(k)
        name = original.ring.names[x] if original.ring else ""
        self._facts = [m for m in conjuncts(original) if name not in m.free]

    def meets(self, turn: Turn, formula: Formula, before: int | None = None) -> list[Met] | None:
        there = [
            k
            for k in self._places.get(_one_sign(turn.point), ())
            if (before is None or k < before) and implies(formula, self.tried[k].formula)
        ]
        chosen = next((k for k in there if self._follows(turn, formula, k)), None)
        if chosen is None:
            self.missing = f"a place where {formula} can turn true"
            impossible = self._impossible(turn.conditions)
            if impossible is not None:
                return impossible
            with_guards = ((k, (*turn.conditions, self.tried[k].guard)) for k in there)
            chosen = next((k for k, under in with_guards if not self.is_impossible(under)), None)
            if chosen is None:
                return None
        self.points[chosen] = turn.point
        return [(chosen, conj(turn.conditions))]

    def _follows(self, turn: Turn, formula: Formula, k: int) -> bool:
        """Whether the engine's guard follows from the conditions of the theorem."""
        guard = self.tried[k].guard
        if implies(conj((*turn.conditions, formula)), guard):
            return True
        return simplify(conj((*turn.conditions, *self._facts, nnf(guard, negate=True)))) == FALSE

    def kept(self, under: Around) -> list[Met] | None:
        for k in self.there(None):
            return [(k, conj(under))]
        return self._impossible(under)

    def _impossible(self, under: Around) -> list[Met] | None:
        return [(-1, conj(under))] if self.is_impossible(under) else None

    def is_impossible(self, under: Around) -> bool:
        """Whether the engine knows that these conditions never hold beside the block's others."""
        return simplify(conj((*under, *self._facts))) == FALSE


def _common(lists: Sequence[Sequence[Formula]]) -> Formula:
    """The conditions that stand in all lists."""
    return conj(c for c in lists[0] if all(c in other for other in lists[1:]))


def _as_checked(point: SymbolicPoint, ring: Ring) -> TestPoint:
    match point:
        case Infinity(sign):
            return TestPoint((), 0, sign)
        case LinearRoot(a, b, epsilon):
            return TestPoint((b.convert(ring), a.convert(ring)), 0, epsilon)
        case QuadraticRoot(a, b, c, branch, epsilon):
            return TestPoint((c.convert(ring), b.convert(ring), a.convert(ring)), branch, epsilon)
        case CubicRoot():
            raise CertificateRejected("points", "the kernel has no test points at roots of cubics")


def _one_sign(point: TestPoint) -> TestPoint:
    """The same point by a polynomial with a positive leading coefficient."""
    if not point.coefficients or point.coefficients[-1].normal()[0] > 0:
        return point
    return TestPoint(tuple(-c for c in point.coefficients), -point.branch, point.shift)


def _real(point: TestPoint) -> list[Formula]:
    """The conditions under which the point is one."""
    if not point.coefficients:
        return []
    conditions = [atom(point.coefficients[-1], Relation.NE)]
    if len(point.coefficients) == 3:
        c, b, a = point.coefficients
        conditions.append(atom(b * b - 4 * (a * c), Relation.GE))
    return conditions
