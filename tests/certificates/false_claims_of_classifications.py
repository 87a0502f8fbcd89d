"""Certificates of classifications by numbers of real solutions, made at random, and what shows that one is false: a
point of parameter space where a class that holds has another number of solutions, or none holds."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import qe
from qe.exact.algebraic import real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.evaluate import holds_at
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, formula_from_json
from tests.certificates.mutation import evidence_in
from tests.certificates.restated import is_stated

Data = dict[str, Any]
GRID = tuple(Fraction(k, 2) for k in range(-6, 7))


def classification(rng: random.Random) -> Certificate | None:
    """A quadratic or cubic equation in x with one or two parameters, sometimes with a condition."""
    lead = rng.choice(("x^2", "x^3", "a*x^2"))
    middle = rng.choice(("a*x", "b*x", "2*x", "-x"))
    rest = rng.choice(("b", "1", "-a", "a - 1"))
    positive = [rng.choice(("x", "x - 1", "a + x"))] if lead == "x^2" and rng.random() < 0.3 else []
    try:
        found = qe.real_root_classification(
            [f"{lead} + {middle} + {rest}"], "x", positive=positive, process=False, check=True
        )
    except qe.Unable:
        return None
    return found.certificate


def other_numbers(rng: random.Random, data: Data) -> bool:
    """Whether at some point another class holds than that with the number of solutions there."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    if payload["constants"] or len(payload["variables"]) != 1 or len(payload["polynomials"]) != 1:
        return False
    names, (x,) = payload["parameters"], payload["variables"]
    ring, outer = Ring.of((*names, x)), Ring.of(names)
    poly = Entry(payload["polynomials"][0], "").polynomial(ring)
    sides = {key: [Entry(p, "").polynomial(ring) for p in payload[key]] for key in ("positive", "equal", "nonzero")}
    classes = [(count, formula_from_json(Entry(f, ""), outer)) for count, f in payload["classes"]]
    for _ in range(40):
        point = [rng.choice(GRID) for _ in names]
        here = dict(zip(names, point, strict=True))
        if any(_at(p, point) for p in sides["equal"]) or not all(_at(p, point) for p in sides["nonzero"]):
            continue
        holding = [count for count, f in classes if holds_at(f, here)]
        try:
            if holding != [_count(poly, sides["positive"], point)]:
                return True
        except ValueError:
            continue
    return False


def _at(poly: Poly, point: list[Fraction]) -> Poly:
    for k, value in enumerate(point):
        poly = poly.at_rational(k, value)
    return poly


def _count(poly: Poly, positive: list[Poly], point: list[Fraction]) -> int | None:
    """The number of roots at which the conditions hold; None where every number is one."""
    line = _at(poly, point)
    if not line:
        return None
    roots = [] if line.is_constant else real_roots(line.to_univariate(len(point)))
    return sum(all(_value(g, float(root), point) > 0 for g in positive) for root in roots)


def _value(poly: Poly, root: float, point: list[Fraction]) -> float:
    """The value at a root, about. ``ValueError`` where it may be 0."""
    coefficients = [int(c) for c in _at(poly, point).to_univariate(len(point)).coeffs()]
    value = sum(c * root**k for k, c in enumerate(coefficients))
    if abs(value) < 1e-6:
        raise ValueError("its sign is not clear")
    return value
