"""``bezier.chain``: a chain of curves through any number of via points, with proof, or why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from bezier.chains import proposals
from bezier.chains.chain import Chain, Requirement, Solved, requirements
from bezier.chains.proof import Best, Contradiction, best, decided, feasible
from bezier.curves.curve import Bezier
from qe.errors import Unable
from qe.proof.certificate import Certificate

NARROW = Fraction(1, 10**7)
"""How far, relative, the radii that are proved to be enough, and not enough, lie from the one that was proposed."""


@dataclass(frozen=True, slots=True)
class Repair:
    """With ``radius`` there is a chain, with ``too_small`` there is none; ``certificate`` proves both."""

    radius: Fraction
    too_small: Fraction
    certificate: Certificate


@dataclass(frozen=True, slots=True)
class Conflict:
    """Conditions that exclude each other; ``smallest``: all of them but any one do not. ``certificate`` proves both."""

    conditions: tuple[str, ...]
    smallest: bool
    certificate: Certificate


@dataclass(frozen=True, slots=True)
class ChainPlan:
    """``curves``: with the least value of the objective, which lies between ``bound`` and ``value`` (rational, at most
    a billionth of it apart); empty where there is no chain. Then ``conflict`` says why, and ``repair`` which radius
    helps (None: there is no ball, or none helps). ``certificate``: of the optimum, or of the contradiction."""

    chain: Chain
    curves: tuple[Bezier, ...]
    value: Fraction | None
    bound: Fraction | None
    certificate: Certificate
    conflict: Conflict | None = None
    repair: Repair | None = None

    @property
    def feasible(self) -> bool:
        """Whether there is a chain."""
        return self.value is not None

    def __str__(self) -> str:
        if self.value is not None:
            return f"{len(self.curves)} curves, objective {float(self.value):.12g}, proved to a billionth"
        assert self.conflict is not None
        why = f"no chain: {', '.join(self.conflict.conditions)} exclude each other"
        return why if self.repair is None else f"{why}; with radius {float(self.repair.radius):.10g} there is one"


def planned(given: Chain) -> ChainPlan:
    """The best chain, or why there is none. Raises ``Unable``."""
    solved = given.solved
    if solved is None:
        raise Unable("the joins and the ends leave no chain: their equations contradict each other")
    rows = requirements(given, solved)
    inside = decided(given, solved, rows)
    if not isinstance(inside, Contradiction):
        found: Best = best(given, solved, rows, inside)
        return ChainPlan(given, solved.curves(found.free), found.value, found.bound, found.certificate)
    conflict = smallest_conflict(given, solved, inside)
    return ChainPlan(given, (), None, None, inside.certificate, conflict, least_radius(given, solved, rows))


def smallest_conflict(given: Chain, solved: Solved, known: Contradiction) -> Conflict:
    """Conditions are left out one by one, as long as the others still exclude each other (deletion filter; Chinneck,
    Dravnieks, ORSA Journal on Computing 3, 1991). Raises ``Unable``."""
    needed: dict[str, Certificate | None] = {}
    while (row := next((r for r in known.support if r.label not in needed), None)) is not None:
        others = [r for r in known.support if r is not row]
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
    proofs = [(f"without {label}", proof) for label in labels if (proof := needed[label]) is not None]
    proof = Certificate.bundle([("they exclude each other", known.certificate), *proofs])
    return Conflict(labels, len(proofs) == len(labels), proof)


def least_radius(given: Chain, solved: Solved, rows: Sequence[Requirement]) -> Repair | None:
    """The least radius with which there is a chain, from both sides."""
    if given.radius_squared is None:
        return None
    free = [row for row in rows if not row.form.is_constant]
    proposal = proposals.least_excess(given, solved.size, free, balls_only=True) if free else None
    fixed = [row.form.constant for row in rows if row.form.is_constant and row.is_ball]
    farthest = float(max(fixed, default=Fraction(0)) + given.radius_squared) ** 0.5
    wanted = max(float(given.radius_squared) ** 0.5 + (proposal.excess if proposal else 0.0), farthest)
    sides = [replace(given, radius_squared=(Fraction(wanted) * (1 + s * NARROW)) ** 2) for s in (1, -1)]
    try:
        enough, less = (decided(side, solved, requirements(side, solved)) for side in sides)
    except Unable:
        return None
    if isinstance(enough, Contradiction) or not isinstance(less, Contradiction):
        return None
    proof = feasible(sides[0], solved, requirements(sides[0], solved), enough)
    bundle = Certificate.bundle([("with the radius", proof), ("with less", less.certificate)])
    return Repair(Fraction(wanted) * (1 + NARROW), Fraction(wanted) * (1 - NARROW), bundle)
