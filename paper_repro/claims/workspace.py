"""Section 2: the feasible region and its radius."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from paper_repro.ask import decided
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.workspace import feasible_region, radius_rule

GIVEN = {"S": (-4, 1), "C1": (-2, 3), "C2": (2, 4), "G": (4, 1)}


@claim(
    key="feasible-region",
    place="Section 2, first and second paragraph; Figure 1",
    title="The feasible region is a hemisphere",
    says="The end effector reaches every point of the hemisphere about the base (surface and interior, $z$ "
    "positive), except the origin itself.",
    verdict=Verdict.REPRODUCED,
    finding="Taken as the model it is. The hemisphere is convex, which the later arguments need; leaving out $O$ "
    "makes it non-convex, but does no harm: a curve that starts above the table and whose control points are not "
    "below it never meets $O$ before its end.",
)
def feasible_region_is_convex() -> Iterator[Evidence]:
    """Convexity is decided in the plane through $O$ and two points of the region. For the origin: the height of a
    cubic curve with $z_0 > 0$ and $z_1, z_2, z_3 \\ge 0$ stays positive before the end."""
    disc = "{0}x^2 + {0}z^2 <= r^2 and {0}z >= 0"
    between = "(s*ax + (1 - s)*bx)^2 + (s*az + (1 - s)*bz)^2 <= r^2 and s*az + (1 - s)*bz >= 0"
    yield decided(
        "with two points the half-disc contains all points between them",
        f"all ax, az, bx, bz, r, s. {disc.format('a')} and {disc.format('b')} and 0 <= s and s <= 1 -> {between}",
    )
    height = "(1 - t)^3*z0 + 3*t*(1 - t)^2*z1 + 3*t^2*(1 - t)*z2 + t^3*z3"
    yield decided(
        "a cubic curve that starts above the table stays above it until its end",
        f"all t, z0, z1, z2, z3. 0 <= t and t < 1 and z0 > 0 and z1 >= 0 and z2 >= 0 and z3 >= 0 -> {height} > 0",
    )
    yield Picture("Figure 1, redrawn: the feasible region of the manipulator.", feasible_region(1.0))


@claim(
    key="radius-rule",
    place="Section 2, third and fourth paragraph; Figure 2",
    title="The radius of the feasible region",
    says="$r$ is the largest of the distances from $O$ to the start, the end and the points to pass.",
    verdict=Verdict.REPRODUCED,
    finding="As a definition it is reproduced: the ball of this radius is the smallest about $O$ that holds the "
    "given points.",
)
def radius() -> Iterator[Evidence]:
    """The rule is applied to four points placed as in Figure 2, with exact squared distances; the engine shows that
    the largest distance is the least radius that holds all points."""
    squares = {name: sum(c * c for c in point) for name, point in GIVEN.items()}
    yield Table(("point", "coordinates", "squared distance"), [(n, str(GIVEN[n]), str(s)) for n, s in squares.items()])
    farthest = max(squares, key=lambda name: squares[name])
    yield Fact("$C_2$ is farthest from $O$, so $r = \\|C_2\\| = \\sqrt{20}$", farthest == "C2" and squares["C2"] == 20)
    needed = " and ".join(f"{s} <= r^2" for s in squares.values())
    yield decided("all four points lie in the ball exactly if $r^2 \\ge 20$", f"all r. {needed} <-> 20 <= r^2")
    yield Picture("Figure 2, redrawn: the radius of the feasible region.", radius_rule(GIVEN, farthest))


@claim(
    key="nearer-is-reachable",
    place="Section 2, last sentence",
    title="What is nearer than a reachable point is reachable",
    says="With the radius so defined, the end effector can of course reach every point that is nearer to $O$.",
    verdict=Verdict.DIFFERS,
    finding="This follows from the hemisphere model, not from the arm. For the arm of the authors' earlier work "
    "($L = 120$ mm, reference [10]) the point $(0, 0, 300)$ can be reached and the nearer point "
    "$(290, 0, 0)$ cannot.",
)
def nearer_is_reachable() -> Iterator[Evidence]:
    """The arm has two moving links of length $\\sqrt{18752}$ and 120 in a vertical plane that turns about the $z$
    axis, on a shoulder at $(44\\sqrt 2, 104 + 44\\sqrt 2)$ in that plane; $w = \\sqrt 2$ is described by $w^2 = 2$
    and $w > 0$. The engine asks for joint positions."""
    arm = (
        "ex w, u, v. w^2 = 2 and w > 0 and u^2 + v^2 = 18752 and ({x} - 44*w - u)^2 + ({z} - 104 - 44*w - v)^2 = 14400"
    )
    yield decided("$(0, 0, 300)$ can be reached", arm.format(x="0", z="300"))
    for x in ("290", "-290"):
        text = f"$(290, 0, 0)$ cannot, with the arm turned {'towards' if x == '290' else 'away from'} it"
        yield decided(text, arm.format(x=f"({x})", z="0"), expected=False)
    yield Fact("$290 < 300$", Fraction(290) < 300)


CLAIMS = (feasible_region_is_convex, radius, nearer_is_reachable)
