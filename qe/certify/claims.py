"""What a certificate claims, in words; and whether that is about a given question.

The claim is read off the entries that the checkers check, so an accepted certificate proves just this.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from qe.certify.kinds import brought_kind
from qe.exact.ring import Ring, format_poly
from qe.formula.build import atom, conj, convert, exists, forall
from qe.formula.normal import rename_apart
from qe.formula.syntax import FALSE, TRUE, Constant, Formula
from qe.kernel.negation import negation, normal
from qe.kernel.renaming import arranged, shape
from qe.kernel.sentence import RELATIONS, read_polynomial
from qe.kernel.table import is_prenex_form
from qe.proof.cells import CellTable
from qe.proof.cells_json import CellEvidence
from qe.proof.certificate import Certificate, Kind
from qe.proof.entry import Entry, formula_from_json


@dataclass(frozen=True, slots=True)
class Claim:
    """``words``: lines of text. ``question`` <-> ``answer``, where the claim has this form (else None); or ``parts``:
    what implies the question, and what its negation."""

    words: tuple[str, ...]
    question: Formula | None = None
    answer: Formula | None = None
    parts: tuple[Formula, Formula] | None = None


def claim_of(certificate: Certificate) -> Claim:
    """The claim of a certificate. Raises ``CertificateRejected`` where an entry is malformed."""
    payload = certificate.payload
    if isinstance(payload, CellEvidence):
        return _of_cells(payload)
    if isinstance(payload, tuple):
        words = [f"{m.label}: {line}" for m in payload for line in claim_of(m.certificate).words]
        return Claim((f"{len(payload)} claims", *words) if payload else ("nothing: the bundle is empty",))
    entry = Entry(payload, "payload")
    match certificate.kind:
        case Kind.DERIVATION:
            order, start, steps, answer = entry.fields("order", "start", "steps", "answer")
            ring = Ring.of(order.names())
            question, found = (formula_from_json(e, ring, quantified=True) for e in (start, answer))
            return Claim((*_equivalence(question, found), _rules(steps)), question, found)
        case Kind.SUBSTITUTION:
            order, block, matrix, _, answer = entry.fields("order", "variables", "matrix", "solved", "answer")
            ring = Ring.of(order.names())
            question = exists(block.names(), formula_from_json(matrix, ring))
            found = formula_from_json(answer, ring)
            return Claim(_equivalence(question, found), question, found)
        case Kind.WITNESS:
            order, matrix, _ = entry.fields("order", "matrix", "values")
            ring = Ring.of(order.names())
            question = exists(ring.names, formula_from_json(matrix, ring))
            return Claim((*_equivalence(question, TRUE), "by numbers for the variables"), question, TRUE)
        case Kind.OPTIMUM:
            return _of_optimum(entry)
        case Kind.SOLUTIONS:
            return _of_solutions(entry)
        case Kind.CLASSIFICATION:
            return _of_classification(entry)
        case Kind.PARTS:
            order, question_entry, true, false, _ = entry.fields("order", "question", "true", "false", "proofs")
            ring = Ring.of(order.names())
            question = formula_from_json(question_entry, ring, quantified=True)
            return _of_parts(question, (formula_from_json(true, ring), formula_from_json(false, ring)))
    brought = brought_kind(certificate.kind.value)
    return Claim((f"{certificate.kind.value}: {brought.words(entry) if brought else 'nothing that is known here'}",))


def is_about(certificate: Certificate, formula: Formula) -> Formula | None:
    """The answer that the certificate claims to this formula, up to names of bound variables and the order of
    conjuncts and disjuncts; None where it is about something else.

    A certificate about the negation counts, with the negated answer; of a bundle the first member that is about it.
    """
    if isinstance(certificate.payload, tuple):
        found = (is_about(member.certificate, formula) for member in certificate.payload)
        return next((answer for answer in found if answer is not None), None)
    claim = claim_of(certificate)
    if claim.answer is None or (negated := _asks(certificate, claim, formula)) is None:
        return None
    return negation(claim.answer) if negated else claim.answer


def parts_of(certificate: Certificate, formula: Formula) -> tuple[Formula, Formula] | None:
    """What the certificate claims to imply this formula, and what its negation; as ``is_about``."""
    answer = is_about(certificate, formula)
    if answer is not None:
        return answer, negation(answer)
    if isinstance(certificate.payload, tuple):
        return None
    claim = claim_of(certificate)
    if claim.parts is None or (negated := _asks(certificate, claim, formula)) is None:
        return None
    true, false = claim.parts
    return (false, true) if negated else (true, false)


def _asks(certificate: Certificate, claim: Claim, formula: Formula) -> bool | None:
    """Whether the claim is about the negation of the formula; None where it is about neither."""
    if claim.question is None:
        return None
    for negated in (False, True):
        asked = negation(formula) if negated else formula
        if isinstance(certificate.payload, CellEvidence):
            if _is_table_of(asked, certificate.payload.table):
                return negated
        elif arranged(normal(claim.question)) == arranged(normal(asked)):
            return negated
    return None


def _is_table_of(asked: Formula, table: CellTable) -> bool:
    apart = rename_apart(normal(asked))
    if shape(normal(asked)) != shape(apart):
        return False
    ring = Ring.of(dict.fromkeys((*table.order, *(apart.ring.names if apart.ring else ()))))
    return is_prenex_form(convert(apart, ring), table)


def _equivalence(question: Formula, answer: Formula) -> tuple[str, ...]:
    if isinstance(answer, Constant) and not question.free:
        return f"the sentence  {question}", f"is {answer}"
    values = f", for all real values of {', '.join(question.free)}" if question.free else ""
    return f"the formula  {question}", f"is equivalent to  {answer}{values}"


def _of_parts(question: Formula, parts: tuple[Formula, Formula]) -> Claim:
    words = f"the formula  {question}", f"is true where  {parts[0]}", f"and false where  {parts[1]}"
    return Claim(words, question, parts=parts)


def _rules(steps: Entry) -> str:
    counts: dict[str, int] = {}
    for rule in _named(steps):
        counts[rule] = counts.get(rule, 0) + 1
    listed = ", ".join(f"{rule} ({count})" if count > 1 else rule for rule, count in counts.items())
    return f"by {listed}" if counts else "as it stands, without any step"


def _named(entry: Entry) -> Iterator[str]:
    """The names of the rules of steps, also of nested ones."""
    value = entry.value
    if isinstance(value, dict):
        if isinstance(value.get("rule"), str) and "before" in value:
            yield str(value["rule"])
        for part in value.values():
            yield from _named(Entry(part, entry.path))
    elif isinstance(value, list):
        for part in value:
            if isinstance(part, dict | list):
                yield from _named(Entry(part, entry.path))


def _of_cells(evidence: CellEvidence) -> Claim:
    table = evidence.table
    question = table.matrix
    for name, kind in reversed(list(zip(table.order, table.quantifiers, strict=True))):
        question = question if not kind else (exists if kind == "E" else forall)([name], question)
    if evidence.parts is not None:
        return _of_parts(question, evidence.parts)
    answer = evidence.answer
    if answer is None and not question.free and table.root.truth is not None:
        answer = TRUE if table.root.truth else FALSE
    if answer is None:
        return Claim((f"truth values of  {question}  on {_size(table)} cells",))
    return Claim((*_equivalence(question, answer), "by a cylindrical algebraic decomposition"), question, answer)


def _size(table: CellTable) -> int:
    count, pending = 0, [table.root]
    while pending:
        cell = pending.pop()
        count += cell.stack is None
        pending += cell.stack.cells if cell.stack is not None else ()
    return count


def _of_solutions(entry: Entry) -> Claim:
    from qe.expert.solutions import system_of

    ring, parts, solutions = system_of(entry)
    where, count = conj(parts), len(list(solutions.items()))
    question = exists(ring.names, where)
    number = ("no real solution", "exactly 1 real solution")[count] if count < 2 else f"exactly {count} real solutions"
    words = (f"the system  {where}", f"has {number}", "by signatures of trace forms")
    return Claim(words, question, TRUE if count else FALSE)


def _of_classification(entry: Entry) -> Claim:
    variables, parameters, constants, *lists, classes, _ = entry.fields(
        *("variables", "parameters", "constants", "polynomials", "positive", "equal", "nonzero", "classes", "proofs")
    )
    fixed = [[part.text() for part in constant.items()] for constant in constants.items()]
    ring = Ring.of(Entry([*(parts[0] for parts in fixed), *_texts(parameters)], parameters.path).names())
    signs = (" = 0", " > 0", " = 0", " /= 0")
    polys, positive, equal, nonzero = (
        [text + sign for text in _texts(group)] for group, sign in zip(lists, signs, strict=True)
    )
    given = [*equal, *nonzero, *(f"{name} is the root of {p} in [{low}, {high}]" for name, p, low, high in fixed)]
    words = [
        f"the system  {' and '.join([*polys, *positive])}  in {', '.join(_texts(variables))}",
        f"for all real values of {', '.join(_texts(parameters))}" + "".join(f", where {text}" for text in given),
    ]
    for pair in classes.items():
        count, condition = pair.row("number", "condition")
        many = "infinitely many complex" if count.value is None else f"exactly {count.integer()} real"
        words.append(f"has {many} solutions iff  {formula_from_json(condition, ring)}")
    return Claim((*words, "and no other number, by signatures of trace forms"))


def _texts(entry: Entry) -> list[str]:
    return [item.text() for item in entry.items()]


def _of_optimum(entry: Entry) -> Claim:
    assert isinstance(entry.value, dict)
    problem = Entry(entry.value.get("problem"), "payload.problem")
    variables, minimise, constraints = problem.fields("variables", "minimise", "constraints")
    ring = Ring.of(variables.names())
    conditions = []
    for constraint in constraints.items():
        terms, relation = constraint.fields("terms", "relation")
        poly, _ = read_polynomial(terms, ring.names, ring)
        conditions.append(atom(poly, RELATIONS[relation.text()]))
    objective, scale = read_polynomial(minimise, ring.names, ring)
    written = format_poly(objective) + ("" if scale == 1 else f", divided by {scale},")
    where = conj(conditions)
    match entry.value.get("status"):
        case "infeasible":
            question = exists(ring.names, where)
            return Claim((*_equivalence(question, FALSE), "by multipliers"), question, FALSE)
        case "unbounded":
            return Claim((f"{written} has no lower bound where  {where}",))
    return Claim((f"{written} has its least value, {_value(entry.value.get('value'))}, where  {where}",))


def _value(value: object) -> str:
    numbers = value if isinstance(value, list) else []
    return str(numbers[0]) if len(numbers) == 1 else "a number of the field in the certificate"
