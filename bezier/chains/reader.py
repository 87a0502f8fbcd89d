"""A chain as a table: the keys of a file of ``bezier chain``, which are the arguments of ``bezier.chain``."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.chains.chain import Chain, Ends, Objective
from bezier.chains.form import Point
from bezier.input.numbers import describe
from bezier.input.toml_table import Table
from qe.errors import InputError

KEYS = (
    *("start", "via", "goal", "closed", "radius", "centre", "half_space", "degree", "continuity"),
    *("durations", "total", "ends", "velocities", "objective", "max_length", "max_curvature"),
)
_POINT = "a point of 2 or 3 numbers"


def read_chain(table: Table) -> Chain:
    """The chain that a table describes. Raises ``InputError`` naming the key, what was expected and what was given."""
    table.only(KEYS)
    closed = table.values.get("closed", False)
    if not isinstance(closed, bool):
        raise table.error("closed", "true or false", describe(closed))
    points = _points(table, closed)
    size = len(points[0])
    centre = (
        table.as_point("centre", table.values["centre"], size) if "centre" in table.values else (Fraction(0),) * size
    )
    free = table.values.get("durations") == "free"
    if "total" in table.values and not free:
        raise table.error("total", 'this key with durations = "free" only', describe(table.values["total"]))
    return Chain(
        points,
        table.whole("degree", 3, range(1, 10)),
        table.whole("continuity", 2, range(1, 10)),
        () if free else _durations(table, len(points) - (not closed)),
        table.choice("ends", Ends, Ends.FREE),
        closed,
        table.choice("objective", Objective, Objective.LEGS),
        centre,
        table.squared("radius", 'a number above zero, or such as "sqrt(27)"') if "radius" in table.values else None,
        tuple(_half_space(entry, size) for entry in table.tables("half_space")),
        velocities=_velocities(table, size),
        free_total=table.positive("total", Fraction(len(points) - (not closed))) if free else None,
        max_length=table.positive("max_length") if "max_length" in table.values else None,
        max_curvature=table.positive("max_curvature") if "max_curvature" in table.values else None,
    )


def _points(table: Table, closed: bool) -> tuple[Point, ...]:
    """Start, via points and goal, of one dimension; neighbours differ."""
    start = table.required("start", _POINT)
    size = len(start) if isinstance(start, list) else 0
    if size not in (2, 3):
        raise table.error("start", _POINT, describe(start))
    if closed is ("goal" in table.values):
        raise table.error("goal", "no goal of a closed chain" if closed else "a goal", "one" if closed else "none")
    via = table.required("via", "a list of points")
    if not isinstance(via, list):
        raise table.error("via", "a list of points", describe(via))
    named = [("start", start), *((f"via[{i}]", p) for i, p in enumerate(via))]
    named += [] if closed else [("goal", table.values["goal"])]
    points = [table.as_point(name, raw, size) for name, raw in named]
    for k in range(0 if closed else 1, len(points)):
        if points[k] == points[k - 1]:
            raise table.error(named[k][0], f"a point other than {named[k - 1][0]}", "the same")
    return tuple(points)


def _durations(table: Table, pieces: int) -> tuple[Fraction, ...]:
    raw, expected = table.values.get("durations", []), f'{pieces} numbers, the seconds of each curve, or "free"'
    if not isinstance(raw, list) or len(raw) not in (0, pieces):
        raise table.error("durations", expected, describe(raw))
    durations = table.as_point("durations", raw, len(raw))
    for i, t in enumerate(durations):
        if t <= 0:
            raise table.error(f"durations[{i}]", "a number above zero", str(t))
    return durations


def _velocities(table: Table, size: int) -> tuple[Point, ...]:
    if "velocities" not in table.values:
        return ()
    raw = table.values["velocities"]
    if not isinstance(raw, list) or len(raw) != 2:
        raise table.error("velocities", "two points, those at the start and at the goal", describe(raw))
    return tuple(table.as_point(f"velocities[{i}]", entry, size) for i, entry in enumerate(raw))


def _half_space(entry: Table, size: int) -> tuple[Point, Fraction]:
    entry.only(("normal", "offset"))
    normal = entry.as_point("normal", entry.required("normal", f"a point of {size} numbers"), size)
    if not any(normal):
        raise entry.error("normal", "a point that is not zero", "zero")
    return normal, entry.number("offset")


def load_chain(file: Any) -> Chain:
    """The chain of a TOML file. Raises ``InputError``."""
    table = Table.load(file)
    try:
        return read_chain(table)
    except InputError as error:
        if str(error).startswith("chain: "):  # of the value itself, which knows no file
            raise InputError(f"{file}: {error}") from None
        raise
