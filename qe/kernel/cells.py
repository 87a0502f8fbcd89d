"""Checking a tree of cells from scratch: cell tables, and coverings of lines by intervals.

A tree has a line over the sample of each of its cells that is decomposed. A cell of a line is a sector or a section, or
an interval from one position to another, with the sample at one of these. Its ``own`` factors, of the level of the
line, keep their signs on it (all that the line uses, where it is a position). So does what is own on the cells below
it: these signs hold on the whole set of points for which the cell stands.

THEOREM. Let the line over a sample be correct (``line``). Around the sample, on a connected set, let all factors be
order-invariant that the own ones of its cells need (``Projected.needed``). Let a cell contain no root of its own
factors, or be such a root; let its ends be roots of them; let neighbours share the root between them, or overlap and
let the resultant of the factors with these roots be order-invariant, too. Then over the whole set the cells have their
signs and cover the line (Collins 1975; Ábrahám, Davenport, England, Kremer 2021, section 4; Nalbach, Kremer 2024). So a
formula that three-valued evaluation decides from these signs has that truth value on the cell, and a quantifier has the
value that the cells have, or that one of them decides (Collins, Hong 1991). A point alone is such a set whatever is
zero there; nor is anything else asked over a cell that stands for its sample only, a value of a variable that decides
its quantifier.

A factor that is zero on the line over the sample is so where its coefficients are zero: it has the sign 0 on all cells
if these are invariant. Lines above need its order, too: let all partial derivatives of order < m be zero on the line
and one of order m, whose factors are own ones of the cell, not. Then it has order m on the cell over the sample; so
this must be the only point below.

Where an equational constraint restricts a level, the other factors are invariant on the constraint's sections alone.
The truth value of a sector then has to follow from the signs of the constraint's factors: that the matrix implies the
constraint is thus proved where it is used.

Each of these statements is about one cell, its line and the cells below it. So cells over the free variables on which
what is given is false may be open, without truth value: nothing follows from them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.kernel.arithmetic.products import FactorLists, check_lists
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.line import Sample, line_over
from qe.kernel.matrix import Situation, Test, compiled, strengthened
from qe.kernel.negation import negation
from qe.kernel.neighbourhood import Neighbourhood
from qe.kernel.open_block import shows_open
from qe.kernel.projection import Projected
from qe.options import Budget, Projection
from qe.proof.cells import CHARACTER_OF, Cell, CellTable, Stack
from qe.truth import Truth

Path = tuple["Path", str] | str


def check_cells(table: CellTable, answer: Formula | None, given: Sequence[Formula], budget: Budget) -> None:
    """``CertificateRejected`` naming the first entry that fails; returns if the tree is right and the answer has its
    truth values wherever what is ``given`` holds, as far as that is about products of listed factors.

    Raises ``Unable`` where that is not decided within the budget and the limits of size.
    """
    ring = Ring.of(table.order)
    free = _check_header(table)
    check_lists(ring, table.factors)
    lists = FactorLists(ring, table.factors)
    constraints = _constraints(table)
    projection = Projected(lists, budget, evaluates=table.projection is Projection.LAZARD)
    matrix = strengthened(table.matrix, lists, constraints, "payload.matrix")
    after = None if answer is None else compiled(answer, lists, "answer")
    facts = []
    for fact in given:
        with suppress(CertificateRejected):
            facts.append(compiled(fact, lists, "context"))
    walk = _Walk(table, free, constraints, projection, matrix, after, facts, budget)
    if table.root.signs:
        raise CertificateRejected("payload.root.signs", "the whole space has no signs")
    sample = Sample(lists, Point(budget=budget), {}, [], (0,))
    walk.cell(table.root, sample, Situation([], [], [], [], []), "payload.root")


def _check_header(table: CellTable) -> int:
    """The number of free variables, which come first."""
    if len(table.quantifiers) != len(table.order):
        raise CertificateRejected("payload.quantifiers", "expected one entry per variable")
    free = 0
    for k, quantifier in enumerate(table.quantifiers):
        if quantifier not in ("", "E", "A"):
            raise CertificateRejected(f"payload.quantifiers[{k}]", 'expected "", "E" or "A"')
        if quantifier == "":
            if free < k:
                raise CertificateRejected(f"payload.quantifiers[{k}]", "a free variable after a quantified one")
            free = k + 1
    return free


def _constraints(table: CellTable) -> tuple[frozenset[int], ...]:
    """The factors of the constraint of every level, where there are any and the operator allows it."""
    if table.projection not in (Projection.LAZARD, Projection.BROWN_MCCALLUM):
        raise CertificateRejected("payload.projection", "an operator that this checker has no theorem for")
    listed = table.constraints or ((),) * len(table.order)
    if len(listed) != len(table.order):
        raise CertificateRejected("payload.constraints", "expected one list per variable, or none")
    for k, own in enumerate(listed):
        if any(a >= b for a, b in pairwise(own)) or (own and not 0 <= own[0] <= own[-1] < len(table.factors[k])):
            raise CertificateRejected(f"payload.constraints[{k}]", "not an ascending list of factors of this level")
        if own and table.projection is Projection.LAZARD:
            raise CertificateRejected("payload.projection", "no theorem restricts this operator by constraints")
    return tuple(map(frozenset, listed))


@dataclass(frozen=True, slots=True)
class _Walk:
    """The recursion over the cells, with what does not change on the way."""

    table: CellTable
    free: int
    constraints: Sequence[frozenset[int]]
    projection: Projected
    matrix: Test
    answer: Test | None
    facts: Sequence[Test]
    budget: Budget

    def cell(
        self, cell: Cell, sample: Sample | None, situation: Situation, path: Path, *, follows: bool = False
    ) -> Truth:
        """The truth value of a cell, after a check of everything said about it; ``sample`` is None for a leaf.
        ``follows``: its truth, from others."""
        depth = len(situation.signs)
        self.budget.check("verify")
        if cell.stack is not None and sample is not None:
            value = self._decomposed(cell.stack, sample, situation, (path, ".stack"))
        else:
            value = self.matrix(situation) if cell.truth is not None or cell.reach is not None else None
            if value is None and follows:
                value = cell.truth
        if value is not cell.truth and (cell.truth is not None or cell.reach is None):
            said = "does not follow from the signs" if value is None else f"follows to be {value}"
            raise CertificateRejected(_text((path, ".truth")), f"said to be {cell.truth}, {said}")
        if depth == self.free or (depth < self.free and cell.stack is None):
            self._check_free(value, situation, path)
        return value

    def _check_free(self, truth: Truth, situation: Situation, path: Path) -> None:
        """Cells over free variables have a truth value, and the answer agrees with it, unless a fact is false there."""
        if any(fact(situation) is False for fact in self.facts):
            return
        if truth is None:
            raise CertificateRejected(_text((path, ".truth")), "no truth value for a cell over the free variables")
        if self.answer is not None and self.answer(situation) is not truth:
            raise CertificateRejected("answer", f"differs from the truth value {truth} of {_text(path)}")

    def _decomposed(self, stack: Stack, sample: Sample, situation: Situation, here: Path) -> Truth:
        def fail(entry: str, reason: str) -> CertificateRejected:
            return CertificateRejected(_text((here, f".{entry}")), reason)

        k = sample.depth
        if k >= len(self.table.order):
            raise fail("cells", "a stack above the last variable")
        is_plain = all(cell.reach is None for cell in stack.cells)
        if is_plain and k + 1 < len(self.table.order) and len(stack.used) != len(self.table.factors[k]):
            raise fail("used", "a factor of this level is missing")  # who reads a decomposition relies on all of them
        line = line_over(sample, stack, self.constraints[k], fail, evaluates=self.projection.evaluates)
        around = Neighbourhood(line, situation.signs, self.projection)
        parts = around.parts()
        if not sample.is_alone:
            around.check_delineated(parts)
        below = Situation(  # filled in for one child after the other; deeper levels copy what they need
            [*situation.signs, []],
            [*situation.sections, stack.sections],
            [*situation.isolated, frozenset()],
            [*situation.nullified, frozenset()],
            [*situation.positions, 0],
        )
        way = one_way(self.table, k) if k == self.free - 1 and is_plain else 0
        truths = []
        for place, part in enumerate(parts):
            deeper = around.sample_of(part)
            row = line.signs[part.at]
            expected = "" if part.cell.reach else "".join([CHARACTER_OF[row[i]] for i in stack.used])
            if part.cell.signs != expected:
                raise fail(f"cells[{place}].signs", f"said to be {part.cell.signs!r}, found {expected!r}")
            known = around.known(part)
            below.signs[-1] = row if len(known) == len(row) else [s if i in known else None for i, s in enumerate(row)]
            below.isolated[-1], below.nullified[-1] = known.intersection(line.branches), known & line.zero
            below.positions[-1] = part.at
            follows = bool(way) and self._follows(stack.cells, place, way)
            truths.append(self.cell(part.cell, deeper, below, (here, f".cells[{place}]"), follows=follows))
        kind = self.table.quantifiers[k]
        if kind and (kind == "E") in truths:
            return kind == "E"
        around.check_cover(parts)
        if None in truths and kind and sectors_suffice(self.table, k):
            truths = [t for part, t in zip(parts, truths, strict=True) if t is not None or part.first % 2 == 0]
        return None if not kind or None in truths else kind == "A"

    @staticmethod
    def _follows(cells: Sequence[Cell], position: int, way: int) -> bool:
        """Whether the truth of a cell follows from a decomposed one of the stack (``one_way``)."""
        truth = cells[position].truth
        upward = (truth is True) == (way > 0)  # from a cell below
        others = cells[:position] if upward else cells[position + 1 :]
        return truth is not None and any(c.stack is not None and c.truth is truth for c in others)


def sectors_suffice(table: CellTable, level: int) -> bool:
    """Whether a quantified stack of this level is decided by its sectors alone.

    THEOREM. If the matrix is a positive combination of atoms <, >, /= and the quantifiers from ``level`` on are all
    existential, the values of x_level over any point that can be completed to a solution form an open set: if it
    is not empty it meets a sector, the sections being finitely many points. Dually for atoms <=, >=, = and
    universal quantifiers, where the exceptions form an open set.
    """
    later = {*table.quantifiers[level:]}
    if later == {"E"}:
        return shows_open(table.matrix, table.order)
    return later == {"A"} and shows_open(negation(table.matrix), table.order)


def one_way(table: CellTable, level: int) -> int:
    """1 if the formula stays true where the level's variable grows alone, -1 where it falls; 0 if that is not seen.

    THEOREM. Let each comparison in a positive combination that has x be p > 0 or p >= 0 where dp/dx is nowhere
    negative, or p < 0 or p <= 0 where it is nowhere positive. Each stays true where x grows, and with them the matrix
    and what quantifiers over other variables make of it. So over each point of a cell, what is true (false) on a cell
    of the stack is so on those above (below) it.
    """
    if all(_goes(table.matrix, level, 1)):
        return 1
    return -1 if all(_goes(table.matrix, level, -1)) else 0


def _goes(formula: Formula, x: int, way: int) -> Iterator[bool]:
    match formula:
        case Constant():
            return
        case Atom(poly, relation):
            sense = {Relation.GT: way, Relation.GE: way, Relation.LT: -way, Relation.LE: -way}.get(relation)
            slope = poly.derivative(x).terms()
            even = all(exponent % 2 == 0 for exponents, _ in slope for exponent in exponents)
            yield not slope or (sense is not None and even and all(c * sense > 0 for _, c in slope))
        case And(args) | Or(args):
            for part in args:
                yield from _goes(part, x, way)
        case _:
            yield False


def _text(path: Path) -> str:
    return path if isinstance(path, str) else _text(path[0]) + path[1]
