"""Values of joints at an exact point: an angle or a length, in balls as narrow as one likes."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from bezier.arm.elimination import Quotient
from qe.exact.point_values import Ball, Evaluation, angle

Ends = tuple[Fraction, Fraction]
Known = tuple[Quotient, ...]
"""Cosine and sine of a joint that turns, or the length of one that slides."""

BITS = 64


@dataclass(frozen=True, slots=True, eq=False)
class Value:
    """One joint of one solution: its angle in (-pi, pi] (rad) or its length (mm), in a ball at most 2^-60 wide, and
    cosine and sine of an angle."""

    ball: Ball
    pair: tuple[Ball, Ball] | None = None

    def __float__(self) -> float:
        return float(self.ball)

    @property
    def ends(self) -> Ends:
        """An interval around the angle or the length."""
        return self.ball.ends

    def fixed(self, places: int) -> str:
        """The angle or the length with so many decimal places."""
        digits = round(sum(self.ends) / 2 * 10**places)
        whole, part = divmod(abs(digits), 10**places)
        return f"{'-' if digits < 0 else ''}{whole}.{part:0{places}d}"

    def meets(self, other: Value) -> bool:
        """Whether the balls leave it open that both are the same: those of cosine and sine, or of the length."""
        pairs = zip(self.pair or (self.ball,), other.pair or (other.ball,), strict=True)
        return all(a.ends[0] <= b.ends[1] and b.ends[0] <= a.ends[1] for a, b in pairs)

    @property
    def cosine(self) -> Ends | None:
        """An interval around the cosine; None for a length."""
        return None if self.pair is None else self.pair[0].ends

    @property
    def sine(self) -> Ends | None:
        """An interval around the sine; None for a length."""
        return None if self.pair is None else self.pair[1].ends


def value_of(here: Evaluation, quotients: Known, bits: int) -> Value:
    """A joint at a point: from its cosine and sine, or from its length alone."""
    if len(quotients) == 1:
        return Value(quotients[0].at(here, bits))
    pair = quotients[0].at(here, bits), quotients[1].at(here, bits)
    return Value(angle(*pair, bits), pair)
