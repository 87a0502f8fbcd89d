"""Section 4.1: one curve of degree n with equally spaced abscissae."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from bezier.input.task import Axis, task
from bezier.methods.single import program as single
from paper_repro.ask import decided, eliminated, optimised
from paper_repro.claim import Evidence, Fact, Picture, Table, Verdict, claim
from paper_repro.figures.curves import heights
from paper_repro.written import curve, names

N, P, Q = 6, 2, 3
"""The instance of this section: x_0 = 0, x_6 = 1, a = 2/5, b = 3/5, for which p = 2 and q = 3."""
A, B = Fraction(2, 5), Fraction(3, 5)
Y = names("y", N)
INNER = ", ".join(Y[1:-1])


def four(y: Sequence[object] = Y, height: str = "h") -> str:
    """Problem (4) for the instance above."""
    meets = [f"{curve([str(v) for v in y], f'({t})')} = {height}" for t in (A, B)]
    before = [f"{y[0]} <= {v}" for v in y[1 : P + 1]]
    over = [f"{height} <= {v}" for v in y[P + 1 : Q + 1]]
    after = [f"{y[N]} <= {v}" for v in y[Q + 1 : N]]
    return " and ".join((*meets, *before, *over, *after))


STARTED = "y0 = 0 and y6 = 0 and h = 1"


@claim(
    key="eq-2",
    place="Section 4.1, equations (1) and (2)",
    title="Equally spaced abscissae make $P_x$ linear",
    says="With $x_i = ((n-i) x_0 + i x_n)/n$ the first coordinate is $P_x(t) = (1-t) x_0 + t x_n$.",
    verdict=Verdict.REPRODUCED,
    finding="Proved for $n = 1, \\dots, 8$; in general it is the linear precision of Bernstein polynomials. The "
    "converse holds as well: no other abscissae make $P_x$ this linear polynomial (derived for $n = 2, 3, 4$).",
)
def equation_2() -> Iterator[Evidence]:
    """The identity is decided for arbitrary $x_0, x_n$ and all real $t$; for the converse $t$ is eliminated."""
    for n in range(1, 9):
        spaced = [f"({n - i}*x0 + {i}*x{n})/{n}" for i in range(n + 1)]
        yield decided(f"(2) for $n = {n}$", f"all x0, x{n}, t. {curve(spaced)} = (1 - t)*x0 + t*x{n}")
    for n in (2, 3, 4):
        x = names("x", n)
        equal = " and ".join(f"{n}*x{i} = {n - i}*x0 + {i}*x{n}" for i in range(1, n))
        question = f"all t. 0 <= t and t <= 1 -> {curve(x)} = (1 - t)*x0 + t*x{n}"
        yield eliminated(f"abscissae that give (2), $n = {n}$", question, equal)


@claim(
    key="eq-3",
    place="Section 4.1, equation (3)",
    title="The parameter from the abscissa",
    says="$t = (x - x_0)/(x_n - x_0)$.",
    verdict=Verdict.REPRODUCED,
    finding="Derived. It needs $x_0 \\ne x_n$, which is not said but follows from the conditions on the indices.",
)
def equation_3() -> Iterator[Evidence]:
    """(2) is solved for $t$ by the engine, without and with the assumption."""
    yield decided(
        "for $x_0 \\ne x_n$, (2) and (3) say the same",
        "all t, x, x0, xn. x0 /= xn -> (x = (1 - t)*x0 + t*xn <-> t*(xn - x0) = x - x0)",
    )
    yield eliminated(
        "where some $t$ in $[0,1]$ exists, for $x_0 < x_n$",
        "x0 < xn and (ex t. 0 <= t and t <= 1 and x = (1 - t)*x0 + t*xn)",
        "x0 < xn and x0 <= x and x <= xn",
    )


@claim(
    key="index-condition",
    place="Section 4.1, before Figure 4",
    title="The indices p and q",
    says="The interval $[a, b]$ defines $p$ and $q$ with $x_p < a \\le x_{p+1} \\le x_q \\le b < x_{q+1}$ and "
    "$1 \\le p < q + 1 \\le n$.",
    verdict=Verdict.CORRECTED,
    finding="The printed range allows $p = q$, which the inequalities exclude: $p < q$ is meant. And such indices "
    "need not exist: some abscissa must lie in $[a, b]$, for instance because $b - a \\ge (x_n - x_0)/n$, and "
    "$x_1 < a$.",
)
def index_condition() -> Iterator[Evidence]:
    """$p = q$ is put into the inequalities; an interval between two neighbouring abscissae has no indices; an
    interval at least as long as their distance always contains one."""
    yield decided(
        "no abscissae satisfy the inequalities with $p = q$",
        "ex xp, xnext, a, b. xp < a and a <= xnext and xnext <= xp and xp <= b and b < xnext",
        expected=False,
    )
    found = [(p, q) for p in range(1, 6) for q in range(p, 6) if _fits(6, Fraction(35, 100), Fraction(45, 100), p, q)]
    yield Fact("for $n = 6$ on $[0, 1]$ and $a = 0.35$, $b = 0.45$ there are no indices", not found)
    yield decided(
        "the first abscissa $x$ at or after $a$ lies in $[a, b]$ if $b - a$ is at least the step $d$",
        "all a, b, x, d. d > 0 and x - d < a and a <= x and b - a >= d -> x <= b",
    )
    yield Fact("for $a = 2/5$, $b = 3/5$ they are $p = 2$ and $q = 3$", _fits(N, A, B, P, Q))


def _fits(n: int, a: Fraction, b: Fraction, p: int, q: int) -> bool:
    x = [Fraction(i, n) for i in range(n + 1)]
    return x[p] < a <= x[p + 1] <= x[q] <= b < x[q + 1]


@claim(
    key="eq-4",
    place="Section 4.1, problem (4); Figure 4",
    title="Choosing the inner control points",
    says="Among the $y_1, \\dots, y_{n-1}$ with $P_y(t_a) = P_y(t_b) = h_y$ and the lower bounds of (4), the one "
    "with the smallest sum $y_{p+1} + \\dots + y_q$ is taken; $z$ likewise.",
    verdict=Verdict.CORRECTED,
    finding="The problem is linear and is solved exactly, with a certificate; with symbolic height and ends the "
    "engine says when it has a solution. But the optimum is often trivial and not unique: the outer $y_i$ have no "
    "upper bound and do not count in the sum, so $y_{p+1} = \\dots = y_q = h_y$ can be optimal with infinitely many "
    "outer values. A second criterion is needed.",
)
def equation_4() -> Iterator[Evidence]:
    """The instance is $n = 6$, $x_0 = 0$, $x_6 = 1$, $a = 2/5$, $b = 3/5$, hence $p = 2$, $q = 3$. The five unknowns
    are eliminated, first with symbolic $y_0, y_6, h_y$, then for $y_0 = y_6 = 0$, $h_y = 1$."""
    yield eliminated(
        "(4) has a solution exactly if",
        f"ex {INNER}. {four()}",
        "18403*y0 + 2592*y6 <= 20995*h and 2592*y0 + 18403*y6 <= 20995*h",
    )
    best, found = optimised("the least $y_3$ for $y_0 = y_6 = 0$ and $h_y = 1$", "y3", f"{STARTED} and {four()}", "1")
    yield best
    tied = f"y1 = y2 and y2 = y4 and y4 = y5 and y3 = 1 and {STARTED} and {four()}"
    yield eliminated("optimal, with equal outer ordinates", f"ex h, y0, y2, y3, y4, y5, y6. {tied}", "10512*y1 = 11305")
    others = f"y1 = y5 and y2 = y4 and y3 = 1 and {STARTED} and {four()}"
    yield eliminated(
        "all optimal tuples with $y_1 = y_5$ and $y_2 = y_4$: a segment, not a point",
        f"ex h, y0, y3, y4, y5, y6. {others}",
        "3492*y1 + 7020*y2 = 11305 and y1 >= 0 and y2 >= 0",
    )
    equal = Fraction(11305, 10512)
    tuples = {
        "equal outer ordinates": (0, equal, equal, 1, equal, equal, 0),
        "the optimiser's": [found.point[v] for v in Y],
    }
    yield Table(("optimal tuple", *Y), [(name, *map(str, values)) for name, values in tuples.items()])
    axes = (Axis("y", Fraction(0), Fraction(1, 2), Fraction(1)),)
    given = task(8, (Fraction(0), Fraction(8)), (Fraction(5, 2), Fraction(11, 2)), axes)
    chosen = single.choose(given, axes[0]).values
    assert chosen is not None
    yield Fact(
        "for another instance ($n = 8$) `bezier.methods.single.program` finds the sum 3, the least possible with "
        "$y_3, y_4, y_5 \\ge 1$",
        sum(chosen[i] for i in given.middle) == 3,
    )
    yield Picture(
        "Figure 4, redrawn: the position of $(a, h_y)$ and $(b, h_y)$; here $n = 8$, $x_i = i$, $a = 5/2$, $b = 11/2$.",
        heights(list(zip(given.abscissae, chosen)), given.interval, 1, given.p, given.q),
    )


def placed(y: Sequence[Any]) -> list[tuple[Fraction, Any]]:
    """Ordinates over the equally spaced abscissae."""
    return [(Fraction(i, N), v) for i, v in enumerate(y)]


CLAIMS = (equation_2, equation_3, index_condition, equation_4)
