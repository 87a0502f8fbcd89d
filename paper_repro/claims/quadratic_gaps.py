"""Section 4.2.1: what formula (8) leaves open: no solution, the table, and solutions given away."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

import qe
from bezier.curves.containment import Inside, examine_all
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Workspace, WorkspaceKind
from paper_repro.ask import decided, eliminated, verified
from paper_repro.claim import Evidence, Fact, Picture, Verdict, claim
from paper_repro.claims.quadratic import curves
from paper_repro.figures.curves import path as drawn_path
from paper_repro.figures.regions import three_discs, two_regions
from paper_repro.figures.workspace import dips_below_floor
from paper_repro.written import EIGHT, Points, curve


@claim(
    key="eq-8-infeasible",
    place="Section 4.2.1, formula (8)",
    title="When does (8) have a solution?",
    says="By elimination the possible region of $\\hat Q_1$ is obtained and then the three curves; that there may be "
    "none is not mentioned.",
    verdict=Verdict.CORRECTED,
    finding="(8) can be infeasible. $\\|Q_0 - R_0\\| \\le r$ is necessary; the three norm conditions say "
    "that a circle of radius $r/2$ about $\\hat Q_1/2$ encloses $O, Q_0, R_0$, so (8) can be satisfied exactly if the "
    "smallest enclosing circle has radius at most $r/2$. For $Q_0 = (-d, k)$, $R_0 = (d, k)$ with $k > d > 0$ this "
    "reads $d^2 + k^2 \\le r k$.",
)
def infeasible() -> Iterator[Evidence]:
    """An instance without solution is decided and refuted with multipliers that the checker multiplies out; the
    symmetric case is solved by elimination with letters for $d, k, r$; the necessary condition is proved in the
    plane."""
    given = {"q0": (-2, 0, 1), "r0": (2, 0, 1)}
    yield decided(
        "no $\\hat Q_1$ for $Q_0 = (-2,0,1)$, $R_0 = (2,0,1)$, $r = 3$",
        EIGHT.satisfiable("xyz", given, 9),
        expected=False,
    )
    found = qe.minimize(EIGHT.objective("xyz", given), EIGHT.substituted("xyz", given, 9), method="convex")
    multipliers = ", ".join(map(str, found.multipliers))
    text = f"the norm conditions on P1, Q1, R1 times ({multipliers}) add up to a contradiction"
    yield verified(text, EIGHT.substituted("xyz", given, 9), found.certificate)
    letters = {"q0": ("(-d)", "k"), "r0": ("d", "k")}
    yield eliminated(
        "the symmetric case, with letters",
        f"k > d and d > 0 and r > 0 and ({EIGHT.satisfiable('xy', letters, 'r^2')})",
        "k > d and d > 0 and r > 0 and d^2 + k^2 <= r*k",
    )
    ends = "(2*a - x)^2 + (2*b - y)^2 <= r^2 and (2*c - x)^2 + (2*d - y)^2 <= r^2"
    yield decided(
        "$\\|Q_0 - R_0\\| \\le r$ is necessary, from $\\|\\hat P_1\\|, \\|\\hat R_1\\| \\le r$ alone",
        f"all x, y, a, b, c, d, r. r >= 0 and {ends} -> (a - c)^2 + (b - d)^2 <= r^2",
    )
    for kind, via, least in (("acute", (1, 2), Fraction(25, 4)), ("obtuse", (2, 1), Fraction(16))):
        points: Points = {"q0": (-via[0], via[1]), "r0": via}
        text = (
            f"an {kind} triangle: $Q_0 = (-{via[0]}, {via[1]})$, $R_0 = ({via[0]}, {via[1]})$ need $r^2 \\ge {least}$"
        )
        yield eliminated(text, EIGHT.satisfiable("xy", points, "s"), f"s >= {least}")
    pictures = three_discs(
        ((-1, 2), (1, 2)), (2.2, 2.5, 3.0), ("$r = 2.2$: none", "$r = 2.5$: exactly one", "$r = 3$: a region")
    )
    yield Picture(
        "The three discs for $Q_0 = (-1, 2)$, $R_0 = (1, 2)$: with $d = 1$, $k = 2$ the condition is $5 \\le 2r$.",
        pictures,
    )


@claim(
    key="eq-8-hemisphere",
    place="Section 4.2.1, before (8)",
    title="All control points lie in the hemisphere (degree 2)",
    says="The norm conditions of (8) require that all remaining control points lie in the hemisphere.",
    verdict=Verdict.CORRECTED,
    finding="They lie in the ball: $z \\ge 0$ is dropped. For $Q_0 = (0, 1, 1/10)$, $R_0 = (1/10, 1, 1/10)$, $r = 2$ "
    "the choice $\\hat Q_1 = (0,1,1)$ satisfies (8) and puts $\\hat P_1$ at height $-4/5$. With "
    "$0 \\le z(\\hat Q_1) \\le 2 z(\\hat Q_0), 2 z(\\hat R_0)$ added, the region is the same with three planes cut "
    "off.",
)
def hemisphere() -> Iterator[Evidence]:
    """The engine is asked for control points that (8) allows and that are below the table; the example is put into
    (8); the corrected formula is eliminated."""
    given = {"q0": (0, 1, Fraction(1, 10)), "r0": (Fraction(1, 10), 1, Fraction(1, 10))}
    below = " or ".join(f"{p}z < 0" for p in EIGHT.bounded)
    block = ", ".join(f"{p}{axis}" for p in (*EIGHT.chosen, *EIGHT.block) for axis in "xyz")
    yield decided(
        "(8) allows a control point below the table", f"ex {block}. {EIGHT.body('xyz', given, 4)} and ({below})"
    )
    chosen = "q1x = 0 and q1y = 1 and q1z = 1"
    yield decided(
        "namely $\\hat Q_1 = (0,1,1)$ with $\\hat P_1 = (0, 1, -4/5)$",
        f"ex {block}. {chosen} and {EIGHT.body('xyz', given, 4)} and p1x = 0 and p1y = 1 and p1z = -4/5",
    )
    yield eliminated(
        "corrected: with $z \\ge 0$ for $\\hat P_1, \\hat Q_1, \\hat R_1$",
        EIGHT.text("xyz", given, 4, above=True),
        EIGHT.substituted("xyz", given, 4, above=True),
    )
    path = curves(given, (0, 1, 1), (0, Fraction(-6, 5), Fraction(8, 5)), (0, Fraction(8, 5), Fraction(6, 5)))
    yield Picture(
        "Side view: (8) is satisfied, $P_1$ and $R_1$ are below the table.",
        dips_below_floor(path, 2.0, (1, 2), "(8) holds with $r = 2$"),
    )


@claim(
    key="eq-8-sufficient",
    place="Section 4.2.1, formula (8)",
    title="The control polygon test gives away solutions",
    says="The region of $\\hat Q_1$ is defined by control points in the ball, which guarantees that the curves stay "
    "in it.",
    verdict=Verdict.CORRECTED,
    finding="It is sufficient only. Asking the same of the whole curves, (8*): "
    "$\\|\\hat P(t)\\|, \\|\\hat Q(t)\\|, \\|\\hat R(t)\\| \\le r$ for all $t$, gives a larger region; there are "
    "points for which (8) has no solution and (8*) has one.",
)
def sufficient_only() -> Iterator[Evidence]:
    """In the plane, $t$ is eliminated from (8*): first for one $\\hat Q_1$ where (8) is infeasible, then on the line
    of symmetry of another instance, where both answers are intervals."""
    path = curves({"q0": (-2, 1), "r0": (2, 1)}, (0, 1), (-1, 0), (0, 3))
    yield decided(
        "(8) has no solution for $Q_0 = (-2,1)$, $R_0 = (2,1)$, $r = 3$",
        EIGHT.satisfiable("xy", {"q0": (-2, 1), "r0": (2, 1)}, 9),
        expected=False,
    )
    for name, item in path.items():
        yield decided(
            f"${name}(t)$ stays in the disc for $Q_1 = (0, 1)$, from $(-1,0)$ to $(0,3)$",
            f"all t. {_stays(item.points)}",
        )
    yield Picture(
        "A path in the disc although $P_1$ and $R_1$ are outside and (8) has no solution.",
        drawn_path(path, 3.0, "$r = 3$"),
    )
    given: Points = {"q0": (-1, 2), "r0": (1, 2)}
    symbolic = [
        ((-3, 0), (-2, "(4 - y)"), (-1, 2)),
        ((-1, 2), (0, "y"), (1, 2)),
        ((1, 2), (2, "(4 - y)"), (3, 0)),
    ]
    yield eliminated(
        "(8) for $Q_0 = (-1,2)$, $R_0 = (1,2)$, $r = 3$ and $Q_1 = (0, y)$",
        f"ex q1x. q1x = 0 and {EIGHT.substituted('xy', given, 9).replace('q1y', 'y')}",
        "y <= 3 and (y - 4)^2 <= 5",
    )
    longer = "8*y^4 - 116*y^3 + 481*y^2 - 706*y + 257 <= 0 and y <= 4"
    yield eliminated(
        "(8*) there, from $(-3,0)$ to $(3,0)$", f"all t. {' and '.join(f'({_stays(p)})' for p in symbolic)}", longer
    )
    yield decided("every solution of (8) is one of (8*)", f"all y. y <= 3 and (y - 4)^2 <= 5 -> {longer}")
    heights = [Fraction(k, 8) for k in range(40)]
    on_axis = qe.region(longer)
    kept = [_keeps(curves(given, (0, y), (-3, 0), (3, 0)), 9) for y in heights]
    yield Fact(
        "40 values of $y$: the formula agrees with the examination of the curves",
        kept == [on_axis.contains({"y": y}) for y in heights],
    )
    discs = [(center, 3.0) for center in ((0, 0), (-2, 4), (2, 4))]
    drawing = two_regions(discs, lambda x, y: _depth(given, x, y), (-2.6, 2.6, 0.2, 4.6))
    yield Picture(
        "Where $Q_1$ may be for $Q_0 = (-1,2)$, $R_0 = (1,2)$, $r = 3$, start $(-3,0)$ and goal $(3,0)$.", drawing
    )


def _stays(points: Sequence[Sequence[Any]]) -> str:
    """The curve with these control points in the plane stays in the disc."""
    x, y = (curve([p[k] for p in points]) for k in (0, 1))
    return f"0 <= t and t <= 1 -> ({x})^2 + ({y})^2 <= 9"


def _keeps(path: Mapping[str, Bezier], radius_squared: int) -> bool:
    disc = Workspace(WorkspaceKind.BALL, Fraction(radius_squared), dimension=2)
    return all(isinstance(o, Inside) for item in path.values() for o in examine_all(item, disc.conditions))


def _depth(given: Points, x: Any, y: Any) -> Any:
    """The least of (r^2 - |p(t)|^2) / (t (1 - t)) along the curves, for drawing: nonnegative where they stay in.

    The division keeps the ends, which may lie on the boundary, from hiding what happens beside them.
    """
    t = np.linspace(0, 1, 42)[1:-1, None, None]
    found = []
    for item in curves(given, (x, y), (-3, 0), (3, 0)).values():
        a, b, c = item.points
        at = [(1 - t) ** 2 * float(u) + 2 * t * (1 - t) * v + t**2 * float(w) for u, v, w in zip(a, b, c)]
        found.append(((9 - at[0] ** 2 - at[1] ** 2) / (t * (1 - t))).min(axis=0))
    return np.min(found, axis=0)


CLAIMS = (infeasible, hemisphere, sufficient_only)
