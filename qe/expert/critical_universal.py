"""Rule "critical values of a universal block": polynomials that are nowhere positive on intervals.

THEOREM. Let T be the set of parameters p with g_j(p, y) <= 0 for all y in D_j, j = 1, ..., k, where D_j is an interval
with rational ends l_j < h_j, which may belong to it or not, and every g_j has degree at most 2 in p, with a Hessian
matrix in p that depends on y alone and is positive semidefinite for all y in [l_j, h_j]. Then T is closed and convex.
Over every point of its boundary some g_j has a zero at l_j, or at h_j, or a zero y where its derivative by y vanishes.
PROOF. By continuity the ends may be added to D_j. T is an intersection of closed convex sets {p : g_j(p, y) <= 0}. Near
a boundary point p there are points p' outside T, with g_j(p', y') > 0; as the intervals are compact, such y' for one j
have a limit y with g_j(p, y) >= 0, and p is in T: the greatest value of g_j(p, .) on [l_j, h_j] is 0, at y.

LEMMA. If g_j = c * g, with c(y) >= 0 on [l_j, h_j] and not zero, then g may take the place of g_j: T stays what it is.
PROOF. Without the finitely many zeros of c, D_j is dense in [l_j, h_j], and there g_j is nowhere positive iff g is. A
continuous function is nowhere positive on a set iff it is so on a dense subset.

So the factors of g_j in y alone are left out where their product has one sign. (A curve through a given point on the
sphere has a g_j that is zero at an end of the interval for all p: every point would be critical.) T is the closed
convex set of the first theorem of ``critical_values``, with these critical points, and what follows there from its
boundary holds here: with one open cell in T, and the same truth as a set S that is the closure of its interior at the
samples of all open cells, T = S. A matrix is positive semidefinite iff no principal minor is negative (Horn, Johnson:
Matrix Analysis, 7.2). A sample is in T if the g_j are seen to be nowhere positive (Sturm), and not in T by a number y
in D_j where g_j is positive.

Evidence: ``order`` (the parameters), ``chains`` (for each j: at l_j, at h_j, and for the double zeros if y occurs),
``factors``, ``stacks`` (of a cell: -1 where the sample is in T, else the number of an exception), ``exceptions`` ([j,
y]), ``regular``, as for "critical values".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product

from qe.exact.ring import Poly, Ring
from qe.expert.critical_points import determinant, vanishing
from qe.expert.critical_values import check_open_cells, check_shape, read_conditions
from qe.formula.build import convert
from qe.formula.syntax import And, Atom, ForAll, Formula, Or, Relation
from qe.kernel.arithmetic.sturm import count_roots_between, exact, sign_of
from qe.kernel.negation import negation, normal
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Entry

MOST_CASES = 64
"""Disjuncts of the negated body, at most."""


@dataclass(frozen=True, slots=True)
class Exceeding:
    """g(p, y) > 0 for some y between two numbers; y is the last variable of the ring."""

    poly: Poly
    low: Fraction
    high: Fraction

    def critical(self) -> list[list[Poly]]:
        """Polynomials that vanish together over critical points: at both ends, and at a double zero.

        Without y in the polynomial, an end says all.
        """
        y = self.poly.ring.size - 1
        ends = [[self.poly.at_rational(y, end)] for end in (self.low, self.high)]
        return [*ends, [self.poly, self.poly.derivative(y)]] if self.poly.degree(y) else ends

    def is_excluded(self, values: Sequence[Fraction]) -> bool:
        """Whether g <= 0 on the interval, over a point."""
        line = self.poly
        for i, value in enumerate(values):
            line = line.at_rational(i, value)
        return is_nonnegative(-line, self.low, self.high)

    def is_convex(self) -> bool:
        """Whether g is convex in p for all y of the interval, as the theorem says."""
        free = range(self.poly.ring.size - 1)
        hessian = [[self.poly.derivative(i).derivative(j) for j in free] for i in free]
        if any(i in free for row in hessian for entry in row for i in entry.variables):
            return False
        chosen = [rows for count in range(1, len(free) + 1) for rows in combinations(free, count)]
        minors = (determinant([[hessian[i][j] for j in rows] for i in rows]) for rows in chosen)
        return all(is_nonnegative(minor, self.low, self.high) for minor in minors)


def check_critical_universal(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    order, chains, factors, stacks, listed, regular = only(
        claim, "order", "chains", "factors", "stacks", "exceptions", "regular"
    )
    names, after = order.names(), claim.plain(normal(claim.after))
    if not names or not set(claim.before.free) | set(after.free) <= set(names):
        raise order.fail("expected the parameters")
    parts = read_parts(claim, names)
    ring, outer, free = parts[0].poly.ring, Ring.of(names), len(names)
    holds = convert(after, outer)
    starts = [start for part in parts for start in part.critical()]
    rows = list(chains.items())
    if len(rows) != len(starts):
        raise chains.fail(f"expected {len(starts)} chains")
    surfaces = [vanishing(start, row, free, ring) for start, row in zip(starts, rows, strict=True)]
    exceptions = [_exception(e, parts) for e in listed.items()]

    def check_inside(values: tuple[Fraction, ...], said: Entry) -> None:
        if said.integer(-1) != -1 or not all(part.is_excluded(values) for part in parts):
            raise said.fail("an inequality is not seen to hold on its interval")

    def check_outside(values: tuple[Fraction, ...], said: Entry) -> None:
        if said.integer() >= len(exceptions):
            raise said.fail("not the number of an exception")
        part, y = exceptions[said.integer()]
        if part.poly.evaluate((*values, y)) <= 0:
            raise said.fail("the inequality holds at the exception")

    check_open_cells(holds, outer, surfaces, (factors, stacks), (check_inside, check_outside), claim, limits)
    if regular.value is None:
        read_conditions(after, outer, claim, strict=False)
    else:
        check_shape(regular, holds, limits)


def read_parts(claim: Claim, names: tuple[str, ...]) -> list[Exceeding]:
    """What the block excludes; ``CertificateRejected`` where the theorem does not cover it."""
    block = claim.before
    if not isinstance(block, ForAll) or len(block.variables) != 1:
        raise claim.fail("expected a universal block of one variable")
    if set(block.variables) & set(names):
        raise claim.fail("the variable of the block is a parameter")
    ring = Ring.of((*names, *block.variables))
    cases = list(_cases(convert(negation(claim.plain(block.body)), ring), claim))
    if not 0 < len(cases) <= MOST_CASES:
        raise claim.fail(f"expected at most {MOST_CASES} cases, and at least one")
    return [_part(case, claim) for case in cases]


def _cases(formula: Formula, claim: Claim) -> Iterator[tuple[Atom, ...]]:
    """Conjunctions of atoms whose disjunction the formula is."""
    match formula:
        case Atom():
            yield (formula,)
        case Or(args):
            for arg in args:
                yield from _cases(arg, claim)
        case And(args):
            lists = [list(_cases(arg, claim)) for arg in args]
            count = 1
            for found in lists:
                count *= len(found)
            if count > MOST_CASES:
                raise claim.fail(f"more than {MOST_CASES} cases")
            for chosen in product(*lists):
                yield tuple(atom for case in chosen for atom in case)
        case _:
            raise claim.fail("expected comparisons of polynomials")


def _part(case: Sequence[Atom], claim: Claim) -> Exceeding:
    """A case: linear bounds of y on both sides, and one strict inequality with parameters."""
    lower: list[Fraction] = []
    upper: list[Fraction] = []
    others: list[Poly] = []
    for atom in case:
        poly, y = atom.poly, atom.poly.ring.size - 1
        if atom.relation in (Relation.LT, Relation.LE):
            poly = -poly
        elif atom.relation not in (Relation.GT, Relation.GE):
            raise claim.fail("expected inequalities")
        if poly.variables == (y,) and poly.degree(y) == 1:
            constant, slope = (c.constant_value() for c in poly.coefficients(y))
            (lower if slope > 0 else upper).append(Fraction(-constant, slope))
        elif atom.relation in (Relation.LT, Relation.GT):
            others.append(poly)
        else:
            raise claim.fail("expected bounds of the block's variable, and weak inequalities for it")
    if len(others) != 1 or not lower or not upper or max(lower) >= min(upper):
        raise claim.fail("expected one inequality on an interval in each case")
    low, high = max(lower), min(upper)
    part = Exceeding(_without_content(others[0], low, high), low, high)
    if not part.is_convex():
        raise claim.fail("an inequality is not seen to be convex in the parameters")
    return part


def _without_content(poly: Poly, low: Fraction, high: Fraction) -> Poly:
    """The polynomial without its factors in the last variable alone, where their product has one sign (the lemma)."""
    y = poly.ring.size - 1
    content = poly.ring.constant(1)
    for factor, multiplicity in poly.factors()[1]:
        if factor.variables == (y,):
            content *= factor**multiplicity
    if is_nonnegative(content, low, high):
        return poly.exact_divide(content)
    return poly.exact_divide(-content) if is_nonnegative(-content, low, high) else poly


def is_nonnegative(poly: Poly, low: Fraction, high: Fraction) -> bool:
    """Whether a polynomial in the last variable alone is nowhere negative between two numbers, low < high.

    No factor of odd multiplicity has a zero inside; then its sign at one place that is no zero decides.
    """
    if poly.is_constant:
        return poly.constant_value() >= 0
    y = poly.ring.size - 1
    for factor, multiplicity in poly.factors()[1]:
        if multiplicity % 2 and _zeros_inside(factor, low, high):
            return False
    line, count = poly.to_univariate(y), poly.degree(y) + 2
    signs = (sign_of(line(exact(low + (high - low) * k / count))) for k in range(1, count))
    return next(sign for sign in signs if sign) > 0


def _zeros_inside(factor: Poly, low: Fraction, high: Fraction) -> int:
    """The zeros of an irreducible polynomial between two numbers."""
    y = factor.ring.size - 1
    if factor.degree(y) == 1:
        constant, slope = (c.constant_value() for c in factor.coefficients(y))
        return int(low < Fraction(-constant, slope) < high)
    return count_roots_between(factor.to_univariate(y), low, high)  # it has no rational zeros


def _exception(entry: Entry, parts: Sequence[Exceeding]) -> tuple[Exceeding, Fraction]:
    case, number = entry.row("number of a case", "number")
    if case.integer() >= len(parts):
        raise case.fail("there is no such case")
    part, y = parts[case.integer()], number.rational()
    if not part.low <= y <= part.high:
        raise entry.fail("not in the interval of its case")
    return part, y
