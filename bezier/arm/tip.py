"""Where the end point of an arm, and the origins of its frames, are while its joints move as polynomials of the time:
polynomials again, and how far the points are from them at most.

THEOREM (Taylor's, with the remainder of Lagrange). For a function f that is smooth on [m - r, m + r],

    f(m + v) = f_0(m) + f_1(m) v + ... + f_n(m) v^n + f_{n+1}(ξ) v^{n+1},    f_k(ξ) the k-th derivative at ξ over k!,

for some ξ in the interval. Arithmetic of power series over balls gives all f_k(m), and with the interval in place of m
a ball around all f_{n+1}(ξ) (Moore, Methods and Applications of Interval Analysis, 1979, section 3.4). Coordinates of
the end point are smooth everywhere: they are polynomials in cosines and sines of polynomials.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import takewhile

from flint import arb_series

from bezier.arm.model import Arm
from bezier.proofs.course import around, ball, radius_above
from bezier.proofs.square_roots import STILL, Surd, carried, image
from bezier.trajectories.piecewise import Row, Trajectory
from qe.errors import InputError, Unable
from qe.exact.balls import precision
from qe.exact.rational_poly import RationalPoly

DEGREE, BITS = 7, 96
SHORTEST = Fraction(1, 1 << 30)
"""Of a piece, as a part of it."""


def axes_of(arm: Arm, names: Sequence[str]) -> list[int]:
    """For each joint the axis of that name; in their order where the axes have no names but q1, q2, … Raises
    ``InputError`` for others."""
    joints, plain = [joint.name for joint in arm.joints], [re.sub(r"\W", "_", name) for name in names]
    if sorted(plain) == sorted(joints):
        return [plain.index(name) for name in joints]
    if plain == [f"q{k + 1}" for k in range(len(joints))]:
        return list(range(len(joints)))
    raise InputError(f"trajectory: expected the axes {', '.join(joints)} of the arm, found {', '.join(names)}")


def tip_of(arm: Arm, joints: Trajectory, error: Fraction) -> Trajectory:
    """Polynomials x, y, z (mm) from which the end point is nowhere ``error`` away. Raises ``Unable``."""
    return frames_of(arm, joints, error, [len(arm.rows)])[0]


def frames_of(arm: Arm, joints: Trajectory, error: Fraction, numbers: Iterable[int]) -> list[Trajectory]:
    """The same of the origins of the frames behind so many rows, on the same pieces."""
    chains, axes = [_Chain(replace(arm, rows=arm.rows[:k])) for k in numbers], axes_of(arm, joints.names)
    breaks, pieces = [joints.breaks[0]], list[list[Row]]()
    for start, length, row in zip(joints.breaks, joints.lengths, joints.pieces, strict=False):
        for end, polys in _pieces(chains, [row[k] for k in axes], length, error):
            breaks.append(start + end)
            pieces.append(polys)
    return [Trajectory(("x", "y", "z"), tuple(breaks), rows) for rows in zip(*pieces, strict=True)]


def is_fixed(arm: Arm, number: int) -> bool:
    """Whether the origin of the frame behind so many rows stays where it is: it is on the axis of each joint before."""
    chain = replace(arm, rows=arm.rows[:number]).chain
    place = STILL[1]
    for link, turns in zip(chain.constants[:0:-1], chain.turns[::-1], strict=True):
        place = image(link, place)
        if not turns or any(place[:2]):
            return False
    return True


def _pieces(
    chains: Sequence[_Chain], q: Row | list[RationalPoly], length: Fraction, error: Fraction
) -> Iterator[tuple[Fraction, list[Row]]]:
    """The ends of intervals, with the polynomials from the end before."""
    todo, low = [length], Fraction(0)
    while todo:
        known = (chain.polynomials(q, low, todo[-1], error) for chain in chains)
        polys = [row for row in takewhile(bool, known) if row]
        if len(polys) == len(chains):
            low = todo.pop()
            yield low, polys
        elif todo[-1] - low < SHORTEST * length:
            raise Unable(f"the arm is not enclosed within {float(error):.3g} mm")
        else:
            todo.append((low + todo[-1]) / 2)


class _Chain:
    """The arm in ball arithmetic."""

    def __init__(self, arm: Arm) -> None:
        with precision(BITS):
            self.base, *self.links = arm.chain.in_numbers(Surd.ball)
        self.turns = arm.chain.turns

    def polynomials(self, q: Sequence[RationalPoly], low: Fraction, high: Fraction, error: Fraction) -> Row | None:
        """By the time since ``low``, closer to the end point than ``error`` until ``high``; None where they are not."""
        half = round((high - low) * 64 / _power_below(high - low)) * _power_below(high - low) / 128  # of few digits
        r, far, result = max(half, high - low - half), Fraction(0), list[RationalPoly]()
        with precision(BITS):
            near = self._tip(q, arb_series([ball(low + half), 1], prec=DEGREE + 1))
            whole = self._tip(q, arb_series([ball(low + half) + around(r), 1], prec=DEGREE + 2))
            for p, rest in zip(near, whole, strict=True):
                rounded = list[Fraction]()
                for k in range(DEGREE + 1):
                    unit, middle = _power_below(error / (64 * r**k)), p[k].mid().fmpq()
                    rounded.append(round(Fraction(int(middle.p), int(middle.q)) / unit) * unit)
                    far += radius_above(p[k] - ball(rounded[-1])) * r**k
                far += radius_above(rest[DEGREE + 1]) * r ** (DEGREE + 1)
                result.append(RationalPoly.of(rounded).compose(RationalPoly.of([-half, 1])))
        return tuple(result) if far < error else None

    def _tip(self, q: Sequence[RationalPoly], t: arb_series) -> list[arb_series]:
        """The end point with the joints at q(t)."""
        values = list[tuple[arb_series, ...]]()
        for turns, poly in zip(self.turns, q, strict=False):
            value = arb_series([0], prec=t.prec)
            for c in reversed(poly.coefficients()):
                value = value * t + ball(c)
            values.append((value.cos(), value.sin()) if turns else (value,))
        return list(image(self.base, carried(self.links, values, [arb_series([0], prec=t.prec)] * 3)))


def _power_below(value: Fraction) -> Fraction:
    """A power of two, at most the value and more than a quarter of it."""
    return Fraction(2) ** (value.numerator.bit_length() - value.denominator.bit_length() - 1)
