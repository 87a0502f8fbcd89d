"""Checking a cell table from scratch.

THEOREM. Let the factor lists be closed under the projection (``closure``), and let every stack list exactly the
real roots of its factors over the sample of its cell (``stacks``). Then every listed factor is sign-invariant on
every cell on which it was decomposed (Lazard: McCallum, Parusinski, Paunescu 2019; Brown-McCallum: Brown 2001
where no factor is nullified on a cell of positive dimension). So a formula that three-valued evaluation decides
from these signs has that truth value on the whole cell, and a quantifier over a decomposed cell ranges exactly
over its stack (Collins, Hong 1991): the truth values, and the answer formula compared with them, hold for all
points and not for the samples only.

Where an equational constraint restricts a level, the other factors are invariant on the constraint's sections alone
(McCallum 1999, 2001; ``closure``). A sector is then a leaf, and its truth value has to follow from the signs of
the constraint's factors: that the matrix implies the constraint is thus proved where it is used.

Each of these statements is about one cell, its stack and the cells below it. So where parts are claimed, other cells
over the free variables may be open: nothing follows from them, and the parts must be false there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.kernel.arithmetic.products import FactorLists, check_lists
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.closure import check_closure
from qe.kernel.matrix import Situation, Test, compiled, strengthened
from qe.kernel.stacks import Checked, Fail, Sample, StackChecker
from qe.options import Budget
from qe.proof.cells import Cell, CellTable
from qe.proof.cells_json import CellEvidence
from qe.truth import Truth, conjunction, disjunction

Path = tuple["Path", str] | str


def check_cells(evidence: CellEvidence, budget: Budget) -> None:
    """``CertificateRejected`` naming the first entry that fails; returns if the table proves what it says.

    Raises ``Unable`` where that is not decided within the budget and the limits of size.
    """
    table = evidence.table
    ring = Ring.of(table.order)
    free = _check_header(table)
    check_lists(ring, table.factors)
    lists = FactorLists(ring, table.factors)
    closure = check_closure(lists, table.projection, table.constraints, budget)
    matrix = strengthened(table.matrix, lists, closure, "payload.matrix")
    answer = None if evidence.answer is None else compiled(evidence.answer, lists, "payload.answer")
    if answer is not None and evidence.parts is not None:
        raise CertificateRejected("payload.parts", "an answer has no parts")
    parts = [compiled(part, lists, f"payload.parts[{k}]") for k, part in enumerate(evidence.parts or ())]
    checker = StackChecker(lists, closure)
    walk = _Walk(table, free, checker, matrix, answer, parts, budget)
    sample = Sample(Point(budget=budget), {}, lists.lists, [], (0,))
    if table.root.signs:
        raise CertificateRejected("payload.root.signs", "the whole space has no signs")
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


@dataclass(frozen=True, slots=True)
class _Walk:
    """The recursion over the cells, with what does not change on the way."""

    table: CellTable
    free: int
    checker: StackChecker
    matrix: Test
    answer: Test | None
    parts: Sequence[Test]
    budget: Budget

    def cell(
        self, cell: Cell, sample: Sample | None, situation: Situation, path: Path, *, follows: bool = False
    ) -> None:
        """Check everything said about a cell; ``sample`` is None for a leaf. ``follows``: its truth, from others."""
        depth = len(situation.signs)
        self.budget.check("verify")
        if cell.stack is None or sample is None:
            value = self.matrix(situation)
            if cell.truth is not None and value is not cell.truth and not (value is None and follows):
                said = "does not follow from the signs" if value is None else f"is {value} by the signs"
                raise CertificateRejected(_text((path, ".truth")), f"said to be {cell.truth}, {said}")
        else:
            value = self._decomposed(cell, sample, situation, path)
        if depth <= self.free:
            self._check_free(cell, depth, situation, path)

    def _check_free(self, cell: Cell, depth: int, situation: Situation, path: Path) -> None:
        """Cells over free variables: undecomposed ones have a truth value, and the answer agrees with it.

        Where parts are claimed a cell may be open; a part is false by the signs on every cell of another truth value.
        """
        if depth < self.free and cell.stack is not None:
            return
        if self.parts:
            for k, (part, truth) in enumerate(zip(self.parts, (True, False), strict=True)):
                if cell.truth is not truth and part(situation) is not False:
                    raise CertificateRejected(f"payload.parts[{k}]", f"not excluded on {_text(path)}: {cell.truth}")
            return
        if cell.truth is None:
            raise CertificateRejected(_text((path, ".truth")), "no truth value for a cell over the free variables")
        if self.answer is not None and self.answer(situation) is not cell.truth:
            raise CertificateRejected("payload.answer", f"differs from the truth value {cell.truth} of {_text(path)}")

    def _decomposed(self, cell: Cell, sample: Sample, situation: Situation, path: Path) -> Truth:
        stack = cell.stack
        assert stack is not None
        here: Path = (path, ".stack")

        def fail(entry: str, reason: str) -> CertificateRejected:
            return CertificateRejected(_text((here, f".{entry}")), reason)

        if sample.depth >= len(self.table.order):
            raise fail("cells", "a stack above the last variable")
        checked = self.checker.check(stack, sample, fail)
        below = Situation(  # filled in for one child after the other; deeper levels copy what they need
            [*situation.signs, []],
            [*situation.sections, stack.sections],
            [*situation.isolated, frozenset(checked.branches)],
            [*situation.nullified, checked.nullified],
            [*situation.positions, 0],
        )
        way = one_way(self.table, sample.depth) if sample.depth == self.free - 1 else 0
        for position, child in enumerate(stack.cells):
            row = checked.signs[position]
            below.signs[-1], below.positions[-1] = row, position
            expected = "".join([_CHARACTERS[row[i]] for i in stack.used])
            if child.signs != expected:
                raise fail(f"cells[{position}].signs", f"said to be {child.signs!r}, found {expected!r}")
            if child.stack is not None and checked.restricted and position % 2 == 0:
                raise fail(f"cells[{position}].stack", "only the sections of a constraint may be decomposed")
            deeper = None if child.stack is None else self._child(sample, checked, cell, position, fail)
            follows = bool(way) and self._follows(stack.cells, position, way)
            self.cell(child, deeper, below, (here, f".cells[{position}]"), follows=follows)
        value = self._aggregate(cell, sample.depth)
        if cell.truth is not value:
            raise CertificateRejected(_text((path, ".truth")), f"said to be {cell.truth}, follows to be {value}")
        return value

    @staticmethod
    def _follows(cells: Sequence[Cell], position: int, way: int) -> bool:
        """Whether the truth of a cell follows from a decomposed one of the stack (``one_way``)."""
        truth = cells[position].truth
        upward = (truth is True) == (way > 0)  # from a cell below
        others = cells[:position] if upward else cells[position + 1 :]
        return truth is not None and any(c.stack is not None and c.truth is truth for c in others)

    def _aggregate(self, cell: Cell, level: int) -> Truth:
        assert cell.stack is not None
        kind = self.table.quantifiers[level]
        cells = cell.stack.cells
        if kind and sectors_suffice(self.table, level):
            cells = tuple(c for position, c in enumerate(cells) if position % 2 == 0 or c.truth is not None)
        match kind:
            case "E":
                return disjunction(c.truth for c in cells)
            case "A":
                return conjunction(c.truth for c in cells)
        return None

    def _child(self, sample: Sample, checked: Checked, cell: Cell, position: int, fail: Fail) -> Sample:
        stack = cell.stack
        assert stack is not None
        if position // 2 in checked.places and position % 2:
            return checked.places[position // 2]
        if position % 2:
            number = self.checker.section_coordinate(checked, stack, position // 2, fail)
            return sample.extended(number, checked.signs[position], sector=False)
        return sample.extended(stack.sectors[position // 2], checked.signs[position], sector=True)


def sectors_suffice(table: CellTable, level: int) -> bool:
    """Whether a quantified stack of this level is decided by its sectors alone.

    THEOREM. If the matrix is a positive combination of atoms <, >, /= and the quantifiers from ``level`` on are all
    existential, the values of x_level over any point that can be completed to a solution form an open set: if it
    is not empty it meets a sector, the sections being finitely many points. Dually for atoms <=, >=, = and
    universal quantifiers, where the exceptions form an open set.
    """
    later = set(table.quantifiers[level:])
    if later == {"E"}:
        return _positive(table.matrix, (Relation.LT, Relation.GT, Relation.NE))
    return later == {"A"} and _positive(table.matrix, (Relation.LE, Relation.GE, Relation.EQ))


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


def _positive(formula: Formula, relations: tuple[Relation, ...]) -> bool:
    match formula:
        case Constant():
            return True
        case Atom(_, relation):
            return relation in relations
        case And(args) | Or(args):
            return all(_positive(a, relations) for a in args)
    return False


_CHARACTERS = {1: "+", -1: "-", 0: "0", None: "?"}


def _text(path: Path) -> str:
    return path if isinstance(path, str) else _text(path[0]) + path[1]
