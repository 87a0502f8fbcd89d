"""Section 4: the assumption on the points to pass, and whether the middle curve keeps their height."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import qe
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.paths.heights import Below, heights_of
from bezier.paths.path import assemble
from bezier.problem import PlanMethod, Problem
from paper_repro.ask import decided, optimised
from paper_repro.claim import Evidence, Fact, Table, Verdict, claim
from paper_repro.written import EIGHT, SEVEN, Points, curve, names

GIVEN: Points = {"q0": (-1, 3, 3), "r0": (1, 3, 3)}


@claim(
    key="equal-heights",
    place="Section 4, first paragraph",
    title="The two points to pass have the same $y$ and $z$",
    says="Two points that the curve must pass are given; they have the same $y$ and $z$ coordinates.",
    verdict=Verdict.REPRODUCED,
    finding="An assumption, and a useful one: with it the best choice under (8) never has a control point below the "
    "table, although (8) has no condition on $z$. For points of different height it can have one.",
)
def equal_heights() -> Iterator[Evidence]:
    """In the plane of $O, Q_0, R_0$ write $Q_0 = (a, k)$, $R_0 = (b, k)$, $\\hat Q_1 = (x, v)$ with $k > 0$; heights
    are proportional to the second coordinate. If $\\hat P_1$ or $\\hat Q_1$ were below the table ($v > 2k$ or $v <
    0$), then $(x, 2k)$ or $(x, 0)$ would be allowed too, and better."""
    given = {"q0": ("a", "k"), "r0": ("b", "k")}
    allowed = EIGHT.substituted("xy", given, "r^2")
    for case, moved in (("q1y > 2*k", "2*k"), ("q1y < 0", "0")):
        better = allowed.replace("q1y", f"({moved})")
        for name, condition in zip(("P_1", "Q_1", "R_1"), better.split(" and ")):
            sentence = f"all a, b, k, q1x, q1y, r. k > 0 and {case} and {allowed} -> {condition}"
            text = f"if $v {case[4]} {moved.replace('*', '')}$, the moved point satisfies the condition on ${name}$"
            yield decided(text, sentence)
        nearer = f"({moved} - k)^2 < (q1y - k)^2"
        yield decided("and is nearer to the middle of $Q_0 R_0$", f"all k, q1y. k > 0 and {case} -> {nearer}")
    uneven: Points = {"q0": (-1, 3, Fraction(1, 10)), "r0": (1, 3, 3)}
    objective, conditions = EIGHT.objective("xyz", uneven), EIGHT.substituted("xyz", uneven, 36)
    best, found = optimised(
        "$Q_0 = (-1,3,1/10)$, $R_0 = (1,3,3)$, $r = 6$: the best choice", objective, conditions, "1241/200"
    )
    yield best
    yield Fact("has $\\hat P_1$ at height $-27/20$", Fraction(2, 10) - found.point["q1z"] == Fraction(-27, 20))


@claim(
    key="method-2-height",
    place="Section 4.2, after (5)",
    title="The middle curve avoids the obstacle",
    says="The second curve $Q(t)$ avoids the obstacle: $y$ and $z$ exceed a certain value in a certain interval of "
    "$x$.",
    verdict=Verdict.CORRECTED,
    finding="Neither (7) nor (8) contains the heights: both allow middle curves that sink below the points to pass. "
    "The best choice may run straight from $Q_0$ to $R_0$, exactly at their height. Heights of the control points of "
    "$Q(t)$ as further conditions repair this; they keep the problem convex.",
)
def method_2_height() -> Iterator[Evidence]:
    """For $Q_0 = (-1,3,3)$, $R_0 = (1,3,3)$, $r^2 = 27$ the engine looks for allowed control points whose curve is
    lower than 3 half-way, and for allowed control points at or above 3, which keep the whole curve there."""
    middle = {"(8)": (EIGHT, ["3", "q1z", "3"]), "(7)": (SEVEN, ["3", "q1z", "q2z", "3"])}
    for name, (printed, heights) in middle.items():
        conditions = printed.substituted("xyz", GIVEN, 27)
        free = ", ".join(f"{p}{axis}" for p in printed.chosen for axis in "xyz")
        low = f"ex {free}. {conditions} and {curve(heights, '(1/2)')} < 3"
        yield decided(f"{name} allows a middle curve that is below height 3 half-way", low)
        high = " and ".join(f"{p}z >= 3 and {p}y >= 3" for p in printed.chosen)
        yield decided(
            f"{name} with $y, z \\ge 3$ for the control points of $Q$ can be satisfied",
            f"ex {free}. {conditions} and {high}",
        )
    best, _ = optimised(
        "the best choice under (8)", EIGHT.objective("xyz", GIVEN), EIGHT.substituted("xyz", GIVEN, 27), "2"
    )
    yield best
    points = names("u", 3)
    above = " and ".join(f"{u} >= h" for u in points)
    yield decided(
        "control points at or above $h$ keep a cubic curve there",
        f"all t, h, {', '.join(points)}. 0 <= t and t <= 1 and {above} -> {curve(points)} >= h",
    )


OUTER: Points = {
    "q0": (-1, Fraction(7, 10), Fraction(7, 10)),
    "r0": (1, Fraction(7, 10), Fraction(7, 10)),
}
START = (Fraction(-21, 20), 0, Fraction(1, 10))


@claim(
    key="method-2-outer",
    place="Section 4.2, after (5) (not in the paper)",
    title="The outer curves keep away from the obstacle",
    says="$P(t)$ leads from the start to the interval of $x$ that holds the obstacle, $Q(t)$ avoids it, $R(t)$ leads "
    "on to the end. Heights are asked of $Q(t)$ only.",
    verdict=Verdict.DIFFERS,
    finding="$P(t)$ and $R(t)$ may come back into the interval below the heights. For $Q_0 = (-1, 7/10, 7/10)$, "
    "$R_0 = (1, 7/10, 7/10)$, start $(-21/20, 0, 1/10)$ and $r = 3/2$ the best choice under (7) in the hemisphere "
    "does: $P(t)$ has $x > -1$ for $t$ from 0.102 to 0.287, at heights down to 0.086. The condition has to hold for "
    "all three curves; `bezier plan` decides it in every plan.",
)
def method_2_outer() -> Iterator[Evidence]:
    """The optimum of (7) with $z \\ge 0$ is computed exactly; its coordinates lie in one number field. The engine,
    given the polynomial of the field's generator $w$, looks for a $t$ at which $P(t)$ is inside the interval and low.
    The stretches below the heights are then isolated."""
    found = qe.minimize(SEVEN.objective("xyz", OUTER), SEVEN.substituted("xyz", OUTER, "9/4", above=True))
    yield Fact("the optimum is found, certificate accepted", found.is_optimal and qe.verify(found.certificate).accepted)
    q1, q2 = ([found.point[f"{p}{axis}"] for axis in "xyz"] for p in SEVEN.chosen)
    p1 = [4 * q - 4 * a + b for q, a, b in zip(OUTER["q0"], q1, q2)]
    p2 = [2 * q - a for q, a in zip(OUTER["q0"], q1)]
    low, high = q1[0].field.theta.interval(20)
    powers = enumerate(q1[0].field.minimal_polynomial)
    field = " + ".join(f"({c})*w^{k}" for k, c in powers) + f" = 0 and {low} < w and w < {high}"
    x, z = (curve([START[k], _in_w(p1[k]), _in_w(p2[k]), OUTER["q0"][k]]) for k in (0, 2))
    inside = f"0 < t and t < 1 and {x} > -1 and {x} < 1"
    yield decided("$P(t)$ is below the height 7/10 somewhere inside", f"ex w, t. {field} and {inside} and {z} < 7/10")
    yield decided("and below 9/100", f"ex w, t. {field} and {inside} and {z} < 9/100")
    problem = Problem(
        PlanMethod.CUBIC,
        Workspace(WorkspaceKind.HEMISPHERE, Fraction(9, 4)),
        START,
        (tuple(OUTER["q0"]), tuple(OUTER["r0"])),
        (-START[0], *START[1:]),
        False,
    )
    drawn = Bezier.of((START, p1, p2, OUTER["q0"]))
    below = heights_of(problem.strip, assemble({"P": drawn}, {}, problem.workspace)).below
    ends = [(item.axis, *(f"{float(side.t[0]):.6f}" for side in (item.begin, item.end))) for item in below]
    yield Table(("height in", "below from t", "to t"), ends)
    yield Fact("both heights are violated on one stretch of $P(t)$, between its two passages of $x = -1$", _same(below))


def _in_w(value: Any) -> str:
    """An element of a number field as a polynomial in its generator."""
    return " + ".join(f"({c})*w^{k}" for k, c in enumerate(value.coefficients))


def _same(below: Sequence[Below]) -> bool:
    crossed = all(side.at == "x = -1" for item in below for side in (item.begin, item.end))
    return crossed and [item.axis for item in below] == ["y", "z"]


CLAIMS = (equal_heights, method_2_height, method_2_outer)
