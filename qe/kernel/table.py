"""Rules "cells", "shorter" and "covering": a cell table of a prenex form of what stands before.

THEOREM (prenex form). Let no variable be bound twice, or both bound and free. Then quantifiers may move outwards past
conjunctions and disjunctions, as R is not empty, in any order in which those that stand inside each other keep theirs,
but for neighbours of one kind. So a formula is equivalent to a prefix of that order before its negation normal form
without quantifiers; variables that do not occur may be quantified anyhow.

Evidence: ``cells``, a table by which ``after`` has the truth of ``before`` on every cell of the free variables on which
the facts of the step hold (``kernel.cells``). A step from a formula to itself says that the table is right.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import And, Constant, Exists, ForAll, Formula, Or
from qe.formula.traverse import subformulas
from qe.kernel.cells import check_cells
from qe.kernel.negation import normal
from qe.kernel.renaming import arranged
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.cells import CellTable
from qe.proof.cells_json import cells_from_json


def check_table(claim: Claim, context: Context, limits: Limits) -> None:
    """The table is checked, and is about the formulas of the step."""
    entry = only(claim, "cells")[0]
    table, before = cells_from_json(entry), normal(claim.before)
    if not {*before.free, *claim.after.free} <= set(table.order) <= set(claim.ring.names):
        raise entry.fail("the table is about other variables")
    answer = None if claim.before == claim.after else claim.after
    if answer is not None and not answer.is_quantifier_free:
        raise claim.fail("expected an answer without quantifiers")
    known = [fact for fact in context if fact.is_quantifier_free and {*fact.free} <= {*table.order}]
    ring = Ring.of(table.order)
    given = [_moved(fact, ring) for fact in known]
    try:
        check_cells(table, None if answer is None else _moved(answer, ring), given, limits.budget)
    except CertificateRejected as error:
        at = f"{claim.path}.after" if error.step == "answer" else f"{entry.path}.{error.step.removeprefix('payload.')}"
        raise CertificateRejected(at, error.reason) from None
    if not is_prenex_form(before, table):
        raise entry.fail("the table is about another formula")


def _moved(formula: Formula, ring: Ring) -> Formula:
    return convert(normal(formula), ring)


def _matrix(formula: Formula) -> Formula:
    """The formula without its quantifiers."""
    match formula:
        case And(args):
            return conj(_matrix(a) for a in args)
        case Or(args):
            return disj(_matrix(a) for a in args)
        case Exists(_, body) | ForAll(_, body):
            return _matrix(body)
    return formula


def is_prenex_form(formula: Formula, table: CellTable) -> bool:
    """Whether the prefix and the matrix of a table are a prenex form of a formula, by the theorem."""
    formula = normal(formula)
    kinds = dict(zip(table.order, table.quantifiers, strict=True))
    names = [v for f in subformulas(formula) if isinstance(f, Exists | ForAll) for v in f.variables]
    if len(set(names)) < len(names) or set(names) & set(formula.free):
        return False
    if any(kinds.get(v, "free") for v in formula.free) or not _is_nested(formula, (), table.order, kinds):
        return False
    matrix, ring = _matrix(formula), formula.ring
    if ring is None or not set(table.order) <= set(ring.names):
        return isinstance(matrix, Constant) and normal(table.matrix) == matrix
    return arranged(normal(_moved(table.matrix, ring))) == arranged(normal(matrix))


def _is_nested(formula: Formula, outside: tuple[str, ...], order: Sequence[str], kinds: Mapping[str, str]) -> bool:
    """Whether the quantifiers have their kinds and, below those of ``outside``, a possible order."""
    match formula:
        case And(args) | Or(args):
            return all(_is_nested(a, outside, order, kinds) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            kind = "E" if isinstance(formula, Exists) else "A"
            if any(kinds.get(v, kind) != kind or not _follows(v, outside, order, kinds) for v in variables):
                return False
            return _is_nested(body, outside + variables, order, kinds)
    return True


def _follows(name: str, outside: Sequence[str], order: Sequence[str], kinds: Mapping[str, str]) -> bool:
    """Whether a variable comes after those outside, or only quantifiers of one kind stand between."""
    if name not in kinds:
        return True
    place = order.index(name)
    for other in outside:
        if other in kinds and order.index(other) > place:
            between = order[place : order.index(other) + 1]
            if len({kinds[v] for v in between}) > 1:
                return False
    return True
