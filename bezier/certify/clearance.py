"""Checker for certificates of kind "clearance": a whole Bezier curve never meets an obstacle, or where it first does.

The obstacle is a union of pieces {f_1 >= 0, ..., f_m >= 0} (> 0 where strict) in the coordinates of the curve. THEOREM.
The curve misses a piece if [0, 1] is covered by intervals on each of which one f_i(P(t)) has only negative Bernstein
coefficients, or only nonpositive ones where f_i > 0 is strict. The certificate names the intervals and the i; the
polynomials f_i(P(t)) and their coefficients on the intervals are computed here.

With ``contact`` the intervals cover [0, after] only, and at the parameter ``t`` >= ``after`` all constraints of one
piece hold: the curve meets the obstacle first in (after, t], or in [0, t] when ``after`` is 0.
"""

from __future__ import annotations

from fractions import Fraction

from bezier.certify.containment import MAX_DEGREE, Vector, constant, product, read_points, restricted
from qe.certify.kinds import BroughtKind
from qe.errors import CertificateRejected
from qe.expert.arithmetic.numbers import read_field
from qe.expert.arithmetic.residue import Residue, RootField, add, scale
from qe.options import Budget
from qe.proof.entry import Entry, Json

Constraint = tuple[list[Residue], bool]


def check_clearance(payload: dict[str, Json], budget: Budget | None = None) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    numbers, points_entry, pieces, contact = Entry(payload, "payload").fields(
        "field", "points", "pieces", optional=("contact",)
    )
    field = read_field(numbers, budget)
    curve = _Curve(read_points(points_entry, field), field)
    result = list(pieces.items())
    if not result:
        raise pieces.fail("expected at least one piece")
    after, t, index = _contact(contact)
    for k, piece in enumerate(result):
        constraints, spans = piece.fields("constraints", "spans")
        forms = [_along(c, curve) for c in constraints.items()]
        _check_cover(forms, spans, field, after)
        if k == index and not all(_holds(form, strict, t, field) for form, strict in forms):
            raise contact.fail("a constraint of this piece does not hold at t")
    if index >= len(result):
        raise contact.fail(f"expected one of {len(result)} pieces")


def _contact(entry: Entry) -> tuple[Fraction, Fraction, int]:
    """Where the intervals end, and the parameter and the piece of the contact; piece -1 without a contact."""
    if entry.value is None:
        return Fraction(1), Fraction(1), -1
    after, at, piece = entry.fields("after", "t", "piece")
    low, high = after.rational(), at.rational()
    if not 0 <= low <= high <= 1:
        raise entry.fail("expected 0 <= after <= t <= 1")
    return low, high, piece.integer()


def _holds(form: list[Residue], strict: bool, t: Fraction, field: RootField) -> bool:
    """Whether a constraint holds at the parameter t."""
    value = form[0] if t == 0 else restricted(form, Fraction(0), t)[-1]
    return field.sign(value) > 0 if strict else field.sign(value) >= 0


class _Curve:
    """The coordinates of a curve as polynomials in Bernstein form, with their powers."""

    def __init__(self, points: list[Vector], field: RootField) -> None:
        self.field, self.dimension, self.degree = field, len(points[0]), len(points) - 1
        self.coordinates = [[p[i] for p in points] for i in range(self.dimension)]
        self.monomials: dict[tuple[int, ...], list[Residue]] = {(0,) * self.dimension: constant(Fraction(1), 0)}

    def monomial(self, exponents: tuple[int, ...]) -> list[Residue]:
        """x^i y^j ... along the curve."""
        if exponents not in self.monomials:
            axis = next(i for i, e in enumerate(exponents) if e)
            lower = tuple(e - (i == axis) for i, e in enumerate(exponents))
            self.monomials[exponents] = product(self.monomial(lower), self.coordinates[axis], self.field)
        return self.monomials[exponents]


def _along(entry: Entry, curve: _Curve) -> Constraint:
    """f(P(t)) in Bernstein form, and whether f > 0 is meant instead of f >= 0."""
    terms, strict = entry.fields("terms", "strict")
    read: dict[tuple[int, ...], Fraction] = {}
    for term in terms.items():
        powers, number = term.row("exponents", "coefficient")
        exponents = tuple(e.integer() for e in powers.items())
        if len(exponents) != curve.dimension or exponents in read:
            raise powers.fail(f"expected {curve.dimension} exponents, each combination once")
        read[exponents] = number.rational()
    power = max((sum(e) for e in read), default=0)
    degree = power * curve.degree
    if max(degree, power) > MAX_DEGREE:
        raise terms.fail(f"expected a degree of at most {MAX_DEGREE} along the curve")
    total = constant(Fraction(0), degree)
    for exponents, coefficient in read.items():
        one = constant(Fraction(1), degree - sum(exponents) * curve.degree)
        raised = product(curve.monomial(exponents), one, curve.field)
        total = [add(a, scale(b, coefficient)) for a, b in zip(total, raised, strict=True)]
    truth = strict.truth()
    if truth is None:
        raise strict.fail("expected true or false")
    return total, truth


def _check_cover(constraints: list[Constraint], spans: Entry, field: RootField, until: Fraction) -> None:
    """The spans follow one another from 0 to ``until``, and on each the constraint it names fails."""
    reached = Fraction(0)
    for span in spans.items():
        low, high, index = span.row("low", "high", "index of a constraint")
        start, end, i = low.rational(), high.rational(), index.integer()
        if start != reached or not start < end <= until:
            raise span.fail(f"expected an interval from {reached}")
        if i >= len(constraints):
            raise index.fail(f"expected one of {len(constraints)} constraints")
        form, strict = constraints[i]
        largest = max(field.sign(c) for c in restricted(form, start, end))
        if largest > 0 or (largest == 0 and not strict):
            raise CertificateRejected(span.path, "the constraint does not fail on this interval")
        reached = end
    if reached != until:
        raise spans.fail(f"the intervals do not reach {until}")


KIND = BroughtKind(check_clearance, lambda _: "about a curve, see the entries of its payload")
