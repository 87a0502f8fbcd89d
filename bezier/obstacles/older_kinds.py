"""Certificates of former releases of the kinds "containment" and "clearance", as derivations of today.

They held the control points of a curve over one number field, a condition or the pieces of an obstacle, and intervals
on which Bernstein coefficients have one sign. Nothing here is trusted: what comes out is checked. Kept for one release.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves.containment import margin_terms
from bezier.curves.curve import Bezier
from bezier.curves.scalar import Terms
from bezier.curves.sentences import CurveSentence, Span
from bezier.curves.workspace import Ball, HalfSpace
from bezier.obstacles.survey import MAX_DEGREE
from qe.errors import CertificateRejected
from qe.exact.field import NumberField
from qe.formula.syntax import Relation
from qe.kernel.limits import check_field
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry


def containment(payload: Entry) -> Certificate:
    """That no point of the curve violates the condition."""
    field, points, condition, breaks = payload.fields("field", "points", "condition", "breaks")
    curve, ends = _curve(field, points), [b.rational() for b in breaks.items()]
    if ends[:1] != [0] or ends[-1] != 1 or ends != sorted(set(ends)):
        raise breaks.fail("expected ascending numbers from 0 to 1")
    if isinstance(condition.value, dict) and "normal" in condition.value:
        normal, offset = condition.fields("normal", "offset")
        margin = margin_terms(HalfSpace(tuple(-c.rational() for c in normal.items()), offset.rational()))
    else:
        centre, radius = condition.fields("centre", "radius_squared")
        square = radius.row("a rational number")[0].rational()
        margin = margin_terms(Ball(tuple(c.rational() for c in centre.items()), square))
    if any(len(e) != curve.dimension for e in margin):
        raise condition.fail(f"expected {curve.dimension} numbers")
    spans = [(low, high, 0) for low, high in pairwise(ends)]
    return _refuted(CurveSentence(curve, ([(margin, Relation.LT)],)), [spans], payload)


def clearance(payload: Entry) -> Certificate:
    """That no point of the curve lies in the obstacle; or not before, and then one does."""
    field, points, pieces, contact = payload.fields("field", "points", "pieces", optional=("contact",))
    curve = _curve(field, points)
    rows = [piece.fields("constraints", "spans") for piece in pieces.items()]
    if not rows:
        raise pieces.fail("expected at least one piece")
    whole = CurveSentence(curve, [[_comparison(c, curve) for c in constraints.items()] for constraints, _ in rows])
    until = Fraction(1)
    if contact.value is not None:
        after, t, piece = contact.fields("after", "t", "piece")
        until = after.rational()
        if not 0 <= until <= t.rational() <= 1:
            raise contact.fail("expected 0 <= after <= t <= 1")
        if piece.integer() >= len(rows):
            raise piece.fail(f"expected one of {len(rows)} pieces")
    covers = [_spans(spans, len(system), until) for (_, spans), system in zip(rows, whole.systems, strict=True)]
    if contact.value is None:
        return _refuted(whole, covers, payload)
    there = CurveSentence(curve, whole.systems, (until, t.rational()), after=0 < until < t.rational())
    members = [("there", there.holds_at(t.rational()))]
    if until:
        before = CurveSentence(curve, whole.systems, (Fraction(0), until))
        members.insert(0, ("not before", _refuted(before, covers, payload)))
    return Certificate.bundle(members)


def _refuted(sentence: CurveSentence, spans: Sequence[Sequence[Span]], payload: Entry) -> Certificate:
    made = sentence.refuted(spans)
    if made is None:
        raise payload.fail("the intervals do not prove it")
    return made


def _curve(field: Entry, points: Entry) -> Bezier:
    polynomial, interval = field.fields("minimal_polynomial", "interval")
    minimal, ends = ([e.rational() for e in entry.items()] for entry in (polynomial, interval))
    check_field([int(c) for c in minimal])
    rows = [[_coordinate(c, len(minimal) - 1) for c in point.items()] for point in points.items()]
    if len(rows) > MAX_DEGREE + 1 or not all(1 <= len(row) <= 3 for row in rows):
        raise points.fail(f"expected at most {MAX_DEGREE + 1} points of up to three coordinates")
    if all(len(c) == 1 for row in rows for c in row):
        return Bezier.of([[c[0] for c in row] for row in rows])
    generated = NumberField.from_root([int(c) for c in minimal], *ends)
    return Bezier.of([[generated.element(c) if c[1:] else c[0] for c in row] for row in rows])


def _coordinate(entry: Entry, degree: int) -> list[Fraction]:
    values = [c.rational() for c in entry.items()]
    if not 1 <= len(values) <= degree:
        raise entry.fail(f"expected 1 to {degree} coefficients")
    return values


def _comparison(entry: Entry, curve: Bezier) -> tuple[Terms, Relation]:
    listed, strict = entry.fields("terms", "strict")
    terms: Terms = {}
    for term in listed.items():
        powers, number = term.row("exponents", "coefficient")
        exponents = tuple(e.integer() for e in powers.items())
        if len(exponents) != curve.dimension or exponents in terms or sum(exponents) > MAX_DEGREE:
            raise powers.fail(f"expected {curve.dimension} exponents of a degree up to {MAX_DEGREE}, each once")
        terms[exponents] = number.rational()
    if max(map(sum, terms), default=0) * curve.degree > MAX_DEGREE:
        raise listed.fail(f"expected a degree of at most {MAX_DEGREE} along the curve")
    return terms, Relation.GT if strict.truth() else Relation.GE


def _spans(entry: Entry, size: int, until: Fraction) -> list[Any]:
    rows = [span.row("low", "high", "index of a constraint") for span in entry.items()]
    cover = [(low.rational(), high.rational(), i.integer()) for low, high, i in rows]
    ends = [Fraction(0), *(high for _, high, _ in cover)]
    if [low for low, _, _ in cover] != ends[:-1] or ends != sorted(set(ends)) or ends[-1] != until:
        raise CertificateRejected(entry.path, f"expected intervals that follow one another from 0 to {until}")
    if any(i >= size for _, _, i in cover):
        raise entry.fail(f"expected one of {size} constraints")
    return cover
