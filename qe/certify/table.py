"""Rules "cells", "shorter" and "constant": a cell table, as a certificate of its own, about this very step.

THEOREM (prenex form). Let no variable be bound twice, or both bound and free. Then quantifiers may move outwards past
conjunctions and disjunctions, as R is not empty, in any order in which those that stand inside each other keep theirs,
but for neighbours of one kind. So a formula is equivalent to a prefix of that order before its negation normal form
without quantifiers; variables that do not occur may be quantified anyhow.

Evidence: ``certificate``, of kind "cells", with the truth of ``after`` on every cell of the free variables.
"""

from __future__ import annotations

from qe.certify.negation import normal
from qe.certify.step import Claim, Context, Limits, only
from qe.exact.ring import Ring
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import And, Exists, ForAll, Formula, Or
from qe.formula.traverse import subformulas
from qe.proof.cells import CellTable
from qe.proof.cells_json import CellEvidence

Bound = tuple[tuple[str, str], ...]


def check_table(claim: Claim, context: Context, limits: Limits) -> None:
    """The certificate is checked, and is about the formulas of the step."""
    entry = only(claim, "certificate")[0]
    evidence = limits.leaf(entry).payload
    if not isinstance(evidence, CellEvidence) or evidence.answer is None:
        raise entry.fail("expected a certificate by cells, with an answer")
    table, before = evidence.table, normal(claim.before)
    free = set(before.free) | set(claim.after.free)
    if not free <= set(table.order) <= set(claim.ring.names):
        raise entry.fail("the table is about other variables")
    if normal(_moved(evidence.answer, claim.ring)) != normal(claim.after):
        raise entry.fail("the table is about another answer")
    if normal(_moved(table.matrix, claim.ring)) != normal(_matrix(before)):
        raise entry.fail("the table is about another formula")
    _check_prefix(before, table, claim)


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


def _check_prefix(formula: Formula, table: CellTable, claim: Claim) -> None:
    names = [v for f in subformulas(formula) if isinstance(f, Exists | ForAll) for v in f.variables]
    if len(set(names)) < len(names) or set(names) & set(formula.free):
        raise claim.fail("a name is bound twice, or free and bound")
    kinds = dict(zip(table.order, table.quantifiers, strict=True))
    if any(kinds[v] for v in formula.free):
        raise claim.fail("the table quantifies a free variable")
    _check_nesting(formula, (), table, kinds, claim)


def _check_nesting(formula: Formula, outside: Bound, table: CellTable, kinds: dict[str, str], claim: Claim) -> None:
    """``outside``: the variables bound on the way down, with their kinds."""
    match formula:
        case And(args) | Or(args):
            for arg in args:
                _check_nesting(arg, outside, table, kinds, claim)
        case Exists(variables, body) | ForAll(variables, body):
            kind = "E" if isinstance(formula, Exists) else "A"
            for name in variables:
                if name in kinds and kinds[name] != kind:
                    raise claim.fail(f"the table has another quantifier for {name}")
                if name in kinds and not all(_in_order(a, name, table, kinds) for a, _ in outside):
                    raise claim.fail(f"the table quantifies {name} too early")
            _check_nesting(body, outside + tuple((v, kind) for v in variables), table, kinds, claim)


def _in_order(outer: str, inner: str, table: CellTable, kinds: dict[str, str]) -> bool:
    """Whether the outer variable comes first, or only quantifiers of one kind stand between the two."""
    if outer not in kinds or table.order.index(outer) < table.order.index(inner):
        return True
    between = table.order[table.order.index(inner) : table.order.index(outer) + 1]
    return len({kinds[v] for v in between}) == 1
