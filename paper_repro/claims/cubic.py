"""Section 4.2: three cubic curves, formula (7), and the choice of Q1 and Q2."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.curve import Bezier, Smoothness, join
from bezier.curves.scalar import decimal_text, dot, is_zero
from paper_repro.ask import decided, eliminated, number, optimised
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.curves import curvature
from paper_repro.figures.curves import path as drawn_path
from paper_repro.written import SEVEN, Points

SPACE: Points = {"q0": (-1, 3, 3), "r0": (1, 3, 3)}
PLANE: Points = {"q0": (-1, 1), "r0": (1, 1)}
LETTERS: Points = {"q0": ("q0x", "q0y", "q0z"), "r0": ("r0x", "r0y", "r0z")}
ENDS = ((Fraction(-3, 2), 0), (Fraction(3, 2), 0))
"""Start and goal in the plane, which make the radius 3/2."""


def curves(given: Points, q1: Sequence[Any], q2: Sequence[Any], ends: Sequence[Sequence[Any]]) -> Mapping[str, Bezier]:
    """The three cubic curves by (6)."""
    rows = list(zip(given["q0"], given["r0"], q1, q2))
    p1, p2 = [4 * q - 4 * a + b for q, _, a, b in rows], [2 * q - a for q, _, a, _ in rows]
    r1, r2 = [2 * r - b for _, r, _, b in rows], [a - 4 * b + 4 * r for _, r, a, b in rows]
    q0, r0 = given["q0"], given["r0"]
    return {
        "P": Bezier.of((ends[0], p1, p2, q0)),
        "Q": Bezier.of((q0, q1, q2, r0)),
        "R": Bezier.of((r0, r1, r2, ends[1])),
    }


def chosen(found: qe.Optimum, axes: str) -> tuple[list[Any], list[Any]]:
    """Q1 and Q2 of an optimum."""
    first, second = ([found.point[f"{p}{axis}"] for axis in axes] for p in SEVEN.chosen)
    return first, second


@claim(
    key="eq-7",
    place="Section 4.2, formula (7) and the paragraph after it",
    title="Elimination for formula (7)",
    says="Quantifier elimination for (7) is computationally expensive and has not yet been successful.",
    verdict=Verdict.SOLVED,
    finding="It succeeds in milliseconds, with numbers and with all of $Q_0, R_0, r$ as letters. All equations are "
    "linear, so elimination substitutes; what remains are six ball conditions on $(Q_1, Q_2)$, a convex set.",
)
def equation_7() -> Iterator[Evidence]:
    """(7) is written in coordinates exactly as printed (18 variables, 12 of them quantified, 12 equations, 6 norms)
    and given to the engine; the answer is compared with the six conditions written out by hand."""
    yield eliminated(
        "with $Q_0 = (-1,3,3)$, $R_0 = (1,3,3)$, $r^2 = 27$",
        SEVEN.text("xyz", SPACE, 27),
        SEVEN.substituted("xyz", SPACE, 27),
    )
    yield eliminated(
        "with letters for $Q_0$, $R_0$ and $r$",
        SEVEN.text("xyz", LETTERS, "r^2"),
        SEVEN.substituted("xyz", LETTERS, "r^2"),
    )
    yield decided("and there are control points for the numbers", SEVEN.satisfiable("xyz", SPACE, 27))


@claim(
    key="eq-7-choice",
    place="Section 4.2, after (7)",
    title="Choosing $Q_1$ and $Q_2$",
    says="$Q_1$ and $Q_2$ are chosen such that $\\|Q_1 - Q_0\\|^2 + \\|Q_2 - Q_1\\|^2 + \\|R_0 - Q_2\\|^2$ is as "
    "small as possible under (7); this gives a path through the two points (the positions were not obtained).",
    verdict=Verdict.SOLVED,
    finding="The positions are obtained, as exact algebraic numbers with a certificate of optimality. The problem is "
    "convex and its optimum unique. Without active conditions $Q_1 = (2Q_0 + R_0)/3$, $Q_2 = (Q_0 + 2R_0)/3$; this "
    "is the optimum exactly if $\\|5Q_0 - 2R_0\\| \\le 3r$ and $\\|5R_0 - 2Q_0\\| \\le 3r$.",
)
def choice() -> Iterator[Evidence]:
    """Exact convex optimisation for $Q_0 = (-1,1)$, $R_0 = (1,1)$ in the plane and several radii, and for an instance
    in space. The joins are compared exactly; the threshold is decided by putting the interior solution into (7)."""
    rows = []
    for radius in (Fraction(13, 5), Fraction(2), Fraction(17, 10), Fraction(3, 2)):
        found = qe.minimize(SEVEN.objective("xy", PLANE), SEVEN.substituted("xy", PLANE, radius**2), method="convex")
        accepted = qe.verify(found.certificate).accepted
        yield Fact(
            f"$r = {radius}$: optimum found, unique, certificate accepted",
            found.is_optimal and found.unique is True and accepted,
        )
        q1, _ = chosen(found, "xy")
        names = ", ".join(active(found, radius**2)) or "none"
        rows.append((str(radius), decimal_text(found.value, 7), f"({float(q1[0]):.5f}, {float(q1[1]):.5f})", names))
    yield Table(("r", "objective", "Q1 (Q2 is its mirror image)", "active conditions"), rows)
    exact, best = optimised(
        "$r = 3/2$, exactly", SEVEN.objective("xy", PLANE), SEVEN.substituted("xy", PLANE, "9/4"), "5 - 2*sqrt(2)"
    )
    yield exact
    q1, q2 = chosen(best, "xy")
    yield Table(("point", "x", "y"), [(n, *(f"${number(c)}$" for c in p)) for n, p in (("Q1", q1), ("Q2", q2))])
    space, _ = optimised(
        "in space, $r^2 = 27$", SEVEN.objective("xyz", SPACE), SEVEN.substituted("xyz", SPACE, 27), "4/3"
    )
    yield space
    thirds = {"q1": "(2*q0 + r0)/3", "q2": "(q0 + 2*r0)/3"}
    interior = SEVEN.substituted("x", {"q0": ("q",), "r0": ("s",)}, "r^2")
    for name, value in thirds.items():
        interior = interior.replace(f"{name}x", "(" + value.replace("q0", "q").replace("r0", "s") + ")")
    yield decided(
        "on a line: the thirds satisfy (7) exactly if the two conditions hold, for $|Q_0|, |R_0| \\le r$",
        f"all q, s, r. q^2 <= r^2 and s^2 <= r^2 -> ({interior} <-> (5*q - 2*s)^2 <= 9*r^2 and (5*s - 2*q)^2 <= 9*r^2)",
    )
    path = curves(PLANE, q1, q2, ENDS)
    smooth = [join(path[a], path[b]).smoothness for a, b in ("PQ", "QR")]
    yield Fact("the three curves join $C^2$, exactly", all(s is Smoothness.C2 for s in smooth))
    yield Picture(
        "The optimal path for $r = 3/2$, from $(-3/2, 0)$ to $(3/2, 0)$.",
        drawn_path(path, 1.5, "$Q_0 = (-1, 1)$, $R_0 = (1, 1)$, control points within $r = 3/2$"),
    )
    yield Picture("Its curvature is continuous at the joins.", curvature(path))


def active(found: qe.Optimum, radius_squared: Fraction) -> list[str]:
    """Names of the inner control points whose norm is exactly r at an optimum in the plane."""
    q1, q2 = chosen(found, "xy")
    path = curves(PLANE, q1, q2, ENDS)
    inner = {f"{name}{i}": item.points[i] for name, item in path.items() for i in (1, 2)}
    return [name for name, p in inner.items() if is_zero(dot(p, p) - radius_squared)]


CLAIMS = (equation_7, choice)
