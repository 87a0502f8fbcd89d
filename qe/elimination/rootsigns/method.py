"""Blocks of one variable about the roots or the sign of one polynomial, by tables of signs.

THEOREM. Let the leading coefficient of f not be 0. How the roots of f lie determines the answer (``Question.holds``)
and constrains the signs of the minors of Hermite's forms and of the coefficients (``theory``). So a formula in these
signs that is true on all rows that belong to types with the answer yes, and false on those with the answer no, is the
answer, if no row belongs to both. Which one is chosen makes no difference to its truth, and the shortest is wanted
(Gonzalez-Vega 1998 has such formulas by Sturm-Habicht sequences). Where the leading coefficient is 0 the degree is
lower, and that question is left to be asked.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from qe.elimination.protocol import Context, Outcome
from qe.elimination.rootsigns.cover import Rows
from qe.elimination.rootsigns.forms import minors, special
from qe.elimination.rootsigns.question import Question, read
from qe.elimination.rootsigns.theory import Name, Place, RootType, Shape, Signs, rows
from qe.errors import Unable
from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.options import Budget, Options


class RootsBySigns:
    """One polynomial in one variable, with parameters."""

    name = "roots by signs"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Blocks of one variable over quantifier-free bodies."""
        return "signs of Hermite's forms" if problem.is_flat and len(problem.variables) == 1 else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The formula; blocks of lower degree for a leading coefficient 0. None for conditions of another kind.

        Raises ``Unable`` where minors grow past their limits or signs do not decide, ``BudgetExceeded``.
        """
        dual = problem.dual
        ring = dual.body.ring
        if ring is None or dual.variables[0] not in ring.index:
            return None
        x = ring.index[dual.variables[0]]
        question = read(dual.body, x)
        if question is None:
            return None
        formula = answer(question, x, context.budget)
        return Outcome(context.log.step(self.name, problem.formula, problem.asked(formula)))


def answer(question: Question, x: int, budget: Budget) -> Formula:
    """Equivalent to the question, in the parameters but for the case of a leading coefficient 0."""
    table = _decisive(question, budget)
    lead, regular, lower = question.f[-1], _formula(question, table), question.degenerate(x)
    if lower != TRUE:
        regular = conj((atom(lead, Relation.NE), regular))
    return conj((question.side, disj((regular, conj((atom(lead, Relation.EQ), lower))))))


@dataclass(frozen=True)
class _Table:
    """The rows that are possible, each once, with the answers that the types they belong to give."""

    polys: tuple[Poly, ...]
    rows: tuple[Signs, ...]
    truths: tuple[frozenset[bool], ...]
    discriminant: Poly


def _decisive(question: Question, budget: Budget) -> _Table:
    """A table without rows that decide nothing."""
    shape = question.shape
    for squares in (False, True) if shape.place is Place.CONDITION else (False,):
        table = _table(question, replace(shape, squares=squares), budget)
        if all(len(truths) == 1 for truths in table.truths):
            return table
    raise Unable("the signs of Hermite's forms do not decide")


def _table(question: Question, shape: Shape, budget: Budget) -> _Table:
    """The rows that suit the polynomials: constant ones, and such as are multiples of each other."""
    polys = _polynomials(question, shape, budget)
    listed = [polys[name] for name in shape.names]
    columns: dict[Poly, tuple[int, int]] = {}
    checks: list[tuple[int, int, int]] = []  # a column whose sign is that of another, or of 1, times a number
    for k, p in enumerate(listed):
        unit, normal = p.normal()
        turn = (unit > 0) - (unit < 0)
        if p.is_constant:
            checks.append((k, -1, turn))
        elif normal in columns:
            other, factor = columns[normal]
            checks.append((k, other, turn * factor))
        else:
            columns[normal] = (k, turn)
    kept = [k for k, _ in columns.values()]
    truths_by_signs: dict[Signs, set[bool]] = {}
    held: dict[tuple[int, RootType], bool] = {}
    for signs, lead, kind in rows(shape):
        if all(signs[k] == (turn if other < 0 else turn * signs[other]) for k, other, turn in checks):
            if (lead, kind) not in held:
                held[lead, kind] = question.holds(lead, kind)
            truths_by_signs.setdefault(tuple([signs[k] for k in kept]), set()).add(held[lead, kind])
    budget.check("rows of signs")
    budget.spend(len(truths_by_signs) // 20)
    truths = tuple(frozenset(t) for t in truths_by_signs.values())
    return _Table(tuple(listed[k] for k in kept), tuple(truths_by_signs), truths, polys["P", shape.degree])


def _polynomials(question: Question, shape: Shape, budget: Budget) -> dict[Name, Poly]:
    """The literals."""
    f = question.f
    named: dict[Name, Poly] = {("c", k): p for k, p in enumerate(f)}
    forms = {"P": special(f, (1,), budget)}
    if shape.place is not Place.LINE:
        forms["A"] = special(f, (0, 1), budget) if shape.place is Place.RAY else minors(f, question.g, budget)
    if shape.squares:
        g, zero = question.g, f[0].ring.constant(0)
        inside = ([(i, k - i) for i in range(len(g)) if 0 <= k - i < len(g)] for k in range(2 * len(g) - 1))
        forms["Q"] = minors(f, [sum((g[i] * g[j] for i, j in pairs), zero) for pairs in inside], budget)
    for name, listed in forms.items():
        named |= {(name, k): p for k, p in enumerate(listed, 1)}
    if shape.invariant:
        e, d, c, b, a = f
        named["I", 0] = 12 * (a * e) - 3 * (b * d) + c * c
    return named


def _formula(question: Question, table: _Table) -> Formula:
    """True on the rows with the answer yes, false on those with no; cases by the first and last coefficient and the
    discriminant where that is shorter."""
    true = sum(1 << k for k, t in enumerate(table.truths) if True in t)
    false = (1 << len(table.rows)) - 1 - true
    if not true:
        return FALSE
    splitting = [p for p in dict.fromkeys((question.f[-1], question.f[0], table.discriminant)) if p in table.polys]
    return Rows(table.polys, table.rows).formula(true, false, splitting)
