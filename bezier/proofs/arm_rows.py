"""Arms, points and boxes of joint positions as evidence holds them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from bezier.proofs import square_roots as sr
from bezier.proofs.square_roots import STILL, ZERO, Interval, Motion, Surd, Triple, back, together, turn
from qe.errors import Unable
from qe.proof.entry import Entry

MOST_ROWS, MOST_TERMS, MOST_BITS = 40, 16, 20_000
Box = tuple[Interval, ...]
"""Cosine and sine, or the length, of a joint."""
Pair = tuple[Surd, Surd]
Row = tuple[Surd, Pair, Surd, Pair, bool | None]
"""a, alpha, d, theta (cosines and sines), and whether the joint of the row turns; None where there is none."""


@dataclass(frozen=True, slots=True)
class ArmChain:
    """``constants``: what lies before, between and after the joints; ``turns``: which joints turn (others slide)."""

    constants: tuple[Motion, ...]
    turns: tuple[bool, ...]

    @staticmethod
    def of(modified: bool, rows: Iterable[Row]) -> ArmChain:
        """Of rows in the modified or the standard convention (Craig, section 3.5)."""
        constants, turns, open_part = list[Motion](), list[bool](), STILL
        for a, alpha, d, theta, turning in rows:
            across, along = turn((1, 2), alpha, (a, ZERO, ZERO)), turn((0, 1), theta, (ZERO, ZERO, d))
            before, after = (across, along) if modified else (STILL, together(along, across))
            open_part = together(open_part, before)
            if turning is not None:
                constants.append(open_part)
                turns.append(turning)
                open_part = STILL
            open_part = together(open_part, after)
        return ArmChain((*constants, open_part), tuple(turns))

    @property
    def reversed(self) -> ArmChain:
        """Read from the hand to the base: every joint goes the other way."""
        return ArmChain(tuple(back(m) for m in self.constants[::-1]), self.turns[::-1])

    def in_numbers(self, number: Callable[[Surd], Any]) -> list[Any]:
        """The constant motions in numbers of another kind."""
        return [([list(map(number, row)) for row in rows], list(map(number, o))) for rows, o in self.constants]


def read_chain(entry: Entry) -> ArmChain:
    """The rows of an arm."""
    convention, rows = entry.fields("convention", "rows")
    modified = convention.text() == "modified"
    if not modified and convention.text() != "standard":
        raise convention.fail("expected modified or standard")
    listed = list(rows.items())
    if len(listed) > MOST_ROWS:
        raise rows.fail(f"expected at most {MOST_ROWS} rows")
    return ArmChain.of(modified, map(_row, listed))


def _row(row: Entry) -> Row:
    a, alpha, d, theta, joint = row.fields("a", "alpha", "d", "theta", "joint")
    if joint.value is not None and joint.text() not in ("revolute", "prismatic"):
        raise joint.fail("expected null, revolute or prismatic")
    turning = None if joint.value is None else joint.text() == "revolute"
    return _rational(a), _angle(alpha), _rational(d), _angle(theta), turning


def _angle(entry: Entry) -> Pair:
    """An integer k for k pi / 12, or [cosine, sine]."""
    if isinstance(entry.value, int) and not isinstance(entry.value, bool):
        if abs(entry.value) > 24:
            raise entry.fail("expected at most 24 twelfths of pi")
        return cosine_of(entry.value), cosine_of(entry.value - 6)
    c, s = read_circle(entry)
    return Surd.rational(c), Surd.rational(s)


def read_circle(entry: Entry) -> tuple[Fraction, Fraction]:
    """Cosine and sine of an angle."""
    values = [read_number(v) for v in entry.items()]
    if len(values) != 2 or values[0] ** 2 + values[1] ** 2 != 1:
        raise entry.fail("expected cosine and sine")
    return values[0], values[1]


def cosine_of(k: int) -> Surd:
    """cos(k pi / 12)."""
    k = abs(k) % 24
    k = min(k, 24 - k)
    if k > 6:
        return -cosine_of(12 - k)
    quarter, half = Fraction(1, 4), Fraction(1, 2)
    return Surd.of(
        (
            ((1, Fraction(1)),),
            ((2, quarter), (6, quarter)),
            ((3, half),),
            ((2, half),),
            ((1, half),),
            ((2, -quarter), (6, quarter)),
            (),
        )[k]
    )


def _rational(entry: Entry) -> Surd:
    return Surd.rational(read_number(entry))


def read_number(entry: Entry) -> Fraction:
    """A rational number that is not too long."""
    value = entry.rational()
    if max(value.numerator.bit_length(), value.denominator.bit_length()) > MOST_BITS:
        raise Unable(f"{entry.path}: a number of more than {MOST_BITS} bits")
    return value


def read_triple(entry: Entry) -> Triple:
    """Three numbers, each a list of [q, d]: the sum of q √d, d squarefree."""
    result = tuple(read_surd(c) for c in entry.items())
    if len(result) != 3:
        raise entry.fail("expected three numbers")
    return result


def read_surd(entry: Entry) -> Surd:
    """A number as a list of [q, d]: the sum of q √d, d squarefree."""
    pairs = list[tuple[int, Fraction]]()
    for item in entry.items():
        parts = list(item.items())
        if len(parts) != 2 or len(pairs) == MOST_TERMS:
            raise item.fail(f"expected at most {MOST_TERMS} pairs of a factor and a number under a root")
        q, d = read_number(parts[0]), parts[1].integer(1)
        if d > sr.LARGEST:
            raise Unable(f"{item.path}: a root of more than {sr.LARGEST}")
        if not sr.is_squarefree(d):
            raise item.fail("expected a squarefree number under the root")
        pairs.append((d, q))
    return Surd.of(pairs)


def read_joint(entry: Entry, turning: bool) -> Box:
    """[[low, high] of cosine, [low, high] of sine] of a joint that turns, [[low, high] of the length] of others."""
    parts = [[read_number(v) for v in part.items()] for part in entry.items()]
    if [len(ends) for ends in parts] != [2] * (1 + turning):
        raise entry.fail("expected two ends of cosine and sine" if turning else "expected two ends of a length")
    return tuple((low, high) for low, high in parts)
