"""Section 1: why polylines and splines do not suffice."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction

from bezier.arm.reader import natural_spline
from bezier.curves.containment import Leaves, examine
from bezier.curves.curve import Smoothness, join
from bezier.curves.workspace import Workspace, WorkspaceKind
from paper_repro.ask import decided, eliminated
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.workspace import spline_outside

DISC = Workspace(WorkspaceKind.HEMISPHERE, Fraction(25), dimension=2)
STOPS = ((-5, 0), (-4, 3), (4, 3), (5, 0))


@claim(
    key="polyline",
    place="Section 1, third paragraph",
    title="A polyline has jumps of velocity at its vertices",
    says="A path made of straight lines may have discontinuous velocity and acceleration at the vertices.",
    verdict=Verdict.REPRODUCED,
    finding="At a real corner the velocity jumps, whatever the speeds on the two sides; only a stop avoids it.",
)
def polyline() -> Iterator[Evidence]:
    """The lines from $A$ to $O$ and from $O$ to $B$ are run through in the times $1/u$ and $1/v$ for any $u, v > 0$.
    Elimination of the speeds gives the exact condition for equal velocities at the vertex."""
    yield eliminated(
        "equal velocities $-u A = v B$ are possible exactly if $O$ lies between $A$ and $B$ on one line",
        "ex u, v. u > 0 and v > 0 and -u*ax = v*bx and -u*ay = v*by and (ax /= 0 or ay /= 0) and (bx /= 0 or by /= 0)",
        "ax*by - ay*bx = 0 and ax*bx + ay*by < 0",
    )


@claim(
    key="spline-leaves",
    place="Section 1, third paragraph",
    title="A spline curve may leave the feasible region",
    says="The cubic spline curve through the given points need not lie in the feasible region.",
    verdict=Verdict.REPRODUCED,
    finding="The natural cubic spline through four points on the boundary of a half-disc leaves it.",
)
def spline_leaves() -> Iterator[Evidence]:
    """The natural cubic spline through $(-5,0), (-4,3), (4,3), (5,0)$, all at distance 5 from $O$, is computed exactly
    and examined over the whole parameter interval."""
    spans = natural_spline([tuple(map(Fraction, stop)) for stop in STOPS])
    smooth = all(join(a, b).smoothness is Smoothness.C2 for a, b in itertools.pairwise(spans))
    free = all(c == 0 for c in (*spans[0].derivative(2, 0), *spans[2].derivative(2, 1)))
    yield Fact("the three cubic spans pass the points, join $C^2$, and have no curvature at the ends", smooth and free)
    outcome = examine(spans[0], DISC.ball)
    assert isinstance(outcome, Leaves)
    point = tuple(map(str, outcome.point))
    yield Table(
        ("parameter t", "point", "squared distance from O"),
        [(str(outcome.t), f"({', '.join(point)})", str(25 - outcome.margin))],
    )
    x, y = ("-5 - 4/3*t + 7/3*t^3", "18/5*t - 3/5*t^3")
    yield decided("the engine finds a parameter outside, too", f"ex t. 0 <= t and t <= 1 and ({x})^2 + ({y})^2 > 25")
    yield Picture(
        "The spline bulges over the boundary of the half-disc near its ends.", spline_outside(spans, 5, outcome.point)
    )


CLAIMS = (polyline, spline_leaves)
