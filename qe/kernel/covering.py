"""Rule "covering": a formula and its quantifier-free answer, by a cylindrical algebraic covering.

Evidence: a prenex form of the formula (``order``, free variables first, ``quantifiers``, ``matrix``); ``factors`` by
level; ``line``, what is known of the first axis. A line has ``used`` (indices of factors of its level), ``sectors``
(ascending rationals), ``sections`` (between two sectors the factors with a root there, one root in common, or none),
and ``intervals``: ``first`` and ``last`` position covered (sector k is 2*k, what lies between it and the next is
2*k + 1), ``at`` (the position of the sample), ``own`` (the factors of the level on which it depends, or more),
``lower`` and ``upper`` (one of these with a root at the end, null where there is none), and either ``atoms`` (whose
truth at the sample decides the matrix) or the ``line`` over the sample. ``own`` is null where nobody asks what holds
beside the sample. Older certificates have no ``quantifiers`` and no ``matrix``, and ``false`` for ``atoms``.

THEOREM. Let an interval depend on the factors of its atoms, or on those on which the line over its sample does; let the
factors of its own level (squarefree and coprime, as their discriminants and resultants are not zero) vanish nowhere on
it, or, if it is a point, some of them there; let its finite ends be roots of some of them. Then the formula has one
truth value on it: that of the matrix, or of the line. A line has the truth value of its intervals where they cover it,
each beginning where the one before reaches; if its variable is quantified, also where one interval is true (for ∃;
for ∀: false). It depends on the factors of lower level of its intervals, of leading coefficients, discriminants and
pairwise resultants of the factors of each interval, and of resultants of an upper bound with the next lower bound. If
none of its factors is zero on a line over the neighbourhood, all of this is so over every connected neighbourhood of
the sample on which the factors it depends on are order-invariant: the factors are delineable there (McCallum 1998;
Brown 2001, theorem 3.1), so the bounds keep their order. Over the first axis there is nothing to depend on. Nor is
there where all variables so far have one quantifier and one value decides. Ábrahám, Davenport, England, Kremer 2021,
section 4; Nalbach, Kremer 2024.

A factor f that is zero on the line over s is so wherever its coefficients are zero: an atom with it depends on these. A
line above needs its order, too: let all partial derivatives of f of order < m be zero on the line and one of order m,
whose factors are among the interval's own, not. Then f has order m on {s} x I. So what is said of the line holds over s
only, and the intervals below are points; nothing has to be projected.

The answer has the truth value of the formula on every interval of the last free variable (or of one before, if atoms
decide there), by the signs of the own factors of this interval and of those below, which are constant there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Formula, Or
from qe.kernel.arithmetic.products import FactorLists, Product, check_lists
from qe.kernel.arithmetic.triangular import Point
from qe.kernel.block import refuted_block
from qe.kernel.closure import checked_discriminant, checked_resultant
from qe.kernel.covering_line import Line, Sample, line_of
from qe.kernel.negation import normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.table import is_prenex_form
from qe.options import Projection
from qe.proof.cells import Cell, CellTable
from qe.proof.entry import Entry, formula_from_json
from qe.truth import Truth, conjunction, disjunction

Factor = tuple[int, int]
"""Level and index."""

Signs = Mapping[Factor, int]


def check_covering(claim: Claim, context: Context, limits: Limits) -> None:
    """The formula is equivalent to its answer by the covering."""
    optional = ("quantifiers", "matrix")
    order, factors, line, quantifiers, matrix = only(claim, "order", "factors", "line", optional=optional)
    names = order.names()
    if not set(names) <= set(claim.ring.names):
        raise order.fail("it has other variables than the formula and its answer")
    ring = Ring.of(names)
    read = _older if quantifiers.value is None and matrix.value is None else _asked
    question = read(claim, ring, quantifiers, matrix)
    lists = [[f.polynomial(claim.ring).convert(ring).normal()[1] for f in level.items()] for level in factors.items()]
    check_lists(ring, lists)
    walk = _Walk(claim.ring, FactorLists(ring, lists), question, limits)
    known = walk.line(line, Sample(Point(budget=limits.budget), {}), {})
    if not question.free and question.answer != (TRUE if known.truth else FALSE):
        raise claim.fail(f"the covering says {known.truth}")


def _asked(claim: Claim, ring: Ring, quantifiers: Entry, matrix: Entry) -> _Question:
    """The prenex form in the evidence, after a look that it is one of the formula."""
    kinds = tuple(q.text() for q in quantifiers.items())
    before, after = normal(claim.before), normal(claim.after)
    if len(kinds) != len(ring.names) or not {*kinds} <= {"", "E", "A"}:
        raise quantifiers.fail('"", "E" or "A" expected for every variable')
    free = kinds.count("")
    if any(kinds[:free]):
        raise quantifiers.fail("a free variable after a quantified one")
    if not set(before.free) | set(after.free) <= {*ring.names[:free]}:
        raise claim.fail("its evidence has other variables free than the formula and its answer")
    if not after.is_quantifier_free:
        raise claim.fail("an answer without quantifiers expected")
    body = convert(formula_from_json(matrix, claim.ring), ring)
    if not is_prenex_form(before, CellTable(ring.names, kinds, body, Projection.BROWN_MCCALLUM, (), Cell("", None))):
        raise matrix.fail("it is no prenex form of the formula")
    return _Question(kinds, free, normal(body), convert(after, ring))


def _older(claim: Claim, ring: Ring, *_: Entry) -> _Question:
    """Older certificates are about closed blocks without solutions, or their negations, and say nothing of prefixes."""
    body = refuted_block(claim).body
    if not set(body.free) <= set(ring.names):
        raise claim.fail("the variables of the block expected")
    return _Question(("E",) * len(ring.names), 0, normal(convert(body, ring)), FALSE)


@dataclass(frozen=True, slots=True)
class _Question:
    """The prenex formula and its answer."""

    kinds: tuple[str, ...]
    free: int
    matrix: Formula
    answer: Formula

    def is_leading(self, level: int) -> bool:
        """Whether all variables so far have one quantifier."""
        return self.kinds[level] != "" and len({*self.kinds[: level + 1]}) == 1


@dataclass(frozen=True, slots=True)
class _Known:
    """What was found right of a line. ``pinned``: over its sample only."""

    depends: frozenset[Factor]
    truth: Truth
    pinned: bool = False


@dataclass(frozen=True, slots=True)
class _Part:
    """An interval found correct: its positions, the factors on which it depends, of its level and ``below``, and one of
    its level at either end."""

    first: int
    last: int
    truth: Truth
    own: frozenset[int]
    below: frozenset[Factor]
    lower: int | None
    upper: int | None
    pinned: bool


@dataclass(slots=True)
class _Walk:
    """The recursion over the lines. ``projected``: discriminants and resultants found so far."""

    given: Ring
    lists: FactorLists
    question: _Question
    limits: Limits
    projected: dict[tuple[int, int, int], Poly] = field(default_factory=dict)

    def line(self, entry: Entry, sample: Sample, signs: Signs, *, beside: bool = True) -> _Known:
        """What is known of a line, found correct, or ``CertificateRejected``. ``signs``: in the free variables;
        ``beside``: whether it is asked on what it depends."""
        self.limits.tick()
        level = sample.depth
        if level >= len(self.lists.lists):
            raise entry.fail("a line above the last variable")
        used, sectors, sections, intervals = entry.fields("used", "sectors", "sections", "intervals")
        line = line_of(sample, self.lists.lists[level], used, sectors, sections)
        parts = [self._interval(part, line, level, signs) for part in intervals.items()]
        truths, kind = {part.truth for part in parts}, self.question.kinds[level]
        decides = {"E": True, "A": False}.get(kind)
        if kind and decides in truths:
            if len(parts) > 1:
                raise intervals.fail("one interval is enough where one value decides")
        else:
            _covers(parts, 2 * len(line.sectors) - 2, intervals)
        truth = truths.pop() if len(truths) == 1 else None
        if level == 0 or not beside:
            return _Known(frozenset(), truth)
        if any(part.pinned for part in parts):
            return _Known(frozenset(), truth, pinned=True)
        depends = set[Factor]().union(*(part.below for part in parts))
        for part in parts:
            depends |= self._projection(sorted(part.own), line, level, entry)
        for left, right in pairwise(parts):
            depends |= self._neighbours(left, right, level, entry)
        return _Known(frozenset(depends), truth)

    # --- intervals ------------------------------------------------------------------------------------
    def _interval(self, entry: Entry, line: Line, level: int, signs: Signs) -> _Part:
        names = ("first", "last", "at", "own", "lower", "upper")
        first, last, at, listed, lower, upper, *either = entry.fields(*names, optional=("atoms", "false", "line"))
        low, high, place = first.integer(), last.integer(), at.integer()
        reasons = [reason for reason in either if reason.value is not None]
        if len(reasons) != 1:
            raise entry.fail("one reason expected")
        if not low <= place <= high <= 2 * len(line.sectors) - 2:
            raise entry.fail("its places do not ascend within the line")
        beside = listed.value is not None
        own = frozenset(i.integer() for i in listed.items()) if beside else frozenset[int]()
        if not own <= line.rows.keys():
            raise listed.fail("factors expected that the line uses and that are not zero on it")
        if not self.question.kinds[level]:
            signs = {**signs, **{(level, i): line.sign(i, place) for i in own}}
        by_line = reasons[0].path.endswith(".line")
        if by_line:
            extended = line.sample.extended(level, line.number(place, at))
            found = self.line(reasons[0], extended, signs, beside=beside)
        else:
            found = self._decided(reasons[0], line, level, place)
        if level == self.question.free - 1 or (level < self.question.free and not by_line):
            self._answered(found.truth, signs, entry)
        if not beside:
            if not self.question.is_leading(level) or found.truth is not (self.question.kinds[level] == "E"):
                raise listed.fail("it is asked what holds beside the sample")
            return _Part(low, high, found.truth, own, frozenset(), None, None, pinned=False)
        zero = [i for at_level, i in found.depends if at_level == level and i in line.zero]
        needed = {i for at_level, i in found.depends if at_level == level and i not in line.zero}
        if not needed <= own:
            raise listed.fail("the factors of this level on which it depends expected, all of them used by the line")
        roots = line.roots({*own}, low, high)
        if roots and not low == high == roots[0]:
            raise entry.fail("it contains a root of one of its factors")
        if not roots and (low % 2 or high % 2):
            raise entry.fail("an interval that is no root begins and ends with a sector")
        if found.pinned and not roots:
            raise entry.fail("what is known of the line above holds over a point only")
        begin = None if low == 0 else low // 2 if roots else low // 2 - 1
        end = None if high == 2 * len(line.sections) else high // 2
        bounds = _bound(lower, own, line, begin), _bound(upper, own, line, end)
        below = {f for f in found.depends if f[0] < level}
        for i in zero:
            if by_line:
                self._order_of_zero(self.lists.lists[level][i], line.sample, level, own, listed)
            for c in self.lists.lists[level][i].coefficients(level):
                below |= _factors(self._covered(c, entry)) if c else set()
        pinned = found.pinned or (bool(zero) and by_line)
        return _Part(low, high, found.truth, own, frozenset(below), *bounds, pinned)

    def _decided(self, entry: Entry, line: Line, level: int, place: int) -> _Known:
        """The factors of the atoms, and the truth of the matrix that these have at the sample."""
        truths, depends = dict[Formula, Truth](), set[Factor]()
        for part in entry.items():
            found = convert(formula_from_json(part, self.given), self.lists.ring)
            if not isinstance(found, Atom) or found.poly.level > level:
                raise part.fail("an atom in the variables up to this one expected")
            product = self._covered(found.poly, part)
            truths[found] = found.relation.holds(self._sign(product, line, level, place, part))
            depends |= _factors(product)
        truth = _truth(self.question.matrix, truths.get)
        if truth is None:
            raise entry.fail("these atoms do not decide the formula")
        return _Known(frozenset(depends), truth)

    def _sign(self, product: Product, line: Line, level: int, place: int, entry: Entry) -> int:
        sign = product.unit
        for at, index, exponent in product.powers:
            if at == level and index not in line.rows and index not in line.zero:
                raise entry.fail(f"it has the factor {index} of this level, which its line does not use")
            own = line.sign(index, place) if at == level else line.sample.sign(self.lists.lists[at][index])
            sign *= own if exponent % 2 else own * own
        return sign

    def _answered(self, truth: Truth, signs: Signs, entry: Entry) -> None:
        """The answer has this truth value where the factors have these signs."""

        def of_atom(found: Formula) -> Truth:
            product = self.lists.decompose(found.poly) if isinstance(found, Atom) else None
            if product is None or not isinstance(found, Atom):
                return None
            own = [(signs.get((level, index)), exponent) for level, index, exponent in product.powers]
            if any(s == 0 for s, _ in own):
                return found.relation.holds(0)
            sign = product.unit
            for s, exponent in own:
                if s is None:
                    return None
                sign *= s if exponent % 2 else 1
            return found.relation.holds(sign)

        if truth is None or _truth(self.question.answer, of_atom) is not truth:
            raise entry.fail(f"the formula is {truth} here, and that of the answer does not follow from the signs")

    # --- projection -------------------------------------------------------------------------------------
    def _order_of_zero(self, f: Poly, sample: Sample, level: int, own: frozenset[int], entry: Entry) -> None:
        """A partial derivative of least order that is not zero on the line has its factors among the interval's own."""
        partials = [f]
        while all(_is_zero(g, sample, level) for g in partials):
            self.limits.tick()
            partials = list({g.derivative(i): None for g in partials for i in g.variables})
        for g in partials:
            product = None if _is_zero(g, sample, level) else self.lists.decompose(g)
            if product is not None and {i for at, i in _factors(product) if at == level} <= own:
                return
        raise entry.fail("a factor is zero on the whole line, and nothing tells its order there")

    def _projection(self, own: Sequence[int], line: Line, level: int, entry: Entry) -> set[Factor]:
        """The factors of leading coefficients, discriminants and resultants, and what keeps a factor from being zero
        on a whole line of the neighbourhood."""
        depends = set[Factor]()
        for place, i in enumerate(own):
            f = self.lists.lists[level][i]
            depends |= _factors(self._covered(f.leading(level), entry))
            depends |= self._not_nullified(f, line.sample, level, entry)
            if f.degree(level) > 1:
                depends |= _factors(self._covered(self._discriminant(level, i), entry))
            for j in own[:place]:
                depends |= _factors(self._covered(self._resultant(level, j, i), entry))
        return depends

    def _not_nullified(self, f: Poly, sample: Sample, level: int, entry: Entry) -> set[Factor]:
        """Factors whose signs keep a coefficient from vanishing near the sample; f is not zero on the line over it.

        On level 1 the line depends on the leading coefficient, so that it is not zero near the sample, or the
        neighbourhood is the sample alone.
        """
        coefficients = f.coefficients(level)
        if level == 1 or sample.sign(coefficients[-1]) or any(c.is_constant and c for c in coefficients):
            return set()
        for c in coefficients:
            product = self.lists.decompose(c) if c else None
            if product is not None and sample.sign(c):
                return _factors(product)
        raise entry.fail("a factor may be zero on a whole line (Brown 2001, theorem 3.1)")

    def _neighbours(self, left: _Part, right: _Part, level: int, entry: Entry) -> set[Factor]:
        """The factors of the resultant of an upper bound and the next lower bound."""
        if left.upper is None or right.lower is None:
            raise entry.fail("an interval in the middle is unbounded")
        if left.upper == right.lower:
            return set()
        i, j = sorted((left.upper, right.lower))
        return _factors(self._covered(self._resultant(level, i, j), entry))

    def _covered(self, p: Poly, entry: Entry) -> Product:
        product = self.lists.decompose(p)
        if product is None or not product.unit:
            raise entry.fail("it depends on a polynomial that is zero, or no product of listed factors")
        return product

    def _discriminant(self, level: int, i: int) -> Poly:
        return self._once((level, i, i), lambda f, _: checked_discriminant(self.lists, f, level, i))

    def _resultant(self, level: int, i: int, j: int) -> Poly:
        return self._once((level, i, j), lambda f, g: checked_resultant(self.lists, f, g, level, j))

    def _once(self, key: tuple[int, int, int], compute: Callable[[Poly, Poly], Poly]) -> Poly:
        level, i, j = key
        if key not in self.projected:
            self.limits.tick()
            self.projected[key] = compute(self.lists.lists[level][i], self.lists.lists[level][j])
        return self.projected[key]


def _covers(parts: Sequence[_Part], end: int, entry: Entry) -> None:
    """Each interval begins where the one before reaches, and they reach the end."""
    reached = -1
    for k, part in enumerate(parts):
        if part.first > reached + 1 or (part.first == 0) != (k == 0):
            raise entry.fail(f"there is a gap before interval {k}")
        if reached == end:
            raise entry.fail(f"interval {k} is superfluous")
        reached = part.last
    if reached != end:
        raise entry.fail("the line is not covered to its end")


def _bound(entry: Entry, own: frozenset[int], line: Line, section: int | None) -> int | None:
    """The factor whose root, in a section, is an end of an interval; None where it is unbounded."""
    if section is None and entry.value is None:
        return None
    index = entry.integer()
    if section is None or index not in own or index not in line.sections[section]:
        raise entry.fail("a factor of the interval with a root at its end expected")
    return index


def _is_zero(f: Poly, sample: Sample, level: int) -> bool:
    """Whether a polynomial is zero on the whole line over a sample."""
    return not any(sample.sign(c) for c in f.coefficients(level) if c)


def _factors(product: Product) -> set[Factor]:
    return {(level, index) for level, index, _ in product.powers}


def _truth(formula: Formula, of_atom: Callable[[Formula], Truth]) -> Truth:
    """The truth of a formula without negations by that of its atoms."""
    match formula:
        case Constant(value):
            return value
        case And(args):
            return conjunction(_truth(a, of_atom) for a in args)
        case Or(args):
            return disjunction(_truth(a, of_atom) for a in args)
    return of_atom(formula)
