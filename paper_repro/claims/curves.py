"""Section 3: Bézier curves and the convex hull property."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import comb
from typing import Any

import sympy

import qe
from bezier.curves.curve import Bezier
from paper_repro.ask import decided, eliminated
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.curves import de_casteljau as drawn_construction
from paper_repro.figures.curves import loose_hull
from paper_repro.written import curve, names

FIGURE = ((0, 0), (1, 3), (5, 4), (7, 1))


@claim(
    key="definition-1",
    place="Section 3, Definition 1",
    title="Bézier curves, and where they start and end",
    says="$P(t) = \\sum_{i=0}^n \\binom{n}{i} t^i (1-t)^{n-i} P_i$ for $0 \\le t \\le 1$ starts at $P_0$ and ends at "
    "$P_n$.",
    verdict=Verdict.REPRODUCED,
    finding="Proved for $n = 1, \\dots, 6$ with arbitrary control points; in general all terms but the first vanish "
    "at $t = 0$ and all but the last at $t = 1$. That the points are different is not needed.",
)
def end_points() -> Iterator[Evidence]:
    """One coordinate suffices, since the sum is taken in each coordinate alone."""
    for n in range(1, 7):
        points = names("p", n)
        at = f"{curve(points, '0')} = p0 and {curve(points, '1')} = p{n}"
        yield decided(f"$P(0) = P_0$ and $P(1) = P_{n}$ for $n = {n}$", f"all {', '.join(points)}. {at}")


@claim(
    key="misprint-degree",
    place="Section 3, Definition 1 (misprint)",
    title="The $N$-degree curve",
    says="With control points $P_0, \\dots, P_n$ the curve is called an $N$-degree Bézier curve.",
    verdict=Verdict.CORRECTED,
    finding="A misprint: $n$ is meant. A curve with $n + 1$ control points has degree at most $n$, and exactly $n$ "
    "unless its last difference vanishes, as for equally spaced points.",
)
def degree() -> Iterator[Evidence]:
    """The coefficient of $t^n$ is found by differentiating $n$ times, for $n = 1, \\dots, 6$; the next derivative
    vanishes."""
    t = sympy.Symbol("t")
    for n in range(1, 7):
        points = sympy.symbols(f"p0:{n + 1}")
        drawn = sum(sympy.binomial(n, i) * t**i * (1 - t) ** (n - i) * p for i, p in enumerate(points))
        top = sympy.expand(sympy.diff(drawn, t, n))
        difference = sum((-1) ** (n - i) * sympy.binomial(n, i) * p for i, p in enumerate(points))
        holds = sympy.expand(top - sympy.factorial(n) * difference) == 0 and sympy.diff(top, t) == 0
        yield Fact(f"$n = {n}$: the coefficient of $t^{n}$ is the last difference, and there is no higher power", holds)


@claim(
    key="inner-points",
    place="Section 3, paragraph after Definition 1",
    title="The curve does not pass through its inner control points",
    says="The curve does not pass through the control points except for the first and the last one.",
    verdict=Verdict.CORRECTED,
    finding="It usually does not, but it can. A curve of degree 2 meets $P_1$ exactly if $P_1$ lies on the open "
    "segment from $P_0$ to $P_2$ (or all points coincide); a cubic curve can do so with different points, no three "
    "of them on a line.",
)
def inner_points() -> Iterator[Evidence]:
    """Degree 2: $t$ is eliminated from $P(t) = P_1$, with $P_1$ in the origin. Degree 3: the engine looks for a
    fourth point such that the curve from $(0,0)$ meets $P_1 = (1,0)$ half-way."""
    meets = " and ".join(f"(1 - t)^2*a{c} + t^2*b{c} = 0" for c in "xy")
    yield eliminated(
        "$P_1 = O$ lies on the curve with ends $A$ and $B$ exactly in this case",
        f"ex t. 0 < t and t < 1 and {meets}",
        "ax*by - ay*bx = 0 and ax*bx + ay*by < 0 or ax = 0 and ay = 0 and bx = 0 and by = 0",
    )
    x, y = curve([0, 1, 1, "x"], "(1/2)"), curve([0, 0, 1, "y"], "(1/2)")
    found = qe.find_instance(f"{x} = 1 and {y} = 0")
    yield Fact(
        "with $P_2 = (1,1)$ the point is $P_3 = (2,-3)$", found is not None and found["x"] == 2 and found["y"] == -3
    )
    points = ((0, 0), (1, 0), (1, 1), (2, -3))
    yield Fact("then $P(1/2) = P_1$", Bezier.of(points).point(Fraction(1, 2)) == (1, 0))


@claim(
    key="attracted",
    place="Section 3, paragraph after Definition 1 (the pull)",
    title="The curve is attracted by the control points",
    says="The curve is attracted by its inner control points, as if they exerted a pull on it.",
    verdict=Verdict.REPRODUCED,
    finding="In this sense: if $P_i$ moves by a vector $V$, the point $P(t)$ moves by $\\beta_i(t) V$, in the same "
    "direction and less far, for every $t$ in $(0,1)$; most at $t = i/n$. So no inner control point is without effect "
    "anywhere on the open curve, and moving one changes all of it. Proved for $n = 2, \\dots, 5$; in general "
    "$\\beta_i(t) = \\binom{n}{i} t^i (1-t)^{n-i}$ has the derivative $\\beta_i(t) (i - nt)/(t(1-t))$.",
)
def attracted() -> Iterator[Evidence]:
    """One coordinate suffices. The coefficient of $P_i$ is positive and below 1 on $(0,1)$ and largest at $i/n$; that
    it is the factor of $V$ is an identity in all control points."""
    for n in range(2, 6):
        points = names("p", n)
        weights = [curve([int(k == i) for k in range(n + 1)]) for i in range(n + 1)]
        moved = [curve([f"{p} + v" if k == i else p for k, p in enumerate(points)]) for i in range(n + 1)]
        shifts = " and ".join(f"{moved[i]} = {curve(points)} + ({weights[i]})*v" for i in range(1, n))
        text = f"$n = {n}$: moving $P_i$ by $V$ moves $P(t)$ by $\\beta_i(t) V$"
        yield decided(text, f"all t, v, {', '.join(points)}. {shifts}")
        pulls = " and ".join(
            f"{w} > 0 and {w} < 1 and {w} <= {comb(n, i) * Fraction(i, n) ** i * Fraction(n - i, n) ** (n - i)}"
            for i, w in enumerate(weights[1:-1], start=1)
        )
        text = f"$n = {n}$: $0 < \\beta_i(t) < 1$, and $\\beta_i(t) \\le \\beta_i(i/n)$, for all inner $i$"
        yield decided(text, f"all t. 0 < t and t < 1 -> {pulls}")


@claim(
    key="de-casteljau",
    place="Section 3, construction; Figure 3",
    title="De Casteljau's construction",
    says="Dividing the sides of the control polygon in the ratio $t : 1-t$, then the sides of the polygon so found, "
    "and so on $n$ times, leads to the point $P(t)$ of Definition 1.",
    verdict=Verdict.REPRODUCED,
    finding="Proved for $n = 1, \\dots, 5$ with arbitrary control points; in general it is Pascal's rule for the "
    "binomial coefficients.",
)
def de_casteljau() -> Iterator[Evidence]:
    """The construction is written out with variables for all intermediate points and eliminated; what remains must be
    the polynomial of Definition 1. The figure uses exact points at $t = 2/5$."""
    for n in range(1, 6):
        rows = [names("p", n), *([f"c{k}n{i}" for i in range(n - k + 1)] for k in range(1, n + 1))]
        steps = [
            f"{new} = (1 - t)*{a} + t*{b}"
            for row, following in itertools.pairwise(rows)
            for new, a, b in zip(following, row, row[1:])
        ]
        inner = ", ".join(name for row in rows[1:] for name in row)
        reached = f"ex {inner}. {' and '.join(steps)} and x = {rows[-1][0]}"
        sentence = f"all t, x, {', '.join(rows[0])}. ({reached}) <-> x = {curve(rows[0])}"
        yield decided(f"the construction gives Definition 1 for $n = {n}$", sentence)
    t = Fraction(2, 5)
    levels: list[Sequence[Sequence[Any]]] = [FIGURE]
    while len(levels[-1]) > 1:
        row = levels[-1]
        levels.append([tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in itertools.pairwise(row)])
    yield Fact("the last point is $P(2/5)$", levels[-1][0] == Bezier.of(FIGURE).point(t))
    coordinates = [
        (f"level {k}", ", ".join(f"({', '.join(map(str, p))})" for p in row)) for k, row in enumerate(levels)
    ]
    yield Table(("", "points at t = 2/5"), coordinates)
    yield Picture(
        "Figure 3, redrawn: construction of a Bézier curve of degree 3, at $t = 2/5$.",
        drawn_construction(FIGURE, levels[1:]),
    )


@claim(
    key="misprint-locus",
    place="Section 3, construction (misprint)",
    title="The locus of is $Q_0^{(n)}$",
    says="After $n$ steps, “the locus of is $Q_0^{(n)}$” for $0 \\le t \\le 1$ constructs the curve.",
    verdict=Verdict.CORRECTED,
    finding="A misprint: the locus of $Q_0^{(n)}$ is the curve.",
    rests_on=("de-casteljau",),
)
def locus() -> Iterator[Evidence]:
    """Follows from the entry on the construction, where the last point is found to be $P(t)$ for all $t$."""
    yield from ()


@claim(
    key="misprint-unisurf",
    place="Section 3, first sentence; reference [15] (misprint)",
    title="The UNIURF CAD system",
    says="Bézier's book of 1986 is cited as “The Mathematical Basis of the UNIURF CAD System”.",
    verdict=Verdict.NOT_TESTABLE,
    finding="A misprint in the list of references: the system and the book are called UNISURF.",
)
def unisurf() -> Iterator[Evidence]:
    """Nothing to compute."""
    yield from ()


@claim(
    key="convex-hull",
    place="Section 3, last paragraph",
    title="The convex hull property",
    says="Every point of a Bézier curve lies in the convex hull of its control points.",
    verdict=Verdict.REPRODUCED,
    finding="Proved by the engine in the plane for $n \\le 3$ and arbitrary control points. In general: the "
    "Bernstein polynomials are nonnegative on $[0,1]$ and their sum is 1, so $P(t)$ is a convex combination of the "
    "$P_i$ in any dimension.",
)
def convex_hull() -> Iterator[Evidence]:
    """The hull is the common part of all half-planes that hold the control points, so it suffices that each such
    half-plane $a x + b y \\le c$ holds the curve. For one polygon the hull itself is computed, by eliminating the
    weights."""
    for n in (1, 2, 3):
        x, y = names("x", n), names("y", n)
        given = " and ".join(f"a*{u} + b*{v} <= c" for u, v in zip(x, y))
        block = ", ".join(["a", "b", "c", "t", *x, *y])
        sentence = f"all {block}. 0 <= t and t <= 1 and {given} -> a*({curve(x)}) + b*({curve(y)}) <= c"
        yield decided(f"a half-plane that holds the control points holds the curve, $n = {n}$", sentence)
    for n in (4, 5, 6):
        weights = [curve([int(k == i) for k in range(n + 1)]) for i in range(n + 1)]
        positive = " and ".join(f"{w} >= 0" for w in weights)
        yield decided(
            f"Bernstein polynomials: nonnegative, with sum 1, for $n = {n}$",
            f"all t. 0 <= t and t <= 1 -> {positive} and {' + '.join(weights)} = 1",
        )
    corners = ((0, 0), (1, 2), (3, 2), (4, 0))
    weights = [f"c{i}" for i in range(4)]
    combined = [" + ".join(f"{p[k]}*{w}" for p, w in zip(corners, weights)) for k in (0, 1)]
    hull = f"ex {', '.join(weights)}. {' and '.join(f'{w} >= 0' for w in weights)} and {' + '.join(weights)} = 1"
    yield eliminated(
        "the hull of $(0,0), (1,2), (3,2), (4,0)$",
        f"{hull} and x = {combined[0]} and y = {combined[1]}",
        "y >= 0 and y <= 2 and 2*x - y >= 0 and 2*x + y <= 8",
    )
    u, v = (curve([p[k] for p in corners]) for k in (0, 1))
    inside = f"{v} >= 0 and {v} <= 2 and 2*({u}) - ({v}) >= 0 and 2*({u}) + {v} <= 8"
    yield decided("the curve with these control points stays in it", f"all t. 0 <= t and t <= 1 -> {inside}")


@claim(
    key="polyhedron-test",
    place="Section 3, last paragraph",
    title="Control points in the region keep the curve in the region",
    says="If the polyhedron of the control points lies in the feasible region, so does the curve.",
    verdict=Verdict.CORRECTED,
    finding="The test is sufficient, since the region is convex; it is not necessary: a curve can stay in the disc "
    "while a control point is outside. Methods that rest on it give away paths; see (8*) below.",
)
def polyhedron_test() -> Iterator[Evidence]:
    """A curve of degree 2 in the unit disc with its middle control point outside."""
    points = ((Fraction(-3, 5), 0), (0, Fraction(6, 5)), (Fraction(3, 5), 0))
    x, y = (curve([p[k] for p in points]) for k in (0, 1))
    yield Fact("$\\|P_1\\| = 6/5 > 1$", points[1][1] > 1)
    yield decided("the whole curve lies in the unit disc", f"all t. 0 <= t and t <= 1 -> ({x})^2 + ({y})^2 <= 1")
    yield Picture("A curve in the unit disc with a control point outside.", loose_hull(Bezier.of(points), 1.0))


CLAIMS = (end_points, degree, inner_points, attracted, de_casteljau, locus, unisurf, convex_hull, polyhedron_test)
