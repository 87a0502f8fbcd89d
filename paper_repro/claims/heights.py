"""Section 4: the assumption on the points to pass, and whether the middle curve keeps their height."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from paper_repro.ask import decided, optimised
from paper_repro.claim import Evidence, Fact, Verdict, claim
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


CLAIMS = (equal_heights, method_2_height)
