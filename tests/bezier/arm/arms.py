"""Arms and curves for tests: arms written row by row, limits of their joints, curves along points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from bezier.arm.model import Arm
from bezier.curves.curve import Bezier

Limits = tuple[object, object] | None
Points = Sequence[tuple[Any, ...]]


def arm_text(*rows: str, convention: str = "standard") -> str:
    """An arm with a joint q1, q2, … in each row; semicolons separate the keys of a row."""
    body = "".join(f'[[row]]\njoint = "q{k}"\n{row}\n' for k, row in enumerate(rows, start=1))
    return f'convention = "{convention}"\n{body}'.replace("; ", "\n")


def limited(arm: Arm, *limits: Limits) -> Arm:
    """The arm with these limits of its joints; the others have none."""
    listed = iter([*limits, *[None] * len(arm.joints)])
    rows = []
    for row in arm.rows:
        if row.joint is not None:
            ends = next(listed)
            exact = None if ends is None else (Fraction(str(ends[0])), Fraction(str(ends[1])))
            row = replace(row, joint=replace(row.joint, limits=exact))
        rows.append(row)
    return replace(arm, rows=tuple(rows))


def curves_of(*curves: Points) -> dict[str, Bezier]:
    """The curves with these control points."""
    exact = ([tuple(Fraction(str(c)) for c in p) for p in points] for points in curves)
    return {f"curve {k}": Bezier.of(points) for k, points in enumerate(exact)}
