"""The claims of the abstract and of Section 5. Most rest on entries above; the page links to them."""

from __future__ import annotations

from collections.abc import Iterator

from paper_repro.ask import decided
from paper_repro.claim import Evidence, Verdict, claim
from paper_repro.written import EIGHT, SEVEN


@claim(
    key="conclusion-method-1",
    place="Section 5, first paragraph",
    title="Method 1 avoids obstacles with a minimal curve",
    says="The first method avoids obstacles with a minimum curve that matches position and size of the obstacle, but "
    "does not guarantee that the curve stays in the feasible region.",
    verdict=Verdict.DIFFERS,
    finding="The second half is right. The first is not: the curve may dip below the height between $a$ and $b$, and "
    "what is minimised is a sum of inner ordinates, whose optimum is not unique; it says little about the curve.",
    rests_on=("eq-4", "eq-4-dip", "method-1-leaves"),
)
def method_1() -> Iterator[Evidence]:
    """Follows from the entries on (4)."""
    yield from ()


@claim(
    key="conclusion-guarantee",
    place="Abstract; Section 5, first paragraph",
    title="Method 2 keeps the curve in the feasible region",
    says="The second method guarantees that the curve does not go outside the feasible region.",
    verdict=Verdict.CORRECTED,
    finding="True for the ball. For the hemisphere, which is the feasible region of the paper, the conditions "
    "$z \\ge 0$ on the control points have to be added, to (7) as to (8); then it is guaranteed.",
    rests_on=("convex-hull", "feasible-region", "eq-7-hemisphere", "eq-8-hemisphere"),
)
def guarantee() -> Iterator[Evidence]:
    """Follows from the convex hull property; the last step is decided for a cubic curve in the plane: control points
    in the half-disc keep the height of the curve nonnegative."""
    yield decided(
        "nonnegative heights of the control points give a nonnegative height of the curve",
        "all t, a, b, c, d. 0 <= t and t <= 1 and a >= 0 and b >= 0 and c >= 0 and d >= 0 -> (1 - t)^3*a + 3*t*(1 - "
        "t)^2*b + 3*t^2*(1 - t)*c + t^3*d >= 0",
    )


@claim(
    key="conclusion-cost",
    place="Section 5, first paragraph",
    title="The cubic method costs too much",
    says="For the second method the calculation cost is high and the positions of the control points have not been "
    "obtained.",
    verdict=Verdict.SOLVED,
    finding="Elimination takes milliseconds; a solution always exists; the best one is found exactly, with a "
    "certificate, in a fraction of a second. It is a usable path only where no point to pass lies at distance $r$.",
    rests_on=("eq-7", "eq-7-always", "eq-7-choice"),
)
def cost() -> Iterator[Evidence]:
    """Follows from the entries on (7)."""
    yield from ()


@claim(
    key="conclusion-practical",
    place="Section 5, first paragraph",
    title="The method with degree 2 works in practical time",
    says="To overcome this, the alternative with 2-degree curves can be calculated in a practical time.",
    verdict=Verdict.CORRECTED,
    finding="It can, but it is no substitute in general: (8) can be infeasible where (7) has a solution, and the "
    "curves join only $C^1$.",
    rests_on=("eq-8", "eq-8-infeasible", "eq-7-always", "timing"),
)
def practical() -> Iterator[Evidence]:
    """One instance for both formulas."""
    given = {"q0": (-2, 0, 1), "r0": (2, 0, 1)}
    yield decided(
        "(8) has no solution for $(-2,0,1)$, $(2,0,1)$, $r = 3$", EIGHT.satisfiable("xyz", given, 9), expected=False
    )
    yield decided("(7) has one for the same points", SEVEN.satisfiable("xyz", given, 9))


@claim(
    key="conclusion-future",
    place="Section 5, last two paragraphs; also Section 1, fourth paragraph",
    title="Novelty and future work",
    says="Bézier curves have hardly been used in trajectory planning with computer algebra; better constraints, "
    "efficiency and joint sequences are the next steps.",
    verdict=Verdict.NOT_TESTABLE,
    finding="Statements about the literature and about plans. Of the plans this project takes up better constraints "
    "(heights, obstacles, whole-curve tests), efficiency and joint sequences.",
    rests_on=("arm-joint-sequence",),
)
def future() -> Iterator[Evidence]:
    """Nothing to compute."""
    yield from ()


CLAIMS = (method_1, guarantee, cost, practical, future)
