"""Section 2: the feasible region and its radius."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import qe
from paper_repro.ask import decided, eliminated
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.workspace import feasible_region, radius_rule
from paper_repro.written import EIGHT, SEVEN, Points, inside

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
    "below it never meets $O$ before its end. `bezier plan` notes a path that goes through $O$.",
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
    verdict=Verdict.CORRECTED,
    finding="As a definition it is reproduced: the ball of this radius is the smallest about $O$ that holds the "
    "given points. But it defeats Method 2 whenever a point to pass is the farthest one, as in the paper's own "
    "Figure 2: then (7) and (8) force its neighbouring control points onto it, so that every path stops there, and (8) "
    "has no solution if both points to pass are at distance $r$. A slightly larger radius is needed, such as 5 instead "
    "of $\\sqrt{20}$ for Figure 2.",
)
def radius() -> Iterator[Evidence]:
    """The rule is applied to four points placed as in Figure 2, with exact squared distances. In space, with letters
    for everything, the engine decides what the conditions $\\|Q_1\\| \\le r$ and $\\|2 Q_0 - Q_1\\| \\le r$ of (7) and
    (8) say if $\\|Q_0\\| = r$. For Figure 2 the optimum of (7) is computed with both radii."""
    squares = {name: sum(c * c for c in point) for name, point in GIVEN.items()}
    yield Table(("point", "coordinates", "squared distance"), [(n, str(GIVEN[n]), str(s)) for n, s in squares.items()])
    farthest = max(squares, key=lambda name: squares[name])
    yield Fact("$C_2$ is farthest from $O$, so $r = \\|C_2\\| = \\sqrt{20}$", farthest == "C2" and squares["C2"] == 20)
    needed = " and ".join(f"{s} <= r^2" for s in squares.values())
    yield decided("all four points lie in the ball exactly if $r^2 \\ge 20$", f"all r. {needed} <-> 20 <= r^2")
    letters = {"q0": ("a", "b", "c")}
    norms = " and ".join(inside(point, "xyz", letters, "r^2") for point in ("q1", "2*q0 - q1"))
    yield decided(
        "if $\\|Q_0\\| = r$, the norm conditions on $Q_1$ and $P_2 = 2 Q_0 - Q_1$ (in (8): $P_1$) force $Q_1 = Q_0$",
        f"all a, b, c, q1x, q1y, q1z, r. a^2 + b^2 + c^2 = r^2 and {norms} -> q1x = a and q1y = b and q1z = c",
    )
    both: Points = {"q0": (-3, 4), "r0": (3, 4)}
    yield decided(
        "so (8) has no solution for $Q_0 = (-3,4)$, $R_0 = (3,4)$, $r = 5$",
        EIGHT.satisfiable("xy", both, 25),
        expected=False,
    )
    figure: Points = {"q0": GIVEN["C1"], "r0": GIVEN["C2"]}
    for square, stops in ((20, True), (25, False)):
        found = qe.minimize(SEVEN.objective("xy", figure), SEVEN.substituted("xy", figure, square), method="convex")
        at_point = [str(found.point[f"q2{axis}"]) for axis in "xy"] == ["2", "4"]
        said = "$Q_2 = R_0$: the path stops at $C_2$" if stops else "$Q_2 \\ne R_0$: the path does not stop"
        accepted = qe.verify(found.certificate).accepted
        yield Fact(f"Figure 2 with $r^2 = {square}$: at the optimum of (7) {said}", at_point is stops and accepted)
    yield Picture("Figure 2, redrawn: the radius of the feasible region.", radius_rule(GIVEN, farthest))


L1, L2 = 18752, 14400
"""The squared lengths of the two moving links, in mm^2."""
W = "w^2 = 2 and w > 0"


def over(side: str) -> str:
    """The squared distance from the shoulder in the arm's plane, less 18752 + 14400; ``side``: the sign of p."""
    return f"(({side}p - 44*w)^2 + (z - 104 - 44*w)^2 - {L1 + L2})"


@claim(
    key="nearer-is-reachable",
    place="Section 2, last sentence",
    title="What is nearer than a reachable point is reachable",
    says="With the radius so defined, the end effector can of course reach every point that is nearer to $O$.",
    verdict=Verdict.CORRECTED,
    finding="This follows from the hemisphere model, not from the arm. For the arm of the authors' earlier work "
    "($L = 120$ mm, reference [10]) the point $(0, 0, 300)$ can be reached and the nearer point $(290, 0, 0)$ cannot. "
    "Without joint limits a point is reachable exactly if $(\\sqrt{x^2+y^2} - a)^2 + (z - c)^2 \\le R^2$ with "
    "$a = 44\\sqrt 2$, $c = 104 + 44\\sqrt 2$, $R = 8\\sqrt{293} + 120$; there is no hole, and $O$ itself is "
    "reachable. So the sentence holds for radii up to $a + \\sqrt{R^2 - c^2}$, which is 258.149 mm, and for no larger "
    "one.",
)
def nearer_is_reachable() -> Iterator[Evidence]:
    """The arm has two moving links of length $\\sqrt{18752}$ and 120 in a vertical plane that turns about the $z$
    axis, on a shoulder at $(44\\sqrt 2, 104 + 44\\sqrt 2)$ in that plane; $w = \\sqrt 2$ is described by $w^2 = 2$
    and $w > 0$. The joint positions are eliminated; $p$ is the distance from the $z$ axis, and the arm can be turned
    towards a point ($p$) or away from it ($-p$)."""
    arm = (
        "ex w, u, v. w^2 = 2 and w > 0 and u^2 + v^2 = 18752 and ({x} - 44*w - u)^2 + ({z} - 104 - 44*w - v)^2 = 14400"
    )
    yield decided("$(0, 0, 300)$ can be reached", arm.format(x="0", z="300"))
    for x in ("290", "-290"):
        text = f"$(290, 0, 0)$ cannot, with the arm turned {'towards' if x == '290' else 'away from'} it"
        yield decided(text, arm.format(x=f"({x})", z="0"), expected=False)
    yield Fact("$290 < 300$", Fraction(290) < 300)
    yield eliminated(
        "places $(x, y)$, seen from the shoulder, that the two links reach: a ring",
        f"ex u, v. u^2 + v^2 = {L1} and (x - u)^2 + (y - v)^2 = {L2}",
        f"(x^2 + y^2 - {L1 + L2})^2 <= {4 * L1 * L2}",
    )
    rings = [f"{over(side)}^2 <= {4 * L1 * L2}" for side in ("", "-")]
    disc = f"({over('')} <= 0 or {rings[0]})"
    yield decided(
        "a ring for the arm turned towards the point, another one turned away: together exactly the disc of radius $R$",
        f"all w, p, z. {W} and p >= 0 -> ({rings[0]} or {rings[1]} <-> {disc})",
    )
    yield decided("$O$ is reachable", f"ex w, p, z. {W} and p = 0 and z = 0 and {rings[0]}")
    for radius, whole in (("258149/1000", True), ("258150/1000", False)):
        yield decided(
            f"the whole half-disc of radius {float(Fraction(radius)):.3f} is {'' if whole else 'not '}reachable",
            f"all w, p, z. {W} and p >= 0 and z >= 0 and p^2 + z^2 <= ({radius})^2 -> {disc}",
            expected=whole,
        )


CLAIMS = (feasible_region_is_convex, radius, nearer_is_reachable)
