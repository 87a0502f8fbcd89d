"""A comparison for people and programs: rows that the table and the page share, and one JSON object."""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import Any

from bezier.compare.comparison import METHODS, PAPER, Comparison, PlanarRegion, Side
from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import brief
from bezier.methods.cubic.existence import trivial_witness
from bezier.planner.outputs import summary
from bezier.planner.words import why_not
from bezier.problem import PlanMethod
from bezier.report.first import RESULTS

TITLES = {PlanMethod.QUADRATIC: "quadratic, formula (8)", PlanMethod.CUBIC: "cubic, formula (7)"}
DIGITS = 8
NOT_REACHED = "not reached"


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the comparison; ``cells`` in the order of ``METHODS``."""

    label: str
    cells: tuple[str, str]


def rows(found: Comparison) -> list[Row]:
    """What both methods give, side by side."""
    sides = [found.sides[method] for method in METHODS]
    return [
        Row("result", _both(sides, _result)),
        Row("objective, mm²", _both(sides, lambda s: "" if s.plan.objective is None else brief(s.plan.objective))),
        Row("active conditions", _both(sides, lambda s: ", ".join(s.plan.active) or "none")),
        Row("joins, proved", _both(sides, _joins)),
        Row("whole path in the workspace", _both(sides, _inside)),
        Row("length, mm", _both(sides, lambda s: bracket(s.length))),
        Row("largest curvature, 1/mm", _both(sides, lambda s: bracket(s.curvature))),
        Row("certificates", _both(sides, lambda s: "accepted" if s.plan.certified else "not all accepted")),
        Row(
            "region in space",
            (f"volume of Q1 {bracket(found.volume) or NOT_REACHED}", "pairs (Q1, Q2) in six dimensions"),
        ),
        Row("area of Q1 in the plane, mm²", (_area(found.planar.polygon), _area(found.planar.cubic))),
        Row("the same, whole curves (8*)", (_area(found.planar.whole), "")),
        Row("quantifier elimination", _both(sides, lambda s: duration(s.plan.seconds["elimination"]))),
        Row("  the paper reports", (PAPER[METHODS[0]], PAPER[METHODS[1]])),
        Row("whole plan", _both(sides, lambda s: duration(sum(s.plan.seconds.values())))),
    ]


def step_rows(found: Comparison) -> list[Row]:
    """The time of every step of both plans."""
    seconds = [found.sides[method].plan.seconds for method in METHODS]
    names = dict.fromkeys(name for times in seconds for name in times)
    first, second = ({name: duration(s) for name, s in times.items()} for times in seconds)
    return [Row(name, (first.get(name, ""), second.get(name, ""))) for name in names]


def notes(found: Comparison) -> list[str]:
    """What the table cannot say."""
    planar = found.planar
    said = {True: "the engine proved that", False: "the engine REFUTED that", None: "it was not decided whether"}
    lines = [
        f"{said[planar.contained]} every Q1 of (8) in the plane is one of (8*): bounding the control points is enough"
        " to bound the curves" + (", and more than is needed" if _is_larger(planar.whole, planar.polygon) else "")
    ]
    if found.existence.truth:
        lines.append(f"existence theorem of (7), found by the engine: it always has the solution {_told(found)}")
        lines.append("with that choice the path stops and turns round at both joins; the objective rules it out")
    lines += [f"planar region of {name}: {r.reason}" for name, r in planar.named.items() if r.region and r.reason]
    lines += [f"{name}: not finished, {reason}" for name, reason in found.unfinished.items()]
    return lines


def _told(found: Comparison) -> str:
    trivial = ", ".join(f"{name} = {value}" for name, value in trivial_witness().items())
    return "Q1 = Q0, Q2 = R0" if found.existence.witness == trivial else found.existence.witness


def _is_larger(one: PlanarRegion, other: PlanarRegion) -> bool:
    """Whether the area of ``one`` is certainly larger than that of ``other``."""
    return (
        one.area is not None
        and other.area is not None
        and other.area.high is not None
        and one.area.low > other.area.high
    )


def _both(sides: list[Side], text: Any) -> tuple[str, str]:
    first, second = (text(side) for side in sides)
    return first, second


def _result(side: Side) -> str:
    return why_not(side.plan) or RESULTS[side.plan.outcome]


def _joins(side: Side) -> str:
    return "" if side.plan.path is None else side.plan.path.smoothness.name


def _inside(side: Side) -> str:
    if side.plan.path is None:
        return ""
    return "proved" if side.plan.path.is_inside else "it LEAVES the workspace"


def _area(found: PlanarRegion) -> str:
    return bracket(found.area, 5) or NOT_REACHED


def bracket(found: Enclosure | None, digits: int = DIGITS) -> str:
    """An enclosure as text, its ends rounded outwards: ``[10.797249, 10.797250]``; nothing for None."""
    if found is None:
        return ""
    ends = found.to_json(digits)
    return (
        ends["low"]
        if found.low == found.high and float(ends["low"]) == found.low
        else f"[{ends['low']}, {ends['high']}]"
    )


def duration(seconds: float) -> str:
    """Seconds or milliseconds."""
    return f"{seconds * 1e3:.1f} ms" if seconds < 1 else f"{seconds:.2f} s"


# --- the terminal -----------------------------------------------------------------------------------------
def table(found: Comparison) -> str:
    """The comparison as a table for the terminal."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    drawn = Table(title=f"radius r = {found.problem.workspace.radius_text}", title_justify="left")
    for heading in ("", *TITLES.values()):
        drawn.add_column(heading, overflow="fold")
    for row in rows(found):
        drawn.add_row(*(Text(text) for text in (row.label, *row.cells)))
    drawn.add_section()
    for row in step_rows(found):
        drawn.add_row(*(Text(text) for text in (f"step: {row.label}", *row.cells)))
    console = Console(file=io.StringIO(), width=110, color_system=None)
    console.print(drawn)
    for name, seconds in found.seconds.items():
        if name not in {method.value for method in METHODS}:
            console.print(Text(f"{name}: {duration(seconds)}"))
    for line in notes(found):
        console.print(Text(line), soft_wrap=True)
    stream = console.file
    assert isinstance(stream, io.StringIO)
    return stream.getvalue().rstrip("\n")


# --- JSON -------------------------------------------------------------------------------------------------
def to_json(found: Comparison, files: list[str]) -> dict[str, Any]:
    """The object that ``bezier compare --json`` prints: every plan as ``bezier plan --json`` prints it, and more."""
    return {
        "status": "solved",
        "methods": {method.value: _side_json(found.sides[method], PAPER[method]) for method in METHODS},
        "region_volume": None if found.volume is None else found.volume.to_json(),
        "planar": {
            "axes": [[str(c) for c in axis] for axis in (found.planar.plane.first, found.planar.plane.second)],
            "regions": {name: _region_json(r) for name, r in found.planar.named.items()},
            "polygon_lies_in_whole": found.planar.contained,
        },
        "existence": {
            "sentence": found.existence.sentence,
            "truth": found.existence.truth,
            "witness": found.existence.witness,
        },
        "unfinished": dict(found.unfinished),
        "files": files,
        "seconds": {name: round(s, 6) for name, s in found.seconds.items()},
    }


def _side_json(side: Side, paper: str) -> dict[str, Any]:
    total, bend = side.length, side.curvature
    return {
        **summary(side.plan, [], sum(side.plan.seconds.values())),
        "smoothness": None if side.plan.path is None else side.plan.path.smoothness.name,
        "length": None if total is None else total.to_json(),
        "lengths": {name: e.to_json() for name, e in side.lengths.items()},
        "curvature": None if bend is None else bend.to_json(),
        "curvatures": {name: e.to_json() for name, e in side.curvatures.items()},
        "paper": paper,
    }


def _region_json(found: PlanarRegion) -> dict[str, Any]:
    region = found.region
    return {
        "formula": found.formula,
        "cells": None if region is None else [piece.brief() for piece in region.cells],
        "area": None if found.area is None else found.area.to_json(),
        "reason": found.reason or None,
    }
