"""Families of nonlinear questions with known answers in which one number grows, on which solvers differ most.

A part of the suite ``scaling``: inequalities between means, placements in the plane, discriminants, stability,
combinations of quadrics, and alternating quantifiers.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from math import prod

from experiments.problem import Problem

SEED = 27
APART = {2: "1.41", 3: "1.03", 4: "1", 5: "0.7", 6: "0.6"}
"""For numbers of points, a distance that they can all have in the unit square, within 0.012 of the largest."""


def problems() -> list[Problem]:
    """All of them."""
    return [
        *_family("kissing", kissing, range(2, 8), lambda n: "true" if n <= 6 else "false"),
        *_family("packing-sat", lambda n: packing(n, "0"), range(2, 7), lambda n: "true"),
        *_family("packing-unsat", lambda n: packing(n, "0.05"), range(2, 6), lambda n: "false"),
        *_family("means", means, range(2, 7)),
        *_family("power-means", power_means, range(2, 9)),
        *_family("cauchy", cauchy, range(1, 6)),
        *_family("cyclic", cyclic, range(3, 9)),
        *_family("shapiro", shapiro, range(3, 7)),
        *_family("discriminant", discriminant, (2, 3, 4, 6, 8, 10), lambda n: None),
        *_family("stability", stability, range(2, 6), lambda n: None),
        *_family("quadrics", quadrics, (2, 4, 6, 8, 10, 12), lambda n: None),
        *_family("random-dense", dense, range(1, 5), lambda n: None),
        *_family("alternation", alternation, range(2, 6), lambda n: None),
    ]


def _family(
    name: str, text: Callable[[int], str], sizes: Sequence[int], answer: Callable[[int], str | None] = lambda n: "true"
) -> Iterator[Problem]:
    for n in sizes:
        yield Problem(f"scaling/{name}", f"{name}-{n}", text(n), answer(n), size=n)


def _names(letter: str, count: int) -> list[str]:
    return [f"{letter}{i}" for i in range(1, count + 1)]


def _positive(names: Sequence[str], claim: str) -> str:
    return f"all {', '.join(names)}. {' and '.join(f'{x} > 0' for x in names)} -> {claim}"


def _sum(terms: Sequence[str]) -> str:
    return f"({' + '.join(terms)})"


def kissing(n: int) -> str:
    """So many unit circles touch another one in the plane and do not meet each other: six do, seven do not."""
    points = list(zip(_names("x", n), _names("y", n), strict=True))
    conditions = [f"{x}^2 + {y}^2 = 4" for x, y in points]
    conditions += [f"({a} - {c})^2 + ({b} - {d})^2 >= 4" for (a, b), (c, d) in combinations(points, 2)]
    return f"ex {', '.join(v for point in points for v in point)}. {' and '.join(conditions)}"


def packing(n: int, more: str) -> str:
    """Points in the unit square that are so far apart, and ``more``."""
    points, least = list(zip(_names("x", n), _names("y", n), strict=True)), Fraction(APART[n]) + Fraction(more)
    conditions = [f"0 <= {v} and {v} <= 1" for point in points for v in point]
    conditions += [f"({a} - {c})^2 + ({b} - {d})^2 >= {least**2}" for (a, b), (c, d) in combinations(points, 2)]
    return f"ex {', '.join(v for point in points for v in point)}. {' and '.join(conditions)}"


def means(n: int) -> str:
    """The arithmetic mean is at least the geometric one."""
    x = _names("x", n)
    return _positive(x, f"{_sum(x)}^{n} >= {n**n} * {' * '.join(x)}")


def power_means(n: int) -> str:
    """The cubic mean is at least the arithmetic one."""
    x = _names("x", n)
    return _positive(x, f"{n**2} * {_sum([f'{v}^3' for v in x])} >= {_sum(x)}^3")


def cauchy(n: int) -> str:
    """The inequality of Cauchy and Schwarz."""
    x, y = _names("x", n), _names("y", n)
    left = f"{_sum([f'{v}^2' for v in x])} * {_sum([f'{v}^2' for v in y])}"
    return f"all {', '.join((*x, *y))}. {left} >= {_sum([f'{a}*{b}' for a, b in zip(x, y, strict=True)])}^2"


def cyclic(n: int) -> str:
    """A sum of squares is at least the sum of the products of neighbours."""
    x = _names("x", n)
    right = _sum([f"{a}*{b}" for a, b in zip(x, (*x[1:], x[0]), strict=True)])
    return f"all {', '.join(x)}. {_sum([f'{v}^2' for v in x])} >= {right}"


def shapiro(n: int) -> str:
    """Shapiro's cyclic sum is at least n/2."""
    x = _names("x", n)
    bottoms = [f"({x[(i + 1) % n]} + {x[(i + 2) % n]})" for i in range(n)]
    tops = [" * ".join([x[i], *(b for k, b in enumerate(bottoms) if k != i)]) for i in range(n)]
    return _positive(x, f"2 * {_sum(tops)} >= {n} * {' * '.join(bottoms)}")


def discriminant(n: int) -> str:
    """When a trinomial has a positive root."""
    return f"ex x. x > 0 and x^{n} + a*x + b = 0"


def stability(n: int) -> str:
    """Two parameters for which a polynomial has no real root to the right of -1."""
    known = " + ".join(f"{prod(range(k + 1, n + 1)) // prod(range(1, n - k + 1))}*x^{k}" for k in range(2, n))
    return f"all x. x >= -1 -> x^{n} + {known + ' + ' if known else ''}a*x + b > 0"


def quadrics(n: int) -> str:
    """Clauses of two strict conditions on seeded quadrics in the plane."""
    rng = random.Random(SEED)

    def side() -> str:
        a, b, c, d, e, f = (rng.randint(-9, 9) for _ in range(6))
        return f"{a}*x^2 + {b}*x*y + {c}*y^2 + {d}*x + {e}*y + {f} {rng.choice('<>')} 0"

    return f"ex x, y. {' and '.join(f'({side()} or {side()})' for _ in range(n // 2))}"


def dense(n: int) -> str:
    """When a seeded dense quartic in so many variables falls below a parameter."""
    rng, x = random.Random(SEED), _names("x", n)
    lower = [f"{rng.randint(-9, 9)}*{a}*{b}" for a, b in combinations((*x, "1"), 2)]
    return f"ex {', '.join(x)}. {' + '.join([*(f'{v}^4' for v in x), *lower])} < a"


def alternation(n: int) -> str:
    """Alternating quantifiers over a chain of quadratic conditions."""
    x = _names("x", n)
    prefix = " ".join(f"{'all' if k % 2 else 'ex'} {v}." for k, v in enumerate(x))
    conditions = [f"{a}^2 + {b}^2 >= {a}*{b} + {k}*{a} - 1" for k, (a, b) in enumerate(pairwise(x))]
    return f"{prefix} {' and '.join(conditions)}"
