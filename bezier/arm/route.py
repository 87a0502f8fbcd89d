"""Paths for arms from files: ``[[curve]]`` tables of a TOML file, or the folder of a plan.

[[curve]]
points = [[10, 40, 80], [40, 100, 20]]      # control points in mm: two make a line
name = "first"                              # optional
spline = true                               # points to pass through instead: a natural cubic spline, one curve per span
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector, add, scale, subtract
from bezier.input.files import read_text
from bezier.input.numbers import describe
from bezier.input.toml_table import Table

MOST_POINTS = 40


def load_route(path: Path) -> dict[str, Bezier]:
    """The curves of a file by name, in order. Raises ``InputError``."""
    return read_route(read_text(path), str(path))


def read_route(text: str, source: str = "<path>") -> dict[str, Bezier]:
    """The curves that TOML text describes. Raises ``InputError``."""
    table = Table.parse(text, source)
    table.only(("curve",))
    entries = table.tables("curve")
    if not entries:
        raise table.error("curve", "tables [[curve]]", "none")
    found: dict[str, Bezier] = {}
    for i, entry in enumerate(entries):
        entry.only(("points", "name", "spline"))
        name = entry.values.get("name", f"curve {i + 1}")
        if not isinstance(name, str) or not name or name in found:
            raise entry.error("name", "a name of its own for each curve", describe(name))
        points = _points(entry)
        is_spline = entry.values.get("spline", False)
        if not isinstance(is_spline, bool):
            raise entry.error("spline", "true or false", describe(is_spline))
        spans = natural_spline(points) if is_spline else [Bezier.of(points)]
        found |= {name if len(spans) == 1 else f"{name}, span {k}": c for k, c in enumerate(spans, start=1)}
    return found


def _points(entry: Table) -> list[Vector]:
    raw = entry.required("points", "a list of points")
    if not isinstance(raw, list) or not 2 <= len(raw) <= MOST_POINTS:
        raise entry.error("points", f"2 to {MOST_POINTS} points", describe(raw))
    return [entry.as_point(f"points[{i}]", p) for i, p in enumerate(raw)]


def natural_spline(points: Sequence[Vector]) -> list[Bezier]:
    """The natural cubic spline through the points, with equal steps of the parameter, as one Bézier curve for each
    span.

    With slopes m_i: m_{i-1} + 4 m_i + m_{i+1} = 3 (p_{i+1} - p_{i-1}) inside, 2 m_0 + m_1 = 3 (p_1 - p_0) and likewise
    at the end (C. de Boor, A Practical Guide to Splines, chapter IV). Exact.
    """
    n = len(points)
    diagonal = [Fraction(2), *[Fraction(4)] * (n - 2), Fraction(2)]
    right = [scale(3, subtract(points[min(i + 1, n - 1)], points[max(i - 1, 0)])) for i in range(n)]
    for i in range(1, n):
        factor = 1 / diagonal[i - 1]
        diagonal[i] -= factor
        right[i] = subtract(right[i], scale(factor, right[i - 1]))
    slopes = [scale(1 / diagonal[-1], right[-1])]
    for i in range(n - 2, -1, -1):
        slopes.insert(0, scale(1 / diagonal[i], subtract(right[i], slopes[0])))
    third = Fraction(1, 3)
    return [
        Bezier((p, add(p, scale(third, u)), subtract(q, scale(third, v)), q))
        for p, q, u, v in zip(points, points[1:], slopes, slopes[1:], strict=False)
    ]
