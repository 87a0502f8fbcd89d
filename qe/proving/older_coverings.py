"""Coverings as certificates of former releases have them, as trees of cells. Nothing here is trusted.

Their evidence: a prenex form of the formula (``order``, ``quantifiers``, ``matrix``; the oldest have only the first,
and are about closed blocks), ``factors`` by level, and ``line``. A line has ``used``, ``sectors``, ``sections`` and
``intervals``, these ``first`` and ``last`` position, ``at``, ``own`` (null where the sample is enough), ``lower`` and
``upper`` (factors with a root at the ends), and ``atoms`` (``false`` in the oldest) or the ``line`` over the sample.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from qe.decomposition.evidence import tree
from qe.decomposition.line import Bound, Cover, CoverInterval, SampleTruth
from qe.exact.fibre_stack import isolate_over
from qe.exact.ring import Poly, Ring
from qe.exact.sample import Point
from qe.formula.build import convert
from qe.formula.syntax import TRUE, Atom, ForAll
from qe.kernel.block import existential
from qe.kernel.negation import negation
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.cells_json import cells_to_json
from qe.proof.certificate import written
from qe.proof.entry import Entry, Json, formula_from_json
from qe.proving.search import refuted_block


def covering(claim: Claim, context: Context, limits: Limits) -> list[Json]:
    """The step by a tree. ``CertificateRejected`` where the evidence is no covering."""
    optional = ("quantifiers", "matrix")
    order, levels, line, quantifiers, matrix = only(claim, "order", "factors", "line", optional=optional)
    ring, (before, after) = Ring.of(order.names()), existential(claim)
    if quantifiers.value is None and matrix.value is None:
        kinds, body = ("E",) * len(ring.names), refuted_block(claim).body
    else:
        kinds, body = tuple(q.text() for q in quantifiers.items()), formula_from_json(matrix, claim.ring)
        if isinstance(claim.before, ForAll):
            kinds, body = tuple({"E": "A", "A": "E"}.get(kind, kind) for kind in kinds), negation(body)
    factors = [[f.polynomial(claim.ring).convert(ring).normal()[1] for f in level.items()] for level in levels.items()]
    cover = _Reader(claim.ring, ring, factors).line(line, Point(ring))
    truth = None if kinds.count("") else after == TRUE
    table = tree(replace(cover, truth=truth), kinds, convert(body, ring))
    evidence: Json = {"cells": cells_to_json(table)}
    return [written("cells", (), before, after, context, evidence)]


@dataclass(frozen=True, slots=True)
class _Reader:
    given: Ring
    ring: Ring
    factors: list[list[Poly]]

    def line(self, entry: Entry, point: Point) -> Cover:
        used, sectors, sections, intervals = entry.fields("used", "sectors", "sections", "intervals")
        factors = self.factors[point.depth]
        stack = isolate_over(point, tuple(factors[i.integer()] for i in used.items()))
        listed = [[factors[i.integer()] for i in section.items()] for section in sections.items()]
        numbers = [q.rational() for q in sectors.items()]

        def bound(poly: Poly, section: int) -> Bound:
            return Bound(poly, sum(poly in members for members in listed[: section + 1]))

        def interval(part: Entry) -> CoverInterval:
            names = ("first", "last", "at", "own", "lower", "upper")
            low, high, at, own, lower, upper, *reasons = part.fields(*names, optional=("atoms", "false", "line"))
            first, last, (half, odd) = low.integer(), high.integer(), divmod(at.integer(), 2)
            root = bound(listed[half][0], half) if odd else None
            sample = _at(point, numbers[half]) if root is None else stack.sample(2 * root.section(stack) + 1)
            *atoms, above = reasons
            reason = self.line(above, sample) if above.value is not None else self.atoms(*atoms)
            is_point = first == last and first % 2 == 1
            start = None if lower.value is None else bound(factors[lower.integer()], first // 2 - (not is_point))
            end = None if upper.value is None else bound(factors[upper.integer()], last // 2)
            bare = own.value is None
            kept = () if bare else tuple(factors[i.integer()] for i in own.items())
            zero = tuple(stack.polys[j] for j in stack.nullified)
            known = SampleTruth(sample, root, None, reason)
            return CoverInterval(start, end, is_point, kept, (), known, zero, is_bare=bare)

        return Cover(point, None, tuple(map(interval, intervals.items())))

    def atoms(self, some: Entry, others: Entry) -> frozenset[Atom]:
        listed = (some if some.value is not None else others).items()
        read = (convert(formula_from_json(part, self.given), self.ring) for part in listed)
        return frozenset(part for part in read if isinstance(part, Atom))


def _at(point: Point, number: Fraction) -> Point:
    """The point one rational coordinate longer."""
    x = point.ring.gen(point.depth)
    return isolate_over(point, (x * number.denominator - number.numerator,)).sample(1)
