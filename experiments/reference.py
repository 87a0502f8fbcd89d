"""Executable specification: complete real quantifier elimination by the method of Cohen and Hormander.

This module is an oracle for tests. It shares no arithmetic and no algorithm with the engine: its
polynomials are nested tuples of Python integers, and one quantifier is eliminated by the sign matrix of the
polynomials of its body, which is built from the derivative and from remainders, one polynomial of highest
degree at a time. Source: L. Hormander, The Analysis of Linear Partial Differential Operators II (1983),
appendix A.2, after an idea of P. Cohen; presented as a program in J. Harrison, Handbook of Practical Logic and
Automated Reasoning (2009), section 5.9. It is slow (not even elementary recursive), and complete.

Two departures from the textbook keep small problems small: the sign matrix of polynomials with integer
coefficients is read off their isolated roots (Sturm), and the same roots discard sign assumptions on
polynomials in one variable that no real number fulfils.

The variable bound by ``d`` enclosing binders has level ``d``; free variables come first. A polynomial is an
integer or ``(level, (c0, c1, ..., cn))`` with n >= 1, cn nonzero and coefficients of lower level.
A quantifier-free formula is a bool or one of ``("atom", p, signs)``, ``("and" | "or", formulas)``,
``("not", formula)`` and the decision ``("if", p, (f, g, h))``: f where p < 0, g where p = 0, h where p > 0.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import lru_cache, reduce
from itertools import pairwise, zip_longest
from math import gcd
from typing import Any

from qe.errors import InputError
from qe.formula import syntax
from qe.formula.build import atom, conj, disj
from qe.options import Budget

Toy = Any  # a nested tuple as described above; recursive types buy nothing here
Tree = Any
Signs = Mapping[Toy, int]
Rows = list[dict[Toy, int]]


def decide(formula: syntax.Formula, *, budget: Budget | None = None) -> bool:
    """Whether a sentence is true over R. ``InputError`` when variables are free or root atoms occur."""
    if names := formula.free:
        raise InputError(f"not a sentence: {', '.join(names)} free")
    return eliminate(formula, budget=budget) == syntax.TRUE


def eliminate(formula: syntax.Formula, *, budget: Budget | None = None) -> syntax.Formula:
    """An equivalent quantifier-free formula in the free variables (long; meant for small input)."""
    names, ring = formula.free, formula.ring

    def poly(p: Toy) -> Any:
        assert ring is not None
        if isinstance(p, int):
            return ring.constant(p)
        return reduce(lambda total, c: total * ring.var(names[p[0]]) + poly(c), reversed(p[1]), ring.constant(0))

    def back(f: Tree) -> syntax.Formula:
        if isinstance(f, bool):
            return syntax.TRUE if f else syntax.FALSE
        _, p, branches = f
        kinds = syntax.Relation.LT, syntax.Relation.EQ, syntax.Relation.GT
        return disj(conj((atom(poly(p), r), back(branch))) for r, branch in zip(kinds, branches, strict=True))

    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, 50_000))  # continuations nest deeply; pure Python frames are on the heap
    try:
        solver = _Solver(budget or Budget())
        levels = {name: i for i, name in enumerate(names)}
        return back(solver.decision(solver.translate(formula, levels, len(levels)), {}))
    finally:
        sys.setrecursionlimit(limit)


# --- toy polynomials -------------------------------------------------------------------------------------
def _level(p: Toy) -> int:
    return -1 if isinstance(p, int) else int(p[0])


def _make(level: int, coefficients: list[Toy]) -> Toy:
    while coefficients and coefficients[-1] == 0:
        coefficients.pop()
    if len(coefficients) < 2:
        return coefficients[0] if coefficients else 0
    return (level, tuple(coefficients))


def _coefficients(p: Toy, level: int) -> tuple[Toy, ...]:
    return p[1] if _level(p) == level else (p,)


def _add(p: Toy, q: Toy) -> Toy:
    level = max(_level(p), _level(q))
    if level < 0:
        return p + q
    pairs = zip_longest(_coefficients(p, level), _coefficients(q, level), fillvalue=0)
    return _make(level, [_add(a, b) for a, b in pairs])


def _mul(p: Toy, q: Toy) -> Toy:
    level = max(_level(p), _level(q))
    if level < 0:
        return p * q
    a, b = _coefficients(p, level), _coefficients(q, level)
    result: list[Toy] = [0] * (len(a) + len(b) - 1)
    for i, c in enumerate(a):
        for j, d in enumerate(b):
            result[i + j] = _add(result[i + j], _mul(c, d))
    return _make(level, result)


def _integers(p: Toy) -> Iterator[int]:
    if isinstance(p, int):
        yield p
    else:
        for c in p[1]:
            yield from _integers(c)


def _primitive(p: Toy) -> tuple[int, Toy]:
    """(s, q): the sign s of a leading integer, and q with p = s * (positive integer) * q."""

    def divide(q: Toy) -> Toy:
        return q // content if isinstance(q, int) else (q[0], tuple(divide(c) for c in q[1]))

    *_, last = _integers(p)
    content = gcd(*_integers(p)) * (-1 if last < 0 else 1) or 1
    return (-1 if content < 0 else 1), divide(p)


def _derivative(p: Toy) -> Toy:
    return _make(p[0], [_mul(k, c) for k, c in enumerate(p[1])][1:])


def _remainder(p: Toy, q: Toy, head_sign: int) -> Toy:
    """r of lower degree than q, of the sign of p wherever q = 0; ``head_sign``: the sign of q's head."""
    level, divisor = q[0], q[1]
    rest, odd = list(_coefficients(p, level)), False
    while len(rest) >= len(divisor):
        top, shift = rest.pop(), len(rest) + 1 - len(divisor)
        rest = [_mul(divisor[-1], c) for c in rest]
        for i, c in enumerate(divisor[:-1]):
            rest[shift + i] = _add(rest[shift + i], _mul(-1, _mul(top, c)))
        odd = not odd
    r = _make(level, rest)
    sign, q = _primitive(r)  # positive integer factors are dropped at once: they only grow
    return _mul(sign * (head_sign if odd else 1), q)


# --- integer polynomials in one variable: real roots -------------------------------------------------------
@lru_cache(maxsize=20_000)
def _sturm(p: Toy, q: Toy) -> tuple[Toy, ...]:
    """The signed remainder sequence; its last element is a gcd."""
    chain = [p, q]
    while not isinstance(chain[-1], int):
        head = chain[-1][1][-1]
        chain.append(_mul(-1, _remainder(chain[-2], chain[-1], 1 if head > 0 else -1)))
    return tuple(chain[:-1] if chain[-1] == 0 else chain)


@lru_cache(maxsize=200_000)
def _sign_at(p: Toy, x: Fraction) -> int:
    value, power = 0, 1  # p(n/d) times d^degree
    for c in reversed(p[1] if isinstance(p, tuple) else (p,)):
        value, power = value * x.numerator + c * power, power * x.denominator
    return (value > 0) - (value < 0)


@lru_cache(maxsize=200_000)
def _variations(p: Toy, x: Fraction) -> int:
    """Between points that are no roots, the difference is the number of distinct real roots (Sturm 1829)."""
    signs = [] if isinstance(p, int) else [s for f in _sturm(p, _derivative(p)) if (s := _sign_at(f, x))]
    return sum(a != b for a, b in pairwise(signs))


def _count(p: Toy, low: Fraction, high: Fraction) -> int:
    return _variations(p, low) - _variations(p, high)


def _isolate(ps: list[Toy], low: Fraction, high: Fraction) -> Iterator[tuple[Fraction, Fraction]]:
    """Ascending intervals that hold one root of the product of ``ps`` each; their ends are no roots."""
    inside = [p for p in ps if _count(p, low, high)]
    if not inside:
        return
    if all(_count(f, low, high) == 1 for p in inside for f in (p, _sturm(inside[0], p)[-1])):
        yield low, high
        return
    middle = (low + high) / 2
    while any(_sign_at(p, middle) == 0 for p in inside):
        middle = (low + middle) / 2
    yield from _isolate(inside, low, middle)
    yield from _isolate(inside, middle, high)


@lru_cache(maxsize=5_000)
def _sign_rows(ps: tuple[Toy, ...]) -> tuple[tuple[int, ...], ...]:
    """The sign matrix of nonconstant integer polynomials: rows for interval, root, interval, ..., interval."""
    size = max((sum(abs(c) for c in p[1]) for p in ps), default=1)  # Cauchy: roots are smaller than this + 1
    bound = Fraction(1 << (size + 1).bit_length())
    rows = [tuple(_sign_at(p, -bound) for p in ps)]
    for low, high in _isolate(list(dict.fromkeys(ps)), -bound, bound):
        after = tuple(_sign_at(p, high) for p in ps)
        rows.append(tuple(0 if _count(p, low, high) else s for p, s in zip(ps, after, strict=True)))
        rows.append(after)
    return tuple(rows)


# --- elimination -------------------------------------------------------------------------------------------
def _known(p: Toy, signs: Signs) -> int | None:
    """The sign of p, if it is a constant, assumed, or has an assumed power of a variable as a factor."""
    if isinstance(p, int):
        return (p > 0) - (p < 0)
    unit, p = _primitive(p)
    if p in signs:
        return unit * signs[p]
    if p[1][0] == 0 and p[1] != (0, 1):
        x, k, q = _split_power(p)
        base, rest = _known(x, signs), _known(q, signs)
        return 0 if 0 in (base, rest) else None if base is None or rest is None else unit * base**k * rest
    return None


def _split_power(p: Toy) -> tuple[Toy, int, Toy]:
    """(x, k, q) with p = x^k * q and k as large as possible, for the main variable x of p."""
    k = next(i for i, c in enumerate(p[1]) if c != 0)
    return (p[0], (0, 1)), k, _make(p[0], list(p[1][k:]))


def _assign(f: Tree, sign: Callable[[Toy], int | None]) -> Tree:
    """The formula with polynomials of known sign replaced, and constants propagated."""
    match f:
        case "atom", p, allowed:
            s = sign(p)
            return f if s is None else s in allowed
        case "if", p, branches:
            s = sign(p)
            if s is not None:
                return _assign(branches[s + 1], sign)
            return _decision(p, {k: _assign(branches[k + 1], sign) for k in (-1, 0, 1)})
        case "not", g:
            g = _assign(g, sign)
            return not g if isinstance(g, bool) else ("not", g)
        case ("and" | "or") as kind, parts:
            unit = kind == "and"
            kept: dict[Tree, None] = {}
            for part in parts:
                g = _assign(part, sign)
                if g is (not unit):
                    return g
                kept.update({} if g is unit else {g: None})
            return unit if not kept else next(iter(kept)) if len(kept) == 1 else (kind, tuple(kept))
    return f


def _decision(p: Toy, branches: dict[int, Tree]) -> Tree:
    """The decision on the sign of p; signs without a branch cannot occur."""
    first, *others = branches.values()
    return ("if", p, tuple(branches.get(s, first) for s in (-1, 0, 1))) if any(b != first for b in others) else first


def _polys(f: Tree) -> Iterator[Toy]:
    if isinstance(f, bool):
        return
    if f[0] in ("atom", "if"):
        yield f[1]
    if f[0] != "atom":
        for part in (f[1],) if f[0] == "not" else f[-1]:
            yield from _polys(part)


class _Solver:
    """The elimination proper, in continuation passing style: ``signs`` holds the assumptions of a branch."""

    def __init__(self, budget: Budget) -> None:
        self.budget = budget

    def translate(self, formula: syntax.Formula, levels: Mapping[str, int], depth: int) -> Tree:
        """The formula with its quantifiers eliminated; ``levels`` of the names in scope, ``depth`` of them."""
        match formula:
            case syntax.Constant(value):
                return value
            case syntax.Atom(poly, relation):
                return ("atom", self.toy(poly, levels), relation.signs)
            case syntax.And(args):
                return ("and", tuple(self.translate(a, levels, depth) for a in args))
            case syntax.Or(args):
                return ("or", tuple(self.translate(a, levels, depth) for a in args))
            case syntax.Not(arg):
                return ("not", self.translate(arg, levels, depth))
            case syntax.Exists(names, body):
                inner = {**levels, **{name: depth + i for i, name in enumerate(names)}}
                f = self.translate(body, inner, depth + len(names))
                for level in reversed(range(depth, depth + len(names))):
                    f = self.exists(level, f)
                return f
            case syntax.ForAll(names, body):
                return ("not", self.translate(syntax.Exists(names, syntax.Not(body)), levels, depth))
        raise InputError("the reference implementation reads formulas without root atoms")

    @staticmethod
    def toy(poly: Any, levels: Mapping[str, int]) -> Toy:
        total: Toy = 0
        for exponents, coefficient in poly.terms():
            term: Toy = int(coefficient)
            for name, k in zip(poly.ring.names, exponents, strict=True):
                if k:
                    term = _mul(term, (levels[name], (0,) * k + (1,)))
            total = _add(total, term)
        return total

    def exists(self, level: int, body: Tree) -> Tree:
        """A formula without the variable of this (highest) level, equivalent to: it exists such that body."""
        body = _assign(body, lambda p: _known(p, {}))
        if isinstance(body, bool):
            return body
        columns = list(dict.fromkeys(p for p in _polys(body) if _level(p) == level))

        def finish(rows: Rows, signs: Signs) -> Tree:
            cases = dict.fromkeys(_assign(body, row.get) for row in rows)
            return self.decision(("or", tuple(cases)), signs)

        return self.matrix(columns, level, {}, finish)

    def decision(self, f: Tree, signs: Signs) -> Tree:
        """The formula as a decision tree (or a bool) under the assumptions."""
        f = _assign(f, lambda p: _known(p, signs))
        if isinstance(f, bool):
            return f
        return self.split(next(_polys(f)), signs, lambda _, more: self.decision(f, more))

    def split(self, p: Toy, signs: Signs, then: Callable[[int, Signs], Tree]) -> Tree:
        """Continue with the sign of p, in one branch for each sign that the assumptions leave possible."""
        self.budget.check("reference elimination")
        if (known := _known(p, signs)) is not None:
            return then(known, signs)
        unit, p = _primitive(p)
        if p[1][0] == 0 and p[1] != (0, 1):
            x, k, q = _split_power(p)
            return self.split(x, signs, lambda s, more: then(0, more) if s == 0 else
                              self.split(q, more, lambda t, most: then(unit * s**k * t, most)))
        options = [-1, 0, 1]
        if all(isinstance(c, int) for c in p[1]):
            line = [q for q in signs if q[0] == p[0] and all(isinstance(c, int) for c in q[1])]
            wanted = tuple(signs[q] for q in line)
            options = sorted({row[-1] for row in _sign_rows((*line, p)) if row[:-1] == wanted})
        return _decision(p, {s: then(unit * s, {**signs, p: s}) for s in options})

    def matrix(self, ps: list[Toy], level: int, signs: Signs, then: Callable[[Rows, Signs], Tree]) -> Tree:
        """Continue with the sign matrix of ps, as polynomials in the variable of this level.

        Rows stand for interval, point, interval, ..., interval of the real line, where the points include all
        roots of the polynomials; columns are the signs of ``ps``.
        """
        low = next((p for p in ps if _level(p) < level), None)
        if low is not None:
            rest = [p for p in ps if p != low]
            return self.split(low, signs, lambda sign, more: self.matrix(
                rest, level, more, lambda rows, most: then([{**row, low: sign} for row in rows], most)))
        heads = {p: _known(p[1][-1], signs) for p in ps}
        doubtful = next((p for p in ps if not heads[p]), None)
        if doubtful is not None and heads[doubtful] is None:
            return self.split(doubtful[1][-1], signs, lambda _, more: self.matrix(ps, level, more, then))
        if doubtful is not None:
            rest = [_make(level, list(p[1][:-1])) if p == doubtful else p for p in ps]
            shorter = rest[ps.index(doubtful)]
            return self.matrix(rest, level, signs, lambda rows, more: then(
                [{**row, doubtful: row[shorter]} for row in rows], more))
        if all(isinstance(c, int) for p in ps for c in p[1]):
            return then([dict(zip(ps, row, strict=True)) for row in _sign_rows(tuple(ps))], signs)
        top = max(ps, key=lambda p: len(p[1]))
        divisors = [_derivative(top), *(p for p in ps if p != top)]
        remainders = {q: _remainder(top, q, heads.get(q) or heads[top] or 0) for q in divisors if _level(q) == level}
        return self.matrix([*divisors, *remainders.values()], level, signs, lambda rows, more: then(
            _insert(rows, top, divisors, remainders), more))


def _insert(rows: Rows, p: Toy, divisors: list[Toy], remainders: Mapping[Toy, Toy]) -> Rows:
    """The rows of p and ``divisors`` (the first is p') from the rows of ``divisors`` and ``remainders``.

    At a point where some divisor q vanishes p has the sign of its remainder by q; between two such points p is
    strictly monotone; at infinity it has the sign, or the opposite sign, of its derivative.
    """
    gaps, points, ends = [rows[0]], [], [-rows[0][divisors[0]]]
    for point, after in zip(rows[1::2], rows[2::2], strict=True):
        sign = next((point[r] for q, r in remainders.items() if point[q] == 0), None)
        if sign is not None:
            points.append({p: sign, **{q: point[q] for q in divisors}})
            gaps.append(after)
            ends.append(sign)
    ends.append(rows[-1][divisors[0]])
    result: Rows = []
    for k, gap in enumerate(gaps):
        left, right, others = ends[k], ends[k + 1], {q: gap[q] for q in divisors}
        # both zero contradicts Rolle: then the assumptions are inconsistent and any sign will do
        between = [left, 0, right] if left * right < 0 else [left or right or gap[divisors[0]]]
        result += [*points[max(k - 1, 0) : k], *({p: sign, **others} for sign in between)]
    return result
