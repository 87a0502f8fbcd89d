"""Certificates made at random, altered until what they claim is false: for a search for one that is accepted.

Alterations are consistent where that makes the attack stronger: an answer, an atom or a polynomial is changed wherever
it stands, so that the steps, tables and multipliers around it fit each other as far as they can.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction
from typing import Any

from bezier.curves.containment import Inside, examine
from bezier.curves.containment import containment as contained
from bezier.curves.curve import Bezier
from bezier.curves.workspace import Ball, Condition, HalfSpace
from bezier.obstacles.survey import clearance_certificate
from qe.certify.claims import claim_of
from qe.convex.optimum import NotConvex, minimize
from qe.elimination.cad import certificate_for
from qe.engine.run import solve
from qe.errors import InputError, QEError, Unable
from qe.exact.ring import Poly, Ring
from qe.expert.convex_problem import RELATIONS
from qe.expert.sentences import read_terms
from qe.formula.build import atom, conj, exists, forall
from qe.formula.evaluate import substituted
from qe.formula.syntax import TRUE, Atom, Constant, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.certificate import Certificate, Kind, digest
from qe.proof.entry import Entry, formula_from_json, formula_to_json, poly_to_text
from qe.proving.certificates import substitution_certificate
from tests.attacks.formulas import altered, differs, eliminated, formula, question, simple
from tests.attacks.rules import RULES
from tests.bezier.made import ball
from tests.certificates.mutation import Path, at, evidence_in, leaves, lists
from tests.certificates.restated import is_stated, restated

Data = dict[str, Any]
IsFalse = Callable[[random.Random, Data], bool]
"""Whether the claim of the data is seen to be false; False also where that is not known."""

RELATION_NAMES = tuple(relation.value for relation in Relation)
SECONDS, PARAMETERS = 0.5, 33


# --- true certificates -----------------------------------------------------------------------------
def derivation(rng: random.Random) -> Certificate | None:
    """The certificate of an answer, where it is a derivation."""
    return _derivation(question(rng), Options(certify=True))


def derivation_by_a_rule(rng: random.Random) -> Certificate | None:
    """The same for a question on whose way a rule fires that others seldom need."""
    row = rng.choice(list(RULES.values()))
    return _derivation(row.question(rng), row.options)


def _derivation(asked: Formula, options: Options) -> Certificate | None:
    try:
        found = solve(asked, options, Budget(4 * SECONDS)).certificate
    except Unable:
        return None
    return found if found is not None and found.kind == Kind.DERIVATION else None


def cells(rng: random.Random) -> Certificate | None:
    """A table with an answer, in up to two variables."""
    ring = Ring.of(("a", "x"))
    body = formula(rng, ring, rng.choice((0, 1)))
    asked = (exists if rng.random() < 0.5 else forall)(("x",), body)
    answer = None if isinstance(asked, Constant) else eliminated(asked)
    try:
        return None if answer is None else certificate_for(asked, answer, Options(), Budget(SECONDS))
    except Unable:
        return None


def substitution(rng: random.Random) -> Certificate | None:
    """Linear equations with constant pivots, and what they leave of other conditions."""
    ring = Ring.of(("a", "b", "x", "y"))
    own = Ring.of(("a", "b"))
    equations = [ring.var(v) * rng.choice((1, 2, -3)) - simple(rng, own).convert(ring) for v in ("x", "y")]
    body = conj((*(atom(p, Relation.EQ) for p in equations), formula(rng, ring, 1)))
    asked = exists(("x", "y"), body)
    answer = None if isinstance(asked, Constant) else eliminated(asked)
    return None if answer is None else substitution_certificate(asked, answer)


def witness(rng: random.Random) -> Certificate | None:
    """Rational numbers that satisfy a formula."""
    ring = Ring.of(("x", "y", "z"))
    matrix = formula(rng, ring, 2)
    values = [Fraction(rng.randint(-6, 6), rng.randint(1, 3)) for _ in ring.names]
    if isinstance(matrix, Constant) or substituted(matrix, dict(zip(ring.names, values, strict=True))) != TRUE:
        return None
    return Certificate.witness(matrix, ring.names, values)


def optimum(rng: random.Random) -> Certificate | None:
    """Convex problems in two variables: discs, parabolas and half-planes."""
    ring = Ring.of(("x", "y"))
    x, y = ring.var("x"), ring.var("y")

    def number() -> int:
        return rng.choice((-3, -2, -1, 0, 1, 1, 2, 4))

    def line() -> Poly:
        return x * number() + y * number() + number()

    shapes: list[Callable[[], Poly]] = [
        line,
        line,
        lambda: x**2 + y**2 + line(),
        lambda: x**2 + line(),
        lambda: x**2 * 2 + x * y + y**2 + line(),
    ]
    relations = (Relation.LE, Relation.LE, Relation.LT)
    conditions = conj(atom(rng.choice(shapes)(), rng.choice(relations)) for _ in range(rng.randint(1, 3)))
    try:
        return minimize(rng.choice(shapes)(), conditions, budget=Budget(SECONDS)).certificate
    except (NotConvex, Unable):
        return None


def containment(rng: random.Random) -> Certificate | None:
    """A curve of up to four points in a ball or a half-space that holds it, sometimes just so."""
    points = [[Fraction(rng.randint(-4, 4), rng.choice((1, 2))) for _ in range(2)] for _ in range(rng.randint(2, 4))]
    slack = rng.choice((Fraction(0), Fraction(0), Fraction(1, 10), Fraction(1)))
    condition: Condition = Ball((Fraction(0),) * 2, max(x * x + y * y for x, y in points) + slack)
    if rng.random() < 0.5:
        a, b = (Fraction(rng.randint(*ends)) for ends in ((-3, 3), (1, 3)))
        condition = HalfSpace((-a, -b), max(a * x + b * y for x, y in points) + slack)
    curve = Bezier.of(points)
    outcome = examine(curve, condition)
    return contained(curve, outcome) if isinstance(outcome, Inside) else None


def clearance(rng: random.Random) -> Certificate | None:
    """A curve of three points that passes a ball, or two."""
    points = [tuple(rng.randint(-4, 4) for _ in range(3)) for _ in range(3)]
    balls = [ball([rng.randint(-2, 2) for _ in range(3)], rng.randint(1, 3)) for _ in range(rng.randint(1, 2))]
    both = replace(balls[0], pieces=tuple(piece for one in balls for piece in one.pieces), box=None)
    try:
        return clearance_certificate(Bezier.of(points), both)
    except InputError:  # it meets a ball
        return None


# --- what is false -----------------------------------------------------------------------------------
def not_equivalent(rng: random.Random, data: Data) -> bool:
    """Whether question and answer are seen to differ at some point."""
    claim = claim_of(Certificate.from_json(text_of(data)))
    if claim.equivalence is None or not claim.equivalence[1].is_quantifier_free:
        return False
    truth = eliminated(claim.equivalence[0])
    return truth is not None and differs(rng, truth, claim.equivalence[1], TRUE)


def _not_a_solution(rng: random.Random, data: Data) -> bool:
    payload, point = data["payload"], data["payload"]["steps"][0]["evidence"]
    matrix = formula_from_json(Entry(payload["start"][2], "start"), Ring.of(payload["order"]))
    values = {name: Fraction(value) for name, value in zip(point["order"], point["values"], strict=True)}
    return substituted(matrix, {name: values[name] for name in matrix.free}) != TRUE


def _not_the_optimum(rng: random.Random, data: Data) -> bool:
    """Whether what the evidence says of the optimum is false, or the certificate claims another sentence."""
    if not is_stated(data):
        return True
    payload = evidence_in(data)
    problem = payload["problem"]
    ring = Ring.of(problem["variables"])
    objective, scale = read_terms(Entry(problem["minimise"], "minimise"), ring.names, ring)
    conditions = []
    for constraint in problem["constraints"]:
        poly, _ = read_terms(Entry(constraint["terms"], "terms"), ring.names, ring)
        conditions.append(atom(poly, RELATIONS[constraint["relation"]]))
    try:
        true = minimize(objective, conj(conditions), scale=Fraction(1, scale), budget=Budget(SECONDS))
    except (NotConvex, Unable):
        return False
    if true.status.name.lower() != payload["status"]:
        return True
    if true.value is None or true.attained is not payload["attained"]:
        return true.value is not None
    return abs(number(payload["value"], payload["field"]) - float(true.value)) > 1e-6


def number(coefficients: list[str], field: Data) -> float:
    """A number of a field, about."""
    low, high = (Fraction(end) for end in field["interval"])
    minimal = [Fraction(c) for c in field["minimal_polynomial"]]

    def sign(t: Fraction) -> int:
        value = sum(c * t**k for k, c in enumerate(minimal))
        return (value > 0) - (value < 0)

    left = sign(low)
    while left and high - low > Fraction(1, 2**40):
        middle = (low + high) / 2
        low, high = (middle, high) if sign(middle) == left else (low, middle)
    return float(sum(Fraction(c) * low**k for k, c in enumerate(coefficients)))


def _has_a_point(rng: random.Random, data: Data) -> bool:
    """Whether a point of a curve is seen to satisfy what is claimed to have none; or if it is claimed to have one."""
    payload = data["payload"]
    whole = formula_from_json(Entry(payload["start"], "start"), Ring.of(payload["order"]), quantified=True)
    if payload["answer"] is not False or not isinstance(whole, Exists):
        return payload["answer"] is True
    return any(_at(whole.body, Fraction(k, PARAMETERS - 1)) for k in range(-PARAMETERS, 2 * PARAMETERS))


def _at(body: Formula, t: Fraction) -> bool:
    """Whether the body holds at the parameter, with the only values that its equations leave for the others."""
    body, values = substituted(body, {"t": t}), dict[str, Fraction]()
    for part in conjuncts(body):
        if isinstance(part, Atom) and part.relation == Relation.EQ and len(part.free) == 1:
            rest, *higher = part.poly.coefficients(part.poly.variables[0])
            if len(higher) == 1:
                values.setdefault(part.free[0], Fraction(-rest.constant_value(), higher[0].constant_value()))
    return set(body.free) <= set(values) and substituted(body, {v: values[v] for v in body.free}) == TRUE


KINDS: dict[str, tuple[Callable[[random.Random], Certificate | None], IsFalse]] = {
    "derivation": (derivation, not_equivalent),
    "derivation by a rule": (derivation_by_a_rule, not_equivalent),
    "cells": (cells, not_equivalent),
    "substitution": (substitution, not_equivalent),
    "witness": (witness, _not_a_solution),
    "optimum": (optimum, _not_the_optimum),
    "containment": (containment, _has_a_point),
    "clearance": (clearance, _has_a_point),
}


# --- alterations -------------------------------------------------------------------------------------
def text_of(data: Data) -> str:
    """The certificate, signed with the digest of its content."""
    return json.dumps({**data, "digest": digest(data)})


def other_claim(rng: random.Random, data: Data) -> Data:
    """The certificate with one to three things changed; mostly its claim is among them, or follows the evidence."""
    made = deepcopy(data)
    if "answer" in made["payload"] and rng.random() < 0.7:
        made = _other_answer(rng, made)
    for _ in range(rng.choice((0, 1, 1, 2)) if made != data else rng.choice((1, 1, 2, 3))):
        change = rng.choice((_other_atom, _other_polynomial, _other_leaf, _other_leaf, _other_list))
        made = change(rng, made)
    return restated(made) if rng.random() < 0.7 else made


def _everywhere(node: Any, old: Any, new: Any) -> Any:
    if node == old and type(node) is type(old):
        return deepcopy(new)
    if isinstance(node, dict):
        return {key: _everywhere(value, old, new) for key, value in node.items()}
    return [_everywhere(value, old, new) for value in node] if isinstance(node, list) else node


def _other_answer(rng: random.Random, data: Data) -> Data:
    """Another answer, in its place alone or wherever the formula stands."""
    payload = data["payload"]
    if payload["answer"] is None:
        return data
    given: Formula = formula_from_json(Entry(payload["answer"], "answer"), Ring.of(payload["order"]), quantified=True)
    new = formula_to_json(altered(rng, given), quantified=True)
    if rng.random() < 0.3:
        payload["answer"] = new
        return data
    return {**data, "payload": _everywhere(payload, payload["answer"], new)}


def _other_atom(rng: random.Random, data: Data) -> Data:
    """Another relation of an atom, or an atom in place of another, wherever it stands."""
    found = [node for _, node in lists(data["payload"]) if node[0] == "atom" and len(node) == 3]
    if not found:
        return data
    old = rng.choice(found)
    new = ["atom", rng.choice(found)[1] if rng.random() < 0.3 else old[1], rng.choice(RELATION_NAMES)]
    return {**data, "payload": _everywhere(data["payload"], old, new)}


def _other_polynomial(rng: random.Random, data: Data) -> Data:
    """Another constant term of a polynomial, wherever it stands."""
    names = data["payload"].get("order")
    texts = [v for _, v in leaves(data["payload"]) if isinstance(v, str) and any(n in v for n in names or ())]
    if not texts:
        return data
    old = rng.choice(texts)
    try:
        new = poly_to_text((Entry(old, "").polynomial(Ring.of(names)) + rng.choice((-1, 1, 2))).normal()[1])
    except QEError:
        return data
    return {**data, "payload": _everywhere(data["payload"], old, new)}


def _other_leaf(rng: random.Random, data: Data) -> Data:
    """Another number, sign or truth value."""
    path, value = rng.choice(list(leaves(data["payload"])))
    return _with(data, path, _other_value(rng, value))


def _other_value(rng: random.Random, value: Any) -> Any:
    if value is None or isinstance(value, bool):
        return rng.choice([v for v in (None, True, False) if v is not value])
    if isinstance(value, int):
        return value + rng.choice((-2, -1, 1))
    if value and set(value) <= set("+-0?") and not value.isdigit():
        k = rng.randrange(len(value))
        return value[:k] + rng.choice("+-0?") + value[k + 1 :]
    try:
        number = Fraction(value)
    except (ValueError, ZeroDivisionError):
        return value
    return str(rng.choice((-number, number + rng.choice((-1, 1)), number * 2, Fraction(0), number / 3)))


def _other_list(rng: random.Random, data: Data) -> Data:
    """An entry of a list left out, doubled, or exchanged with its neighbour."""
    found = list(lists(data["payload"]))
    if not found:
        return data
    path, items = rng.choice(found)
    k = rng.randrange(len(items))
    left = items[:k] + items[k + 1 :]
    made = rng.choice((left, [*items[: k + 1], *items[k:]], [*left[: k + 1], items[k], *left[k + 1 :]]))
    return _with(data, path, made)


def _with(data: Data, path: Path, value: Any) -> Data:
    made = deepcopy(data)
    at(made["payload"], path[:-1])[path[-1]] = value
    return made
