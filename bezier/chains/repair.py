"""What change makes an infeasible chain possible: another radius, one point elsewhere, another velocity at one end, one
duration. Each is proved to be enough by a chain, and each comes with one that is proved not to be; or all of a kind are
proved not to help.

The distance by which a point or velocity has to move is a convex problem, so both sides are those of its least value.
The radius is one, too. Durations are not: a duration is looked for among some, and the one that is proved not to be
enough is nearer to the given one, but others yet nearer are not excluded. What excludes the chains that lack the joins
of one curve excludes all durations of it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import copysign, exp
from typing import Any

from bezier.chains.chain import Chain, requirements
from bezier.chains.proof import GAPS, LEAST, Contradiction, best, decided, feasible
from bezier.chains.proposals import loosened
from bezier.chains.region import Places, at_label
from qe.errors import Unable
from qe.proof.certificate import Certificate, Labelled

NARROW = Fraction(1, 10**7)
"""How far, relative, the values that are proved to be enough, and not enough, lie from the one that was proposed."""
_GAPS = (*GAPS, Fraction(1, 20), Fraction(1, 2))  # of the square of a distance, which may be small
_FAR, _CLOSE, _STEPS = 2.1, 1e-7, 20  # of logarithms of factors of durations


@dataclass(frozen=True, slots=True)
class Repair:
    """``change`` ("radius", "start", "via[2]", "velocities[0]", "durations[0]"): with this ``value`` there is a chain,
    and with ``too_small`` there is none (of a point or velocity: the square of a distance below which no place is near
    enough). ``certificate`` proves both."""

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
    if (change == "radius" or change in chain.paces) and (len(value) != 1 or value[0] <= 0):
        raise ValueError("one number above 0 expected")
    if change == "radius":
        return replace(chain, radius_squared=value[0] ** 2)
    if change == "durations":
        return replace(chain, durations=tuple(value), free_total=None)
    if matched := re.fullmatch(r"durations\[(\d+)\]", change):
        return replace(chain, durations=_with(chain.times, int(matched[1]), value[0]))
    if matched := re.fullmatch(r"velocities\[([01])\]", change):
        zero = (Fraction(0),) * chain.dimension
        return replace(chain, velocities=_with(chain.velocities or (zero, zero), int(matched[1]), tuple(value)))
    return replace(chain, points=_with(chain.points, chain.point_names.index(change), tuple(value)))


def _with(values: Sequence[Any], place: int, value: Any) -> tuple[Any, ...]:
    return *values[:place], value, *values[place + 1 :]


def both_sides(chain: Chain, change: str, enough: Fraction, less: Fraction) -> Repair | None:
    """With one number there is a chain, with the other there is none, if that can be proved."""
    sides = [changed(chain, change, (value,)) for value in (enough, less)]
    rows = [requirements(side, side.solved) for side in sides]
    try:
        inside, none = (decided(side, side.solved, listed) for side, listed in zip(sides, rows, strict=True))
    except Unable:
        return None
    if isinstance(inside, Contradiction) or not isinstance(none, Contradiction):
        return None
    proof = feasible(sides[0], sides[0].solved, rows[0], inside)
    enough_proved = f"possible with {change} = {enough}", proof
    less_proved = f"impossible with {change} = {less}", none.certificate
    return Repair(change, (enough,), less, Certificate.bundle([enough_proved, less_proved]))


def least_radius(given: Chain) -> Repair | None:
    """The least radius with which there is a chain, from both sides."""
    loose = None if given.radius_squared is None else loosened(given, "radius")
    if given.radius_squared is None or loose is None:
        return None
    wanted = Fraction(float(given.radius_squared) ** 0.5 + loose.excess)
    return both_sides(given, "radius", wanted * (1 + NARROW), wanted * (1 - NARROW))


def nearest(given: Chain, names: Sequence[str]) -> Repair | None:
    """Which of these points or velocities has to move least, and where to; that it is the one is not proved."""
    start = loosened(given)
    todo = [(0.0 if start is None else start.change(name), False, name) for name in names]
    while todo := sorted(todo):  # first what has to move least; the excess is convex, so slopes give bounds from below
        _, is_known, name = todo.pop(0)
        if not is_known:
            moved = loosened(given, name)
            todo += [] if moved is None else [(moved.excess, True, name)]
            continue
        try:
            places = Places.of(given, name)
            least = best(places.chain, places.solved, places.rows, places.inside, _GAPS)
        except Unable:
            continue
        corner = places.place.at(least.free)
        member = next(m for m in least.certificate.payload if isinstance(m, Labelled) and m.label.startswith(LEAST))
        labelled = [(f"{member.label} with {name} free", member.certificate)]
        labelled.append((at_label(name, corner), places.witness(corner, least.free)))
        return Repair(name, corner, least.bound, Certificate.bundle(labelled))
    return None


def excluded(given: Chain, names: Sequence[str]) -> tuple[tuple[str, Contradiction], ...]:
    """That no other value of one of these helps; none where that cannot be proved of all."""
    proofs = []
    for name in names:
        chain = replace(given, free=name)
        try:
            none = decided(chain, chain.solved, requirements(chain, chain.solved))
        except Unable:
            return ()
        if not isinstance(none, Contradiction):
            return ()
        proofs.append((f"impossible with {name} free", none))
    return tuple(proofs)


def nearest_duration(given: Chain) -> Repair | None:
    """One curve made slower or faster by the least factor that was seen to help."""
    start, seen = loosened(given), list[tuple[float, int, float]]()
    named = [] if start is None else [(start.change(name), k) for k, name in enumerate(given.paces)]
    for far, k in sorted(named):
        if far > 2 * min(seen, default=(_FAR,))[0]:
            break
        if (log := _logarithm(given, k)) is not None:
            seen.append((abs(log), k, log))
    for _, k, log in sorted(seen):
        high, low = (_paced(given, k, log + side * copysign(1e-6, log)).times[k] for side in (1, -1))
        if (repair := both_sides(given, f"durations[{k}]", high, low)) is not None:
            return repair
    return None


def _logarithm(given: Chain, k: int) -> float | None:
    """That of the factor of a duration from which on nothing has to be given up, by Newton's method; None where there
    is none nearby."""
    log, last, steps = 0.0, 0.0, 0
    while abs(log) < _FAR and steps < _STEPS:
        loose = loosened(_paced(given, k, log))
        slope = 0.0 if loose is None else loose.slopes[given.paces[k]]
        if loose is None or not slope or (loose.excess > 0 and slope * last < 0):
            return None
        log, last, steps = log + loose.excess / slope, slope, steps + 1
        if abs(loose.excess / slope) < _CLOSE:
            return log
    return None


def _paced(given: Chain, k: int, log: float) -> Chain:
    time = given.times[k] * Fraction(exp(log)).limit_denominator(10**9)
    return replace(given, durations=_with(given.times, k, time))
