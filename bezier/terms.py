"""Conditions on Q1 as polynomials: how the entries of a certificate are matched with those of the problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from bezier import quadratic
from bezier.problem import Problem
from bezier.scalar import dot, sign
from bezier.workspace import Ball, Condition, HalfSpace
from qe.errors import InputError

Terms = dict[tuple[int, ...], Fraction]
"""Coefficient by exponents of q1x, q1y, q1z."""


def terms_of(listed: Sequence[Any]) -> Terms:
    """A polynomial from the list [coefficient, exponents] of its terms."""
    return {tuple(exponents): Fraction(coefficient) for coefficient, exponents in listed}


def _clean(terms: Mapping[tuple[int, ...], Any]) -> Terms:
    return {e: Fraction(c) for e, c in terms.items() if c}


def objective_terms(problem: Problem) -> Terms:
    """|Q1 - Q0|^2 + |R0 - Q1|^2."""
    q0, r0 = problem.via
    found: dict[tuple[int, ...], Any] = {(0, 0, 0): dot(q0, q0) + dot(r0, r0)}
    for i in range(3):
        found[_power(i, 1)] = -2 * (q0[i] + r0[i])
        found[_power(i, 2)] = 2
    return _clean(found)


def condition_terms(condition: Condition) -> Terms:
    """The polynomial p with p <= 0 exactly on the condition."""
    if isinstance(condition, Ball):
        constant = dot(condition.centre, condition.centre) - condition.radius_squared
        found: dict[tuple[int, ...], Any] = {(0, 0, 0): constant}
        for i, c in enumerate(condition.centre):
            found |= {_power(i, 1): -2 * c, _power(i, 2): 1}
        return _clean(found)
    if isinstance(condition, HalfSpace):
        return _clean({(0, 0, 0): -condition.offset, **{_power(i, 1): -n for i, n in enumerate(condition.normal)}})
    raise InputError(f"unknown condition {condition.name}")


def _power(i: int, exponent: int) -> tuple[int, ...]:
    return tuple(exponent if k == i else 0 for k in range(3))


def multiple_of(a: Terms, b: Terms) -> Fraction | None:
    """The positive rational c with a = c * b, or None."""
    if a.keys() != b.keys() or not a:
        return None
    key = next(iter(a))
    ratio = a[key] / b[key]
    return ratio if ratio > 0 and all(a[e] == ratio * b[e] for e in a) else None


def fixed_values(constraints: Sequence[Mapping[str, Any]]) -> dict[int, Fraction]:
    """The variables that an equation c x + d = 0 among the constraints fixes, with their values."""
    found = {}
    for constraint in constraints:
        terms = terms_of(constraint["terms"])
        linear = [i for i in range(3) if _power(i, 1) in terms]
        if constraint["relation"] == "=" and len(linear) == 1 and terms.keys() <= {(0, 0, 0), _power(linear[0], 1)}:
            found[linear[0]] = -terms.get((0, 0, 0), Fraction(0)) / terms[_power(linear[0], 1)]
    return found


def reduced(terms: Terms, fixed: Mapping[int, Fraction]) -> Terms:
    """The polynomial with fixed variables replaced by their values."""
    found: Terms = {}
    for exponents, coefficient in terms.items():
        left = tuple(0 if i in fixed else k for i, k in enumerate(exponents))
        for i, value in fixed.items():
            coefficient = coefficient * value ** exponents[i]
        found[left] = found.get(left, Fraction(0)) + coefficient
    return _clean(found)


def named_multipliers(problem: Problem, optimum: Any) -> list[tuple[str, Any]]:
    """(label, multiplier) for each condition with a non-zero multiplier.

    The multiplier belongs to the condition in the form |P1|^2 - r^2 <= 0 (or -z <= 0 for the table), whatever
    positive multiple of it the engine worked with.
    """
    known = [(item.label, condition_terms(item.condition)) for item in quadratic.as_conditions_on_q1(problem)]
    stated = optimum.certificate.payload["problem"]["constraints"]
    fixed = fixed_values(stated)
    found = []
    for constraint, value in zip(stated, optimum.multipliers, strict=True):
        if sign(value):
            terms, at = terms_of(constraint["terms"]), {} if constraint["relation"] == "=" else fixed
            matches = ((label, multiple_of(reduced(terms, at), reduced(other, at))) for label, other in known)
            label, ratio = next(((name, c) for name, c in matches if c is not None), ("another condition", Fraction(1)))
            found.append((label, ratio * value))
    return found
