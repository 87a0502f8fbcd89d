"""A comparison for people and programs: rows that the table and the page share, and one JSON object."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

from bezier.compare.comparison import METHODS, PAPER, Comparison, PlanarRegion, Side
from bezier.curves.enclosure import Enclosure
from bezier.curves.scalar import brief
from bezier.methods.cubic.existence import trivial_witness
from bezier.planner.outputs import summary
from bezier.planner.words import why_not
from bezier.problem import PlanMethod
from bezier.report.first import RESULTS, duration

TITLES = {PlanMethod.QUADRATIC: "quadratic, formula (8)", PlanMethod.CUBIC: "cubic, formula (7)"}
DIGITS = 8
NOT_REACHED = "not reached"


Row = tuple[str, str, str]
"""One line of the comparison: its label, and cells in the order of ``METHODS``."""


def rows(comparison: Comparison) -> list[Row]:
    """What both methods give, side by side."""
    first, second = (comparison.sides[method] for method in METHODS)

    def both(label: str, text: Callable[[Side], str]) -> Row:
        return label, text(first), text(second)

    return [
        both("result", lambda s: why_not(s.plan) or RESULTS[s.plan.outcome]),
        both("objective, mm²", lambda s: "" if s.plan.objective is None else brief(s.plan.objective)),
        both("active conditions", lambda s: ", ".join(s.plan.active) or "none"),
        both("joins, proved", lambda s: "" if s.plan.path is None else s.plan.path.smoothness.name),
        both("whole path in the workspace", _inside),
        both("length, mm", lambda s: bracket(s.quality.length if s.quality else None)),
        both("largest curvature, 1/mm", lambda s: bracket(s.quality.curvature if s.quality else None)),
        both("certificates", lambda s: "accepted" if s.plan.certified else "not all accepted"),
        (
            "region in space",
            f"volume of Q1 {bracket(comparison.volume) or NOT_REACHED}",
            "pairs (Q1, Q2) in six dimensions",
        ),
        ("area of Q1 in the plane, mm²", _area(comparison.planar.polygon), _area(comparison.planar.cubic)),
        ("the same, whole curves (8*)", _area(comparison.planar.whole), ""),
        both("quantifier elimination", lambda s: duration(s.plan.seconds["elimination"])),
        ("  the paper reports", PAPER[METHODS[0]], PAPER[METHODS[1]]),
        both("whole plan", lambda s: duration(sum(s.plan.seconds.values()))),
    ]


def step_rows(comparison: Comparison) -> list[Row]:
    """The time of every step of both plans."""
    first, second = ({n: duration(s) for n, s in comparison.sides[m].plan.seconds.items()} for m in METHODS)
    return [(name, first.get(name, ""), second.get(name, "")) for name in first | second]


def notes(comparison: Comparison) -> list[str]:
    """What the table cannot say."""
    planar, (whole, polygon) = comparison.planar, (comparison.planar.whole.area, comparison.planar.polygon.area)
    is_larger = bool(whole and polygon and polygon.high is not None and whole.low > polygon.high)
    said = {True: "the engine proved that", False: "the engine REFUTED that", None: "it was not decided whether"}
    lines = [
        f"{said[planar.contained]} every Q1 of (8) in the plane is one of (8*): bounding the control points is enough"
        " to bound the curves" + (", and more than is needed" if is_larger else "")
    ]
    if comparison.existence.truth:
        trivial = ", ".join(f"{name} = {value}" for name, value in trivial_witness().items())
        solution = comparison.existence.witness
        solution = "Q1 = Q0, Q2 = R0" if solution == trivial else solution
        lines.append(f"existence theorem of (7), found by the engine: it always has the solution {solution}")
        lines.append("with that choice the path stops and turns round at both joins; the objective rules it out")
    lines += [f"planar region of {name}: {r.reason}" for name, r in planar.named.items() if r.region and r.reason]
    lines += [f"{name}: not finished, {reason}" for name, reason in comparison.unfinished.items()]
    lines += [f"derivation of {name}: not every step checked: {why}" for name, why in comparison.unproved.items()]
    return lines


def _inside(side: Side) -> str:
    if side.plan.path is None:
        return ""
    return "proved" if side.plan.path.is_inside else "it LEAVES the workspace"


def _area(region: PlanarRegion) -> str:
    return bracket(region.area, 5) or NOT_REACHED


def bracket(enclosure: Enclosure | None, digits: int = DIGITS) -> str:
    """An enclosure as text, its ends rounded outwards: ``[10.797249, 10.797250]``; nothing for None."""
    if enclosure is None:
        return ""
    ends = enclosure.to_json(digits)
    is_exact = enclosure.low == enclosure.high and float(ends["low"]) == enclosure.low
    return ends["low"] if is_exact else f"[{ends['low']}, {ends['high']}]"


# --- the terminal -----------------------------------------------------------------------------------------
def table(comparison: Comparison) -> str:
    """The comparison as a table for the terminal."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    drawn = Table(title=f"radius r = {comparison.problem.workspace.radius_text}", title_justify="left")
    for heading in ("", *TITLES.values()):
        drawn.add_column(heading, overflow="fold")
    for row in rows(comparison):
        drawn.add_row(*(Text(text) for text in row))
    drawn.add_section()
    for row in step_rows(comparison):
        drawn.add_row(*(Text(text) for text in (f"step: {row[0]}", *row[1:])))
    console = Console(file=io.StringIO(), width=110, color_system=None)
    console.print(drawn)
    for name, seconds in comparison.seconds.items():
        if name not in {method.value for method in METHODS}:
            console.print(Text(f"{name}: {duration(seconds)}"))
    for line in notes(comparison):
        console.print(Text(line), soft_wrap=True)
    stream = console.file
    assert isinstance(stream, io.StringIO)
    return stream.getvalue().rstrip("\n")


# --- JSON -------------------------------------------------------------------------------------------------
def to_json(comparison: Comparison, files: list[str]) -> dict[str, Any]:
    """The object that ``bezier compare --json`` prints: every plan as ``bezier plan --json`` prints it, and more."""
    return {
        "status": "solved",
        "methods": {method.value: _side_json(comparison.sides[method], PAPER[method]) for method in METHODS},
        "region_volume": None if comparison.volume is None else comparison.volume.to_json(),
        "planar": {
            "axes": [
                [str(c) for c in axis] for axis in (comparison.planar.plane.first, comparison.planar.plane.second)
            ],
            "regions": {name: _region_json(r) for name, r in comparison.planar.named.items()},
            "polygon_lies_in_whole": comparison.planar.contained,
        },
        "existence": {
            "sentence": comparison.existence.sentence,
            "truth": comparison.existence.truth,
            "witness": comparison.existence.witness,
        },
        "unfinished": dict(comparison.unfinished),
        "unproved": dict(comparison.unproved),
        "files": files,
        "seconds": {name: round(s, 6) for name, s in comparison.seconds.items()},
    }


def _side_json(side: Side, paper: str) -> dict[str, Any]:
    made, bend = side.quality, side.quality.curvature if side.quality else None
    return {
        **summary(side.plan, [], sum(side.plan.seconds.values())),
        "smoothness": None if side.plan.path is None else side.plan.path.smoothness.name,
        "length": None if made is None else made.length.to_json(),
        "lengths": {name: e.to_json() for name, e in made.lengths.items()} if made else {},
        "curvature": None if bend is None else bend.to_json(),
        "curvatures": {name: e and e.to_json() for name, e in made.curvatures.items()} if made else {},
        "paper": paper,
    }


def _region_json(planar: PlanarRegion) -> dict[str, Any]:
    region = planar.region
    return {
        "formula": planar.formula,
        "cells": None if region is None else [piece.brief() for piece in region.cells],
        "area": None if planar.area is None else planar.area.to_json(),
        "reason": planar.reason or None,
    }
