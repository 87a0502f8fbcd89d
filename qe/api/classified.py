"""The certificate of a whole classification by numbers of real solutions: what its checker asks is proved here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from qe.certify.verify import verify
from qe.engine.run import solve
from qe.errors import InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.ring import Poly, Ring
from qe.exact.univariate import from_univariate
from qe.expert.classification import read_question, sentence
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.groebner.counting import RealRootClassification
from qe.groebner.question import ParametricSystem
from qe.options import Budget, Method, Options
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry, Json, formula_to_json, poly_to_text


def certified(
    asked: ParametricSystem, classification: RealRootClassification, budget: Budget
) -> RealRootClassification:
    """The classification with its certificate, which the checker has accepted; ``Unable`` without one."""
    payload = _question(asked, classification)
    question, classes, _ = read_question(Entry(payload, "payload"))
    sentences = question.sentences(classes, lambda: budget.check("certificate"))
    evidence: dict[str, Json] = {**payload, "proofs": [_proof(s, budget) for s in sentences if s != TRUE]}
    certificate = Certificate.step("classification", (), *sentence(Entry(evidence, "evidence")), evidence)
    verdict = verify(certificate, budget)
    if not verdict.accepted:
        raise Unable(f"no certificate of the classification: {verdict.reason}")
    return replace(classification, certificate=certificate)


def _proof(case: Formula, budget: Budget) -> Json:
    for method in (Method.AUTO, Method.CAD):
        answer = solve(case, Options(method=method, certify=True), budget)
        if answer.formula == FALSE:
            raise InternalError("a classification contradicts the cases of its checker")
        if answer.formula == TRUE and answer.certificate is not None and not answer.unchecked:
            assert isinstance(answer.certificate.payload, dict)
            return answer.certificate.payload
    raise Unable("no certificate of the classification: a case is decided without one")


def _question(asked: ParametricSystem, classification: RealRootClassification) -> dict[str, Json]:
    names = asked.ring.names
    variables = [names[i] for i in asked.block.variables]
    parameters = [n for n in names if n not in variables and n not in asked.constants]
    ring = Ring.of((*asked.constants, *parameters))
    whole = Ring.of((*ring.names, *variables))

    def texts(polys: tuple[Poly, ...], ring: Ring = whole) -> list[Json]:
        return [poly_to_text(p.convert(ring)) for p in polys]

    return {
        "variables": list[Json](variables),
        "parameters": list[Json](parameters),
        "constants": _constants(asked.constants, ring),
        "polynomials": texts(asked.polys),
        "positive": texts(classification.positive),
        "equal": texts(asked.equal, ring),
        "nonzero": texts(asked.nonzero, ring),
        "classes": [[c.count, formula_to_json(convert(c.condition, ring))] for c in classification.classes],
        "proofs": [],
    }


def _constants(given: Mapping[str, RealAlgebraic], ring: Ring) -> list[Json]:
    listed: list[Json] = []
    for name, number in given.items():
        low, high = (number.as_fraction(),) * 2 if number.is_rational else number.interval()
        minimal = from_univariate(ring, ring.index[name], number.poly)
        listed.append([name, poly_to_text(minimal), str(low), str(high)])
    return listed
