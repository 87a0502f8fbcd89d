"""Certificates of former releases of kinds that are steps of derivations today: "cells", "witness", "substitution",
"parts", "optimum", "solutions", "classification"; as certificates, and inside the evidence of steps.

Nothing here is trusted: what comes out is checked. Kept for one release.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib.metadata import entry_points
from typing import Any

from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Ring
from qe.expert import classification, optimum, solutions
from qe.formula.build import convert, exists
from qe.formula.normal import rename_apart
from qe.formula.syntax import TRUE, Formula
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import is_same
from qe.kernel.table import is_prenex_form
from qe.kernel.verdict import CRASHES
from qe.options import Budget
from qe.proof.cells import CellTable
from qe.proof.cells_json import cells_from_json
from qe.proof.certificate import Certificate, Kind, Labelled, prenex_form
from qe.proof.entry import Entry, Json, formula_from_json

GROUP = "bezier_qe.older_kinds"
Reader = Callable[[Entry], Certificate]


def recent(certificate: Certificate) -> Certificate:
    """The certificate as a derivation, or a bundle of such; itself where it is that. ``CertificateRejected`` names what
    cannot be understood."""
    payload = certificate.payload
    if isinstance(payload, tuple):
        members = tuple(Labelled(m.label, recent(m.certificate)) for m in payload)
        return certificate if members == payload else replace(certificate, payload=members)
    made = READERS.get(certificate.kind.value) or brought_reader(certificate.kind.value)
    if made is None and not any(map(_is_certificate, objects(payload))):
        return certificate
    try:
        new: Any = _renewed(payload)
        found = Certificate(certificate.kind, new) if made is None else made(Entry(new, "payload"))
    except (CertificateRejected, Unable):
        raise
    except CRASHES as error:
        raise CertificateRejected("payload", f"not a certificate of kind {certificate.kind.value}: {error}") from None
    return replace(found, digests=certificate.digests)


def brought_reader(kind: str) -> Reader | None:
    """What an installed package makes of its former kind of this name (entry points of the group ``GROUP``)."""
    points = () if kind in (Kind.DERIVATION.value, Kind.BUNDLE.value) else entry_points(group=GROUP, name=kind)
    return next((point.load() for point in points), None)


def is_table_of(certificate: Certificate, formula: Formula) -> bool:
    """Whether a certificate was a table of this formula or its negation: it named no question but the prenex form."""
    if certificate.kind.value != "cells" or not isinstance(certificate.payload, dict):
        return False
    table = cells_from_json(Entry(_table(certificate.payload), "payload"))
    return any(_is_prenex_form(table, asked) for asked in (formula, negation(formula)))


def _is_prenex_form(table: CellTable, formula: Formula) -> bool:
    question = rename_apart(normal(formula))
    ring = Ring.of(dict.fromkeys((*table.order, *(question.ring.names if question.ring else ()))))
    return is_same(question, formula) and is_prenex_form(convert(question, ring), table)


def objects(data: Json) -> Iterator[dict[str, Json]]:
    """All objects in the data."""
    pending: list[Json] = [data]
    while pending:
        node = pending.pop()
        if isinstance(node, dict):
            yield node
            pending += node.values()
        elif isinstance(node, list):
            pending += node


def _is_certificate(node: Json) -> bool:
    return isinstance(node, dict) and node.keys() == {"kind", "payload"}


def _renewed(data: Json) -> Json:
    """The data with the evidence of today in its steps."""
    if isinstance(data, list):
        return [_renewed(part) for part in data]
    if not isinstance(data, dict):
        return data
    if _is_certificate(data):
        return _lemma(data)
    evidence: Any = data.get("evidence")
    if "rule" in data and isinstance(evidence, dict) and _is_certificate(evidence.get("certificate")):
        rule, inside = _evidence(evidence["certificate"], str(data["rule"]))
        return {**data, "rule": rule, "evidence": inside}
    listed = data.get("certificates")
    if isinstance(listed, list):  # systems without solutions
        return {"systems": [_evidence(part, "")[1] for part in listed]}
    if _is_certificate(data.get("regular")):
        data = {**data, "regular": _evidence(data["regular"], "")[1]["cells"]}
    return {name: _renewed(part) for name, part in data.items()}


def _lemma(data: dict[str, Json]) -> Json:
    """A certificate inside a step, which is a derivation there; others stay as they are, and prove nothing."""
    kind, payload = data["kind"], data["payload"]
    if not isinstance(kind, str) or not isinstance(payload, dict):
        return data
    found = recent(Certificate(Kind(kind), payload))
    return found.payload if found.kind == Kind.DERIVATION else data  # type: ignore[return-value]


def _evidence(data: Any, rule: str) -> tuple[str, Any]:
    """The rule and the evidence of a step by what was a certificate of its own."""
    payload = data["payload"]
    match data["kind"]:
        case "cells":
            return ("cells" if rule == "constant" else rule), {"cells": _table(payload)}
        case "witness":
            return "instance", {"order": payload["order"], "values": payload["values"]}
        case "optimum":
            return "multipliers", payload
        case "solutions":
            return "solutions", payload
    raise CertificateRejected(rule, "a certificate of another kind expected")


def _table(payload: dict[str, Json]) -> dict[str, Json]:
    return {name: part for name, part in payload.items() if name not in ("answer", "parts")}


def _cells(payload: Entry) -> Certificate:
    assert isinstance(payload.value, dict)
    evidence = _table(payload.value)
    table = cells_from_json(Entry(evidence, payload.path))
    ring, question, parts = Ring.of(table.order), prenex_form(table), payload.value.get("parts")
    stated = payload.value["answer"]
    if parts is not None:
        true, false = (formula_from_json(e, ring) for e in Entry(parts, f"{payload.path}.parts").row("true", "false"))
        return Certificate.decided(question, true, false, "cells", {"cells": evidence})
    answer = None if stated is None else formula_from_json(Entry(stated, f"{payload.path}.answer"), ring)
    return Certificate.cells(table, answer)


def _witness(payload: Entry) -> Certificate:
    order, matrix, values = payload.fields("order", "matrix", "values")
    question = exists(order.names(), formula_from_json(matrix, Ring.of(order.names())))
    return Certificate.step("instance", order.names(), question, TRUE, {"order": order.value, "values": values.value})


def _substitution(payload: Entry) -> Certificate:
    order, _, matrix, solved, answer = payload.fields("order", "variables", "matrix", "solved", "answer")
    ring = Ring.of(order.names())
    rows = [row.row("variable", "equation") for row in solved.items()]
    listed = [(name.text(), equation.polynomial(ring)) for name, equation in rows]
    body, found = (formula_from_json(entry, ring) for entry in (matrix, answer))
    return Certificate.substitution(body, ring.names, listed, found)


def _parts(payload: Entry) -> Certificate:
    order, asked, *parts, proofs = payload.fields("order", "question", "true", "false", "proofs")
    ring = Ring.of(order.names())
    question, true, false = (formula_from_json(entry, ring, quantified=True) for entry in (asked, *parts))
    listed = [recent(Certificate(Kind(e["kind"]), e["payload"])) for e in proofs.value]  # type: ignore[union-attr,index,arg-type,call-overload]
    derivations: Any = [part.payload for proof in listed for part in proof.parts]
    return Certificate.decided(question, true, false, "parts", {"proofs": derivations})


def _step(rule: str, sentence: Callable[[Entry], tuple[Formula, Formula]]) -> Callable[[Entry], Certificate]:
    def made(payload: Entry) -> Certificate:
        evidence: Any = payload.value
        return Certificate.step(rule, (), *sentence(payload), evidence)

    return made


READERS: dict[str, Reader] = {
    "cells": _cells,
    "witness": _witness,
    "substitution": _substitution,
    "parts": _parts,
    "optimum": _step("multipliers", lambda payload: optimum.sentence(payload, Budget())),
    "solutions": _step("solutions", lambda payload: solutions.sentence(payload, Budget())),
    "classification": _step("classification", classification.sentence),
}
"""What is made of a certificate of each former kind."""
