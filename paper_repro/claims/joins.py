"""Section 4.2: smooth joins, equation (6), and which degree is needed."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

import qe
from paper_repro.ask import decided, eliminated
from paper_repro.claim import Evidence, Fact, Picture, Verdict, claim
from paper_repro.figures.regions import region

T = sympy.Symbol("t")


def span(letter: str, n: int) -> sympy.Expr:
    """One coordinate of a curve of degree n with control points ``letter0, letter1, ...`` (Definition 1)."""
    points = sympy.symbols(f"{letter}0:{n + 1}")
    return sum(sympy.binomial(n, i) * T**i * (1 - T) ** (n - i) * p for i, p in enumerate(points))


def joined(first: str, second: str, n: int, order: int) -> sympy.Basic:
    """The derivatives of this order agree where the first curve ends and the second begins."""
    left, right = span(first, n).diff(T, order), span(second, n).diff(T, order)
    return sympy.Eq(sympy.expand(left.subs(T, 1)), sympy.expand(right.subs(T, 0)))


def smooth(n: int, order: int) -> sympy.Basic:
    """P, Q, R of degree n with equal values and derivatives up to ``order`` at both joins."""
    return sympy.And(*(joined(a, b, n, k) for a, b in ("pq", "qr") for k in range(order + 1)))


@claim(
    key="smooth-joins",
    place="Section 4.2, after (5)",
    title="Conditions for smooth joins of cubic curves",
    says="$P(1) = Q(0)$ means $P_3 = Q_0$; then $P'(1) = Q'(0)$ means $2 Q_0 = P_2 + Q_1$, and then "
    "$P''(1) = Q''(0)$ means $2 (Q_1 - P_2) = Q_2 - P_1$; likewise for $Q$ and $R$.",
    verdict=Verdict.REPRODUCED,
    finding="Each condition is derived from Definition 1 by differentiation and elimination, and found necessary and "
    "sufficient.",
)
def smooth_joins() -> Iterator[Evidence]:
    """Definition 1 is differentiated symbolically; the engine eliminates $P_3$ (or $Q_3$) and compares."""
    for first, second, at in (("p", "q", "Q_0"), ("q", "r", "R_0")):
        a, b = first, second
        position, velocity, acceleration = (joined(first, second, 3, k) for k in range(3))
        yield eliminated(f"the curves meet at ${at}$", sympy.And(position), f"{a}3 = {b}0")
        yield eliminated(
            f"the curves meet at ${at}$ with equal first derivatives",
            qe.Exists(f"{a}3", sympy.And(position, velocity)),
            f"2*{b}0 = {a}2 + {b}1",
        )
        yield eliminated(
            f"... and with equal second derivatives at ${at}$",
            qe.Exists(f"{a}3", sympy.And(position, velocity, acceleration)),
            f"2*{b}0 = {a}2 + {b}1 and 2*({b}1 - {a}2) = {b}2 - {a}1",
        )


@claim(
    key="eq-6",
    place="Section 4.2, equation (6)",
    title="The control points that follow from $Q_0, Q_1, Q_2, R_0$",
    says="$P_1 = 4Q_0 - 4Q_1 + Q_2$, $P_2 = 2Q_0 - Q_1$, $R_1 = 2R_0 - Q_2$, $R_2 = Q_1 - 4Q_2 + 4R_0$.",
    verdict=Verdict.REPRODUCED,
    finding="Derived: from the six equations for values, first and second derivatives at the two joins, elimination "
    "leaves exactly (6). It says that $P, Q, R$ are three consecutive spans of a uniform cubic B-spline.",
)
def equation_6() -> Iterator[Evidence]:
    """The join conditions come from Definition 1 by differentiation, not from the paper's intermediate equations. The
    points $P_3$ and $Q_3$ are eliminated; then all but one of the four unknowns."""
    conditions = smooth(3, 2)
    six = {
        "p1": "p1 = 4*q0 - 4*q1 + q2",
        "p2": "p2 = 2*q0 - q1",
        "r1": "r1 = 2*r0 - q2",
        "r2": "r2 = q1 - 4*q2 + 4*r0",
    }
    yield eliminated("all conditions together", qe.Exists(("p3", "q3"), conditions), " and ".join(six.values()))
    for kept, equation in six.items():
        others = ("p3", "q3", *(name for name in six if name != kept))
        yield eliminated(f"what remains for ${kept[0].upper()}_{kept[1]}$", qe.Exists(others, conditions), equation)
    spans = (
        "6*q0 = d1 + 4*d2 + d3 and 3*q1 = 2*d2 + d3 and 3*q2 = d2 + 2*d3 and 6*r0 = d2 + 4*d3 + d4 "
        "and 3*p1 = 2*d1 + d2 and 3*p2 = d1 + 2*d2 and 3*r1 = 2*d3 + d4 and 3*r2 = d3 + 2*d4"
    )
    yield eliminated(
        "control points of three spans of a uniform cubic B-spline with some de Boor points $d_1, \\dots, d_4$",
        f"ex d1, d2, d3, d4. {spans}",
        " and ".join(six.values()),
    )


@claim(
    key="smallest-degree",
    place="Section 4.2, first paragraph",
    title="Three is the smallest degree whose curvature can be controlled",
    says="Curves of degree 3 are used because it is the smallest degree whose curvature can be controlled.",
    verdict=Verdict.REPRODUCED,
    finding="What can be proved: a line has no curvature; a curve of degree 2 is fixed by its ends and the tangents "
    "there, and so is its curvature, which moreover never changes sign; three joined curves of degree 2 can be $C^2$ "
    "only if the four given points satisfy $R_2 - 3R_0 + 3Q_0 - P_0 = 0$. With degree 3, ends and tangents leave a "
    "two-dimensional choice of end curvatures, each of them may be any number alone, and $C^2$ joins are possible "
    "for all points (6).",
)
def smallest_degree() -> Iterator[Evidence]:
    """$P' \\times P''$ decides about curvature. For degree 3 the ends are $(0,0)$ and $(1,0)$, the tangents there have
    slopes $3/4$ and $-3/4$, and $P_1$, $P_2$ move on them; the engine eliminates them from the end curvatures."""
    for n, text in ((1, "degree 1: $P' \\times P'' = 0$"), (2, "degree 2: $P' \\times P''$ is the same for all $t$")):
        x, y = span("x", n), span("y", n)
        cross = sympy.expand(x.diff(T) * y.diff(T, 2) - y.diff(T) * x.diff(T, 2))
        points = [str(s) for s in sorted((cross.free_symbols | x.free_symbols | y.free_symbols) - {T}, key=str)]
        yield decided(text, qe.ForAll(("t", *points), sympy.Eq(cross, cross.subs(T, 0))))
    crossing = " and ".join(f"ax*{u} + bx*{v} = dx and ay*{u} + by*{v} = dy" for u, v in (("s", "t"), ("u", "v")))
    yield decided(
        "degree 2: ends at distance $D$ and tangents $A$, $B$ that are not parallel determine $P_1$",
        f"all ax, ay, bx, by, dx, dy, s, t, u, v. ax*by - ay*bx /= 0 and {crossing} -> s = u and t = v",
    )
    given = sympy.And(*(joined(a, b, 2, k) for a, b in ("pq", "qr") for k in range(3)))
    yield eliminated(
        "degree 2 with $C^2$ joins: possible for given $P_0, Q_0, R_0, R_2$ exactly if",
        qe.Exists(("p1", "p2", "q1", "q2", "r1"), given),
        "r2 - 3*r0 + 3*q0 - p0 = 0",
    )
    # P1 = (a, 3a/4) and P2 = (1 - b, 3b/4): the curvature at P0 is (1 - 2b) / (2 a^2 (5/4)^3), likewise at P3.
    ends = "3*a^2*k*(125/64) = 2*(3/4 - b*(3/2)) and 3*b^2*m*(125/64) = 2*(3/4 - a*(3/2))"
    start = ends.split(" and ")[0]
    yield decided(
        "degree 3: the curvature at one end can be any number", f"all k. ex a, b. a > 0 and b > 0 and {start}"
    )
    both = qe.eliminate(f"ex a, b. a > 0 and b > 0 and {ends}")
    pairs = qe.region(both.formula, order=("k", "m"))
    yield Fact("degree 3: the possible pairs of end curvatures fill a region of dimension 2", pairs.dimension == 2)
    inside = [("1/2", "1/2"), ("-1", "1/4"), ("-1/4", "-1/4")]
    yield Fact(
        "such as $(1/2, 1/2)$, $(-1, 1/4)$ and $(-1/4, -1/4)$", all(pairs.contains({"k": k, "m": m}) for k, m in inside)
    )
    yield Picture(
        "The pairs of curvatures at the two ends (turning towards the chord is positive) that a cubic curve can have.",
        region(pairs),
    )


CLAIMS = (smooth_joins, equation_6, smallest_degree)
