"""Certificates about curves and obstacles, in the form that ``bezier.certify.clearance`` multiplies out."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from bezier.certify.bernstein import MAX_DEGREE
from bezier.curves.curve import Bezier
from bezier.curves.evidence import curve_payload
from bezier.obstacles.along import Along
from bezier.obstacles.clearance import Contact, Search
from bezier.obstacles.obstacle import Constraint, Obstacle, Piece
from qe.errors import InputError
from qe.proof.certificate import Certificate, Kind

JUST_BEFORE = Fraction(1, 2**40)
"""How closely before an exactly known contact the curve is proved clear."""
DEEP = 64
"""Halvings allowed for a certificate. Where roots alone decide, there is none."""


def clearance_certificate(curve: Bezier, obstacle: Obstacle) -> Certificate | None:
    """The certificate that the curve never meets the obstacle.

    For closed obstacles the compactness of [0, 1] makes the subdivision end. None when the obstacle is given by strict
    inequalities and the curve touches its boundary, when it comes closer than ``DEEP`` halvings can tell, or when a
    polynomial along the curve has a degree beyond what the checker takes.
    Raises ``InputError`` when the curve does meet the obstacle.
    """
    pieces = _pieces(curve, obstacle, Fraction(1))
    return None if pieces is None else Certificate(Kind("clearance"), {**curve_payload(curve), "pieces": pieces})


def contact_certificate(curve: Bezier, obstacle: Obstacle, contact: Contact) -> Certificate | None:
    """The certificate that the curve first meets the obstacle within the interval of this contact.

    For an exactly known parameter t the interval is (t - ``JUST_BEFORE``, t]. None when no rational parameter in the
    interval lies in the obstacle (tangency at an irrational parameter), and in the cases of ``clearance_certificate``.
    """
    low, high = contact.t
    after = max(low - JUST_BEFORE, Fraction(0)) if contact.is_exact else low
    place = curve.point(high)
    met = [k for k, piece in enumerate(obstacle.pieces) if all(c.holds(c.value(place)) for c in piece.constraints)]
    pieces = _pieces(curve, obstacle, after) if met else None
    if pieces is None:
        return None
    where: dict[str, Any] = {"after": str(after), "t": str(high), "piece": met[0]}
    return Certificate(Kind("clearance"), {**curve_payload(curve), "pieces": pieces, "contact": where})


def _pieces(curve: Bezier, obstacle: Obstacle, until: Fraction) -> list[Any] | None:
    """The pieces with a proof that the curve misses them on [0, until]."""
    if max(c.degree for piece in obstacle.pieces for c in piece.constraints) * curve.degree > MAX_DEGREE:
        return None
    along = Along(curve.segment(Fraction(0), until)) if until else None
    found = []
    for piece in obstacle.pieces:
        spans = [] if along is None else _cover(along, piece, until)
        if spans is None:
            return None
        found.append({"constraints": [_constraint(c) for c in piece.constraints], "spans": spans})
    return found


def _cover(along: Along, piece: Piece, until: Fraction) -> list[list[Any]] | None:
    """The spans for one piece; ``along``: the curve up to ``until``."""
    search = Search(piece, roots_after=DEEP)
    if search.run([along.form(c) for c in piece.constraints]) is not None:
        raise InputError("a curve that meets the obstacle has no clearance certificate")
    if any(span.constraint is None for span in search.spans):
        return None
    return [[str(until * span.low), str(until * span.high), span.constraint] for span in search.spans]


def _constraint(constraint: Constraint) -> dict[str, Any]:
    return {"terms": [[list(e), str(c)] for e, c in constraint.terms], "strict": constraint.strict}
