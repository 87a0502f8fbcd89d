"""Claims of the rule "elimination set", right ones and altered ones, and whether they are true on a grid."""

from __future__ import annotations

import random
from collections.abc import Iterator
from copy import deepcopy
from fractions import Fraction
from itertools import product
from typing import Any

from qe.certify.registry import RULES
from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.trace import Substituted
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Exists, Formula, Relation
from qe.formula.traverse import polynomials
from qe.kernel.derivation import limits_of
from qe.kernel.elimination_points import read_points
from qe.kernel.elimination_set import check_elimination_set, start
from qe.kernel.step import Claim, Limits
from qe.options import Budget
from qe.proof.entry import Entry, formula_to_json
from qe.proving.elimination_points import Points
from qe.proving.shifts import low
from tests.unit.elimination.vs.line import holds, samples, specialise

RING = Ring.of(("a", "b", "x"))
GRID = tuple(map(Fraction, ("-2", "-1", "-1/2", "0", "1/2", "1", "3/2", "3")))
X = 2


def limits() -> Limits:
    return limits_of(Budget(20), RULES)


def random_polynomial(chance: random.Random) -> Poly:
    generators = [RING.gen(i) for i in (0, 1, 2, 2, 2)]
    found = RING.constant(chance.randint(-3, 3))
    for _ in range(chance.randint(1, 3)):
        term = RING.constant(chance.randint(-2, 2))
        for _ in range(chance.randint(1, 2)):
            term = term * chance.choice(generators)
        found = found + term
    return found


def random_formula(chance: random.Random, depth: int) -> Formula:
    """And/or combinations of atoms of degree at most 2."""
    if not depth or chance.random() < 0.25:
        return atom(random_polynomial(chance), chance.choice(tuple(Relation)))
    join = conj if chance.random() < 0.55 else disj
    return join(random_formula(chance, depth - 1) for _ in range(chance.randint(2, 3)))


def evidence_for(body: Formula) -> dict[str, Any] | None:
    """The evidence of one elimination set for ``ex x. body``, without steps after it; None where there is none."""
    result = eliminate_block(("x",), body, budget=Budget(20), simplify=lambda f: f)
    trace = result.trace.trace if result.trace is not None else None
    if not isinstance(trace, Substituted) or result.formula == TRUE:
        return None
    body = low(trace.formula, X, trace.plan.exponent)
    points = Points(Exists(("x",), body), trace, RING, limits(), complete=True)
    evidence: Any = points.evidence([[] for _ in points.listed])
    return {"body": body, "evidence": evidence}


def claimed(body: Formula, evidence: dict[str, Any]) -> Formula:
    """What the points claim ``ex x. body`` to be equivalent to. Raises ``CertificateRejected`` for malformed points."""
    tried = read_points(Entry(evidence["points"], "points"), body, X, RING)
    return disj(start(t, X, "x", ("x",), RING) for t in tried)


def accepted(body: Formula, after: Formula, evidence: dict[str, Any]) -> bool:
    """What the checker says."""
    given = {**evidence, "parts": [[] for _ in evidence["points"]]}
    claim = Claim("elimination set", Exists(("x",), body), after, RING, Entry(given, "evidence"), "step")
    try:
        check_elimination_set(claim, (), limits())
    except (CertificateRejected, Unable):
        return False
    return True


def is_true(body: Formula, after: Formula) -> bool:
    """Whether both sides of the claim have the same truth on the grid, by exact evaluation."""
    for a, b in product(GRID, repeat=2):
        values = {"a": a, "b": b}
        if somewhere(specialise(body, values)) != _holds(after, values):
            return False
    return True


def somewhere(body: Formula) -> bool:
    """Whether a formula in x alone holds for some x."""
    return any(holds(body, X, value) for value in samples(polynomials(body), X))


def _holds(formula: Formula, values: dict[str, Fraction]) -> bool:
    if isinstance(formula, Exists):
        return somewhere(specialise(formula.body, values))
    from qe.formula.syntax import And, Or

    if isinstance(formula, And | Or):
        return (all if isinstance(formula, And) else any)(_holds(f, values) for f in formula.args)
    return bool(holds_at(formula, values))


def altered(evidence: dict[str, Any], chance: random.Random) -> Iterator[dict[str, Any]]:
    """The evidence with one thing changed, in every kind of way."""
    for k in range(len(evidence["points"])):
        for change in (
            _without_point,
            _without_guard,
            _other_guard,
            _other_point,
            _other_formula,
            _more_settled,
            _last,
        ):
            made = deepcopy(evidence)
            if change(made, k, chance):
                yield made
    for name, value in (("side", -evidence["side"] or 1), ("side", 0)):
        yield {**deepcopy(evidence), name: value}


def _without_point(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    del evidence["points"][k]
    return True


def _without_guard(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    guard = evidence["points"][k]["guard"]
    if not isinstance(guard, list):
        return False
    if guard[0] == "and":
        del guard[chance.randrange(1, len(guard))]
        evidence["points"][k]["guard"] = guard[1] if len(guard) == 2 else guard
    else:
        evidence["points"][k]["guard"] = True
    return True


def _other_guard(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    extra = atom(random_polynomial(chance).at_rational(X, 0), chance.choice(tuple(Relation)))
    if extra == TRUE:
        return False
    old = evidence["points"][k]["guard"]
    parts = old[1:] if isinstance(old, list) and old[0] == "and" else [] if old is True else [old]
    more = formula_to_json(extra)
    evidence["points"][k]["guard"] = ["and", *parts, more] if parts else more
    return True


def _other_point(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    point = evidence["points"][k]["point"]
    if point is None:
        return False
    kind = chance.choice(("branch", "shift", "coefficients"))
    if kind == "coefficients":
        if not point["coefficients"]:
            return False
        point["coefficients"][chance.randrange(len(point["coefficients"]))] = chance.choice(("0", "1", "a", "b", "-1"))
    else:
        point[kind] = chance.choice([v for v in (-1, 0, 1) if v != point[kind]])
    return True


def _other_formula(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    formula = evidence["points"][k]["formula"]
    if formula is None or not isinstance(formula, list) or formula[0] not in ("and", "or") or len(formula) < 4:
        return False
    del formula[chance.randrange(1, len(formula))]
    return True


def _more_settled(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    formula = evidence["points"][k]["formula"]
    if not isinstance(formula, list):
        return False
    members = formula[1:] if formula[0] == "and" else [formula]
    evidence["points"][k]["settled"] = [m for m in members if m[0] == "atom" and m[2] in ("<", ">", "/=", "!=")]
    return True


def _last(evidence: dict[str, Any], k: int, chance: random.Random) -> bool:
    """Another order: what is settled by earlier points is so no more."""
    evidence["points"].append(evidence["points"].pop(k))
    return k + 1 < len(evidence["points"])


def examined(seed: int, count: int) -> tuple[int, int]:
    """So many random claims; how many altered ones were looked at, and accepted because they are true, too."""
    chance, looked, right = random.Random(seed), 0, 0
    for _ in range(count):
        body = random_formula(chance, chance.randint(1, 2))
        found = evidence_for(body) if "x" in body.free else None
        if found is None:
            continue
        whole, evidence = found["body"], found["evidence"]
        after = claimed(whole, evidence)
        assert accepted(whole, after, evidence), whole
        assert is_true(whole, after), whole
        for made in altered(evidence, chance):
            looked += 1
            try:
                other = claimed(whole, made)
            except CertificateRejected:
                assert not accepted(whole, after, made)
                continue
            if accepted(whole, other, made):
                right += 1
                assert is_true(whole, other), (whole, other, made)
    return looked, right
