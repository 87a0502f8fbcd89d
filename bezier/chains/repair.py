"""What change makes an infeasible chain possible: another radius, one point elsewhere, one duration. Each is proved to
be enough by a chain, and each comes with one that is proved not to be.

The distance by which a point has to move is a convex problem, so both sides are those of its least value. The radius
is one, too. Durations are not: a duration is looked for among some, and the one that is proved not to be enough is
nearer to the given one, but others yet nearer are not excluded.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from bezier.chains import proposals
from bezier.chains.chain import Chain, Requirement, Solved, objective_form, requirements
from bezier.chains.proof import GAPS, Best, Contradiction, best, decided, feasible
from qe.errors import Unable
from qe.proof.certificate import Certificate

NARROW = Fraction(1, 10**7)
"""How far, relative, the values that are proved to be enough, and not enough, lie from the one that was proposed."""
_FACTORS = (1.25, 1.5, 2.0, 3.0, 4.0, 8.0)  # of a duration
_GAPS = (*GAPS, Fraction(1, 20), Fraction(1, 2))  # of the square of a distance, which may be small
_TOLERANCE = 1e-7  # of conditions, in floating point, in proportion to the room


@dataclass(frozen=True, slots=True)
class Repair:
    """``change`` ("radius", "start", "via[2]", "durations[0]"): with this ``value`` there is a chain, and with
    ``too_small`` there is none (of a point: the square of a distance below which no place is near enough).
    ``certificate`` proves both."""

    change: str
    value: tuple[Fraction, ...]
    too_small: Fraction
    certificate: Certificate

    @property
    def radius(self) -> Fraction:
        """The number that is enough; of the radius that radius."""
        return self.value[0]

    def __str__(self) -> str:
        numbers = [f"{float(c):.10g}" for c in self.value]
        return f"{self.change} = " + (numbers[0] if len(numbers) == 1 else f"({', '.join(numbers)})")


def changed(chain: Chain, change: str, value: Sequence[Fraction]) -> Chain:
    """The chain with this radius, point or duration. Raises ``InputError`` or ``ValueError`` for what is none."""
    if change == "radius":
        return replace(chain, radius_squared=value[0] ** 2)
    if change == "durations":
        return replace(chain, durations=tuple(value), free_total=None)
    if matched := re.fullmatch(r"durations\[(\d+)\]", change):
        times = list(chain.times)
        times[int(matched[1])] = value[0]
        return replace(chain, durations=tuple(times))
    points = list(chain.points)
    points[chain.point_names.index(change)] = tuple(value)
    return replace(chain, points=tuple(points))


def both_sides(chain: Chain, change: str, enough: Fraction, less: Fraction) -> Repair | None:
    """With one number there is a chain, with the other there is none, if that can be proved."""
    sides = [changed(chain, change, (value,)) for value in (enough, less)]
    solved = [side.solved for side in sides]
    if solved[0] is None or solved[1] is None:
        return None
    try:
        inside, none = (decided(c, s, requirements(c, s)) for c, s in zip(sides, solved, strict=True) if s is not None)
    except Unable:
        return None
    if isinstance(inside, Contradiction) or not isinstance(none, Contradiction):
        return None
    proof = feasible(sides[0], solved[0], requirements(sides[0], solved[0]), inside)
    labels = [f"possible with {change} = {enough}", f"impossible with {change} = {less}"]
    return Repair(
        change, (enough,), less, Certificate.bundle(list(zip(labels, (proof, none.certificate), strict=True)))
    )


def least_radius(given: Chain, solved: Solved, rows: Sequence[Requirement]) -> Repair | None:
    """The least radius with which there is a chain, from both sides."""
    if given.radius_squared is None:
        return None
    free = [row for row in rows if not row.form.is_constant]
    proposal = proposals.least_excess(given, solved.size, free, balls_only=True) if free else None
    fixed = [row.form.constant for row in rows if row.form.is_constant and row.is_ball]
    farthest = float(max(fixed, default=Fraction(0)) + given.radius_squared) ** 0.5
    wanted = Fraction(max(float(given.radius_squared) ** 0.5 + (proposal.excess if proposal else 0.0), farthest))
    return both_sides(given, "radius", wanted * (1 + NARROW), wanted * (1 - NARROW))


def nearest_point(given: Chain) -> Repair | None:
    """The point that has to move least, and where to. That no other point could move by less is not proved."""
    moves = sorted(_moves(given))
    for _, k in moves:
        try:
            solved, best = _best_move(replace(given, free_via=k))
        except Unable:
            continue
        corner = solved.controls[k % given.pieces][0 if k < given.pieces else -1].at(best.free)
        name = given.point_names[k]
        members = best.certificate.payload
        assert isinstance(members, tuple)
        labelled = [(f"{m.label} with {name} free", m.certificate) for m in members]
        return Repair(name, corner, best.bound, Certificate.bundle(labelled))
    return None


def _best_move(freed: Chain) -> tuple[Solved, Best]:
    solved = freed.solved
    if solved is None:
        raise Unable("no chain")
    rows = requirements(freed, solved)
    inside = decided(freed, solved, rows)
    if isinstance(inside, Contradiction):
        raise Unable("moving this point does not help")
    return solved, best(freed, solved, rows, inside, _GAPS)


def _moves(given: Chain) -> Iterator[tuple[float, int]]:
    """The squares of the distances, in floating point, by which points have to move."""
    for k in range(len(given.points)):
        freed = replace(given, free_via=k)
        if (solved := freed.solved) is None:
            continue
        rows = requirements(freed, solved)
        varying = [row for row in rows if not row.form.is_constant]
        if any(row.form.constant > 0 for row in rows if row.form.is_constant):
            continue
        objective = objective_form(freed, solved)
        proposal = proposals.least_value(freed, solved.size, varying, objective)
        if proposal is not None and _holds(varying, proposal):
            point = tuple(tuple(Fraction(c) for c in p) for p in proposal.point)
            yield float(objective.value(point)), k


def _holds(rows: Sequence[Requirement], proposal: proposals.Proposal) -> bool:
    point = tuple(tuple(Fraction(c) for c in p) for p in proposal.point)
    return all(row.form.value(point) <= _TOLERANCE * max(1.0, abs(float(row.form.constant))) for row in rows)


def nearest_duration(given: Chain, pieces: Sequence[int]) -> Repair | None:
    """One of these curves made slower or faster by the least factor that was seen to help."""
    seen = []
    for k in pieces:
        for sign in (1, -1):
            before = 1.0
            for factor in _FACTORS:
                if _excess(given, k, factor**sign) <= 0:
                    seen.append((_threshold(given, k, before, factor, sign), sign, k))
                    break
                before = factor
    for factor, sign, k in sorted(seen):
        time = given.times[k]
        low, high = (time * Fraction(factor * (1 + s * 1e-6)).limit_denominator(10**9) ** sign for s in (-1, 1))
        if (repair := both_sides(given, f"durations[{k}]", high, low)) is not None:
            return repair
    return None


def _threshold(given: Chain, k: int, low: float, high: float, sign: int) -> float:
    """Where between a factor that does not help and one that does the first help begins, by bisection."""
    while high - low > 1e-8 * high:
        middle = (low + high) / 2
        low, high = (low, middle) if _excess(given, k, middle**sign) <= 0 else (middle, high)
    return high


def _excess(given: Chain, k: int, factor: float) -> float:
    times = list(given.times)
    times[k] *= Fraction(factor).limit_denominator(10**12)
    other = replace(given, durations=tuple(times))
    if (solved := other.solved) is None:
        return 1.0
    rows = requirements(other, solved)
    if any(row.form.is_constant and row.form.constant > 0 for row in rows):
        return 1.0
    proposal = proposals.least_excess(other, solved.size, [row for row in rows if not row.form.is_constant])
    return 1.0 if proposal is None else proposal.excess
