"""The benchmark of formula (7): medians of five runs in this process, each figure asked beside the one reached.

Run it with ``make bench`` or ``python -m experiments.bench_cubic``. At the end the same instance as an existential
sentence in six variables goes to other solvers, each in a process of its own with a time limit.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import qe
from bezier.compare import whole_curve
from bezier.compare.comparison import planar_statements
from bezier.compare.whole_curve import Plane
from bezier.curves.workspace import WorkspaceKind
from bezier.methods.cubic import formula as cubic
from bezier.methods.cubic.existence import sentence, trivial_witness
from bezier.problem import Problem, read_problem
from experiments.bench import GIVEN, Row, median
from experiments.limits import Ending, run_limited
from experiments.solvers import solver

PEERS = ("ours", "yices", "z3", "cvc5")
PEER_SECONDS, PEER_MEMORY, PEER_START_UP = 30.0, 2000, 20.0

TWO_ACTIVE = """\
method = "cubic"
via = [[-3, "6/5", "8/5"], [2, "6/5", "8/5"]]
start = [-4, 0, 0]
goal = [4, 0, 0]
radius = "sqrt(27)"
"""
"""Q0 = (-3, 2), R0 = (2, 2) in the plane of O and the via points: P1 and R2 are active at the optimum."""


def planar_conditions() -> str:
    """The six norms of (7) for the second instance with both points in the plane: four variables."""
    given = read_problem(TWO_ACTIVE)
    plane = Plane.through(given)
    section = plane.section(cubic.system(given).in_free_points(), ("Q1", "Q2"))
    return str(qe.eliminate(section.formula).formula)


def planar_objective() -> str:
    """|Q1 - Q0|^2 + |Q2 - Q1|^2 + |R0 - Q2|^2 there."""
    route = ((-3, 2), ("q1u", "q1v"), ("q2u", "q2v"), (2, 2))
    return " + ".join(f"(({b}) - ({a}))^2" for p, q in pairwise(route) for a, b in zip(p, q, strict=True))


def spatial_hemisphere() -> Problem:
    """The second instance in the upper half of the ball."""
    given = read_problem(TWO_ACTIVE)
    return replace(given, workspace=replace(given.workspace, kind=WorkspaceKind.HEMISPHERE))


def elimination_rows() -> Iterator[Row]:
    """(7) as printed, and its existence theorem."""
    printed = str(cubic.system(read_problem(GIVEN.format("cubic"))).statement())
    symbolic = str(cubic.shape().symbolic())
    yield Row("(7) as printed", 0.050, median(lambda: qe.eliminate(printed)))
    yield Row("(7) with symbolic points", 0.200, median(lambda: qe.eliminate(symbolic)))
    planar = _in_the_plane(sentence())
    told = qe.eliminate(planar)
    assert told.truth is True
    yield Row("existence theorem, planar", 10.0, median(lambda: qe.decide(planar)), note="witness found")
    yield Row("existence theorem, spatial", 10.0, median(lambda: qe.decide(sentence())), note="witness found")
    offered = trivial_witness()
    yield Row("  with the witness offered, spatial", 10.0, median(lambda: qe.check_witness(sentence(), offered)))


def _in_the_plane(text: str) -> str:
    """The existence theorem for points with z = 0."""
    prefix, rest = text.split(". ", 1)
    return f"{prefix}. q0z = 0 and r0z = 0 and {rest}"


def optimum_rows() -> Iterator[Row]:
    """The exact optimum with its certificate."""
    conditions, objective = planar_conditions(), planar_objective()
    found = qe.minimize(objective, conditions, method="convex")
    yield Row(
        "optimum with certificate, planar",
        0.3,
        median(lambda: qe.minimize(objective, conditions, method="convex").certificate),
    )
    yield Row("  its verification", 0.2, median(lambda: qe.verify(found.certificate)))
    system = cubic.system(spatial_hemisphere())
    spatial, aim = system.in_free_points().formula, system.objective().polynomial
    above = qe.minimize(aim, spatial, method="convex")
    yield Row(
        "optimum, spatial, hemisphere", 1.0, median(lambda: qe.minimize(aim, spatial, method="convex").certificate)
    )
    yield Row("  its verification", 0.2, median(lambda: qe.verify(above.certificate)))


def region_rows() -> Iterator[Row]:
    """Membership of a Q1, and the planar regions."""
    given = read_problem(TWO_ACTIVE)
    plane = Plane.through(given)
    formulas = {name: asked.formula for name, asked in planar_statements(given, plane).items()}
    places = [{"q1u": Fraction(u, 2), "q1v": Fraction(v, 2)} for u, v in ((-3, 4), (-3, 8), (1, 5), (-5, 5))]
    planar = qe.region(formulas["(7)"])
    yield Row("membership of a Q1, planar", 0.050, median(lambda: [planar.contains(p) for p in places]) / len(places))
    names = ", ".join(f"q2{axis}" for axis in "xyz")
    spatial = qe.region(f"ex {names}. {cubic.system(given).in_free_points()}")
    points: list[dict[str, Any]] = [
        dict(zip(("q1x", "q1y", "q1z"), plane.point(*p.values()), strict=True)) for p in places
    ]
    yield Row("membership of a Q1, spatial", 0.5, median(lambda: [spatial.contains(p) for p in points]) / len(points))
    yield Row("planar region of (7), Q2 quantified", 10.0, median(lambda: qe.region(formulas["(7)"]).cells))
    yield Row("planar region of (8*)", 5.0, median(lambda: whole_curve.region(given, plane).cells))


def peer_lines() -> Iterator[str]:
    """What each solver says of (7) as an existential sentence in six variables, and after how long."""
    system = cubic.system(read_problem(GIVEN.format("cubic")))
    text = f"ex {', '.join(system.shape.variables)}. {system.in_free_points()}"
    task = json.dumps({"formula": text, "limit": PEER_SECONDS, "memory": PEER_MEMORY})
    for name in PEERS:
        run = run_limited(solver(name).command, task, seconds=PEER_SECONDS, memory=PEER_MEMORY, start_up=PEER_START_UP)
        yield f"     {name:<6} {_told(run.out, run.ending)}"


def _told(out: str, ending: Ending) -> str:
    if ending is not Ending.FINISHED:
        return f"no answer within the limit of {PEER_SECONDS:g} s or {PEER_MEMORY} MiB"
    last = json.loads(out.splitlines()[-1]) if out.strip() else {"status": "no output", "seconds": 0.0}
    return f"{last.get('answer') or last.get('message') or last['status']} after {last['seconds']:.3f} s"


def main() -> None:
    """Print the table."""
    for rows in (elimination_rows, optimum_rows, region_rows):
        for row in rows():
            print(row, flush=True)
    print("(7) as an existential sentence in 6 variables, Q0 = (-1, 3, 3), R0 = (1, 3, 3), r^2 = 27:")
    for line in peer_lines():
        print(line, flush=True)


if __name__ == "__main__":
    main()
