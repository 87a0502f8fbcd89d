"""``bezier.chain``: a chain of curves through any number of via points, with proof, or why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.chains import proposals
from bezier.chains.chain import Chain, objective_form, requirements
from bezier.chains.exact import Exact, exactly
from bezier.chains.form import Solved
from bezier.chains.limits import best_within
from bezier.chains.proof import GAPS, Best, Contradiction, best, decided, feasible
from bezier.chains.region import PointRegion, Validity, region, validity
from bezier.chains.repair import Repair, excluded, least_radius, nearest, nearest_duration
from bezier.curves.curve import Bezier
from bezier.curves.scalar import described, exact_text
from qe import arguments
from qe.errors import Unable
from qe.proof.certificate import Certificate, Labelled

SHORT = 10**12
LONG = 100
"""Characters of an exact value that is printed; JSON has them all."""


@dataclass(frozen=True, slots=True)
class Conflict:
    """Conditions that exclude each other; ``smallest``: all of them but any one do not. ``certificate`` proves both."""

    conditions: tuple[str, ...]
    smallest: bool
    certificate: Certificate

    def __str__(self) -> str:
        return f"{', '.join(self.conditions)} {'exclude each other' if len(self.conditions) > 1 else 'excludes it'}"


@dataclass(frozen=True, slots=True)
class ChainPlan:
    """``curves``: with the least value of the objective, which lies between ``bound`` and ``value`` (rational, a
    billionth of it apart, or what ``accuracy`` says); empty where there is no chain. Then ``conflict`` says why, and
    ``repair`` which radius helps (None: there is no ball, or none helps); ``with_repairs`` adds other ``repairs``.
    ``certificate``: of the optimum, or of the contradiction."""

    chain: Chain
    curves: tuple[Bezier, ...]
    value: Fraction | None
    bound: Fraction | None
    certificate: Certificate
    conflict: Conflict | None = None
    repair: Repair | None = None
    repairs: tuple[Repair, ...] = ()
    excluded: tuple[tuple[str, tuple[tuple[str, Contradiction], ...]], ...] = ()
    """What is proved not to help, in words, with the proofs."""
    exact: Exact | None = None
    """The optimum itself, where at most one condition is active; with two it takes longer: ``exactly``."""
    searched: bool = False
    """Whether the durations were free: all that is proved holds for those that a search picked."""

    @property
    def feasible(self) -> bool:
        """Whether there is a chain."""
        return self.value is not None

    @property
    def accuracy(self) -> str:
        """How much of ``value`` lies between it and ``bound``, at most."""
        if self.value is None or self.bound is None:
            return ""
        words, gap, size = ("a billionth", "a millionth", "a thousandth"), self.value - self.bound, abs(self.value)
        known = [word for word, share in zip(words, GAPS, strict=True) if gap <= share * size]
        return known[0] if known else f"{100 * float(gap / size):.2g} %"

    def exactly(self) -> Exact | None:
        """The optimum itself as an algebraic number, where at most two conditions are active; else None."""
        if self.exact is not None or self.value is None or _is_bounded(self.chain):
            return self.exact
        solved = self.chain.solved
        rows = requirements(self.chain, solved)
        inside = decided(self.chain, solved, rows)
        found = None if isinstance(inside, Contradiction) else best(self.chain, solved, rows, inside)
        return None if found is None else exactly(self.chain, solved, rows, found, 2)

    def with_repairs(self) -> ChainPlan:
        """The same with all ``repairs`` that are known: the radius, the point or velocity that has to move least, one
        duration; or the proof that no other one point, or velocity, or duration is enough."""
        given = self.chain
        if self.conflict is None or _is_bounded(given):
            return self
        ends = ("velocities[0]", "velocities[1]") if given.velocities or given.is_still else ()
        found = [self.repair] if self.repair is not None else []
        proofs = []
        for what, names in (("point", given.point_names), ("velocity", ends), ("duration", given.paces)):
            repair = nearest_duration(given) if what == "duration" else nearest(given, names)
            if repair is not None:
                found.append(repair)
            elif listed := excluded(given, names):
                proofs.append((f"another {what}", listed))
        return replace(self, repairs=tuple(found), excluded=tuple(proofs))

    @property
    def proof(self) -> Certificate:
        """All certificates as one: the optimum, or the contradiction, the conflict and the repairs."""
        proofs = [self.certificate] if self.conflict is None else [self.conflict.certificate]
        proofs += [repair.certificate for repair in self.repairs or (self.repair,) if repair]
        proofs += [Certificate.bundle([(label, c.certificate) for label, c in listed]) for _, listed in self.excluded]
        members = [m for m in bundled(proofs).payload if isinstance(m, Labelled)]
        # labels say the durations that a search picked, which the file does not
        times = f" with durations = {', '.join(map(str, self.chain.times))}" if self.searched else ""
        parts = (m.label.partition(" with ") for m in members)
        labels = (f"{claim}{times}{joined}{change}" for claim, joined, change in parts)
        return Certificate.bundle([(label, m.certificate) for label, m in zip(labels, members, strict=True)])

    @property
    def lines(self) -> list[str]:
        """What is said, a line for each."""
        picked = [f"durations that a search picked: {', '.join(map(str, self.chain.times))}"] if self.searched else []
        if self.conflict is None:
            exact = [] if self.exact is None else [f"exactly {exact_text(self.exact.value)}"]
            return [str(self), *(line for line in exact if len(line) < LONG), *picked]
        needed = self.conflict.smallest and len(self.conflict.conditions) > 1
        return [
            f"no chain: {self.conflict}{', all of them needed' if needed else ''}",
            *picked,
            *(f"possible with {repair}" for repair in self.repairs),
            *(f"{what} alone is not enough, proved" for what, _ in self.excluded),
        ]

    def region(self, name: str, accuracy: Any = None) -> PointRegion:
        """Where a given point ("start", "via[0]", "goal"; the others as they are) or a control point ("C2.1") may be:
        polytopes inside and outside, the gap of their sizes at most ``accuracy`` (0.001 in the plane, 0.05 in space).
        Raises ``InputError``, ``Unable``."""
        share = None if accuracy is None else arguments.rational(accuracy, "accuracy")
        if share is not None and share <= 0:
            raise arguments.wrong("accuracy", "a number above zero", accuracy)
        return region(self.chain, arguments.text(name, "name"), share)

    def validity(self, name: str) -> Validity:
        """By how much a point may move before there is no chain, from both sides. Raises ``InputError``, ``Unable``."""
        return validity(self.chain, arguments.text(name, "name"))

    def to_json(self) -> dict[str, Any]:
        """Everything, with exact numbers."""
        data: dict[str, Any] = {"status": "solved" if self.feasible else "infeasible"}
        if self.value is not None and self.bound is not None:
            data["objective"] = {"kind": self.chain.objective.value, "value": described(self.value)}
            data["objective"]["bound"] = described(self.bound)
            data["objective"]["exact"] = None if self.exact is None else described(self.exact.value)
        if self.feasible:
            data["durations"] = [str(t) for t in self.chain.times]
            data["curves"] = [[[described(c) for c in p] for p in curve.points] for curve in self.curves]
        if self.conflict is not None:
            data["conflict"] = {"conditions": list(self.conflict.conditions), "smallest": self.conflict.smallest}
            data["repairs"] = [
                {"change": r.change, "value": [described(c) for c in r.value], "too small": described(r.too_small)}
                for r in self.repairs
            ]
            data["not enough"] = [what for what, _ in self.excluded]
        return data

    def page(self, title: str = "chain", shown: PointRegion | None = None) -> str:
        """An HTML page with pictures of the chain, or of the points that have none, in its ball and half-spaces; in the
        plane with a region below."""
        from bezier.report.chain import page
        from bezier.report.html import Card, document, tone

        cards = [Card("chain", "proved" if self.feasible else "there is none", tone(self.feasible))]
        if self.value is not None:
            note = f"least, to {self.accuracy}"
            cards.append(Card(self.chain.objective.value, f"{float(self.value):.10g}", note=note))
        cards += [Card(f"possible with {r.change}", str(r).partition(" = ")[2]) for r in self.repairs]
        lines = self.lines if shown is None else [*self.lines, str(shown)]
        return document(page(self.chain, self.curves, lines, title, cards, shown))

    def __str__(self) -> str:
        if self.value is not None:
            return f"{len(self.curves)} curves, objective {float(self.value):.12g}, proved to {self.accuracy}"
        assert self.conflict is not None
        why = f"no chain: {self.conflict}"
        return why if self.repair is None else f"{why}; with radius {float(self.repair.radius):.10g} there is one"


def bundled(proofs: Sequence[Certificate]) -> Certificate:
    """All members of bundles as one."""
    members = [m for proof in proofs for m in proof.payload if isinstance(m, Labelled)]
    return Certificate.bundle([(m.label, m.certificate) for m in members])


def planned(given: Chain) -> ChainPlan:
    """The best chain, or why there is none. Raises ``Unable``."""
    if given.free_total is not None:
        return replace(planned(timed(given)), searched=True)
    solved = given.solved
    rows = requirements(given, solved)
    inside = decided(given, solved, rows)
    least = best_within if _is_bounded(given) else best
    found = inside if isinstance(inside, Contradiction) else least(given, solved, rows, inside)
    if isinstance(found, Best):
        # short numbers, and no bounds of length and curvature: the exact optimum is likely to take milliseconds
        numbers = [c for p in given.points for c in p] + [given.radius_squared or Fraction(1), *given.times]
        is_quick = not _is_bounded(given) and max(c.denominator for c in numbers) < SHORT
        exact = exactly(given, solved, rows, found, 1) if is_quick else None
        return ChainPlan(given, solved.curves(found.free), found.value, found.bound, found.certificate, exact=exact)
    conflict = smallest_conflict(given, solved, found)
    if _is_bounded(given):  # a repair would have to keep the bounds, too
        return ChainPlan(given, (), None, None, found.certificate, conflict)
    return ChainPlan(given, (), None, None, found.certificate, conflict, least_radius(given))


def _is_bounded(given: Chain) -> bool:
    return given.max_length is not None or given.max_curvature is not None


def smallest_conflict(given: Chain, solved: Solved, known: Contradiction) -> Conflict:
    """Conditions are left out one by one, as long as the others still exclude each other (deletion filter; Chinneck,
    Dravnieks, ORSA Journal on Computing 3, 1991). Raises ``Unable``."""
    needed: dict[str, Certificate | None] = {}
    while (row := next((r for r in known.support if r.label not in needed), None)) is not None:
        others = [r for r in known.support if r is not row]
        if not others:
            break
        try:
            answer = decided(given, solved, others)
        except Unable:  # the others touch
            needed[row.label] = None
            continue
        if isinstance(answer, Contradiction):
            known = answer
        else:
            needed[row.label] = feasible(given, solved, others, answer)
    labels = tuple(row.label for row in known.support)
    proofs = [(f"without {label}", proof) for label in labels if (proof := needed.get(label)) is not None]
    detail = next((row.detail for row in known.support if row.detail), "")
    proof = Certificate.bundle([(f"they exclude each other{detail}", known.certificate), *proofs])
    return Conflict(labels, len(proofs) == len(labels) or len(labels) == 1, proof)


# --- free durations -----------------------------------------------------------------------------------------
_FIRST, _LAST = 1.6, 1.03
"""Factors by which durations are changed, the largest and the smallest one."""
_MOST = 400
"""Chains that are looked at."""
_GRID = 1000


def timed(chain: Chain) -> Chain:
    """The chain with durations of the given sum, as good as a search by coordinates in floating point finds them, from
    three usual choices: the least value is no convex function of the durations."""
    assert chain.free_total is not None
    lengths = [float(sum((y - x) ** 2 for x, y in zip(a, b, strict=True))) ** 0.5 for a, b in pairwise(chain.corners)]
    starts = [[size**power for size in lengths] for power in (0.0, 0.5, 1.0)]
    value, times = min((_value(chain, s), s) for s in starts)
    factor, looked = _FIRST, len(starts)
    while factor > _LAST and looked < _MOST:
        better = False
        for k in range(chain.pieces):
            for change in (factor, 1 / factor):
                other = [t * change if i == k else t for i, t in enumerate(times)]
                looked += 1
                if (new := _value(chain, other)) < value * (1 - 1e-9):
                    value, times, better = new, other, True
                    break
        factor = factor if better else factor**0.5
    return _lasting(chain, times)


def _lasting(chain: Chain, times: Sequence[float]) -> Chain:
    """The chain with durations in this proportion."""
    whole = [max(1, round(_GRID * chain.pieces * t / sum(times))) for t in times]
    total = chain.free_total or Fraction(1)
    return replace(chain, durations=tuple(total * n / sum(whole) for n in whole), free_total=None)


def _value(chain: Chain, times: Sequence[float]) -> float:
    """The least value of the objective; where there is no chain a large number, larger where more is missing."""
    other = _lasting(chain, times)
    if (solved := other.solved).joins:
        return float("inf")
    rows = requirements(other, solved)
    varying, objective = [row for row in rows if not row.form.is_constant], objective_form(other, solved)
    lowest = objective.minimum(solved.size, chain.dimension)
    if lowest is not None and all(row.form.value(lowest[0]) <= 0 for row in rows):
        return float(lowest[1])
    excess = proposals.best(other, solved.size, varying) if varying else None
    if excess is None or excess.excess > 0:
        return 1e12 * (1 + (1e3 if excess is None else excess.excess))
    proposal = proposals.best(other, solved.size, varying, objective)
    if proposal is None:
        return 1e12
    return float(objective.value(tuple(tuple(map(Fraction, p)) for p in proposal.point)))
