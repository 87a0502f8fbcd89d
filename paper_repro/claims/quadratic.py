"""Section 4.2.1: three curves of degree 2, formula (8)."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.containment import Argument, Inside, examine_all
from bezier.curves.curve import Bezier, Smoothness, join
from bezier.curves.workspace import Workspace, WorkspaceKind
from paper_repro.ask import eliminated, optimised, verified
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.claims.joins import smooth
from paper_repro.figures.curves import path as drawn_path
from paper_repro.figures.regions import region
from paper_repro.written import EIGHT, Points

GIVEN: Points = {"q0": (-1, 3, 3), "r0": (1, 3, 3)}
START, GOAL = (-5, 1, 1), (5, 1, 1)
LETTERS: Points = {"q0": ("q0x", "q0y", "q0z"), "r0": ("r0x", "r0y", "r0z")}


def curves(given: Points, q1: Sequence[Any], start: Sequence[Any], goal: Sequence[Any]) -> Mapping[str, Bezier]:
    """The three curves of degree 2 for this Q1."""
    q0, r0 = given["q0"], given["r0"]
    p1, r1 = [2 * q - a for q, a in zip(q0, q1)], [2 * r - a for r, a in zip(r0, q1)]
    return {"P": Bezier.of((start, p1, q0)), "Q": Bezier.of((q0, q1, r0)), "R": Bezier.of((r0, r1, goal))}


@claim(
    key="quadratic-joins",
    place="Section 4.2.1, before (8)",
    title="Smooth joins of curves of degree 2",
    says="Equal first derivatives at the joins mean $2\\hat Q_0 = \\hat P_1 + \\hat Q_1$ and "
    "$2\\hat R_0 = \\hat Q_1 + \\hat R_1$.",
    verdict=Verdict.REPRODUCED,
    finding="Derived by elimination from Definition 1. What the relaxation gives up is the second derivative: the "
    "curves join $C^1$, and $C^2$ only in special position (see the entry on the smallest degree).",
)
def quadratic_joins() -> Iterator[Evidence]:
    """Values and first derivatives at both joins, differentiated symbolically; $\\hat P_2$ and $\\hat Q_2$ are
    eliminated."""
    question = qe.Exists(("p2", "q2"), smooth(2, 1))
    yield eliminated("all conditions together", question, "2*q0 = p1 + q1 and 2*r0 = q1 + r1")


@claim(
    key="eq-8",
    place="Section 4.2.1, formula (8)",
    title="The region of $\\hat Q_1$ by quantifier elimination",
    says="Quantifier elimination gives the possible region of $\\hat Q_1$; then three curves are obtained.",
    verdict=Verdict.REPRODUCED,
    finding="The answer is short: $\\hat Q_1$ lies in the balls of radius $r$ about $O$, $2\\hat Q_0$ and "
    "$2\\hat R_0$. The best point, the curves, and proofs that the whole curves stay in the ball follow exactly.",
)
def equation_8() -> Iterator[Evidence]:
    """(8) is written in coordinates exactly as printed and eliminated, with numbers and with letters; then the
    objective is minimised over the answer, the curves are built and examined over the whole parameter interval."""
    yield eliminated(
        "with $Q_0 = (-1,3,3)$, $R_0 = (1,3,3)$, $r^2 = 27$",
        EIGHT.text("xyz", GIVEN, 27),
        EIGHT.substituted("xyz", GIVEN, 27),
    )
    yield eliminated(
        "with letters for $Q_0$, $R_0$, $r$",
        EIGHT.text("xyz", LETTERS, "r^2"),
        EIGHT.substituted("xyz", LETTERS, "r^2"),
    )
    found = qe.region(EIGHT.substituted("xyz", GIVEN, 27), order=("q1x", "q1y", "q1z"))
    text = f"certificate of the exact cylindrical description ({len(found.cells)} cells)"
    yield verified(text, str(found.formula), found.certificate)
    asked, best = optimised("the best $Q_1$", EIGHT.objective("xyz", GIVEN), EIGHT.substituted("xyz", GIVEN, 27), "2")
    yield asked
    q1 = [best.point[f"q1{axis}"] for axis in "xyz"]
    path = curves(GIVEN, q1, START, GOAL)
    yield Table(
        ("point", "coordinates"),
        [(f"{n}{i}", ", ".join(map(str, p))) for n, c in path.items() for i, p in enumerate(c.points)],
    )
    work = Workspace(WorkspaceKind.HEMISPHERE, Fraction(27))
    outcomes = [o for item in path.values() for o in examine_all(item, work.conditions)]
    yield Fact(
        "every whole curve lies in the hemisphere, by its control points",
        all(isinstance(o, Inside) and o.test is Argument.POLYGON for o in outcomes),
    )
    yield Fact(
        "both joins are $C^1$, exactly",
        all(join(path[a], path[b]).smoothness >= Smoothness.C1 for a, b in ("PQ", "QR")),
    )
    yield Picture("The possible places of $\\hat Q_1$ for these numbers.", region(found))
    yield Picture("Top view of the three curves.", drawn_path(path, 27**0.5, "$r^2 = 27$, seen from above"))


@claim(
    key="eq-8-radius-typo",
    place="Section 4.2.1, definition of r",
    title="The radius with $\\hat R_3$",
    says="$r := \\max\\{\\|\\hat P_0\\|, \\|\\hat Q_0\\|, \\|\\hat R_0\\|, \\|\\hat R_3\\|\\}$.",
    verdict=Verdict.CORRECTED,
    finding="$\\hat R(t)$ has degree 2, so there is no $\\hat R_3$; the goal is $\\hat R_2 = R_3$. With $\\hat R_2$ "
    "the rule is that of Section 2.",
)
def radius_typo() -> Iterator[Evidence]:
    """The number of control points of a curve of degree 2 is counted, and the last one is the goal."""
    path = curves(GIVEN, (0, 3, 3), START, GOAL)
    yield Fact(
        "$\\hat R$ has the control points $\\hat R_0, \\hat R_1, \\hat R_2$ only",
        path["R"].degree == 2 and len(path["R"].points) == 3,
    )
    yield Fact("$\\hat R(1) = \\hat R_2$ is the goal", path["R"].point(1) == GOAL)
    norms = {"P0": START, "Q0": GIVEN["q0"], "R0": GIVEN["r0"], "R2": GOAL}
    yield Table(("point", "squared norm"), [(name, str(sum(c * c for c in p))) for name, p in norms.items()])
    yield Fact("for the numbers of this page $r^2 = 27$", max(sum(c * c for c in p) for p in norms.values()) == 27)


@claim(
    key="timing",
    place="Section 4.2.1, last sentence",
    title="15.4 seconds for formula (8)",
    says="The computation took about 15.4 s (Mathematica 13.3.1, Intel Core i3-8130U 2.20 GHz, 8 GB, Windows 11).",
    verdict=Verdict.NOT_TESTABLE,
    finding="Neither that program nor that machine is at hand, and the paper does not give the points. What can be "
    "said: here formula (8) as printed takes milliseconds, on whatever machine made this page.",
)
def timing() -> Iterator[Evidence]:
    """Median of five runs on this machine, in the running process: (8) with numbers, (8) with letters, existence,
    region, optimum."""
    tasks = {
        "(8) as printed, with numbers": lambda: qe.eliminate(EIGHT.text("xyz", GIVEN, 27)),
        "(8) as printed, all letters": lambda: qe.eliminate(EIGHT.text("xyz", LETTERS, "r^2")),
        "is there a control point?": lambda: qe.eliminate(EIGHT.satisfiable("xyz", GIVEN, 27)),
        "exact cylindrical description": lambda: qe.region(EIGHT.substituted("xyz", GIVEN, 27)),
        "best control point with certificate": lambda: qe.minimize(
            EIGHT.objective("xyz", GIVEN), EIGHT.substituted("xyz", GIVEN, 27), method="convex"
        ),
    }
    medians = {name: _median(task) for name, task in tasks.items()}
    yield Table(("question", "median of 5"), [(name, f"{1000 * s:.1f} ms") for name, s in medians.items()])
    yield Fact("(8) as printed takes less than 15.4 s", medians["(8) as printed, with numbers"] < 15.4)


def _median(task: Callable[[], object]) -> float:
    times = []
    for _ in range(5):
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


CLAIMS = (quadratic_joins, radius_typo, equation_8, timing)
