"""Section 4.1: what problem (4) does not ensure, and how it is repaired."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import qe
from bezier.curves.containment import Inside, Leaves, examine, examine_all
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Ball, Workspace, WorkspaceKind
from bezier.input.task import Axis, task
from bezier.methods.single import program as single
from bezier.methods.single.closed import ProvedCurve, close
from paper_repro.ask import decided, eliminated, optimised, verified
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.claims.method_one import STARTED, A, B, N, Y, four, placed
from paper_repro.figures.curves import dip as drawn_dip
from paper_repro.written import curve, names


@claim(
    key="eq-4-dip",
    place="Section 4.1, before (4)",
    title="The curve exceeds $h_y$ between a and b",
    says="To avoid the obstacle, the coordinates must exceed $h_y$ and $h_z$ over the whole interval $[a, b]$; (4) "
    "is to ensure it.",
    verdict=Verdict.DIFFERS,
    finding="(4) forces the height at $a$ and $b$ and of the control points between them, not of the curve between "
    "them. Even an optimal tuple can let the curve dip below $h_y$, here by more than 8 percent. If $y_0, y_n < h_y$ "
    "and the numbers $y_i - h_y$ change sign only twice, the curve keeps the height; in general it is a question "
    "about all $t$.",
)
def dips() -> Iterator[Evidence]:
    """Among the optimal tuples of the instance above (least $y_3$) the one with the lowest point half-way is found by
    exact optimisation, and the dip is decided for the whole interval. The sufficient test is proved for degree 3."""
    low, found = optimised(
        "the lowest $P_y(1/2)$ among optimal tuples",
        curve(Y, "(1/2)"),
        f"{STARTED} and y3 = 1 and {four()}",
        "17125/18624",
    )
    yield low
    tuple_ = [found.point[v] for v in Y]
    yield Table(Y, [tuple(map(str, tuple_))])
    height = curve([str(v) for v in tuple_])
    yield decided("the tuple satisfies (4)", four([f"({v})" for v in tuple_], "1"))
    yield decided(
        "the curve is nowhere above $h_y = 1$ strictly between $a$ and $b$",
        f"all t. 2/5 < t and t < 3/5 -> {height} < 1",
    )
    signs = "u0 < 0 and u3 < 0 and 0 < s and s < t and t < e and e < 1 and u1 >= 0 and u2 >= 0"
    roots = f"{curve(names('u', 3), 's')} = 0 and {curve(names('u', 3), 'e')} = 0"
    yield decided(
        "degree 3 with two sign changes of $y_i - h_y$: no dip between the two points at height $h_y$",
        f"all u0, u1, u2, u3, s, t, e. {signs} and {roots} -> {curve(names('u', 3))} >= 0",
    )
    yield Picture(
        "A tuple that (4) allows and that is optimal, and the dip between $a$ and $b$.",
        drawn_dip(placed(tuple_), (A, B), 1),
    )


HIGH, FLAT = Fraction(11305, 3492), Fraction(1517, 3510)
BULGY = (0, HIGH, 0, 1, 0, HIGH, 0)
LEVEL = (0, Fraction(7, 4), FLAT, Fraction(3, 2), FLAT, Fraction(7, 4), 0)
"""Tuples that satisfy (4): the least sum, 1, and a greater one, 3/2."""


@claim(
    key="eq-4-bulge",
    place="Section 4.1, after (4)",
    title="The smallest sum minimises the bulge",
    says="The tuple with the smallest sum is selected in order to minimise the bulge of the curve in the positive "
    "direction of $y$.",
    verdict=Verdict.DIFFERS,
    finding="The sum runs over the control points between $a$ and $b$ only, and the bulge may be elsewhere. An optimal "
    "tuple (sum 1) rises to 1.36, another tuple with the greater sum 3/2 nowhere above 1.001. Method 1 here breaks "
    "ties by the smallest largest coordinate, which is a choice too; to minimise the bulge itself, ask for "
    "$P_y(t) \\le m$ for all $t$.",
)
def bulge() -> Iterator[Evidence]:
    """The instance is that of the entry on (4), with $h_y = 1$ and least sum $y_3 = 1$. Two tuples are put into (4),
    and the largest heights of their curves are decided over all $t$."""
    for name, values in (("sum 1", BULGY), ("sum 3/2", LEVEL)):
        yield decided(f"{name}: the tuple satisfies (4)", four([f"({v})" for v in values], "1"))
    yield Table(("", *Y), [(name, *map(str, row)) for name, row in (("sum 1", BULGY), ("sum 3/2", LEVEL))])
    yield decided("with the least sum the curve rises above 27/20", f"ex t. 0 < t and t < 1 and {curve(BULGY)} > 27/20")
    yield decided(
        "with the greater sum it stays below 1001/1000",
        f"all t. 0 <= t and t <= 1 -> {curve(LEVEL)} < 1001/1000",
    )


@claim(
    key="method-1-leaves",
    place="Section 4.1, last paragraph",
    title="Method 1 does not keep the curve in the feasible region",
    says="It is not guaranteed that the curve lies in the feasible region.",
    verdict=Verdict.REPRODUCED,
    finding="A solution of (4) for $y$ and $z$ with the least sums leaves the ball of the radius rule. It cannot "
    "sink below the table, though: if $z_0, z_n, h_z \\ge 0$ then (4) makes all control points, hence the curve, "
    "stay above it.",
)
def leaves() -> Iterator[Evidence]:
    """The optimal tuple found above, scaled to the height 2, is used for $y$ and $z$ over $-3 \\le x \\le 3$; the
    points to pass are $(\\mp 3/5, 2, 2)$."""
    _, found = optimised("", curve(Y, "(1/2)"), f"{STARTED} and y3 = 1 and {four()}", "17125/18624")
    ordinates = [2 * found.point[v] for v in Y]
    path = Bezier(tuple((Fraction(i - 3), v, v) for i, v in enumerate(ordinates)))
    radius_squared = max(Fraction(9), Fraction(9, 25) + 8)
    yield Fact(
        "the curve passes $(-3/5, 2, 2)$ and $(3/5, 2, 2)$",
        [path.point(t) for t in (A, B)] == [(-Fraction(3, 5), 2, 2), (Fraction(3, 5), 2, 2)],
    )
    yield Fact("the radius rule gives $r = 3$", radius_squared == 9)
    outcome = examine(path, Ball((Fraction(0),) * 3, radius_squared))
    assert isinstance(outcome, Leaves)
    squares = sum(c * c for c in outcome.point)
    yield Table(("t", "squared distance from O", "r²"), [(str(outcome.t), f"{float(squares):.4f}", "9")])
    yield Fact(f"at $t = {outcome.t}$ the curve is outside the ball", squares > radius_squared)
    yield decided(
        "with nonnegative ends and height, (4) makes all control points nonnegative",
        f"all {', '.join(Y)}, h. y0 >= 0 and y6 >= 0 and h >= 0 and {four()} -> {' and '.join(f'{v} >= 0' for v in Y)}",
    )


@claim(
    key="method-1-closed",
    place="Section 4.1, last sentence",
    title="Method 1 improved: new constraints that keep the curve in the region",
    says="Improvements are required, such as new constraints so that the curve is included in the feasible region.",
    verdict=Verdict.REPRODUCED,
    finding="Done. With the conditions $P_y(t) \\ge h_y$ and $P_z(t) \\ge h_z$ on $[t_a, t_b]$ and "
    "$\\|P(t)\\| \\le r$, $P_z(t) \\ge 0$ on $[0, 1]$, for all $t$, the same instance has a proved curve, with the "
    "same least sums.",
)
def closed() -> Iterator[Evidence]:
    """The instance of the entry above, degree 6 and height 2. Cuts at finitely many $t$ are added to (4) until the
    curve is proved for all $t$; the exact linear program proves that no smaller sum is possible."""
    height = Fraction(2)
    axes = [Axis(name, Fraction(0), Fraction(0), height) for name in "yz"]
    given = task(N, (Fraction(-3), Fraction(3)), (Fraction(-3, 5), Fraction(3, 5)), axes)
    work = Workspace(WorkspaceKind.HEMISPHERE, Fraction(9))
    found = close(given, work)
    assert isinstance(found, ProvedCurve)
    text = f"no curve has a smaller sum than {found.bound}"
    cuts = f"{len(found.cuts)} linear cuts (listed in the certificate)"
    yield verified(text, f"minimise y3 + z3 subject to (4) for y and z and {cuts}", found.certificate)
    yield Fact(f"the curve found has the sum {found.value}", found.is_optimal)
    yield Table(
        ("", *(f"P{i}" for i in range(N + 1))),
        [(a, *(str(p[k]) for p in found.curve.points)) for k, a in enumerate("xyz")],
    )
    inside = all(isinstance(o, Inside) for o in examine_all(found.curve, work.conditions))
    yield Fact("it stays in the hemisphere of radius 3 for all $t$", inside)
    yield Fact("it keeps the heights for all $t$ in $[t_a, t_b]$", not single.dips(given, found.curve))


PLACED = ((Fraction(2, 5), Fraction(3, 5)), (Fraction(3, 5), Fraction(9, 10)), (Fraction(9, 10), Fraction(19, 20)))


@claim(
    key="method-1-flexible",
    place="Section 4.1, last paragraph (the advantage)",
    title="The curve can be flexibly designed according to the obstacles",
    says="The curve can be flexibly designed according to the position and the size of the obstacles.",
    verdict=Verdict.CORRECTED,
    finding="With the degree as a free choice it can; with a given degree it cannot. For $n = 3$ on $[0, 1]$ with ends "
    "at height 0, (4) has a solution exactly if $a^2 (1 - a) \\le b^2 (1 - b)$, whatever the height: an obstacle near "
    "the end of the path, such as $[3/5, 9/10]$, cannot be passed. There the least degree is 6, for $[9/10, 19/20]$ it "
    "is 14. The nearer the obstacle is to an end, the larger degree and bulge. Height is no limit where both ends lie "
    "at height 0, since (4) then scales with $h$; the feasible region is one (see the entries around this one).",
    rests_on=("index-condition", "eq-4"),
)
def flexible() -> Iterator[Evidence]:
    """For $n = 3$ the inner ordinates are eliminated with letters for $a$, $b$, $h$. For three intervals the exact
    linear program is solved for $n = 3, 4, \\dots$ until (4) has a solution; a refusal has multipliers as proof."""
    where = "1/3 < a and a <= 2/3 and 2/3 <= b and b < 1 and a < b and h > 0"
    meets = " and ".join(f"{curve(['0', 'y1', 'y2', '0'], v)} = h" for v in "ab")
    yield eliminated(
        "$n = 3$, $y_0 = y_3 = 0$: (4) has a solution exactly if",
        f"{where} and (ex y1, y2. {meets} and y1 >= 0 and y2 >= h)",
        f"{where} and a^2*(1 - a) <= b^2*(1 - b)",
    )
    rows, least = [], []
    raised = (Axis("y", Fraction(0), Fraction(0), Fraction(1)),)
    for interval in PLACED:
        refuted = []
        for n in range(3, 20):
            try:
                given = task(n, (Fraction(0), Fraction(1)), interval, raised)
            except qe.InputError:  # no indices p and q for this degree
                continue
            found = single.choose(given, given.axes[0]).values
            if found is not None:
                break
            refuted.append(str(n))
        assert found is not None
        least.append(n)
        top = f"{float(max(found)):.2f}"
        rows.append((f"[{interval[0]}, {interval[1]}]", ", ".join(refuted) or "none", str(n), top))
    yield Table(("obstacle", "degrees with indices, without solution", "least degree", "greatest ordinate"), rows)
    yield Fact("the least degrees are 4, 6, 14", least == [4, 6, 14])


CLAIMS = (dips, bulge, leaves, flexible, closed)
