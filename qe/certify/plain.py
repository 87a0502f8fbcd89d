"""A second reader of certificates: the language's own integers and fractions, nothing else.

python -m qe.certify.plain FILE          or, from anywhere,          python plain.py FILE

It shares no line with the engine, nor with the other checkers, so that a mistake in one reader is not one in both. It
reads witnesses, optima, substitutions, cell tables in up to two variables, bundles, and derivations by boolean steps,
cases and "negation normal form". It says one of three things: accepted; rejected, with the entry that is wrong; or
not decided, where a certificate is beyond what is read here. Exit status: 0, 4, 3, and 2 for what is no certificate.

A polynomial is a dict from exponents to integers; one in a single variable is a list of fractions from degree 0 up.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from math import gcd, lcm, prod
from typing import Any

FORMAT = "bezier-qe certificate"
NESTING, TERMS, DEGREE, SIZE, BITS, CASES = 200, 20_000, 200, 16, 100_000, 50_000
"""Limits: nested formulas, terms of a polynomial, degrees, rows of a determinant, bits of a number, cases of signs."""


class Rejected(Exception):
    """An entry (its path is the first argument) is wrong, for a reason."""


class Undecided(Exception):
    """Beyond what is read here."""


def require(condition: object, where: str, reason: str) -> None:
    """Reject unless the condition holds."""
    if not condition:
        raise Rejected(where, reason)


# --- reading ---------------------------------------------------------------------------------------------------

Poly = dict[tuple[int, ...], int]
Line = list[Fraction]
_NAME = r"(?:[^\W\d]\w*'*|`(?:[^`]|``)+`)"
_POWER = re.compile(rf"({_NAME})(?:\^([1-9]\d*))?")
_POWERS = rf"{_NAME}(?:\^[1-9]\d*)?"
_TERM = re.compile(rf"(?: ([+-]) )?(-?)(?:(?:([1-9]\d*)\*)?({_POWERS}(?:\*{_POWERS})*)|([1-9]\d*))")
_NUMBER = re.compile(r"-?(0|[1-9]\d*)(/[1-9]\d*)?", re.ASCII)
_RELATIONS = {"=": (0,), "/=": (-1, 1), "!=": (-1, 1), "<": (-1,), "<=": (-1, 0), ">": (1,), ">=": (0, 1)}
_NEGATED = {"=": "/=", "/=": "=", "!=": "=", "<": ">=", "<=": ">", ">": "<=", ">=": "<"}


def fields(value: Any, where: str, listed: str, optional: str = "") -> list[Any]:
    """The members of an object with these names; optional ones may be missing (None)."""
    names, others = listed.split(), optional.split()
    require(isinstance(value, dict) and set(names) <= set(value), where, f"expected an object with {listed}")
    require(set(value) <= {*names, *others}, where, "an unknown member")
    return [value.get(name) for name in (*names, *others)]


def _members(value: Any, where: str) -> list[Any]:
    require(isinstance(value, list), where, "expected a list")
    return list(value)


def number(value: Any, where: str) -> Fraction:
    """A rational number in lowest terms."""
    require(isinstance(value, str) and _NUMBER.fullmatch(value) and len(value) < BITS, where, "expected a number")
    found = Fraction(value)
    require(str(found) == value, where, "expected lowest terms")
    return found


def _integer(value: Any, where: str) -> int:
    require(isinstance(value, int) and not isinstance(value, bool) and value >= 0, where, "expected an integer")
    return int(value)


def _variables(value: Any, where: str) -> list[str]:
    names = _members(value, where)
    require(all(isinstance(n, str) and n for n in names) and len(set(names)) == len(names), where, "expected names")
    return names


def polynomial(value: Any, names: Sequence[str], where: str) -> Poly:
    """Terms joined by + and -, each an integer times powers."""
    require(isinstance(value, str) and value, where, "expected a polynomial")
    found, start = Poly(), 0
    while value != "0" and start < len(value):
        term = _TERM.match(value, start)
        if term is None or bool(term[1]) is not bool(start) or (start and term[2]):
            raise Rejected(where, "expected a polynomial")
        exponents = [0] * len(names)
        coefficient = int(term[3] or term[5] or 1) * (-1 if "-" in (term[1], term[2]) else 1)
        for quoted, exponent in _POWER.findall(term[4] or ""):
            name = quoted[1:-1].replace("``", "`") if quoted.startswith("`") else quoted
            right = name in names and len(exponent) < 6 and exponent != "1" and not any(exponents[names.index(name) :])
            require(right, where, f"an unknown variable, or one out of order: {name}")
            exponents[names.index(name)] += int(exponent or 1)
        key, start = tuple(exponents), term.end()
        require(key not in found and coefficient, where, "a repeated or empty term")
        found[key] = coefficient
    require(list(found) == sorted(found, key=lambda e: (sum(e), e), reverse=True), where, "terms out of order")
    return found


Formula = Any
"""A truth value, or a tuple: and, or, not with formulas; atom, terms, relation; exists, forall, names, formula."""


def formula(value: Any, names: Sequence[str], where: str, depth: int = 0) -> Formula:
    """A formula as nested tuples; polynomials as sorted tuples of terms, with the first coefficient positive."""
    if isinstance(value, bool):
        return value
    require(isinstance(value, list) and value and depth < NESTING, where, "expected a formula")
    kind, rest = value[0], value[1:]
    if kind in ("and", "or") and len(rest) > 1:
        return (kind, *(formula(v, names, f"{where}[{k + 1}]", depth + 1) for k, v in enumerate(rest)))
    if kind == "not" and len(rest) == 1:
        return ("not", formula(rest[0], names, f"{where}[1]", depth + 1))
    if kind == "atom" and len(rest) == 2:
        require(rest[1] in [*_RELATIONS], where, "unknown relation")
        return comparison(primitive(rest[0], names, where), rest[1])
    if kind in ("exists", "forall") and len(rest) == 2:
        bound = _variables(rest[0], where)
        require(bound and set(bound) <= set(names), where, "unknown variable")
        return (kind, tuple(bound), formula(rest[1], names, f"{where}[2]", depth + 1))
    if kind == "root":
        raise Undecided(f"{where}: a root atom")
    raise Rejected(where, "expected a formula")


def primitive(value: Any, names: Sequence[str], where: str) -> Poly:
    """A polynomial as atoms have it."""
    p = polynomial(value, names, where)
    right = any(map(any, p)) and gcd(*p.values()) == 1 and p[max(p, key=lambda e: e[::-1])] > 0
    require(right, where, "expected a primitive polynomial with positive leading coefficient")
    return p


def comparison(p: Poly, relation: str) -> Formula:
    """The atom ``p relation 0``, normalised; a truth value for a constant."""
    if all(not any(e) for e in p):
        value = next(iter(p.values()), 0)
        return (value > 0) - (value < 0) in _RELATIONS[relation]
    divisor = gcd(*p.values())
    terms = sorted((e, c // divisor) for e, c in p.items())
    if terms[-1][1] < 0:
        terms = [(e, -c) for e, c in terms]
        relation = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}.get(relation, relation)
    return ("atom", tuple(terms), "/=" if relation == "!=" else relation)


def joined(kind: str, parts: Sequence[Formula]) -> Formula:
    """A conjunction or disjunction, flattened, without repetitions and constants."""
    unit, found = kind == "and", dict[Formula, None]()
    for part in parts:
        inner = part[1:] if isinstance(part, tuple) and part[0] == kind else (part,)
        for one in inner:
            if one is (not unit):
                return not unit
            if one is not unit:
                found[one] = None
    return unit if not found else next(iter(found)) if len(found) == 1 else (kind, *found)


def _joints(f: Formula, kind: str = "and") -> tuple[Formula, ...]:
    return tuple(f[1:]) if isinstance(f, tuple) and f[0] == kind else (f,)


def occurring(f: Formula) -> set[int]:
    """The numbers of the variables in atoms, bound ones included."""
    if isinstance(f, bool):
        return set()
    if f[0] == "atom":
        return {i for e, _ in f[1] for i, k in enumerate(e) if k}
    return set().union(*map(occurring, f[2:] if f[0] in ("exists", "forall") else f[1:]))


def pushed(f: Formula, negative: bool = False) -> Formula:
    """Negation normal form of the formula, or of its negation."""
    if isinstance(f, bool):
        return f is not negative
    if f[0] == "atom":
        return ("atom", f[1], _NEGATED[f[2]]) if negative else f
    if f[0] == "not":
        return pushed(f[1], not negative)
    if f[0] in ("and", "or"):
        return joined("and" if (f[0] == "and") is not negative else "or", [pushed(g, negative) for g in f[1:]])
    return quantified("exists" if (f[0] == "exists") is not negative else "forall", f[1], pushed(f[2], negative))


def quantified(kind: str, names: Sequence[str], f: Formula) -> Formula:
    """A block; neighbours of one kind are joined."""
    if isinstance(f, bool) or not names:
        return f
    if f[0] == kind:
        return (kind, (*(n for n in names if n not in f[1]), *f[1]), f[2])
    return (kind, tuple(names), f)


# --- polynomials -----------------------------------------------------------------------------------------------


def _plus(p: Poly, q: Poly, factor: int = 1) -> Poly:
    found = dict(p)
    for e, c in q.items():
        total = found.get(e, 0) + factor * c
        if total:
            found[e] = total
        else:
            found.pop(e, None)
    return found


def _times(p: Poly, q: Poly) -> Poly:
    if len(p) * len(q) > TERMS:
        raise Undecided("a product of too many terms")
    found = Poly()
    for e, c in p.items():
        for f, d in q.items():
            key = tuple(i + j for i, j in zip(e, f, strict=True))
            found[key] = found.get(key, 0) + c * d
    return {e: c for e, c in found.items() if c}


def _power(p: Poly, exponent: int, size: int) -> Poly:
    if exponent > DEGREE:
        raise Undecided("a high power")
    found: Poly = {(0,) * size: 1}
    for _ in range(exponent):
        found = _times(found, p)
    return found


def parts_in(p: Poly, i: int) -> list[Poly]:
    """The coefficients with respect to variable i, from degree 0 up."""
    found: list[Poly] = [{} for _ in range(max((e[i] for e in p), default=0) + 1)]
    for e, c in p.items():
        found[e[i]][(*e[:i], 0, *e[i + 1 :])] = c
    return found


def _value_at(p: Poly, point: Sequence[Fraction]) -> Fraction:
    if any(k * max(x.numerator.bit_length(), x.denominator.bit_length()) > BITS for e in p for k, x in zip(e, point)):
        raise Undecided("a large power")
    total = Fraction(0)
    for e, c in p.items():
        term = Fraction(c)
        for k, x in zip(e, point, strict=True):
            if k:
                term *= x**k
        total += term
    return total


def _sign(x: Fraction | int) -> int:
    return (x > 0) - (x < 0)


def line(p: Poly, i: int, where: str = "payload") -> Line:
    """A polynomial in variable i alone as a list."""
    require(all(not any(k for j, k in enumerate(e) if j != i) for e in p), where, "more than one variable")
    found = [Fraction(0)] * (max((e[i] for e in p), default=-1) + 1)
    for e, c in p.items():
        found[e[i]] += c
    if len(found) > DEGREE:
        raise Undecided("a high degree")
    return found


def _trimmed(p: Sequence[Fraction]) -> Line:
    found = list(p)
    while found and not found[-1]:
        found.pop()
    return found


def _at(p: Line, x: Fraction) -> Fraction:
    total = Fraction(0)
    for c in reversed(p):
        total = total * x + c
    return total


def divided(p: Line, q: Line) -> tuple[Line, Line]:
    """Quotient and remainder."""
    rest, quotient = _trimmed(p), [Fraction(0)] * max(0, len(p) - len(q) + 1)
    while len(rest) >= len(q):
        factor, shift = rest[-1] / q[-1], len(rest) - len(q)
        quotient[shift] = factor
        for k, c in enumerate(q):
            rest[shift + k] -= factor * c
        rest = _trimmed(rest[:-1])
    return _trimmed(quotient), rest


def common(p: Line, q: Line) -> Line:
    """The monic greatest common divisor."""
    p, q = _trimmed(p), _trimmed(q)
    while q:
        p, q = q, divided(p, q)[1]
        if q:
            q = [c / q[-1] for c in q]
    return [c / p[-1] for c in p] if p else []


def _product(p: Line, q: Line) -> Line:
    found = [Fraction(0)] * max(0, len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            found[i + j] += a * b
    return _trimmed(found)


def _changes(signs: Sequence[int]) -> int:
    present = [s for s in signs if s]
    return sum(a != b for a, b in pairwise(present))


def roots_between(p: Line, low: Fraction | None, high: Fraction | None) -> int:
    """Distinct real roots in (low, high]; None: unbounded."""
    return Fibre(Base(), [[c] if c else [] for c in p]).roots(low, high)


class Root:
    """The only root of a squarefree polynomial in (low, high); no end is a root."""

    def __init__(self, p: Line, low: Fraction, high: Fraction, where: str) -> None:
        self.p = divided(p, common(p, [k * c for k, c in enumerate(p)][1:]))[0] if len(p) > 2 else _trimmed(p)
        require(len(self.p) > 1 and low < high, where, "expected an interval with a root")
        require(_at(self.p, low) and _at(self.p, high), where, "an end of the interval is a root")
        require(roots_between(self.p, low, high) == 1, where, "expected exactly one root there")
        self.low, self.high = low, high

    def halve(self) -> None:
        middle = (self.low + self.high) / 2
        value = _at(self.p, middle)
        if not value:
            third = (self.high - self.low) / 3
            self.low, self.high = middle - third, middle + third
        elif _sign(value) == _sign(_at(self.p, self.low)):
            self.low = middle
        else:
            self.high = middle

    def sign(self, q: Line) -> int:
        """The sign of a polynomial at the root."""
        q = _trimmed(q)
        if len(q) <= 1:
            return _sign(q[0]) if q else 0
        shared = common(self.p, q)
        if len(shared) > 1 and roots_between(shared, self.low, self.high):
            return 0
        while not _at(q, self.low) or not _at(q, self.high) or roots_between(q, self.low, self.high):
            self.halve()
        return _sign(_at(q, self.low))

    def reduced(self, q: Line) -> Line:
        return divided(q, self.p)[1]


# --- witnesses and substitutions -------------------------------------------------------------------------------


def truth(f: Formula, sign_of: Callable[[Any], int | None]) -> bool | None:
    """Three-valued truth of a quantifier-free formula, from the signs of the polynomials of its atoms."""
    if isinstance(f, bool):
        return f
    if f[0] == "atom":
        found = sign_of(f[1])
        return None if found is None else found in _RELATIONS[f[2]]
    if f[0] == "not":
        inner = truth(f[1], sign_of)
        return None if inner is None else not inner
    require(f[0] in ("and", "or"), "payload.matrix", "expected a quantifier-free formula")
    return _decided([truth(g, sign_of) for g in f[1:]], f[0] == "or")


def _decided(values: Sequence[bool | None], decisive: bool) -> bool | None:
    if decisive in values:
        return decisive
    return None if None in values else not decisive


def _check_witness(payload: Any) -> None:
    order, matrix, values = fields(payload, "payload", "order matrix values")
    names = _variables(order, "payload.order")
    body = formula(matrix, names, "payload.matrix")
    numbers = _members(values, "payload.values")
    require(len(numbers) == len(names), "payload.values", "expected one value for each variable")
    rational = {i: number(v, f"payload.values[{i}]") for i, v in enumerate(numbers) if isinstance(v, str)}
    roots: dict[int, Root] = {}
    for i, value in enumerate(numbers):
        if i not in rational:
            where = f"payload.values[{i}]"
            text, ends = fields(value, where, "polynomial interval")
            low, high = (number(e, where) for e in _pair(ends, where))
            roots[i] = Root(line(polynomial(text, names, where), i, where), low, high, where)
    if len(roots) > 1:
        raise Undecided("a witness with more than one irrational number")

    def sign_of(terms: Any) -> int:
        i = next(iter(roots), 0)
        point = [rational.get(j, Fraction(1)) for j in range(len(names))]
        found = [Fraction(0)] * (max(e[i] for e, _ in terms) + 1 if roots else 1)
        for e, c in terms:
            rest = tuple(0 if j == i and roots else k for j, k in enumerate(e))
            found[e[i] if roots else 0] += _value_at({rest: c}, point)
        return roots[i].sign(found) if roots else _sign(found[0])

    require(truth(body, sign_of), "payload.matrix", "the values do not satisfy the formula")


def _pair(value: Any, where: str) -> list[Any]:
    require(isinstance(value, list) and len(value) == 2, where, "expected two numbers")
    return list(value)


def _check_substitution(payload: Any) -> None:
    order, block, matrix, solved, answer = fields(payload, "payload", "order variables matrix solved answer")
    names = _variables(order, "payload.order")
    bound = _variables(block, "payload.variables")
    body = formula(matrix, names, "payload.matrix")
    require({names[i] for i in occurring(body)} | set(bound) == set(names), "payload.order", "not the variables")
    steps = _members(solved, "payload.solved")
    require([_pair(s, "payload.solved")[0] for s in steps] == bound, "payload.solved", "expected one for each variable")
    for k, (name, text) in enumerate(steps):
        where = f"payload.solved[{k}]"
        body = _solved(body, polynomial(text, names, where), names.index(name), len(names), where)
    claimed = formula(answer, names, "payload.answer")
    require(not {names[i] for i in occurring(claimed)} & set(bound), "payload.answer", "a bound variable is left")
    require(set(_joints(joined("and", [claimed]))) == set(_joints(body)), "payload.answer", "not what follows")


def _solved(body: Formula, equation: Poly, i: int, size: int, where: str) -> Formula:
    """The rest of the conjunction with variable i from an equation with a constant coefficient."""
    parts = parts_in(equation, i)
    constant = (0,) * size
    require(len(parts) == 2 and set(parts[1]) == {constant}, where, "expected a constant coefficient")
    needed = comparison(equation, "=")
    require(needed in _joints(body), where, "not a conjunct here")
    lead = parts[1][constant]
    top, bottom = (_plus({}, parts[0], -1), lead) if lead > 0 else (parts[0], -lead)

    def put(f: Formula) -> Formula:
        if isinstance(f, bool):
            return f
        if f[0] == "atom":
            pieces = parts_in(dict(f[1]), i)
            found: Poly = {}
            for k, piece in enumerate(pieces):
                scale = bottom ** (len(pieces) - 1 - k)
                found = _plus(found, _times(piece, _power(top, k, size)), scale)
            return comparison(found, f[2])
        if f[0] == "not":
            return pushed(("not", put(f[1])))
        require(f[0] in ("and", "or"), where, "a quantifier inside")
        return joined(f[0], [put(g) for g in f[1:]])

    return joined("and", [put(c) for c in _joints(body) if c != needed])


# --- optima ----------------------------------------------------------------------------------------------------


class Form:
    """constant + gradient . x + x.H.x/2, with rational numbers."""

    def __init__(self, value: Any, size: int, where: str) -> None:
        self.hessian = [[Fraction(0)] * size for _ in range(size)]
        self.gradient = [Fraction(0)] * size
        self.constant = Fraction(0)
        seen = set()
        for k, term in enumerate(_members(value, where)):
            coefficient, exponents = _pair(term, f"{where}[{k}]")
            c, e = number(coefficient, where), tuple(_integer(v, where) for v in _members(exponents, where))
            require(c and len(e) == size and sum(e) <= 2 and e not in seen, f"{where}[{k}]", "not a term of degree 2")
            seen.add(e)
            found = [i for i, n in enumerate(e) for _ in range(n)]
            if not found:
                self.constant = c
            elif len(found) == 1:
                self.gradient[found[0]] = c
            else:
                self.hessian[found[0]][found[1]] += c
                self.hessian[found[1]][found[0]] += c
        require(_semidefinite(self.hessian), where, "not convex")

    @property
    def is_linear(self) -> bool:
        return not any(map(any, self.hessian))


def _semidefinite(matrix: list[list[Fraction]]) -> bool:
    m = [list(row) for row in matrix]
    for k, row in enumerate(m):
        if row[k] < 0 or (not row[k] and any(row)):
            return False
        if row[k]:
            pivot = list(row)
            for other in m:
                factor = other[k] / pivot[k]
                if factor:
                    other[:] = [a - factor * b for a, b in zip(other, pivot, strict=True)]
    return True


class Field:
    """Numbers as polynomials in a real root."""

    def __init__(self, value: Any, where: str) -> None:
        text, ends = fields(value, where, "minimal_polynomial interval")
        p = [number(c, where) for c in _members(text, where)]
        whole = all(c.denominator == 1 for c in p) and gcd(*(c.numerator for c in p)) == 1
        require(p and whole and p[-1] > 0, where, "expected a primitive polynomial")
        low, high = (number(e, where) for e in _pair(ends, where))
        self.degree = len(p) - 1
        if self.degree == 1 or low == high:
            theta = low if low == high else -p[0] / p[1]
            require((low < theta < high or low == high) and not _at(p, theta), where, "no root in the interval")
            p, low, high = [-theta, Fraction(1)], theta - 1, theta + 1
        self.root = Root(p, low, high, where)

    def read(self, value: Any, where: str) -> Line:
        found = [number(c, where) for c in _members(value, where)]
        require(1 <= len(found) <= self.degree and (found[-1] or not found[1:]), where, "no element of the field")
        return _trimmed(found)

    def row(self, value: Any, count: int, where: str) -> list[Line]:
        found = [self.read(v, f"{where}[{k}]") for k, v in enumerate(_members(value, where))]
        require(len(found) == count, where, f"expected {count} numbers")
        return found

    def sign(self, q: Line) -> int:
        return self.root.sign(q)

    def times(self, p: Line, q: Line) -> Line:
        return self.root.reduced(_product(p, q))


def _add(*parts: Line) -> Line:
    found: Line = []
    for part in parts:
        found += [Fraction(0)] * (len(part) - len(found))
        for k, c in enumerate(part):
            found[k] += c
    return _trimmed(found)


def _scaled(p: Line, factor: Fraction | int) -> Line:
    return _trimmed([c * factor for c in p])


def _dot(row: Sequence[Fraction], x: Sequence[Line], constant: Fraction) -> Line:
    return _add([constant], *(_scaled(v, a) for a, v in zip(row, x, strict=True)))


Equation = tuple[list[Line], Line]
"""row . x = right side."""


class Place:
    """A point in the field, with the constraints of a convex problem around it."""

    def __init__(self, problem: Problem, field: Field, point: list[Line]) -> None:
        self.problem, self.field, self.point = problem, field, point
        self.values = [self.value(f) for f in problem.forms]

    def value(self, form: Form) -> Line:
        inner = (
            self.field.times(v, _add(_scaled(_dot(row, self.point, Fraction(0)), Fraction(1, 2)), [b]))
            for v, row, b in zip(self.point, form.hessian, form.gradient, strict=True)
        )
        return _add([form.constant], *inner)

    def slope(self, form: Form) -> list[Line]:
        return [_dot(row, self.point, b) for row, b in zip(form.hessian, form.gradient, strict=True)]

    def apply(self, row: Sequence[Line]) -> Line:
        return _add(*(self.field.times(a, v) for a, v in zip(row, self.point, strict=True)))

    def tangents(self, form: Form, value: Line) -> list[Equation]:
        """H x = H y, and value + grad.(x - y) = 0."""
        rows: list[list[Line]] = [[[a] if a else [] for a in row] for row in form.hessian]
        found: list[Equation] = [(row, self.apply(row)) for row in rows]
        last = self.slope(form)
        return [*found, (last, _add(self.apply(last), _scaled(value, -1)))]

    def active(self, weights: Sequence[Line], *, values: bool) -> list[Equation]:
        found: list[Equation] = []
        rows = zip(weights, self.problem.forms, self.problem.relations, self.values, strict=True)
        for weight, form, relation, value in rows:
            if relation != "=" and self.field.sign(weight):
                found += self.tangents(form, value if values else [])
        return found

    def check_weights(self, weights: Sequence[Line], where: str, *, complementary: bool) -> None:
        for k, (w, relation, value) in enumerate(zip(weights, self.problem.relations, self.values, strict=True)):
            require(relation == "=" or self.field.sign(w) >= 0, f"{where}[{k}]", "a negative weight")
            if complementary and self.field.sign(w):
                require(not self.field.sign(value), f"{where}[{k}]", "a weight on a constraint that is not active")

    def check_stationary(
        self, weights: Sequence[Line], known: Sequence[Equation], extra: Sequence[Line], where: str, objective: bool
    ) -> None:
        rows = [self.slope(self.problem.objective)] if objective else []
        for w, form in zip(weights, self.problem.forms, strict=True):
            rows.append([self.field.times(w, s) for s in self.slope(form)])
        rows += [[self.field.times(w, a) for a in row] for w, (row, _) in zip(extra, known, strict=True)]
        for j in range(self.problem.size):
            require(not self.field.sign(_add(*(row[j] for row in rows))), where, "the gradient is not zero")
        for w, (row, _) in zip(extra, known, strict=True):
            require(not self.field.sign(w) or any(map(self.field.sign, row)), where, "a weight on an empty equation")

    def total(self, weights: Sequence[Line], known: Sequence[Equation], extra: Sequence[Line]) -> int:
        """The sign of the weighted sum at the point."""
        parts = [self.field.times(w, v) for w, v in zip(weights, self.values, strict=True)]
        for w, (row, right) in zip(extra, known, strict=True):
            parts.append(self.field.times(w, _add(self.apply(row), _scaled(right, -1))))
        return self.field.sign(_add(*parts))

    def strict(self, weights: Sequence[Line]) -> bool:
        pairs = zip(weights, self.problem.relations, strict=True)
        return any(relation == "<" and self.field.sign(w) for w, relation in pairs)

    def check_feasible(self, where: str, *, strictly: bool) -> bool:
        """Whether the strict constraints hold, too."""
        inside = True
        for k, (value, relation) in enumerate(zip(self.values, self.problem.relations, strict=True)):
            found = self.field.sign(value)
            require(found <= 0 and not (relation == "=" and found), where, f"the point violates constraint {k + 1}")
            inside = inside and not (relation == "<" and not found)
        require(inside or not strictly, where, "the point violates a strict constraint")
        return inside

    def links(self, value: Any, known: list[Equation]) -> tuple[list[Equation], list[Line]]:
        found, weights = list(known), list[Line]()
        count = len(self.problem.forms)
        for k, link in enumerate(_members(value, "payload.links") if value is not None else []):
            where = f"payload.links[{k}]"
            first, second = fields(link, where, "weights derived")
            weights = self.field.row(first, count, where)
            extra = self.field.row(second, len(found), where)
            self.check_weights(weights, where, complementary=True)
            self.check_stationary(weights, found, extra, where, objective=False)
            require(self.total(weights, found, extra) >= 0, where, "the weighted sum is negative")
            more = self.active(weights, values=False)
            require(more, where, "a link without weights")
            found += more
        require(value is None or weights, "payload.links", "expected a link")
        return found, weights


class Problem:
    """Minimise a convex objective under convex constraints."""

    def __init__(self, value: Any) -> None:
        names, objective, constraints = fields(value, "payload.problem", "variables minimise constraints")
        self.size = len(_variables(names, "payload.problem.variables"))
        self.objective = Form(objective, self.size, "payload.problem.minimise")
        self.forms: list[Form] = []
        self.relations: list[str] = []
        for k, constraint in enumerate(_members(constraints, "payload.problem.constraints")):
            where = f"payload.problem.constraints[{k}]"
            terms, relation = fields(constraint, where, "terms relation")
            form = Form(terms, self.size, f"{where}.terms")
            require(relation in ("<", "<=", "="), where, "unknown relation")
            require(relation != "=" or form.is_linear, where, "an equation that is not linear")
            self.forms.append(form)
            self.relations.append(relation)


_RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}


def _check_optimum(payload: Any) -> None:
    dual = ("multipliers", "derived", "values")
    own = {"optimal": (*dual, "value", "attained", "unique"), "infeasible": dual, "unbounded": ("direction",)}
    require(isinstance(payload, dict), "payload", "expected an object")
    status = payload.get("status")
    require(isinstance(status, str) and status in own, "payload.status", "unknown status")
    names = ("problem", "status", "field", "faces", "point", *own[status])
    got = dict(zip(names, fields(payload, "payload", " ".join(names), "inner links"), strict=False))
    problem = Problem(got["problem"])
    field = Field(got["field"], "payload.field")
    known = _faces(got["faces"], problem)
    place = Place(problem, field, field.row(got["point"], problem.size, "payload.point"))
    if status == "unbounded":
        place.check_feasible("payload.point", strictly=True)
        _check_direction(got["direction"], problem)
        require(payload.get("inner") is None and payload.get("links") is None, "payload", "not expected here")
        return
    stated = field.row(got["values"], len(problem.forms), "payload.values")
    for k, (value, claim) in enumerate(zip(place.values, stated, strict=True)):
        require(not field.sign(_add(value, _scaled(claim, -1))), f"payload.values[{k}]", "not the value there")
    weights = field.row(got["multipliers"], len(problem.forms), "payload.multipliers")
    if status == "infeasible":
        require(payload.get("inner") is None, "payload.inner", "not expected here")
        known = place.links(payload.get("links"), known)[0]
        extra = field.row(got["derived"], len(known), "payload.derived")
        place.check_weights(weights, "payload.multipliers", complementary=False)
        place.check_stationary(weights, known, extra, "payload.multipliers", objective=False)
        least = place.total(weights, known, extra)
        require(least > 0 or (not least and place.strict(weights)), "payload.multipliers", "no contradiction")
        return
    _check_optimal(payload, place, weights, known)


def _faces(value: Any, problem: Problem) -> list[Equation]:
    field, known = Field(_RATIONAL, "payload.faces"), list[Equation]()
    count = len(problem.forms)
    for k, face in enumerate(_members(value, "payload.faces")):
        where = f"payload.faces[{k}]"
        first, second, third = fields(face, where, "weights derived point")
        rows = [[_trimmed([number(v, where)]) for v in _members(part, where)] for part in (first, second, third)]
        weights, extra, point = rows
        sizes = (len(weights), len(extra), len(point))
        require(sizes == (count, len(known), problem.size), where, "a wrong number of numbers")
        place = Place(problem, field, point)
        place.check_weights(weights, f"{where}.weights", complementary=False)
        place.check_stationary(weights, known, extra, where, objective=False)
        require(place.total(weights, known, extra) >= 0, f"{where}.point", "the weighted sum is negative")
        more = place.active(weights, values=True)
        require(more, where, "a face without weights")
        known += more
    return known


def _check_optimal(payload: Any, place: Place, weights: list[Line], known: list[Equation]) -> None:
    field, problem = place.field, place.problem
    extra = field.row(payload["derived"], len(known), "payload.derived")
    place.check_weights(weights, "payload.multipliers", complementary=True)
    place.check_stationary(weights, known, extra, "payload.multipliers", objective=True)
    attained = place.check_feasible("payload.values", strictly=False)
    claim = field.read(payload["value"], "payload.value")
    require(not field.sign(_add(place.value(problem.objective), _scaled(claim, -1))), "payload.value", "not the value")
    require(payload["attained"] is attained, "payload.attained", f"found {attained}")
    inner, links = payload.get("inner"), payload.get("links")
    if attained:
        require(inner is None and links is None, "payload", "a point inside, or links, are not expected")
    else:
        require(inner is not None, "payload.inner", "missing")
        base, point = fields(inner, "payload.inner", "field point")
        other = Field(base, "payload.inner.field")
        inside = Place(problem, other, other.row(point, problem.size, "payload.inner.point"))
        inside.check_feasible("payload.inner.point", strictly=True)
        if place.strict(weights):
            require(links is None, "payload.links", "not expected here")
        else:
            require(links is not None, "payload.attained", "not proved")
            own = place.tangents(problem.objective, [])
            _, last = place.links(links, [*known, *own, *place.active(weights, values=False)])
            require(place.strict(last), "payload.links", "no strict constraint at the end")
    _check_unique(payload["unique"], place, weights, known)


def _check_unique(claim: Any, place: Place, weights: Sequence[Line], known: Sequence[Equation]) -> None:
    require(isinstance(claim, bool), "payload.unique", "expected a truth value")
    if not claim:
        return
    rows = [list(r) for r in place.problem.objective.hessian]
    for row, _ in known:
        require(all(len(a) <= 1 for a in row), "payload.unique", "irrational equations")
        rows.append([a[0] if a else Fraction(0) for a in row])
    for w, form, relation in zip(weights, place.problem.forms, place.problem.relations, strict=True):
        if relation == "=":
            rows.append(list(form.gradient))
        elif place.field.sign(w):
            rows += [list(r) for r in form.hessian]
            if place.field.degree == 1:
                rows.append([_at(s, -place.field.root.p[0] / place.field.root.p[1]) for s in place.slope(form)])
    require(_rank(rows) == place.problem.size, "payload.unique", "does not follow")


def _rank(rows: list[list[Fraction]]) -> int:
    found = 0
    while rows:
        row = rows.pop()
        lead = next((k for k, a in enumerate(row) if a), None)
        if lead is None:
            continue
        found += 1
        for other in rows:
            factor = other[lead] / row[lead]
            if factor:
                other[:] = [a - factor * b for a, b in zip(other, row, strict=True)]
    return found


def _check_direction(value: Any, problem: Problem) -> None:
    d = [number(v, "payload.direction") for v in _members(value, "payload.direction")]
    require(len(d) == problem.size, "payload.direction", "a wrong number of numbers")

    def along(row: Sequence[Fraction]) -> Fraction:
        return sum((a * b for a, b in zip(row, d, strict=True)), Fraction(0))

    f = problem.objective
    require(
        along(f.gradient) < 0 and not any(map(along, f.hessian)), "payload.direction", "the objective does not fall"
    )
    for form, relation in zip(problem.forms, problem.relations, strict=True):
        rise = along(form.gradient)
        stays = not any(map(along, form.hessian)) and rise <= 0 and not (relation == "=" and rise)
        require(stays, "payload.direction", "it leaves a constraint")


# --- cell tables in up to two variables ------------------------------------------------------------------------


class Base:
    """The base of a stack: nothing, a number in the first variable, or a root of a polynomial in it."""

    def __init__(self, x: Fraction | None = None, root: Root | None = None) -> None:
        self.x, self.root = x, root

    def coefficients(self, p: Poly, level: int) -> list[Line]:
        """The polynomial in the main variable of the level, with numbers for coefficients."""
        if level == 0:
            return [_trimmed([c]) for c in line(p, 0)]
        found = [line(part, 0) for part in parts_in(p, 1)]
        return [self.reduced(c) if self.x is None else _trimmed([_at(c, self.x)]) for c in found]

    def sign(self, c: Line) -> int:
        return self.root.sign(c) if self.root else _sign(c[0]) if c else 0

    def reduced(self, c: Line) -> Line:
        return self.root.reduced(c) if self.root else c


class Fibre:
    """A polynomial on the line over a base: its roots counted by signed remainders (Sturm)."""

    def __init__(self, base: Base, coefficients: Sequence[Line]) -> None:
        self.base, self.c = base, list(coefficients)
        while self.c and not base.sign(self.c[-1]):
            self.c.pop()
        self._sequence: list[Fibre] | None = None

    @property
    def degree(self) -> int:
        return len(self.c) - 1

    def sign(self, y: Fraction) -> int:
        total: Line = []
        for c in reversed(self.c):
            total = _add(_scaled(total, y), c)
        return self.base.sign(total)

    def remainder(self, other: Fibre) -> Fibre:
        """A positive multiple of the remainder."""
        rest, lead = list(self.c), other.c[-1]
        flip = self.base.sign(lead)
        while len(rest) >= len(other.c):
            top, shift = rest.pop(), len(rest) - len(other.c) + 1
            rest = [_scaled(self.base.reduced(_product(lead, c)), flip) for c in rest]
            for k, c in enumerate(other.c[:-1]):
                rest[shift + k] = _add(rest[shift + k], _scaled(self.base.reduced(_product(top, c)), -flip))
            rest = Fibre(self.base, rest).c
        numbers = [c for row in rest for c in row]  # kept small by a positive factor
        factor = Fraction(lcm(*(c.denominator for c in numbers)), gcd(*(c.numerator for c in numbers)) or 1)
        return Fibre(self.base, [_scaled(row, factor) for row in rest])

    def slope(self) -> Fibre:
        return Fibre(self.base, [_scaled(c, k) for k, c in enumerate(self.c)][1:])

    def sequence(self) -> list[Fibre]:
        if self._sequence is None:
            found = [self, self.slope()]
            while found[-1].c:
                rest = found[-2].remainder(found[-1])
                found.append(Fibre(self.base, [_scaled(c, -1) for c in rest.c]))
            self._sequence = found[:-1]
        return self._sequence

    def roots(self, low: Fraction | None, high: Fraction | None) -> int:
        """Distinct real roots in (low, high]; None: unbounded."""
        if self.degree < 1:
            return 0

        def end(y: Fraction | None, side: int) -> int:
            if y is not None:
                return _changes([f.sign(y) for f in self.sequence()])
            return _changes([f.base.sign(f.c[-1]) * (side if f.degree % 2 else 1) for f in self.sequence()])

        return end(low, -1) - end(high, 1)

    def common(self, other: Fibre) -> Fibre:
        f, g = self, other
        while g.c:
            f, g = g, f.remainder(g)
        return f


_STACK = "used sectors sections cells"


class Stack:
    """The cells over a base point: samples of the sectors, the factors of each section, and all roots accounted for."""

    def __init__(self, table: Table, value: Any, base: Base, level: int, where: str) -> None:
        used, sectors, sections, _ = fields(value, where, _STACK)
        count = len(table.factors[level])
        numbers = [_integer(i, f"{where}.used") for i in _members(used, f"{where}.used")]
        require(sorted(set(numbers) & set(range(count))) == numbers, f"{where}.used", "expected numbers of factors")
        require(level == table.size - 1 or len(numbers) == count, f"{where}.used", "a factor is left out")
        self.samples = [number(s, f"{where}.sectors") for s in _members(sectors, f"{where}.sectors")]
        require(all(a < b for a, b in pairwise(self.samples)), f"{where}.sectors", "expected ascending numbers")
        self.fibres = {i: Fibre(base, base.coefficients(table.factors[level][i], level)) for i in numbers}
        self.shown = self._shown(table, table.constraints[level], where)
        self.restricted = len(self.shown) < len([f for f in self.fibres.values() if f.c])
        self.sections = self._sections(_members(sections, f"{where}.sections"), where)
        for i in self.shown:
            f = self.fibres[i]
            outside = f.roots(None, self.samples[0]) + f.roots(self.samples[-1], None)
            require(not outside, f"{where}.sections", f"a root of factor {i} is missing")

    def _shown(self, table: Table, constraint: list[int], where: str) -> list[int]:
        """The factors whose roots are listed."""
        empty = [i for i, f in self.fibres.items() if not f.c]
        if empty and table.lazard:
            raise Undecided(f"{where}: a factor is zero on a whole line")
        if constraint and set(constraint) <= set(self.fibres) and not set(constraint) & set(empty):
            return sorted(set(constraint))
        require(not constraint or empty, f"{where}.used", "a factor of the constraint is missing")
        return [i for i in self.fibres if i not in empty]

    def _sections(self, value: list[Any], where: str) -> list[list[int]]:
        require(len(self.samples) == len(value) + 1, where, "a wrong number of sections")
        found, met = [], dict.fromkeys(self.shown, 0)
        for k, pairs in enumerate(value):
            place, low, high = f"{where}.sections[{k}]", self.samples[k], self.samples[k + 1]
            section = [_integer(_pair(pair, place)[0], place) for pair in _members(pairs, place)]
            require(section and sorted(set(section) & set(self.shown)) == section, place, "expected listed factors")
            for i in self.shown:
                f = self.fibres[i]
                require(f.sign(low) and f.sign(high), f"{where}.sectors", "a sample is a root")
                require(f.roots(low, high) == (i in section), place, f"a wrong number of roots of factor {i}")
                if i in section and i != section[0]:
                    shared = self.fibres[section[0]].common(f)
                    require(shared.degree > 0 and shared.roots(low, high) == 1, place, "no common root")
            for i, (_, n) in zip(section, pairs, strict=True):
                met[i] += 1
                require(_integer(n, place) == met[i], place, f"this is root number {met[i]} of factor {i}")
            found.append(section)
        return found

    def signs(self, position: int, count: int) -> list[int | None]:
        """The signs of the factors in a cell; None where they are open."""
        row, k = list[int | None]([None] * count), position // 2
        for i, f in self.fibres.items():
            if not f.c or (i in self.shown and position % 2 and i in self.sections[k]):
                row[i] = 0
            elif i in self.shown:
                row[i] = f.sign(self.samples[k])
            elif position % 2:
                row[i] = _sign_on(f, self.fibres[self.sections[k][0]], self.samples[k], self.samples[k + 1])
        return row

    def above(self, position: int, factors: list[Poly], where: str) -> Base:
        """The base of the stack over a cell of the first level."""
        k = position // 2
        if position % 2 == 0:
            return Base(self.samples[k])
        return Base(None, Root(line(factors[self.sections[k][0]], 0), self.samples[k], self.samples[k + 1], where))


class Table:
    """A cell table and what is checked of it."""

    def __init__(self, payload: Any) -> None:
        order, quantifiers, matrix, answer, projection, factors, constraints, self.root = fields(
            payload,
            "payload",
            "order quantifiers matrix answer projection factors constraints root",
        )
        names = _variables(order, "payload.order")
        self.quantifiers = _members(quantifiers, "payload.quantifiers")
        require(len(self.quantifiers) == len(names), "payload.quantifiers", "expected one for each variable")
        require(all(q in ("", "E", "A") for q in self.quantifiers), "payload.quantifiers", "expected E, A or nothing")
        self.free = sum(not q for q in self.quantifiers)
        require(not any(self.quantifiers[: self.free]), "payload.quantifiers", "a free variable after a bound one")
        if not 1 <= len(names) <= 2:
            raise Undecided("a cell table in more than two variables")
        self.size = len(names)
        self.matrix = formula(matrix, names, "payload.matrix")
        self.answer = None if answer is None else formula(answer, names, "payload.answer")
        require(projection in ("brown-mccallum", "lazard"), "payload.projection", "unknown")
        self.lazard = projection == "lazard"
        lists = [_members(level, "payload.factors") for level in _members(factors, "payload.factors")]
        self.factors = [[polynomial(f, names, "payload.factors") for f in level] for level in lists]
        require(len(self.factors) == self.size, "payload.factors", "expected one list for each variable")
        listed = _members(constraints, "payload.constraints")
        require(not listed or len(listed) == self.size, "payload.constraints", "expected one list for each variable")
        rows = [[_integer(i, "payload.constraints") for i in _members(r, "payload.constraints")] for r in listed]
        self.constraints = rows or [[] for _ in names]
        self.products: dict[Any, tuple[int, list[tuple[int, int, int]]] | None] = {}
        self._check_lists()

    def _check_lists(self) -> None:
        for level, listed in enumerate(self.factors):
            where = f"payload.factors[{level}]"
            require(all(i < len(listed) for i in self.constraints[level]), "payload.constraints", "no such factor")
            for p in listed:
                main = max((i for e in p for i, k in enumerate(e) if k), default=-1)
                require(main == level, where, "a factor of another level")
        if self.size == 2:
            self._check_projection()

    def _check_projection(self) -> None:
        """Degrees, numbers of roots and common roots of the second level change only at roots of the first."""
        upper = [[line(c, 0) for c in parts_in(p, 1)] for p in self.factors[1]]
        listed = [line(p, 0) for p in self.factors[0]]
        chosen = self.constraints[1] or range(len(upper))
        for i in chosen:
            _check_listed(upper[i][-1], listed, f"the leading coefficient of factor {i}")
            slopes = [_scaled(c, k) for k, c in enumerate(upper[i])][1:]
            if len(slopes) > 1:
                _check_listed(resultant(upper[i], slopes), listed, f"the discriminant of factor {i}")
        for i, j in combinations(range(len(upper)), 2):
            if i in chosen or j in chosen:
                _check_listed(resultant(upper[i], upper[j]), listed, f"the resultant of factors {i} and {j}")

    # --- signs of polynomials --------------------------------------------------------------
    def sign_of(self, terms: Any, signs: list[list[int | None]]) -> int | None:
        """The sign of a polynomial as a product of listed factors whose signs are known."""
        if terms not in self.products:
            self.products[terms] = self._factored(dict(terms))
        found = self.products[terms]
        if found is None:
            return None
        total: int | None = found[0]
        for level, i, exponent in found[1]:
            known = signs[level][i] if level < len(signs) else None
            if known == 0:
                return 0
            total = None if known is None or total is None else total * known**exponent
        return total

    def _factored(self, p: Poly) -> tuple[int, list[tuple[int, int, int]]] | None:
        """The sign of the constant, and (level, factor, exponent), if the polynomial is such a product."""
        found = []
        for level in reversed(range(self.size)):
            for i, f in enumerate(self.factors[level]):
                exponent = 0
                while (quotient := _quotient(p, f)) is not None:
                    p, exponent = quotient, exponent + 1
                if exponent:
                    found.append((level, i, exponent))
        constant = (0,) * self.size
        return (_sign(p[constant]), found) if set(p) == {constant} else None

    # --- cells -----------------------------------------------------------------------------
    def check(self) -> None:
        require(isinstance(self.root, dict) and self.root.get("signs") == "", "payload.root.signs", "expected none")
        self.cell(self.root, Base(), [], "payload.root")

    def cell(self, value: Any, base: Base | None, signs: list[list[int | None]], where: str) -> bool | None:
        """Check a cell and what is above it; its truth value."""
        _, claim, stack = fields(value, where, "signs truth", "stack")
        require(claim is None or isinstance(claim, bool), f"{where}.truth", "expected a truth value")
        depth = len(signs)
        if stack is None:
            if claim is not None:
                found = truth(self.matrix, lambda p: self.sign_of(p, signs))
                if found is None:
                    raise Undecided(f"{where}: the truth value needs more than signs of factors")
                require(found is claim, f"{where}.truth", "not what the signs give")
        else:
            require(depth < self.size and base is not None, f"{where}.stack", "no stack is expected here")
            assert base is not None
            found = self.stack(stack, base, signs, f"{where}.stack")
            require(claim is found, f"{where}.truth", f"found {found}")
        if depth <= self.free and not (depth < self.free and stack is not None):
            require(claim is not None, f"{where}.truth", "no truth value for a cell over the free variables")
            if self.answer is not None:
                said = truth(self.answer, lambda p: self.sign_of(p, signs))
                if said is None:
                    raise Undecided(f"{where}: the answer needs more than signs of factors")
                require(said is claim, "payload.answer", f"differs from the truth value of {where}")
        return bool(claim) if claim is not None else None

    def stack(self, value: Any, base: Base, below: list[list[int | None]], where: str) -> bool | None:
        level, inner = len(below), _members(fields(value, where, _STACK)[3], f"{where}.cells")
        stack, truths = Stack(self, value, base, level, where), list[bool | None]()
        require(len(inner) == 2 * len(stack.sections) + 1, where, "a wrong number of cells")
        for position, child in enumerate(inner):
            place, row = f"{where}.cells[{position}]", stack.signs(position, len(self.factors[level]))
            text = "".join("?" if row[i] is None else "-0+"[row[i] + 1] for i in stack.fibres)  # type: ignore[operator]
            require(isinstance(child, dict) and child.get("signs") == text, f"{place}.signs", f"found {text}")
            if stack.restricted and position % 2 == 0:
                require(child.get("stack") is None, f"{place}.stack", "only sections may be decomposed here")
            above = stack.above(position, self.factors[0], place) if level + 1 < self.size else None
            truths.append(self.cell(child, above, [*below, row], place))
        kind = self.quantifiers[level]
        if kind and self._open(level):
            truths = [t for k, t in enumerate(truths) if k % 2 == 0 or t is not None]
        return _decided(truths, kind == "E") if kind else None

    def _open(self, level: int) -> bool:
        """Whether the sectors alone decide a quantifier: an open set that is not empty meets one."""
        later = set(self.quantifiers[level:])
        relations = {"E": ("<", ">", "/="), "A": ("<=", ">=", "=")}.get("".join(sorted(later)), ())

        def only(f: Formula) -> bool:
            return isinstance(f, bool) or (
                f[2] in relations if f[0] == "atom" else f[0] != "not" and all(map(only, f[1:]))
            )

        return bool(relations) and only(self.matrix)


def _sign_on(f: Fibre, other: Fibre, low: Fraction, high: Fraction) -> int:
    """The sign of f at the only root of the other in (low, high)."""
    shared = f.common(other)
    if shared.degree > 0 and shared.roots(low, high):
        return 0
    for _ in range(10_000):
        if f.sign(low) and not f.roots(low, high):
            return f.sign(low)
        middle = (low + high) / 2
        low, high = (low, middle) if other.roots(low, middle) else (middle, high)
    raise Undecided("a sign that is very close to zero")


def _check_listed(p: Line, listed: Sequence[Line], what: str) -> None:
    """All real roots of a polynomial are roots of the listed ones."""
    p = _trimmed(p)
    require(p, "payload.factors", f"{what} is zero")
    for f in listed:
        while len(shared := common(p, f)) > 1:
            p = divided(p, shared)[0]
    require(len(p) == 1 or not roots_between(p, None, None), "payload.factors", f"{what}: factors are missing")


def _quotient(p: Poly, q: Poly) -> Poly | None:
    """p/q over the rationals up to a positive constant, or None if q does not divide p."""
    if not p:
        return None
    lead, result, rest = max(q), dict[tuple[int, ...], Fraction](), {e: Fraction(c) for e, c in p.items()}
    while rest:
        top = max(rest)
        shift = tuple(a - b for a, b in zip(top, lead, strict=True))
        if min(shift) < 0:
            return None
        factor = rest[top] / q[lead]
        result[shift] = factor
        for e, c in q.items():
            key = tuple(a + b for a, b in zip(e, shift, strict=True))
            left = rest.get(key, Fraction(0)) - factor * c
            if left:
                rest[key] = left
            else:
                rest.pop(key, None)
    bottom = lcm(*(c.denominator for c in result.values()))
    return {e: int(c * bottom) for e, c in result.items()}


def resultant(f: Sequence[Line], g: Sequence[Line]) -> Line:
    """The determinant of Sylvester's matrix, of polynomials in one variable (Bareiss: all divisions are exact)."""
    m, n = len(f) - 1, len(g) - 1
    if m + n > SIZE:
        raise Undecided("a resultant of high degree")
    rows: list[list[Line]] = [[[]] * k + [_trimmed(c) for c in reversed(f)] + [[]] * (n - 1 - k) for k in range(n)]
    rows += [[[]] * k + [_trimmed(c) for c in reversed(g)] + [[]] * (m - 1 - k) for k in range(m)]
    before: Line = [Fraction(1)]
    for k in range(len(rows) - 1):
        pivot = next((r for r in range(k, len(rows)) if rows[r][k]), None)
        if pivot is None:
            return []
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for r in range(k + 1, len(rows)):
            for c in range(k + 1, len(rows)):
                cross = _add(_product(rows[r][c], rows[k][k]), _scaled(_product(rows[r][k], rows[k][c]), -1))
                rows[r][c] = divided(cross, before)[0]
        before = rows[k][k]
    return rows[-1][-1] if rows else [Fraction(1)]


# --- derivations: boolean steps and cases ----------------------------------------------------------------------


Signs = frozenset[int]
ALL: Signs = frozenset((-1, 0, 1))


class Theory:
    """Lemmas about the signs of polynomials, each proved, and a search for signs that respect them."""

    def __init__(self, value: Any, names: Sequence[str], where: str) -> None:
        texts, lemmas = fields(value, where, f"polynomials lemmas{' cases' * ('cases' in value)}")[:2]
        self.polys = [primitive(t, names, where) for t in _members(texts, where)]
        normal: list[Any] = [comparison(p, ">") for p in self.polys]
        self.keys = [("p", f[1]) for f in normal]
        require(len(set(self.keys)) == len(self.keys), where, "a polynomial is listed twice")
        self.flips = [1 if f[2] == ">" else -1 for f in normal]
        self.names = names
        self.identities: list[list[tuple[int, list[tuple[int, int]]]]] = []
        self.lines: list[tuple[list[int], list[tuple[int, ...]]]] = []
        for k, lemma in enumerate(_members(lemmas, where)):
            self._read(lemma, f"{where}.lemmas[{k}]")

    def _read(self, lemma: Any, where: str) -> None:
        if isinstance(lemma, dict) and set(lemma) == {"identity"}:
            self._read_identity(_members(lemma["identity"], where), where)
            return
        listed, samples = fields(lemma, where, "line samples")
        chosen = [_integer(i, where) for i in _members(listed, where)]
        points = [number(s, where) for s in _members(samples, where)]
        require(chosen and sorted(set(chosen) & set(range(len(self.polys)))) == sorted(chosen), where, "no such number")
        require(points and all(a < b for a, b in pairwise(points)), where, "expected ascending samples")
        found = {i for k in chosen for e in self.polys[k] for i, n in enumerate(e) if n}
        require(len(found) == 1, where, "expected one variable")
        x = found.pop()
        columns = []
        for k in chosen:
            p = line(self.polys[k], x, where)
            column = [self.flips[k] * _sign(_at(p, s)) for s in points]
            require(all(column), where, "a sample is a root")
            require(_changes(column) == roots_between(p, None, None), where, "not every root changes the sign")
            columns.append(column)
        rows = list(zip(*columns, strict=True))
        cells: list[tuple[int, ...]] = [rows[0]]
        for a, b in pairwise(rows):
            changed = [u != v for u, v in zip(a, b, strict=True)]
            require(sum(changed) <= 1, where, "two polynomials change together")
            cells += [tuple(0 if c else u for c, u in zip(changed, a, strict=True)), b]
        self.lines.append((chosen, cells))

    def _read_identity(self, terms: list[Any], where: str) -> None:
        total: Poly = {}
        found = []
        for term in terms:
            coefficient, powers = _pair(term, where)
            c = number(coefficient, where)
            require(c and c.denominator == 1, where, "expected an integer")
            pairs = [(_integer(p[0], where), _integer(p[1], where)) for p in _members(powers, where) if _pair(p, where)]
            require(len({i for i, _ in pairs}) == len(pairs), where, "a polynomial stands twice")
            require(all(i < len(self.polys) and e for i, e in pairs), where, "no such polynomial")
            whole: Poly = {(0,) * len(self.names): int(c)}
            for i, e in pairs:
                whole = _times(whole, _power(self.polys[i], e, len(self.names)))
            total = _plus(total, whole)
            found.append((_sign(c) * prod(self.flips[i] ** e for i, e in pairs), pairs))
        require(found and not total, where, "the terms do not add up to 0")
        self.identities.append(found)

    def refutes(self, formulas: Sequence[Formula]) -> bool:
        """Whether no signs that respect the lemmas make all formulas (in negation normal form) true."""
        self.cases = 0
        return self._refuted(dict.fromkeys(self.keys, ALL), list(formulas))

    def _refuted(self, signs: dict[Any, Signs], pending: list[Formula]) -> bool:
        self.cases += 1
        if self.cases > CASES:
            raise Undecided("too many cases of signs")
        left: list[Formula] = []
        while pending:
            f = pending.pop()
            if isinstance(f, bool):
                if not f:
                    return True
            elif f[0] == "and":
                pending += f[1:]
            elif f[0] == "or":
                left.append(f)
            else:
                key, allowed = _condition(f)
                signs[key] = signs.get(key, ALL) & allowed
                if not signs[key]:
                    return True
        if not self._cut(signs):
            return True
        for f in left:
            open_parts = [g for g in f[1:] if not _impossible(g, signs)]
            if len(open_parts) < 2:
                rest = [g for g in left if g is not f]
                return self._refuted(signs, [*rest, *(open_parts or [False])])
        if left:
            chosen = min(left, key=len)
            rest = [g for g in left if g is not chosen]
            return all(self._refuted(dict(signs), [*rest, g]) for g in chosen[1:])
        used = {i for terms in self.identities for _, pairs in terms for i, _ in pairs}
        used |= {i for chosen, _ in self.lines for i in chosen}
        for i in sorted(used):
            options = signs[self.keys[i]]
            if len(options) > 1:
                return all(self._refuted({**signs, self.keys[i]: frozenset((s,))}, []) for s in sorted(options))
        return False

    def _cut(self, signs: dict[Any, Signs]) -> bool:
        """Signs that a lemma excludes go; whether some are left for every polynomial."""
        changed = True
        while changed:
            changed = False
            for terms in self.identities:
                for i in {i for _, pairs in terms for i, _ in pairs}:
                    key = self.keys[i]
                    kept = frozenset(s for s in signs[key] if self._possible(terms, {**signs, key: frozenset((s,))}))
                    changed |= kept != signs[key]
                    signs[key] = kept
                    if not kept:
                        return False
            for chosen, cells in self.lines:
                left = [c for c in cells if all(s in signs[self.keys[i]] for i, s in zip(chosen, c, strict=True))]
                for k, i in enumerate(chosen):
                    kept = signs[self.keys[i]] & {c[k] for c in left}
                    changed |= kept != signs[self.keys[i]]
                    signs[self.keys[i]] = kept
                    if not kept:
                        return False
        return True

    def _possible(self, terms: list[tuple[int, list[tuple[int, int]]]], signs: dict[Any, Signs]) -> bool:
        """Whether the sum can be 0 as far as the signs of its terms say."""
        found = []
        for unit, pairs in terms:
            options: set[int] = {unit}
            for i, exponent in pairs:
                options = {a * s**exponent for a in options for s in signs[self.keys[i]]}
            found.append(options)
        if all(0 in options for options in found):
            return True
        return any(1 in a and -1 in b for k, a in enumerate(found) for j, b in enumerate(found) if j != k)


def _condition(f: Formula) -> tuple[Any, Signs]:
    if f[0] == "atom":
        return ("p", f[1]), frozenset(_RELATIONS[f[2]])
    if f[0] == "forall":  # the negation of an existential block
        return ("f", pushed(f, True)), frozenset((-1,))
    return ("f", f), frozenset((1,))


def _impossible(f: Formula, signs: dict[Any, Signs]) -> bool:
    if isinstance(f, bool):
        return not f
    if f[0] == "and":
        return any(_impossible(g, signs) for g in f[1:])
    if f[0] == "or":
        return all(_impossible(g, signs) for g in f[1:])
    return not signs.get(_condition(f)[0], ALL) & _condition(f)[1]


_BLOCK = {"signs", "simplification", "standard simplification", "boundary apart", "Groebner basis of the equations"}
_BLOCK |= {"case split on factors", "vanishing sum of squares split", "multiple of an equation subtracted"}
_BLOCK |= {"signs by sums of squares"}


def _check_derivation(payload: Any) -> None:
    order, start, steps, answer = fields(payload, "payload", "order start steps answer")
    names = _variables(order, "payload.order")
    current = formula(start, names, "payload.start")
    for k, step in enumerate(_members(steps, "payload.steps")):
        current = _step(step, current, names, f"payload.steps[{k}]")
    require(current == formula(answer, names, "payload.answer"), "payload.answer", "not where the steps lead")


def _step(value: Any, current: Formula, names: Sequence[str], where: str) -> Formula:
    rule, place, old, new, context, evidence = fields(value, where, "rule at before after context evidence")
    before, after = (formula(f, names, where) for f in (old, new))
    path = [_integer(i, f"{where}.at") for i in _members(place, f"{where}.at")]
    facts, changed = _replaced(current, path, before, after, [], names, where)
    used = [formula(f, names, where) for f in _members(context, where)]
    require(all(f in facts for f in used), f"{where}.context", "this does not stand beside the step")
    if rule in ("duality", "negation normal form"):
        require(evidence == {} and pushed(before) == pushed(after), where, "different negation normal forms")
    elif rule in [*_BLOCK]:
        _check_block(before, after, used, Theory(fields(evidence, where, "theory")[0], names, where), names, where)
    else:
        raise Undecided(f"{where}: the rule {rule!r} is not read here")
    return changed


def _replaced(
    f: Formula, path: list[int], before: Formula, after: Formula, facts: list[Formula], names: Sequence[str], where: str
) -> tuple[list[Formula], Formula]:
    if not path and f == before:
        return facts, after
    require(isinstance(f, tuple) and f[0] != "atom", where, "what is replaced does not stand there")
    kind = f[0]
    if kind in ("and", "or"):

        def beside(others: Sequence[Formula]) -> list[Formula]:
            return [part for g in others for part in _joints(g if kind == "and" else pushed(g, True))]

        if not path:
            whole = isinstance(before, tuple) and before[0] == kind and set(before[1:]) < set(f[1:])
            require(whole, where, "what is replaced does not stand there")
            rest = [g for g in f[1:] if g not in before[1:]]
            return [*facts, *beside(rest)], joined(kind, [*rest, after])
        k = path[0] + 1
        require(k < len(f), where, "no such place")
        inner = [*facts, *beside([*f[1:k], *f[k + 1 :]])]
        found, changed = _replaced(f[k], path[1:], before, after, inner, names, where)
        return found, joined(kind, [*f[1:k], changed, *f[k + 1 :]])
    require(path and path[0] == 0, where, "no such place")
    if kind == "not":
        found, changed = _replaced(f[1], path[1:], before, after, facts, names, where)
        return found, not changed if isinstance(changed, bool) else ("not", changed)
    bound = {names.index(n) for n in f[1]}
    kept = [g for g in facts if not occurring(g) & bound]
    found, changed = _replaced(f[2], path[1:], before, after, kept, names, where)
    return found, quantified(kind, f[1], changed)


def _check_block(
    before: Formula, after: Formula, facts: list[Formula], theory: Theory, names: Sequence[str], where: str
) -> None:
    """The same truth under the quantifiers of a block, which may be split over a disjunction and lose variables."""
    negative = isinstance(before, tuple) and before[0] == "forall"
    left, right = pushed(before, negative), pushed(after, negative)
    if isinstance(left, tuple) and left[0] == "exists":
        bound = {names.index(n) for n in left[1]}
        facts = [f for f in facts if not occurring(f) & bound]
        right = joined("or", [_opened(piece, left[1], names, where) for piece in _joints(right, "or")])
        left = left[2]
    if left != right:
        for a, b in ((left, right), (right, left)):
            require(theory.refutes([*map(pushed, facts), a, pushed(b, True)]), where, "the lemmas do not prove it")


def _opened(piece: Formula, bound: Sequence[str], names: Sequence[str], where: str) -> Formula:
    """A formula of which the piece says that it holds for some values of the bound variables."""
    own = piece[1] if isinstance(piece, tuple) and piece[0] == "exists" else None
    free = occurring(piece) - {names.index(n) for n in own or ()}
    require(not free & {names.index(n) for n in bound}, where, "a bound variable is free afterwards")
    return piece if own is None else quantified("exists", [n for n in own if n not in bound], piece[2])


# --- certificates ----------------------------------------------------------------------------------------------

_CHECKS: dict[str, Callable[[Any], None]] = {"witness": _check_witness, "substitution": _check_substitution}
_CHECKS |= {"optimum": _check_optimum, "cells": lambda p: Table(p).check(), "derivation": _check_derivation}


def check(text: str) -> None:
    """Return if it proves what it says; raise ``Rejected``, ``Undecided``, or ``ValueError`` for other text."""
    whole = json.loads(text, parse_float=str, parse_constant=str, object_pairs_hook=_once)
    if not isinstance(whole, dict) or whole.get("format") != FORMAT or repr(whole.get("version")) not in ("1", "2"):
        raise ValueError(f"not a certificate of the format {FORMAT!r}, version 1 or 2")
    stated = whole.pop("digest", None)
    try:
        _check({k: v for k, v in whole.items() if k not in ("format", "version")}, "")
    except RecursionError:
        raise Undecided("nested too deeply") from None
    canonical = json.dumps(whole, ensure_ascii=True, sort_keys=True, separators=(",", ":"))
    require(whole["version"] == 1 + ('"kind":"derivation"' in canonical), "version", "not the one of what it holds")
    require(stated == hashlib.sha256(canonical.encode()).hexdigest(), "digest", "not the digest of the content")


def _check(value: Any, where: str, labelled: bool = False) -> None:
    kind = value.get("kind") if isinstance(value, dict) else None
    if kind == "bundle":
        inner = fields(value, where or "certificate", "kind certificates" + " label" * labelled)[1]
        require(inner, f"{where}certificates", "an empty bundle proves nothing")
        for k, member in enumerate(_members(inner, "certificates")):
            _check(member, f"{where}certificates[{k}].", True)
        return
    require(isinstance(kind, str), f"{where}kind", "expected a kind")
    payload = fields(value, where or "certificate", "kind payload" + " label" * labelled)[1]
    if kind not in _CHECKS:
        raise Undecided(f"certificates of kind {kind!r} are not read here")
    try:
        _CHECKS[kind](payload)
    except Rejected as error:
        raise Rejected(where + error.args[0], error.args[1]) from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a name occurs twice in one object")
    return dict(pairs)


def main(arguments: Sequence[str]) -> int:
    """The command: prints the verdict, and returns the exit status."""
    try:
        [name] = arguments
        with open(name, encoding="utf-8") as file:
            check(file.read())
    except Rejected as error:
        print(f"rejected at {error.args[0]}: {error.args[1]}")
        return 4
    except Undecided as error:
        print(f"not decided: {error}")
        return 3
    except (OSError, ValueError, RecursionError) as error:
        print(f"not a certificate: {error}", file=sys.stderr)
        return 2
    print("accepted")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
