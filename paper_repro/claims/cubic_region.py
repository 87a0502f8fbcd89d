"""Section 4.2: what (7) says about Q1 alone, about the table, and about the plane of the points to pass."""

from __future__ import annotations

import time
from collections.abc import Iterator
from fractions import Fraction

import qe
from bezier.curves.containment import Leaves, examine
from bezier.curves.scalar import decimal_text, sign
from bezier.curves.workspace import Workspace, WorkspaceKind
from paper_repro.ask import LIMIT, decided, number, optimised, tex, verified
from paper_repro.claim import Asked, Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.claims.cubic import ENDS, PLANE, chosen, curves
from paper_repro.figures.regions import region
from paper_repro.figures.workspace import dips_below_floor
from paper_repro.written import SEVEN, Points

TILTED: tuple[Points, Points] = (
    {"q0": (-3, 5), "r0": (1, 5)},
    {"q0": (-3, 3, 4), "r0": (1, 3, 4)},
)
"""Two via points in the plane, and the same ones turned about the first axis by an angle with cosine 3/5."""


@claim(
    key="eq-7-region",
    place="Section 4.2, after (7)",
    title="The conditions on $Q_1$",
    says="After solving (7), conditions on $Q_1$ and $Q_2$ are obtained (they are not, in the paper).",
    verdict=Verdict.SOLVED,
    finding="They are obtained. For both points together they are six balls. For $Q_1$ alone, with $Q_2$ eliminated, "
    "the answer has degree up to 6 and several branches; its region has an exact cylindrical description.",
)
def region_of_q1() -> Iterator[Evidence]:
    """In the plane, for $Q_0 = (-1, 2)$, $R_0 = (1, 2)$, $r = 3$, the engine eliminates $Q_2$ by critical values. At
    rational points on a grid the answer is compared with the decision whether a $Q_2$ exists there."""
    given: Points = {"q0": (-1, 2), "r0": (1, 2)}
    conditions = SEVEN.substituted("xy", given, 9)
    question = f"ex q2x, q2y. {conditions}"
    start = time.perf_counter()
    answer = qe.eliminate(question, timeout=LIMIT)
    seconds = time.perf_counter() - start
    found = qe.region(answer.formula, order=("q1x", "q1y"))
    grid = [(Fraction(i, 4), Fraction(j, 4)) for i in range(-8, 3, 2) for j in range(6, 14, 2)]
    exists = [qe.decide(f"{question} and q1x = {x} and q1y = {y}".replace("q2y. ", "q2y, q1x, q1y. ")) for x, y in grid]
    agrees = exists == [found.contains({"q1x": x, "q1y": y}) for x, y in grid]
    yield Asked("conditions on $Q_1$ alone", question, tex(answer), agrees and any(exists), seconds)
    yield Fact(f"{len(grid)} points: membership agrees with the existence of $Q_2$ ({sum(exists)} times yes)", agrees)
    yield verified(f"certificate of the description ({len(found.cells)} cells)", str(found.formula), found.certificate)
    bounds = [found.bounds(name) for name in found.order]
    rows = [(name, *(decimal_text(end, 7) for end in ends)) for name, ends in zip(("x", "y"), bounds)]
    yield Table(("coordinate of Q1", "least", "greatest"), rows)
    yield Picture("Where $Q_1$ may be so that some $Q_2$ satisfies (7) with it.", region(found))


@claim(
    key="eq-7-hemisphere",
    place="Section 4.2, after (6)",
    title="All control points lie in the hemisphere",
    says="With the norm conditions of (7), all remaining control points lie in the hemisphere of radius $r$ with "
    "$z > 0$.",
    verdict=Verdict.CORRECTED,
    finding="They lie in the ball. The condition on $z$ is missing in (7), and it matters: for $Q_0 = (-1, 0, 1)$, "
    "$R_0 = (1, 0, 1)$, $r = 3/2$ even the optimum of (7) has $P_1$ and $R_2$ below the table, and the curve with "
    "them. Adding $z \\ge 0$ for the six points keeps the problem convex.",
)
def hemisphere() -> Iterator[Evidence]:
    """The optimum for $r = 3/2$ in the plane $y = 0$ of the arm is computed exactly, without and with $z \\ge 0$; the
    sign of the height is exact."""
    given = {name: (p[0], 0, p[1]) for name, p in PLANE.items()}
    printed, best = optimised(
        "(7) as printed", SEVEN.objective("xyz", given), SEVEN.substituted("xyz", given, "9/4"), "5 - 2*sqrt(2)"
    )
    yield printed
    path = curves(given, *chosen(best, "xyz"), [(x, 0, z) for x, z in ENDS])
    heights = {f"{name}{i}": item.points[i][2] for name, item in path.items() for i in (1, 2)}
    yield Table(
        ("control point", "z, exactly", "z"), [(n, f"${number(z)}$", f"{float(z):.4f}") for n, z in heights.items()]
    )
    floor = Workspace(WorkspaceKind.HEMISPHERE, Fraction(9, 4)).floor
    yield Fact("the curve $P(t)$ itself is below it at some $t$", isinstance(examine(path["P"], floor), Leaves))
    yield Fact("$P_1$ and $R_2$ are below the table", [n for n, z in heights.items() if sign(z) < 0] == ["P1", "R2"])
    above = qe.minimize(
        SEVEN.objective("xyz", given), SEVEN.substituted("xyz", given, "9/4", above=True), method="convex"
    )
    kept = curves(given, *chosen(above, "xyz"), [(x, 0, z) for x, z in ENDS])
    lowest = min(sign(item.points[i][2]) for item in kept.values() for i in (1, 2))
    yield Fact(
        f"with $z \\ge 0$ the optimum is {decimal_text(above.value, 6)}, certificate accepted, and no point is below",
        lowest >= 0 and qe.verify(above.certificate).accepted,
    )
    yield Picture(
        "Side view: the optimum of (7) as printed, with two control points below the table.",
        dips_below_floor(path, 1.5, (0, 2), "norm conditions only, $r = 3/2$"),
    )


@claim(
    key="eq-7-plane",
    place="Section 4.2, formula (7) (not in the paper)",
    title="Formula (7) is a problem in the plane of $O$, $Q_0$, $R_0$",
    says="(7) is stated with points in space: six free and twelve quantified variables.",
    verdict=Verdict.REPRODUCED,
    finding="Orthogonal projection onto a plane through $O, Q_0, R_0$ makes none of the six norms and no term of the "
    "objective larger, so existence, optimum and its value can be computed in the plane with four variables. Not so "
    "once heights or obstacles enter.",
)
def planar_reduction() -> Iterator[Evidence]:
    """The same numbers are solved in space and in the plane; the argument itself is decided for one norm: dropping the
    component orthogonal to the plane does not increase it."""
    values = []
    for axes, given in zip(("xy", "xyz"), TILTED):
        found = qe.minimize(SEVEN.objective(axes, given), SEVEN.substituted(axes, given, 36), method="convex")
        yield Fact(
            f"{len(axes)} coordinates: certificate accepted", found.is_optimal and qe.verify(found.certificate).accepted
        )
        values.append(found.value)
    yield Table(("", "least objective"), [(name, decimal_text(v, 7)) for name, v in zip(("plane", "space"), values)])
    yield Fact("the two values are equal, exactly", values[0] == values[1])
    yield decided("projection does not increase a norm", "all x, y, z, r. x^2 + y^2 + z^2 <= r^2 -> x^2 + y^2 <= r^2")


CLAIMS = (region_of_q1, hemisphere, planar_reduction)
