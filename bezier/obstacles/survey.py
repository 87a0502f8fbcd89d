"""Every curve of a path against every obstacle: proofs, contacts, distances, certificates, and what to say of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from bezier.certify.containment import MAX_DEGREE
from bezier.curves.containment import curve_payload
from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.obstacles.bodies import distance_enclosure
from bezier.obstacles.clearance import Along, Clear, Contact, ContactSearch, Outcome, examine
from bezier.obstacles.obstacle import Constraint, Obstacle, Piece
from qe.errors import InputError, Unable
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
    hit = [k for k, piece in enumerate(obstacle.pieces) if all(c.holds(c.value(place)) for c in piece.constraints)]
    pieces = _pieces(curve, obstacle, after) if hit else None
    if pieces is None:
        return None
    where: dict[str, Any] = {"after": str(after), "t": str(high), "piece": hit[0]}
    return Certificate(Kind("clearance"), {**curve_payload(curve), "pieces": pieces, "contact": where})


def _pieces(curve: Bezier, obstacle: Obstacle, until: Fraction) -> list[Any] | None:
    """The pieces with a proof that the curve misses them on [0, until]."""
    if max(c.degree for piece in obstacle.pieces for c in piece.constraints) * curve.degree > MAX_DEGREE:
        return None
    along = Along(curve.segment(Fraction(0), until)) if until else None
    result = []
    for piece in obstacle.pieces:
        spans = [] if along is None else _cover(along, piece, until)
        if spans is None:
            return None
        result.append({"constraints": [_constraint(c) for c in piece.constraints], "spans": spans})
    return result


def _cover(along: Along, piece: Piece, until: Fraction) -> list[list[Any]] | None:
    """The spans for one piece; ``along``: the curve up to ``until``."""
    search = ContactSearch(piece, roots_after=DEEP)
    if search.run([along.form(c) for c in piece.constraints]) is not None:
        raise InputError("a curve that meets the obstacle has no clearance certificate")
    if any(span.constraint is None for span in search.spans):
        return None
    return [[str(until * span.low), str(until * span.high), span.constraint] for span in search.spans]


def _constraint(constraint: Constraint) -> dict[str, Any]:
    return {"terms": [[list(e), str(c)] for e, c in constraint.terms], "strict": constraint.strict}


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found out about one curve and one obstacle."""

    name: str
    curve: Bezier
    obstacle: Obstacle
    outcome: Outcome
    distance: Enclosure | None
    """An enclosure of the least distance; None for obstacles given by a formula, and where the limit of the
    enclosure was reached."""

    @property
    def is_clear(self) -> bool:
        """Whether the whole curve is proved clear of the obstacle."""
        return isinstance(self.outcome, Clear)


def survey(
    curves: Mapping[str, Bezier], obstacles: Sequence[Obstacle], *, distances: bool = True
) -> tuple[Finding, ...]:
    """Every curve against every obstacle, exactly."""
    result = []
    for name, curve in curves.items():
        along = Along(curve)
        for obstacle in obstacles:
            outcome = examine(along, obstacle)
            result.append(Finding(name, curve, obstacle, outcome, _distance(curve, obstacle, outcome, distances)))
    return tuple(result)


def _distance(curve: Bezier, obstacle: Obstacle, outcome: Outcome, wanted: bool) -> Enclosure | None:
    if isinstance(outcome, Contact):
        zero = outcome.t[0] * 0
        return Enclosure(zero, zero) if outcome.attained else None
    if obstacle.body is None or not wanted:
        return None
    try:
        return distance_enclosure(curve, obstacle.body)
    except Unable:
        return None


def contacts(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """The findings in which a curve meets an obstacle."""
    return tuple(finding for finding in findings if not finding.is_clear)


def certificates(findings: Iterable[Finding]) -> list[tuple[str, Certificate]]:
    """A labelled certificate for each clearance and each first contact that has one."""
    result = []
    for finding in findings:
        curve, obstacle, outcome = finding.curve, finding.obstacle, finding.outcome
        certificate = (
            contact_certificate(curve, obstacle, outcome)
            if isinstance(outcome, Contact)
            else clearance_certificate(curve, obstacle)
        )
        if certificate is not None:
            verb = "clear of" if finding.is_clear else "meets"
            result.append((f"{finding.name} {verb} {obstacle.name}", certificate))
    return result


def in_words(finding: Finding) -> str:
    """One line about a finding."""
    outcome, obstacle = finding.outcome, finding.obstacle.name
    if isinstance(outcome, Clear):
        far = f", at least {finding.distance.to_json(6)['low']} away" if finding.distance else ""
        return f"{finding.name}: clear of {obstacle} for all t ({outcome.argument.value}){far}"
    begins = "" if outcome.attained else "right after "
    how = "enters" if outcome.enters else "touches"
    return f"{finding.name}: {how} {obstacle}, first at {begins}t = {parameter(outcome)}, {place(outcome)}"


def parameter(contact: Contact) -> str:
    """The parameter of a contact: exactly, or a decimal that is right in all its digits."""
    if contact.is_exact:
        return str(contact.t[0])
    return f"{float(sum(contact.t) / 2):.12f} (irrational)"


def place(contact: Contact) -> str:
    """The place of a contact, rounded."""
    return f"({', '.join(f'{float(c):.6g}' for c in contact.place)})"


def to_json(finding: Finding) -> dict[str, Any]:
    """A finding with exact numbers."""
    outcome = finding.outcome
    data: dict[str, Any] = {"curve": finding.name, "obstacle": finding.obstacle.name, "clear": finding.is_clear}
    data["distance"] = finding.distance.to_json() if finding.distance else None
    if isinstance(outcome, Clear):
        return {**data, "argument": outcome.argument.value}
    return {
        **data,
        "first_contact": {
            "t": [str(end) for end in outcome.t],
            "decimal": f"{float(sum(outcome.t) / 2):.12g}",
            "place": [c.to_json() for c in outcome.place],
            "exact_place": None if outcome.exact_place is None else [str(c) for c in outcome.exact_place],
            "enters": outcome.enters,
            "attained": outcome.attained,
        },
    }
