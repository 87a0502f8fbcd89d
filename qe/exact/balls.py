"""Ball arithmetic helpers: working precision, exact ends, comparison that says only what is certain."""

from __future__ import annotations

from fractions import Fraction

from flint import arb, ctx, fmpq

FIRST_PRECISION = 64
EXACT_FROM = 128  # bits from which a ball that still contains zero is worth an exact zero test


class precision:
    """Run the body at this working precision (FLINT's is process-wide, so it is always restored)."""

    __slots__ = ("bits", "saved")

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def __enter__(self) -> None:
        self.saved = ctx.prec
        ctx.prec = self.bits

    def __exit__(self, *exception: object) -> None:
        ctx.prec = self.saved


def ball_sign(x: arb) -> int | None:
    """-1, 1, or 0 (only for an exact zero); None when the ball does not tell."""
    if x > 0:
        return 1
    if x < 0:
        return -1
    return 0 if x.is_zero() else None


def lower_end(x: arb) -> fmpq:
    """The lower end of a finite ball, exactly: rounded to a working precision, disjoint balls could share an end."""
    return x.mid().fmpq() - x.rad().fmpq()


def upper_end(x: arb) -> fmpq:
    """The upper end of a finite ball, exactly."""
    return x.mid().fmpq() + x.rad().fmpq()


def ends(x: arb) -> tuple[Fraction, Fraction]:
    """Both ends of a finite ball, as Python's numbers."""
    low, high = lower_end(x), upper_end(x)
    return Fraction(int(low.p), int(low.q)), Fraction(int(high.p), int(high.q))


def hull(lo: fmpq, hi: fmpq) -> arb:
    """A ball that contains the interval [lo, hi]."""
    return arb(lo).union(arb(hi))
