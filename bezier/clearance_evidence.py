"""Certificates that a curve never meets an obstacle, in the form that ``qe.certify.clearance`` multiplies out."""

from __future__ import annotations

from typing import Any

from bezier.along import Along
from bezier.clearance import Search
from bezier.curve import Bezier
from bezier.evidence import curve_payload
from bezier.obstacles import Constraint, Obstacle, Piece
from qe.certify.bernstein import MAX_DEGREE
from qe.errors import InputError
from qe.evidence.certificate import Certificate, Kind

DEEP = 64
"""Halvings allowed for a certificate. Where roots alone decide, there is none."""


def clearance_certificate(curve: Bezier, obstacle: Obstacle) -> Certificate | None:
    """The certificate that the curve never meets the obstacle.

    For closed obstacles the compactness of [0, 1] makes the subdivision end. None when the obstacle is given by strict
    inequalities and the curve touches its boundary, when it comes closer than ``DEEP`` halvings can tell, or when a
    polynomial along the curve has a degree beyond what the checker takes.
    Raises ``InputError`` when the curve does meet the obstacle.
    """
    if max(c.degree for piece in obstacle.pieces for c in piece.constraints) * curve.degree > MAX_DEGREE:
        return None
    along = Along(curve)
    pieces = []
    for piece in obstacle.pieces:
        spans = _cover(along, piece)
        if spans is None:
            return None
        pieces.append({"constraints": [_constraint(c) for c in piece.constraints], "spans": spans})
    return Certificate(Kind.CLEARANCE, {**curve_payload(curve), "pieces": pieces})


def _cover(along: Along, piece: Piece) -> list[list[Any]] | None:
    search = Search(piece, roots_after=DEEP)
    if search.run([along.form(c) for c in piece.constraints]) is not None:
        raise InputError("a curve that meets the obstacle has no clearance certificate")
    if any(span.constraint is None for span in search.spans):
        return None
    return [[str(span.low), str(span.high), span.constraint] for span in search.spans]


def _constraint(constraint: Constraint) -> dict[str, Any]:
    return {"terms": [[list(e), str(c)] for e, c in constraint.terms], "strict": constraint.strict}
