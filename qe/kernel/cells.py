"""Checking a cylindrical tree from scratch: cell tables, and coverings of lines by intervals.

A tree has a line over the sample of each of its cells that is decomposed. A cell of a line is a sector or a section, or
an interval from one position to another, with the sample at one of these; ``own`` are the factors of the level that keep
their signs on it (all that the line uses, where it is a position). What has a sign at the sample of a cell and is its
own, or own of a cell below it, has this sign on the whole set of points for which the cell stands.

THEOREM. Let the line over a sample be correct (``line``), and over some connected set around the sample let all factors
that ``Projection.needed`` names for the own factors of each cell be order-invariant. Let a cell of the line contain no
root of its own factors, or be such a root, and let its ends be roots of them; let its neighbours share the root at which
one ends and the other begins, or overlap and let the resultant of the two factors be order-invariant, too. Then over the
whole set the cells have their signs and cover the line (``projection``; Ábrahám, Davenport, England, Kremer 2021,
section 4; Nalbach, Kremer 2024). So a formula that three-valued evaluation decides from these signs has that truth value
on the cell, and a quantifier has the value that the cells give it, or that one of them decides (Collins, Hong 1991).
A point alone is such a set whatever is zero there; nor is anything else asked below a cell that stands for its sample
only, as a value of a variable that decides its quantifier.

A factor that is zero on the line over the sample is so where its coefficients are zero: it has the sign 0 on all cells if
these are invariant. Lines above need its order, too: let all partial derivatives of order < m be zero on the line and one
of order m, whose factors are own ones of the cell, not. Then it has order m on the cell over the sample; so this must be
the only point below.

Where an equational constraint restricts a level, the other factors are invariant on the constraint's sections alone. The
truth value of a sector then has to follow from the signs of the constraint's factors: that the matrix implies the
constraint is thus proved where it is used.

Each of these statements is about one cell, its line and the cells below it. So where parts are claimed, other cells
over the free variables may be open: nothing follows from them, and the parts must be false there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import And, Atom, Constant, Formula, Or, Relation
from qe.kernel.arithmetic.products import FactorLists, check_lists
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.line import Line, Sample, line_over
from qe.kernel.matrix import Situation, Test, compiled, strengthened
from qe.kernel.projection import RESULTANT, Factor, Projection, factors
from qe.options import Budget
from qe.options import Projection as Operator
from qe.proof.cells import CHARACTER_OF, Cell, CellTable, Stack
from qe.proof.cells_json import CellEvidence
from qe.truth import Truth

Path = tuple["Path", str] | str


def check_cells(evidence: CellEvidence, budget: Budget) -> None:
    """``CertificateRejected`` naming the first entry that fails; returns if the tree proves what it says.

    Raises ``Unable`` where that is not decided within the budget and the limits of size.
    """
    table = evidence.table
    ring = Ring.of(table.order)
    free = _check_header(table)
    check_lists(ring, table.factors)
    lists = FactorLists(ring, table.factors)
    constraints = _constraints(table)
    projection = Projection(lists, budget, evaluates=table.projection is Operator.LAZARD)
    matrix = strengthened(table.matrix, lists, constraints, "payload.matrix")
    answer = None if evidence.answer is None else compiled(evidence.answer, lists, "payload.answer")
    if answer is not None and evidence.parts is not None:
        raise CertificateRejected("payload.parts", "an answer has no parts")
    parts = [compiled(part, lists, f"payload.parts[{k}]") for k, part in enumerate(evidence.parts or ())]
    walk = _Walk(table, free, constraints, projection, matrix, answer, parts, budget)
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
    if table.projection not in (Operator.LAZARD, Operator.BROWN_MCCALLUM):
        raise CertificateRejected("payload.projection", "an operator that this checker has no theorem for")
    listed = table.constraints or ((),) * len(table.order)
    if len(listed) != len(table.order):
        raise CertificateRejected("payload.constraints", "expected one list per variable, or none")
    for k, own in enumerate(listed):
        if any(a >= b for a, b in pairwise(own)) or (own and not 0 <= own[0] <= own[-1] < len(table.factors[k])):
            raise CertificateRejected(f"payload.constraints[{k}]", "not an ascending list of factors of this level")
        if own and table.projection is Operator.LAZARD:
            raise CertificateRejected("payload.projection", "no theorem restricts this operator by constraints")
    return tuple(map(frozenset, listed))


@dataclass(frozen=True, slots=True)
class _Part:
    """A cell on its line: the first and last position, that of the sample, its own factors that have a root somewhere, and
    the sections at its ends. ``is_point``: it is one point of the line."""

    cell: Cell
    first: int
    last: int
    at: int
    own: frozenset[int]
    is_point: bool
    low: frozenset[int] | None
    high: frozenset[int] | None


@dataclass(frozen=True, slots=True)
class _Walk:
    """The recursion over the cells, with what does not change on the way."""

    table: CellTable
    free: int
    constraints: Sequence[frozenset[int]]
    projection: Projection
    matrix: Test
    answer: Test | None
    parts: Sequence[Test]
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
        """Cells over free variables have a truth value, and the answer agrees with it.

        Where parts are claimed a cell may be open; a part is false by the signs on every cell of another truth value.
        """
        if self.parts:
            for k, (part, value) in enumerate(zip(self.parts, (True, False), strict=True)):
                if truth is not value and part(situation) is not False:
                    raise CertificateRejected(f"payload.parts[{k}]", f"not excluded on {_text(path)}: {truth}")
            return
        if truth is None:
            raise CertificateRejected(_text((path, ".truth")), "no truth value for a cell over the free variables")
        if self.answer is not None and self.answer(situation) is not truth:
            raise CertificateRejected("payload.answer", f"differs from the truth value {truth} of {_text(path)}")

    def _decomposed(self, stack: Stack, sample: Sample, situation: Situation, here: Path) -> Truth:
        def fail(entry: str, reason: str) -> CertificateRejected:
            return CertificateRejected(_text((here, f".{entry}")), reason)

        k = sample.depth
        if k >= len(self.table.order):
            raise fail("cells", "a stack above the last variable")
        line = line_over(sample, stack, self.constraints[k], self.projection, fail)
        parts = self._parts(line)
        if not sample.is_alone:
            self._check_delineated(parts, line, situation)
        below = Situation(  # filled in for one child after the other; deeper levels copy what they need
            [*situation.signs, []],
            [*situation.sections, stack.sections],
            [*situation.isolated, frozenset()],
            [*situation.nullified, frozenset()],
            [*situation.positions, 0],
        )
        way = one_way(self.table, k) if k == self.free - 1 else 0
        truths = []
        for place, part in enumerate(parts):
            deeper = self._deeper(part, line)
            row = line.signs[part.at]
            expected = "" if part.cell.reach else "".join([CHARACTER_OF[row[i]] for i in stack.used])
            if part.cell.signs != expected:
                raise fail(f"cells[{place}].signs", f"said to be {part.cell.signs!r}, found {expected!r}")
            known = self._known(part, line, situation)
            below.signs[-1] = row if len(known) == len(row) else [s if i in known else None for i, s in enumerate(row)]
            below.isolated[-1], below.nullified[-1] = known.intersection(line.branches), known & line.zero
            below.positions[-1] = part.at
            follows = bool(way) and self._follows(stack.cells, place, way)
            truths.append(self.cell(part.cell, deeper, below, (here, f".cells[{place}]"), follows=follows))
        kind = self.table.quantifiers[k]
        if kind and (kind == "E") in truths:
            return kind == "E"
        self._check_cover(parts, line, situation)
        if None in truths and kind and sectors_suffice(self.table, k):
            truths = [t for part, t in zip(parts, truths, strict=True) if t is not None or part.first % 2 == 0]
        return None if not kind or None in truths else kind == "A"

    # --- the cells of a line ----------------------------------------------------------------------
    def _parts(self, line: Line) -> list[_Part]:
        """The cells, each without a root of its own factors or at one, and with such roots at its ends."""
        cells, sections, end = line.stack.cells, line.stack.sections, len(line.signs) - 1
        everything, parts = frozenset(line.stack.used), list[_Part]()
        for place, cell in enumerate(cells):
            entry = f"cells[{place}]"
            first, last, at = cell.reach or (place, place, place)
            if not first <= at <= last <= end or (cell.reach is None and len(cells) != end + 1):
                raise line.fail("cells", f"{len(cells)} cells do not stand at {end + 1} positions, at {entry}")
            if cell.reach is None:
                own = everything if place % 2 else everything.intersection(line.branches)
            elif cell.own is not None and not self.projection.evaluates and line.branches.keys() >= {*cell.own}:
                own = frozenset(cell.own)
            elif cell.own is None and line.sample.is_alone:
                parts.append(_Part(cell, first, last, at, everything, True, None, None))
                continue
            else:
                raise line.fail(
                    f"{entry}.own", "factors that the line uses expected, as it is asked what holds beside the sample"
                )
            if not self.projection.evaluates:
                own -= line.zero
            is_point = any(own.intersection(section) for section in sections[first // 2 : (last + 1) // 2])
            if is_point and first < last:
                raise line.fail(entry, "it contains a root of one of its factors")
            if not is_point and (first % 2 or last % 2):
                raise line.fail(entry, "a cell that is no root begins and ends with a sector")
            low = own.intersection(sections[(first - 1) // 2]) if first else None
            high = own.intersection(sections[last // 2]) if last < end else None
            if frozenset() in (low, high):
                raise line.fail(entry, "none of its factors has a root at its end")
            parts.append(_Part(cell, first, last, at, own, is_point, low, high))
        return parts

    def _deeper(self, part: _Part, line: Line) -> Sample | None:
        """The sample of a cell, where it is needed: for what stands above, or for signs of factors besides a constraint's,
        which are put in the row of its position."""
        others = part.own.difference(line.branches) if part.cell.reach is None else ()
        if part.cell.stack is None and not others:
            return None
        row, k = line.signs[part.at], line.sample.depth
        deeper = line.sample.extended(line.number(part.at), row, alone=part.is_point)
        for i in others:
            row[i] = deeper.point.sign(deeper.factor(k, i))
        return deeper

    def _known(self, part: _Part, line: Line, situation: Situation) -> frozenset[int]:
        """The factors of the level whose signs at the sample are those on the whole cell."""
        row, sample = line.signs[part.at], line.sample
        if part.is_point and sample.is_alone:
            return frozenset(range(len(row)))
        if part.cell.reach is None and not line.zero and len(part.own) == len(row):
            return part.own
        zero = (i for i in line.zero if self._stays_zero(i, part, line, situation))
        return part.own | frozenset(zero)

    def _stays_zero(self, i: int, part: _Part, line: Line, situation: Situation) -> bool:
        """Whether a factor that is zero on the line over the sample is zero on the whole cell, and its order known where
        that is needed."""
        sample, f = line.sample, self.projection.lists.lists[line.sample.depth][i]
        if self.projection.evaluates:
            return True
        if part.cell.stack is not None:
            return sample.is_alone and self._has_order(f, part, sample)
        products = [self.projection.lists.decompose(c) for c in f.coefficients(sample.depth) if c]
        return sample.is_alone or all(
            p is not None and self._missing(factors(p), sample, situation) is None for p in products
        )

    def _has_order(self, f: Poly, part: _Part, sample: Sample) -> bool:
        """Whether a partial derivative of least order that is not zero on the line has its factors among the cell's own."""
        partials = [f]
        while all(map(sample.is_zero, partials)):
            self.budget.check("verify")
            partials = list({g.derivative(i): None for g in partials for i in g.variables})
        products = [self.projection.lists.decompose(g) for g in partials if not sample.is_zero(g)]
        return any(p and all(i in part.own for k, i in factors(p) if k == sample.depth) for p in products)

    # --- what holds beside the sample -------------------------------------------------------------
    def _missing(self, needed: Iterable[Factor], sample: Sample, situation: Situation) -> Factor | None:
        """A factor that is not known to be invariant around the sample."""
        for level, i in needed:
            if situation.signs[level][i] is None and sample.dimensions[level + 1]:
                return level, i
        return None

    def _check_delineated(self, parts: Sequence[_Part], line: Line, situation: Situation) -> None:
        """Everything that the own factors of the cells need is invariant around the sample."""
        k, sample, seen = line.sample.depth, line.sample, set[tuple[frozenset[int], frozenset[int], bool]]()
        for part in parts:
            core = part.own.intersection(line.branches)
            order = part.cell.stack is not None
            if (part.own, core, order) in seen:
                continue
            seen.add((part.own, core, order))
            missing = self._missing(self.projection.needed(k, part.own, core, order=order), sample, situation)
            if missing is not None:
                raise line.fail(
                    "cells", f"factor {missing[1]} of level {missing[0]}, of the projection, may change its sign or order"
                )
            for i in part.own if order else core:
                self._check_not_nullified(i, line, situation)

    def _check_not_nullified(self, i: int, line: Line, situation: Situation) -> None:
        """A factor is not zero on a whole line around the sample: a coefficient, or a combination of these, is not zero
        there, and invariant. On level 1 the leading coefficient is not, or the sample is alone."""
        sample = line.sample
        if self.projection.evaluates or sample.depth == 1:
            return
        for witness in self.projection.not_nullified(sample.depth, i):
            product = self.projection.lists.decompose(witness)
            if product is None:
                if not sample.dimensions[witness.level + 1] and sample.sign(witness):
                    return
            elif self._missing(factors(product), sample, situation) is None and sample.sign_of(product):
                return
        raise line.fail("used", f"factor {i} may vanish identically at a point of the cell (Brown 2001, theorem 3.1)")

    def _check_cover(self, parts: Sequence[_Part], line: Line, situation: Situation) -> None:
        """Each cell begins where the one before ends, or before that, also around the sample."""
        if any(part.cell.reach is not None and part.cell.own is None for part in parts):
            raise line.fail("cells", "it is asked what holds beside the sample")
        if not parts or parts[0].low is not None or parts[-1].high is not None:
            raise line.fail("cells", "the line is not covered to its ends")
        for place, (one, other) in enumerate(pairwise(parts)):
            if other.first > one.last + 1:
                raise line.fail("cells", f"there is a gap before cell {place + 1}")
            high, low, k = one.high or frozenset(), other.low or frozenset(), line.sample.depth
            if line.sample.is_alone or one.high is None or other.low is None or high & low:
                continue
            pairs = [self.projection.product(RESULTANT, k, *sorted((i, j))) for i in high for j in low]
            if not any(p and p.unit and self._missing(factors(p), line.sample, situation) is None for p in pairs):
                raise line.fail("cells", f"cell {place} and the next need not meet around the sample")

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


def _text(path: Path) -> str:
    return path if isinstance(path, str) else _text(path[0]) + path[1]
