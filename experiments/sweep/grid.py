"""The grid of a sweep: via points (-d, 0, k) and (d, 0, k), radius r, method.

THEOREM: formula (8) has a solution iff the smallest circle around O, Q0, R0 has a radius <= r/2. Hence the
feasible part of the (d, k) plane is bounded by d = r/2 for k <= d, where the triangle is obtuse or right, and by
d^2 + k^2 = r k for k >= d.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from qe.errors import InputError


class Method(Enum):
    """QUADRATIC: formula (8), feasible or not, and the volume of its region. CUBIC: the objective of (7)."""

    QUADRATIC = "quadratic"
    CUBIC = "cubic"


@dataclass(frozen=True, slots=True)
class Task:
    """One problem: via points at a distance of 2 ``half_width``, at ``height``, in a ball of this radius."""

    half_width: Fraction
    height: Fraction
    radius: Fraction
    method: Method

    @property
    def key(self) -> str:
        """Its name in files."""
        return f"{self.method.value} d={self.half_width} k={self.height} r={self.radius}"

    @property
    def is_problem(self) -> bool:
        """Whether the via points lie in the ball, which the paper's radius rule asks for."""
        return self.half_width**2 + self.height**2 <= self.radius**2


def grid(
    half_widths: Iterable[Fraction], heights: Iterable[Fraction], radii: Iterable[Fraction], methods: Iterable[Method]
) -> list[Task]:
    """All problems of the grid, each once."""
    tasks = (Task(d, k, r, m) for r, d, k, m in itertools.product(radii, half_widths, heights, methods))
    return [task for task in dict.fromkeys(tasks) if task.is_problem]


def values(text: str, name: str) -> tuple[Fraction, ...]:
    """``1/4,1/2,3`` or ``FIRST:LAST:COUNT``, positive; ``InputError`` names the option otherwise."""
    try:
        if ":" in text:
            first, last, count = text.split(":")
            low, high, steps = Fraction(first), Fraction(last), int(count)
            found = tuple(low + (high - low) * i / max(steps - 1, 1) for i in range(steps))
        else:
            found = tuple(Fraction(part) for part in text.split(","))
    except (ValueError, ZeroDivisionError):
        found = ()
    if not found or min(found) <= 0:
        raise InputError(f"{name}: positive numbers A,B,... or FIRST:LAST:COUNT expected, {text!r} found")
    return found
