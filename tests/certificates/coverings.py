"""Evidence of coverings as it stands in certificates, what the checker says of it, and ways to alter it."""

from __future__ import annotations

import copy
import json
import random
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Any

from qe.certify.registry import RULES
from qe.decomposition.cover import Search
from qe.decomposition.evidence import tree
from qe.elimination.coverings import Coverings
from qe.elimination.protocol import Context
from qe.errors import CertificateRejected, InputError, InternalError
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, Constant, Formula, Relation
from qe.io import formats
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.kernel.table import check_table
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, formula_to_json
from qe.proof.run_log import RunLog
from tests.certificates.mutation import at
from tests.differential.generate import random_poly

BODIES = [
    "x^2 + y^2 < 1 and x*y > 1",
    "x^2 + y^2 + z^2 < 1 and x + y + z > 2",
    "(x^2 - 2)*(y^2 - x) = 0 and x^2 + y^2 < 1 and y^3 > 1/2 and x > 1",
    "x^2 = 2 and y^2 = x and x*y > 3",
    "x^3 + y^3 + z^3 = x*y*z + 1 and x^2 + y^2 + z^2 < 1/4",
    "x*y > 1 and (x + y < 0 or x*y < 1/2) and (x > 0 or y > 0)",
]


def proof(body: Formula, order: tuple[str, ...]) -> dict[str, Any]:
    """The evidence that a body has no solution, as it stands in a certificate."""
    assert body.ring is not None
    ring, kinds = Ring.of(order), "E" * len(order)
    moved = convert(body, ring)
    found = Search(moved, ring, kinds, Budget(None, 20_000)).run()
    assert found.truth is False
    return plain(Certificate.cells(tree(found, kinds, moved), FALSE))


def plain(certificate: Certificate) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(json.dumps(certificate.evidence_for("cells")))
    return found


def verdict(body: Formula, given: Any, after: Formula = FALSE) -> str:
    """Empty where the checker accepts that the body has no solution; the evidence is said to be about this body."""
    assert body.ring is not None
    return judged(exists(body.ring.names, body), after, said(given, matrix=body))


def judged(before: Formula, after: Formula, given: Any) -> str:
    """Empty where the checker accepts the step; the evidence is said to be about this answer."""
    ring = before.ring
    assert ring is not None
    claim = Claim("covering", before, after, ring, Entry(said(given, answer=after), "evidence"), "step")
    try:
        check_table(claim, (), limits_of(Budget(60), RULES))
    except CertificateRejected as error:
        return str(error)
    return ""


def said(given: Any, **formulas: Formula) -> Any:
    """The evidence, with other formulas in it; of a sentence the truth goes with the answer."""
    found = copy.deepcopy(given)
    with suppress(LookupError, TypeError, AttributeError, CertificateRejected, InputError, InternalError):
        table = found["cells"]
        ring = Ring.of(tuple(table["order"]))
        answer = formulas.pop("answer", None)
        table |= {name: formula_to_json(convert(f, ring)) for name, f in formulas.items()}
        if "" not in table["quantifiers"] and isinstance(answer, Constant):
            table["root"]["truth"] = answer.value
    return found


QUESTIONS = [
    "ex x. x^2 + b*x + c = 0",
    "ex x. a*x^2 + b*x + c = 0",
    "all x. ex y. x^2 + y^2 = a*x*y + b",
    "ex x. all y. y^2 > x and x > a or y < a",
    "all x. ex y. y^4 = x^2 + x*y + 1 and y > 0",
    "ex x. all y. x < y^2 and x^2 > 2",
    "(ex x. x^2 = a) and not (all y. y^2 > b)",
    "ex y. y^3 - 3*y = a and y >= b",
]


def answered(formula: Formula, budget: Budget) -> tuple[Formula, dict[str, Any]]:
    """What the method answers, and its evidence."""
    problem, log = Block.of(formula), RunLog()
    if problem is None:
        problem = Block((), formula)
    Coverings().run(problem, Context(Options(certify=True), budget, log))
    step = next(s for s in log.steps() if s.rule == "covering")
    assert formula.ring is not None and "proof" in step.evidence
    proof = step.evidence["proof"]
    assert isinstance(proof, dict)
    return step.after, plain(proof["certificate"])


def random_question(rng: random.Random) -> Formula:
    """A formula with up to two parameters and up to two quantifiers of any kinds."""
    free = rng.choice([(), ("a",), ("a",), ("a", "b")])
    ring = Ring.of((*free, "x", "y"))

    def part(depth: int) -> Formula:
        if depth == 0 or rng.random() < 0.15:
            return atom(random_poly(rng, ring, ring.names, rng.choice([1, 2, 2, 3])), rng.choice(list(Relation)))
        return (conj if rng.random() < 0.6 else disj)([part(depth - 1) for _ in range(2)])

    found = nnf(part(rng.choice([1, 2, 2])))
    for name in ("y", "x"):
        found = rng.choice([exists, forall])((name,), found)
    return found


def read(text: str) -> Formula:
    return nnf(formats.read(text, "text"))


def altered(given: Any, path: tuple[Any, ...], rng: random.Random) -> Any:
    found = copy.deepcopy(given)
    part = at(found, path[:-1])
    old, key = part[path[-1]], path[-1]
    if isinstance(old, bool) or old is None:
        part[key] = rng.choice([0, 1])
    elif isinstance(old, int):
        part[key] = old + rng.choice([-1, 1, 2])
    elif isinstance(old, str):
        part[key] = rng.choice(["0", "-1/2", "x", "x - y", "17", "", "E", "A"])
    elif isinstance(old, list) and old:
        change = rng.choice(["pop", "reverse", "repeat"])
        if change == "repeat":
            old.append(old[0])
        else:
            getattr(old, change)()
    elif isinstance(old, dict):
        old.pop(rng.choice(sorted(old)))
    else:
        part[key] = [0]
    return found


def projected(polys: Iterable[Poly], level: int) -> Iterator[tuple[str, Poly]]:
    listed = list(polys)
    for i, f in enumerate(listed):
        yield "leading coefficient", f.leading(level)
        if f.degree(level) > 1:
            yield "discriminant", f.discriminant(level)
        yield from (("resultant", f.resultant(g, level)) for g in listed[:i])


def interval(first: int, last: int, at: int, own: list[int] | None, line: Any = None) -> Any:
    above = {} if line is None else {"stack": line}
    return {"signs": "", "truth": None, "reach": [first, last, at], "own": own, **above}


def line(used: list[int], sectors: list[str], sections: list[list[int]], *intervals: Any) -> Any:
    numbered = [[[i, sum(i in s for s in sections[: k + 1])] for i in section] for k, section in enumerate(sections)]
    return {"used": used, "sectors": sectors, "sections": numbered, "cells": list(intervals)}


def forged(body: Formula, factors: list[list[str]], first: Any) -> str:
    return verdict(body, about(body, factors, first))


def about(body: Formula, factors: list[list[str]], first: Any, kinds: str = "") -> dict[str, Any]:
    names = sorted(body.free)
    payload = {
        "order": names,
        "quantifiers": list(kinds or "E" * len(names)),
        "matrix": formula_to_json(convert(body, Ring.of(names))),
        "projection": "brown-mccallum",
        "factors": factors,
        "constraints": [],
        "root": {"signs": "", "truth": False, "stack": first},
    }
    return {"cells": payload}
