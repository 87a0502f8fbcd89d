"""The conditions of a system as polynomials: how the entries of a certificate are matched with those of the problem."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves.scalar import exactly, sign
from bezier.curves.workspace import Ball, HalfSpace
from bezier.methods.control.system import OnPoint, System
from qe.errors import InternalError
from qe.proof.certificate import Certificate

Terms = dict[tuple[int, ...], Fraction]
"""Coefficient by exponents of the free coordinates, in the order of ``Shape.variables``."""
Linear = tuple[Fraction, tuple[Fraction, ...]]
"""A constant and the coefficients of the free coordinates."""


def terms_of(listed: Sequence[Any]) -> Terms:
    """A polynomial from the list [coefficient, exponents] of its terms."""
    return {tuple(exponents): Fraction(coefficient) for coefficient, exponents in listed}


def objective_terms(system: System) -> Terms:
    """The objective: the sum of |b - a|^2 along the route."""
    squares = []
    for a, b in pairwise(system.shape.route):
        for i in range(3):
            squares.append(_squared(_minus(_coordinate(system, b, i), _coordinate(system, a, i))))
    return _total(squares)


def condition_terms(system: System, item: OnPoint) -> Terms:
    """The polynomial p with p <= 0 exactly on the condition."""
    condition = item.condition
    at = [_coordinate(system, item.point, i) for i in range(3)]
    if isinstance(condition, Ball):
        squares = [_squared((c - exactly(o), w)) for (c, w), o in zip(at, condition.centre, strict=True)]
        return _total([*squares, _affine((-condition.radius_squared, _zeros(system)))])
    if isinstance(condition, HalfSpace):
        parts = [_affine((-n * c, tuple(-n * k for k in w))) for n, (c, w) in zip(condition.normal, at, strict=True)]
        return _total([*parts, _affine((-condition.offset, _zeros(system)))])
    raise InternalError(f"no polynomial for the condition {condition.name}")


def coordinate_terms(system: System, point: str, i: int) -> Terms:
    """Coordinate i of a control point as a polynomial in the free coordinates."""
    return _total([_affine(_coordinate(system, point, i))])


def _coordinate(system: System, point: str, i: int) -> Linear:
    """Coordinate i of a control point as a linear function of the free coordinates."""
    constant, weights = Fraction(0), list(_zeros(system))
    for coefficient, name in system.shape.combination(point):
        if name in system.shape.free:
            weights[3 * system.shape.free.index(name) + i] += coefficient
        else:
            constant += coefficient * exactly(system.given[name][i])
    return constant, tuple(weights)


def _zeros(system: System) -> tuple[Fraction, ...]:
    return (Fraction(0),) * len(system.shape.variables)


def _minus(a: Linear, b: Linear) -> Linear:
    return a[0] - b[0], tuple(x - y for x, y in zip(a[1], b[1], strict=True))


def _affine(form: Linear) -> Terms:
    constant, weights = form
    size = len(weights)
    return {_power(size): constant} | {_power(size, k): w for k, w in enumerate(weights)}


def _squared(form: Linear) -> Terms:
    constant, weights = form
    size = len(weights)
    found: Terms = {_power(size): constant * constant}
    for k, w in enumerate(weights):
        if w:
            found |= {_power(size, k): 2 * constant * w, _power(size, k, k): w * w}
            found |= {_power(size, k, m): 2 * w * weights[m] for m in range(k + 1, size)}
    return found


def _power(size: int, *variables: int) -> tuple[int, ...]:
    """The exponents of a product of variables."""
    return tuple(variables.count(k) for k in range(size))


def _total(parts: Iterable[Mapping[tuple[int, ...], Fraction]]) -> Terms:
    """The sum, without zero coefficients."""
    found: Terms = {}
    for part in parts:
        for exponents, coefficient in part.items():
            found[exponents] = found.get(exponents, Fraction(0)) + coefficient
    return {e: c for e, c in found.items() if c}


def multiple_of(a: Terms, b: Terms) -> Fraction | None:
    """The positive rational c with a = c * b, or None."""
    if a.keys() != b.keys() or not a:
        return None
    key = next(iter(a))
    ratio = a[key] / b[key]
    return ratio if ratio > 0 and all(a[e] == ratio * b[e] for e in a) else None


def fixed_values(constraints: Sequence[Mapping[str, Any]]) -> dict[int, Fraction]:
    """The variables that an equation c x + d = 0 among the constraints fixes, with their values."""
    return fixed_by((terms_of(constraint["terms"]), constraint["relation"]) for constraint in constraints)


def fixed_by(constraints: Iterable[tuple[Terms, str]]) -> dict[int, Fraction]:
    """``fixed_values`` for polynomials with their relations to zero."""
    found = {}
    for terms, relation in constraints:
        if relation == "=" and all(sum(exponents) <= 1 for exponents in terms):
            used = [exponents for exponents in terms if any(exponents)]
            if len(used) == 1:
                constant = terms.get((0,) * len(used[0]), Fraction(0))
                found[used[0].index(1)] = -constant / terms[used[0]]
    return found


def reduced(terms: Terms, fixed: Mapping[int, Fraction]) -> Terms:
    """The polynomial with fixed variables replaced by their values."""
    parts = []
    for exponents, coefficient in terms.items():
        left = tuple(0 if i in fixed else k for i, k in enumerate(exponents))
        for i, value in fixed.items():
            coefficient = coefficient * value ** exponents[i]
        parts.append({left: coefficient})
    return _total(parts)


def proof_of(certificate: Certificate) -> Any:
    """What an optimum, or a bound near one, holds of multipliers."""
    payload: Any = certificate.payload
    return payload[0].certificate.payload if isinstance(payload, tuple) else payload


def named_multipliers(system: System, optimum: Any) -> list[tuple[str, Any]]:
    """(label, multiplier) for each condition with a non-zero multiplier.

    The multiplier belongs to the condition in the form |P1|^2 - r^2 <= 0 (or -z <= 0 for the table), whatever
    positive multiple of it the engine worked with.
    """
    known = [(item.label, condition_terms(system, item)) for item in system.conditions]
    stated = proof_of(optimum.certificate)["problem"]["constraints"][: len(optimum.multipliers)]
    fixed = fixed_values(stated)
    found = []
    for constraint, value in zip(stated, optimum.multipliers, strict=True):
        if sign(value):
            terms, at = terms_of(constraint["terms"]), {} if constraint["relation"] == "=" else fixed
            matches = ((label, multiple_of(reduced(terms, at), reduced(other, at))) for label, other in known)
            label, ratio = next(((name, c) for name, c in matches if c is not None), ("another condition", Fraction(1)))
            found.append((label, ratio * value))
    return found
