"""Section 4.2: whether (7) has a solution, as printed and with Definition 1: no two control points coincide."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction

from paper_repro.ask import decided, optimised
from paper_repro.claim import Evidence, Fact, Picture, Verdict, claim
from paper_repro.claims.cubic import ENDS, LETTERS, PLANE, chosen, curves
from paper_repro.figures.curves import path as drawn_path
from paper_repro.written import SEVEN, Points, inside

ROWS = (("p0", "p1", "p2", "q0"), ("q0", "q1", "q2", "r0"), ("r0", "r1", "r2", "r3"))
"""The control points of the three curves: P_3 = Q_0 and Q_3 = R_0."""
MOVED = (("p", "1 - 5*e", "-e", "0"), ("0", "e", "1 - e", "1"), ("1", "1 + e", "5*e", "q"))
"""Where they lie on the line Q_0 + l (R_0 - Q_0) if Q_1 is at l = e and Q_2 at l = 1 - e."""
NEAR: Points = {**PLANE, "p0": (-1, 0), "r3": (1, 0)}


@claim(
    key="eq-7-always",
    place="Section 4.2, formula (7)",
    title="When does (7) have a solution?",
    says="Finding $Q_1, Q_2$ that satisfy (7) is the problem to be solved; whether there are any is left open.",
    verdict=Verdict.CORRECTED,
    finding="There are two readings. (7) as printed lets control points coincide, and then there always is a solution: "
    "with $Q_1 = Q_0$, $Q_2 = R_0$ every control point is $Q_0$ or $R_0$. It is of no use: the velocity at both joins "
    "is zero and the path turns back there in a cusp. Definition 1 forbids it, as the control points of a curve are "
    "different. Under Definition 1, for a start other than $Q_0$ and an end other than $R_0$, (7) has a solution "
    "exactly if $\\|Q_0\\| < r$, $\\|R_0\\| < r$ and $Q_0 \\ne R_0$. If $\\|Q_0\\| = r$, every solution of (7) has "
    "$Q_1 = Q_0$, and if $\\|R_0\\| = r$ it has $Q_2 = R_0$. With the radius of the paper this is so whenever a point "
    "to pass is the farthest; a larger radius is needed then.",
    rests_on=("radius-rule",),
)
def always_satisfiable() -> Iterator[Evidence]:
    """As printed: the choice is put into (7) with letters for everything, and the sentence is decided for all points
    and radii. Under Definition 1: a point to pass at distance $r$ is decided with letters in space. If both are nearer,
    $Q_1 = Q_0 + e (R_0 - Q_0)$ and $Q_2 = R_0 - e (R_0 - Q_0)$ put all control points on one line; its points near the
    segment stay in the ball (with $a = \\|Q_0\\|^2$, $b = Q_0 \\cdot R_0$, $c = \\|R_0\\|^2$ and $a - 2b + c =
    \\|R_0 - Q_0\\|^2$), and some arbitrarily small $e$ makes them different, wherever on the line the start ($p$) and
    the end ($q$) may lie. $Q_0 = R_0$ is forbidden itself. Three instances follow. Every answer has a certificate."""
    norms = " and ".join(" + ".join(f"{v}0{axis}^2" for axis in "xyz") + " <= r^2" for v in "qr")
    block = ", ".join((*LETTERS["q0"], *LETTERS["r0"], "r"))
    trivial = SEVEN.text("xyz", LETTERS, "r^2").replace("q1", "q0").replace("q2", "r0")
    yield decided(
        "as printed: for all $Q_0, R_0, r$ with norms at most $r$ this choice satisfies (7)",
        f"all {block}. {norms} -> ({trivial})",
        proved=True,
    )
    some = SEVEN.satisfiable("xyz", LETTERS, "r^2")
    yield decided(
        "the engine finds this itself, without being given the choice",
        f"all {block}. {norms} and r >= 0 -> ({some})",
        proved=True,
    )
    path = curves(PLANE, PLANE["q0"], PLANE["r0"], ENDS)
    velocity = [c.derivative(1, t) for c, t in zip(path.values(), (1, 1, 0))]
    yield Fact("the velocity at both joins is zero", all(not any(v) for v in velocity))
    before, after = path["P"].derivative(2, 1), path["Q"].derivative(2, 0)
    yield Fact(
        "the second derivative there is not zero and equal on both sides, so the path reverses: a cusp",
        before == after and any(after),
    )
    yield Picture(
        "The solution $Q_1 = Q_0$, $Q_2 = R_0$: the curve doubles back on the segment from $Q_0$ to $R_0$.",
        drawn_path(path, 1.5, "always possible, never wanted"),
    )
    yield from _no_solution_at_distance_r()
    yield from _solution_if_nearer()
    for square, exists in ((2, False), ("9/4", True), (4, True)):
        different = SEVEN.different(ROWS, "xy", NEAR)
        yield decided(
            f"Definition 1, $Q_0 = (-1,1)$, $R_0 = (1,1)$, from $(-1,0)$ to $(1,0)$ with $r^2 = {square}$: "
            f"{'a' if exists else 'no'} solution",
            f"ex q1x, q1y, q2x, q2y. {SEVEN.substituted('xy', NEAR, square)} and {different}",
            expected=exists,
            proved=True,
        )


def _no_solution_at_distance_r() -> Iterator[Evidence]:
    """(7) contains ||Q_1|| <= r and ||P_2|| = ||2 Q_0 - Q_1|| <= r, and likewise ||Q_2|| and ||R_1||."""
    for via, inner, other in (("q0", "q1", "P_2"), ("r0", "q2", "R_1")):
        far = inside(via, "xyz", LETTERS, "r^2").replace("<=", "=")
        both = " and ".join(inside(point, "xyz", LETTERS, "r^2") for point in (inner, f"2*{via} - {inner}"))
        same = " and ".join(f"{inner}{axis} = {via}{axis}" for axis in "xyz")
        variables = ", ".join((*LETTERS[via], *(f"{inner}{axis}" for axis in "xyz"), "r"))
        first, second = (f"{v[0].upper()}_{v[1]}" for v in (via, inner))
        yield decided(
            f"Definition 1: if $\\|{first}\\| = r$, the conditions of (7) on ${second}$ and ${other}$ force "
            f"${second} = {first}$",
            f"all {variables}. {far} and {both} -> {same}",
            proved=True,
        )


def _solution_if_nearer() -> Iterator[Evidence]:
    """A short way from the choice above along the line through Q_0 and R_0 all control points differ."""
    place = {"q1": "(q0 + e*(r0 - q0))", "q2": "(r0 - e*(r0 - q0))"}
    on_line = dict(zip(("p1", "p2", "r1", "r2"), (MOVED[0][1], MOVED[0][2], MOVED[2][1], MOVED[2][2])))
    equations = []
    for equation in SEVEN.equations:
        name, right = equation.split(" = ")
        for point, value in place.items():
            right = right.replace(point, value)
        equations.append(f"{right} = q0 + ({on_line[name]})*(r0 - q0)")
    yield decided(
        "Definition 1: with $Q_1$, $Q_2$ at $e$ and $1 - e$ on the line from $Q_0$ ($0$) to $R_0$ ($1$), (6) puts "
        "$P_1, P_2, R_1, R_2$ at $1 - 5e$, $-e$, $1 + e$, $5e$",
        f"all q0, r0, e. {' and '.join(equations)}",
        proved=True,
    )
    norm = "(1 - l)^2*a + 2*l*(1 - l)*b + l^2*c"
    yield decided(
        "if $\\|Q_0\\|, \\|R_0\\| < r$, a stretch of the line beyond both points lies in the ball ($s = r^2$)",
        f"all a, b, c, s. a < s and c < s and a - 2*b + c >= 0 -> "
        f"(ex d. d > 0 and (all l. -d <= l and l <= 1 + d -> {norm} <= s))",
        proved=True,
    )
    different = " and ".join(f"{u} /= {v}" for row in MOVED for u, v in itertools.combinations(row, 2))
    yield decided(
        "some $e$ below any $d > 0$ makes the control points of each curve different",
        f"all p, q, d. p /= 0 and q /= 1 and d > 0 -> (ex e. 0 < e and 5*e < d and 5*e < 1 and {different})",
        proved=True,
    )


@claim(
    key="different-ends",
    place="Section 4.2, choice after (7), with Definition 1 of Section 3",
    title="$P_0$ and $R_3$ are different points, too",
    says="By Definition 1 all control points of a curve are different, so the start is different from $P_1, P_2, Q_0$ "
    "and the end from $R_0, R_1, R_2$. In (7) start and end occur in $r$ only.",
    verdict=Verdict.CORRECTED,
    finding="Neither (7) nor the objective sees to it. For $Q_0 = (-1,1)$, $R_0 = (1,1)$, start $(-7/3, 1)$ and end "
    "$(7/3, 1)$ the only best choice has $P_1 = P_0$ and $R_2 = R_3$: under Definition 1 the least value 4/3 is then "
    "not attained, though every greater one is. Such a path only starts and ends at rest. The condition is better "
    "dropped: nothing that is proved of Bézier curves needs it.",
    rests_on=("definition-1", "convex-hull", "eq-7-always"),
)
def different_ends() -> Iterator[Evidence]:
    """The radius rule gives $r^2 = 58/9$, for which the interior solution of (7) just satisfies it. The optimum is
    exact and unique; $P_1$ and $R_2$ follow by (6). Then $Q_1$ and $Q_2$ are moved by $e$ along the line."""
    ends: Points = {**PLANE, "p0": (Fraction(-7, 3), 1), "r3": (Fraction(7, 3), 1)}
    square = max(sum(Fraction(c) ** 2 for c in point) for point in ends.values())
    yield Fact("the radius rule gives $r^2 = 58/9$", square == Fraction(58, 9))
    conditions, objective = SEVEN.substituted("xy", ends, square), SEVEN.objective("xy", ends)
    best, found = optimised("the best choice", objective, conditions, "4/3")
    yield best
    path = curves(PLANE, *chosen(found, "xy"), (ends["p0"], ends["r3"]))
    same = [path["P"].points[1] == path["P"].points[0], path["R"].points[2] == path["R"].points[3]]
    yield Fact("it is the only one, and it has $P_1 = P_0$ and $R_2 = R_3$", found.unique is True and all(same))
    yield Fact("the path starts and ends at rest", not any((*path["P"].derivative(1, 0), *path["R"].derivative(1, 1))))
    free = "q1x, q1y, q2x, q2y"
    yield decided(
        "no other choice attains 4/3, even without (7)",
        f"all {free}. {objective} <= 4/3 -> 3*q1x = -1 and q1y = 1 and 3*q2x = 1 and q2y = 1",
        proved=True,
    )
    moved = {"q1x": "(-1/3 - e)", "q1y": "1", "q2x": "(1/3 + e)", "q2y": "1"}
    wanted = f"{conditions} and {SEVEN.different(ROWS, 'xy', ends)} and {objective} < s"
    for name, value in moved.items():
        wanted = wanted.replace(name, value)
    yield decided(
        "with different points every greater value is undercut", f"all s. s > 4/3 -> (ex e. {wanted})", proved=True
    )


CLAIMS = (always_satisfiable, different_ends)
