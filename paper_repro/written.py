"""The paper's formulas as text in the engine's syntax.

Control points are written as vectors (``p1 = 2*q0 - q1``) and put into coordinates (``p1x``, ``p1y``, ...) here.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

Number = Any
"""An integer, a fraction, or text such as the name of a variable."""
Points = Mapping[str, Sequence[Number]]
_NAME = re.compile(r"\b[pqr]\d\b")


def curve(points: Sequence[Number], t: str = "t") -> str:
    """Definition 1 in one coordinate: the sum of C(n,i) t^i (1-t)^(n-i) P_i."""
    n = len(points) - 1
    rows = [(_coefficient(comb(n, i)), _power(t, i), _power(f"(1 - {t})", n - i)) for i in range(n + 1)]
    return " + ".join("*".join([f for f in row if f] + [_operand(p)]) for row, p in zip(rows, points))


def _coefficient(k: int) -> str:
    return "" if k == 1 else str(k)


def _power(base: str, k: int) -> str:
    return "" if k == 0 else base if k == 1 else f"{base}^{k}"


def _operand(value: Number) -> str:
    """With brackets unless it is a name or a natural number."""
    text = str(value)
    return text if re.fullmatch(r"\w+", text) else f"({text})"


def names(letter: str, n: int, axis: str = "") -> list[str]:
    """``p0, p1, ..., pn`` (or one coordinate of each)."""
    return [f"{letter}{i}{axis}" for i in range(n + 1)]


def in_coordinate(vectors: str, axis: str, given: Points, axes: str = "xyz") -> str:
    """A linear expression in control points, in one coordinate; points in ``given`` by their numbers."""

    def put(match: re.Match[str]) -> str:
        point = given.get(match[0])
        return f"{match[0]}{axis}" if point is None else _operand(point[axes.index(axis)])

    return _NAME.sub(put, vectors)


def norm_squared(vectors: str, axes: str, given: Points) -> str:
    """The squared norm of a linear expression in control points."""
    return " + ".join(f"{_operand(in_coordinate(vectors, axis, given, axes))}^2" for axis in axes)


def inside(vectors: str, axes: str, given: Points, radius_squared: Number) -> str:
    """||vectors|| <= r, squared."""
    return f"{norm_squared(vectors, axes, given)} <= {radius_squared}"


def block(points: Sequence[str], axes: str) -> str:
    """The coordinates of several points, as a list of variables."""
    return ", ".join(f"{p}{axis}" for p in points for axis in axes)


@dataclass(frozen=True, slots=True)
class Printed:
    """A formula of the paper: there are points ``block`` with these equations, and all of ``bounded`` have norm <= r.

    ``chosen``: the free points, of which the objective of the paper is the sum of squared steps along
    ``q0, chosen, r0``.
    """

    block: tuple[str, ...]
    equations: tuple[str, ...]
    bounded: tuple[str, ...]
    chosen: tuple[str, ...]

    def body(self, axes: str, given: Points, radius_squared: Number, *, above: bool = False) -> str:
        """Equations and norm conditions; ``above`` adds that the last coordinate of each point is not negative."""
        parts = [in_coordinate(e, axis, given, axes) for e in self.equations for axis in axes]
        parts += [inside(p, axes, given, radius_squared) for p in self.bounded]
        parts += [f"{p}{axes[-1]} >= 0" for p in self.bounded if above]
        return " and ".join(parts)

    def text(self, axes: str, given: Points, radius_squared: Number, *, above: bool = False) -> str:
        """The formula as printed."""
        return f"ex {block(self.block, axes)}. {self.body(axes, given, radius_squared, above=above)}"

    def satisfiable(self, axes: str, given: Points, radius_squared: Number, *, above: bool = False) -> str:
        """The sentence that some choice of the free points satisfies the formula."""
        return f"ex {block(self.chosen, axes)}. {self.text(axes, given, radius_squared, above=above)}"

    def substituted(self, axes: str, given: Points, radius_squared: Number, *, above: bool = False) -> str:
        """The conditions on the free points with the points of the block put in."""
        solved = dict(e.split(" = ") for e in self.equations)
        parts = [inside(solved.get(p, p), axes, given, radius_squared) for p in self.bounded]
        last = axes[-1]
        parts += [f"{in_coordinate(solved.get(p, p), last, given, axes)} >= 0" for p in self.bounded if above]
        return " and ".join(parts)

    def different(self, curves: Sequence[Sequence[str]], axes: str, given: Points) -> str:
        """Definition 1: the control points of each curve are different, those of the block put in."""
        solved = dict(e.split(" = ") for e in self.equations)
        pairs = [(solved.get(a, a), solved.get(b, b)) for row in curves for a, b in itertools.combinations(row, 2)]
        sides = [[tuple(in_coordinate(p, axis, given, axes) for p in pair) for axis in axes] for pair in pairs]
        return " and ".join(f"({' or '.join(f'{a} /= {b}' for a, b in pair)})" for pair in sides)

    def objective(self, axes: str, given: Points) -> str:
        """What the paper wants as small as possible."""
        stops = ("q0", *self.chosen, "r0")
        return " + ".join(norm_squared(f"{b} - {a}", axes, given) for a, b in itertools.pairwise(stops))


SEVEN = Printed(
    block=("p1", "p2", "r1", "r2"),
    equations=("p1 = 4*q0 - 4*q1 + q2", "p2 = 2*q0 - q1", "r1 = 2*r0 - q2", "r2 = q1 - 4*q2 + 4*r0"),
    bounded=("p1", "p2", "q1", "q2", "r1", "r2"),
    chosen=("q1", "q2"),
)
EIGHT = Printed(
    block=("p1", "r1"),
    equations=("p1 = 2*q0 - q1", "r1 = 2*r0 - q1"),
    bounded=("p1", "q1", "r1"),
    chosen=("q1",),
)
