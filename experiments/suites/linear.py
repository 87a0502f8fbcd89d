"""The suite ``linear``: families of linear arithmetic in which one number grows, each with its known answer."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from experiments.problem import Problem

SEED = 27
CHAINS = (50, 200, 500, 1000, 2000)
UNSAT = (10, 20, 40, 80, 160, 320, 640)
SAT = (20, 40, 80, 320, 1280)
SPARSE = (50, 200, 500, 1000)
CLAUSES = (10, 20, 40, 80, 160, 320)
TIGHT = (10, 20, 40, 80)
CASES = (10, 20, 40, 80)
PROJECTIONS = (2, 4, 6, 8, 10)

Family = Callable[[int], str]


def problems() -> list[Problem]:
    """All of them."""
    return [
        *_family("chain", chain, CHAINS, "true"),
        *_family("cycle", cycle, CHAINS, "false"),
        *_family("dense-unsat", dense_unsat, UNSAT, "false"),
        *_family("dense-sat", dense_sat, SAT, "true"),
        *_family("sparse", sparse, SPARSE, "true"),
        *_family("clauses", clauses, CLAUSES, "true"),
        *_family("few-variables", few_variables, CLAUSES, "true"),
        *_family("tight-clauses", tight_clauses, TIGHT, "true"),
        *_family("clauses-unsat", clauses_unsat, CLAUSES, "false"),
        *_family("cases", cases, CASES, "false"),
        *_family("projection", projection, PROJECTIONS),
    ]


def _family(name: str, made: Family, sizes: Sequence[int], answer: str | None = None) -> Iterator[Problem]:
    for n in sizes:
        yield Problem(f"linear/{name}", f"{name}-{n}", made(n), answer, size=n)


def _names(n: int) -> list[str]:
    return [f"x{k}" for k in range(1, n + 1)]


def _form(row: Sequence[int], names: Sequence[str]) -> str:
    return " + ".join(f"({c})*{x}" for c, x in zip(row, names, strict=True) if c) or "0"


def _exists(names: Sequence[str], parts: Sequence[str]) -> str:
    return f"ex {', '.join(names)}. {' and '.join(parts)}"


def chain(n: int) -> str:
    """x1 < x2 < ... < xn."""
    names = _names(n)
    return _exists(names, [f"{x} < {y}" for x, y in pairwise(names)])


def cycle(n: int) -> str:
    """The same and xn < x1."""
    names = _names(n)
    return _exists(names, [f"{x} < {y}" for x, y in zip(names, [*names[1:], names[0]], strict=True)])


def dense_unsat(n: int) -> str:
    """Random rows r_i.x <= b_i in n variables, and one that the sum of the others excludes narrowly."""
    rng = random.Random(SEED + n)
    rows = [[rng.randint(-9, 9) for _ in range(n)] for _ in range(n)]
    bounds = [rng.randint(-9, 9) for _ in rows]
    weights = [rng.randint(1, 9) for _ in rows]
    total = [sum(w * row[k] for w, row in zip(weights, rows, strict=True)) for k in range(n)]
    limit = sum(w * b for w, b in zip(weights, bounds, strict=True))
    names = _names(n)
    parts = [f"{_form(row, names)} <= {b}" for row, b in zip(rows, bounds, strict=True)]
    return _exists(names, [*parts, f"{_form(total, names)} > {limit}"])


def dense_sat(n: int) -> str:
    """Random rows r_i.x <= b_i with the sum of all coordinates at least n, all tight at one point or nearly so."""
    rng = random.Random(SEED + n)
    rows = [[rng.randint(-9, 9) for _ in range(n)] for _ in range(n)]
    point = [rng.randint(-9, 9) for _ in range(n)]
    names = _names(n)
    parts = []
    for row in rows:
        parts.append(
            f"{_form(row, names)} <= {sum(c * v for c, v in zip(row, point, strict=True)) + rng.randint(0, 1)}"
        )
    return _exists(names, [*parts, f"{_form([1] * n, names)} >= {sum(point)}"])


def sparse(n: int) -> str:
    """Three conditions for each variable, on five variables each, that hold at a random point, some of them strict."""
    rng = random.Random(SEED + n)
    names = _names(n)
    point = [rng.randint(-9, 9) for _ in names]
    parts = []
    for _ in range(3 * n):
        row = {k: rng.choice((-3, -2, -1, 1, 2, 3)) for k in rng.sample(range(n), 5)}
        value = sum(c * point[k] for k, c in row.items())
        relation, bound = ("<", value + 1) if rng.random() < 0.3 else ("<=", value)
        parts.append(" + ".join(f"({c})*{names[k]}" for k, c in row.items()) + f" {relation} {bound}")
    return _exists(names, parts)


def clauses(n: int) -> str:
    """So many clauses of three bounds of random forms, each in three of as many variables."""
    rng = random.Random(SEED + n)
    return _clauses(n, n, rng, lambda value, position: rng.randint(-20, 20))


def few_variables(n: int) -> str:
    """The same in six variables, a bound of each clause holding at a random point."""
    rng = random.Random(SEED + n)
    return _clauses(n, 6, rng, lambda value, position: value + rng.randint(0, 5) if position else rng.randint(-20, 20))


def tight_clauses(n: int) -> str:
    """The same in n/4 variables, one bound of three holding at a random point, and hardly more."""
    rng = random.Random(SEED + n)
    return _clauses(
        n, n // 4, rng, lambda value, position: rng.randint(-20, 20) if position else value + rng.randint(0, 2)
    )


def _clauses(n: int, size: int, rng: random.Random, bound: Callable[[int, int], int]) -> str:
    names = _names(max(4, size))
    point = [rng.randint(-9, 9) for _ in names]
    parts = []
    for _ in range(n):
        atoms = []
        for position in range(3):
            row = {k: rng.choice((-3, -2, -1, 1, 2, 3)) for k in rng.sample(range(len(names)), 3)}
            value = sum(c * point[k] for k, c in row.items())
            atoms.append(" + ".join(f"({c})*{names[k]}" for k, c in row.items()) + f" <= {bound(value, position)}")
        rng.shuffle(atoms)
        parts.append(f"({' or '.join(atoms)})")
    return _exists(names, parts)


def clauses_unsat(n: int) -> str:
    """Each of n/2 variables is at most 0 or at least 2, twice as a sum with its neighbour; their sum lies between."""
    names = _names(max(2, n // 2))
    parts = [f"({x} <= 0 or {x} >= 2)" for x in names]
    parts += [f"({x} - {y} < 0 or {x} - {y} >= 0)" for x, y in pairwise(names)]
    parts += [f"{x} >= 0 and {x} <= 2" for x in names]
    return _exists(names, [*parts, f"{' + '.join(names)} > 0", f"{' + '.join(names)} < 2"])


def cases(n: int) -> str:
    """x lies in one of n intervals, y in one of n others, and they are not as far from each other as asked."""
    xs = " or ".join(f"(x >= {4 * k} and x <= {4 * k + 1})" for k in range(n))
    ys = " or ".join(f"(y >= {4 * k + 2} and y <= {4 * k + 3})" for k in range(n))
    return f"ex x, y. ({xs}) and ({ys}) and x - y > -1 and x - y < 1"


def projection(n: int) -> str:
    """The shadow in three parameters of a random bounded polyhedron: n variables eliminated, 2n + 6 conditions."""
    rng = random.Random(SEED + n)
    names = [*_names(n), "a", "b", "c"]
    parts = []
    for _ in range(2 * n + 6):
        row = {k: rng.choice((-3, -2, -1, 1, 2, 3)) for k in rng.sample(range(n + 3), 3)}
        parts.append(" + ".join(f"({c})*{names[k]}" for k, c in row.items()) + f" <= {rng.randint(1, 20)}")
    return f"ex {', '.join(names[:n])}. {' and '.join(parts)}"
