"""Every curve of a path against every obstacle: proofs, contacts, distances, certificates, and what to say of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from bezier.curves.curve import Bezier
from bezier.curves.enclosure import Enclosure
from bezier.curves.sentences import CurveSentence
from bezier.obstacles.bodies import distance_enclosure
from bezier.obstacles.clearance import SHORT, Along, Clear, Contact, ContactSearch, Outcome, examine
from bezier.obstacles.obstacle import Obstacle
from qe.errors import InputError, Unable
from qe.proof.certificate import Certificate

JUST_BEFORE = Fraction(1, 2**40)
"""How closely before an exactly known contact the curve is proved clear."""
MAX_DEGREE = 64
"""Of polynomials along a curve that certificates are about."""
DEEP = 64
"""Halvings allowed for a certificate. Where roots alone decide, there is none."""


def clearance_certificate(curve: Bezier, obstacle: Obstacle) -> Certificate | None:
    """The certificate that no point of the curve lies in the obstacle.

    None where a polynomial along the curve has a degree above ``MAX_DEGREE``; and for a curve over a number field that
    touches the boundary of an obstacle given by strict inequalities, or comes closer than ``DEEP`` halvings can tell.
    Raises ``InputError`` when the curve does meet the obstacle.
    """
    sentence = meeting(curve, obstacle)
    return _clear(sentence, obstacle) if sentence is not None else None


def contact_certificate(curve: Bezier, obstacle: Obstacle, contact: Contact) -> Certificate | None:
    """The certificate that the curve first meets the obstacle at this contact: that it does there, and not before.

    For an interval of t: in it, and not up to its beginning. Over a number field an exact t is the end of an interval
    of the length ``JUST_BEFORE``. None when no rational parameter in the interval lies in the obstacle (tangency at an
    irrational parameter), and in the cases of ``clearance_certificate``.
    """
    low, high = contact.t
    place, whole = curve.point(high), meeting(curve, obstacle)
    if whole is None or not any(all(c.holds(c.value(place)) for c in piece.constraints) for piece in obstacle.pieces):
        return None
    sharp = contact.is_exact and whole.theta is None
    if contact.is_exact and not sharp:
        low = max(low - JUST_BEFORE, Fraction(0))
    if not high:
        return replace(whole, between=(high, high)).holds_at(high)
    there = replace(whole, between=(low, high), after=not sharp and low > 0).holds_at(high)
    if not low:
        return there
    until = replace(whole, between=(Fraction(0), low), before=sharp)
    clear = until.refuted([[(Fraction(0), low, None)] for _ in obstacle.pieces]) if sharp else _clear(until, obstacle)
    return None if clear is None else Certificate.bundle([("not before", clear), ("there", there)])


def meeting(curve: Bezier, obstacle: Obstacle) -> CurveSentence | None:
    """That some point of the curve lies in the obstacle; None where a degree is above ``MAX_DEGREE``."""
    systems = [[(dict(c.terms), c.relation) for c in piece.constraints] for piece in obstacle.pieces]
    most = max(c.degree for piece in obstacle.pieces for c in piece.constraints)
    return CurveSentence(curve, systems) if most * curve.degree <= MAX_DEGREE else None


def _clear(sentence: CurveSentence, obstacle: Obstacle) -> Certificate | None:
    """That a sentence about the curve, up to a parameter, is false."""
    until, listed = sentence.between[1], []
    along = Along(sentence.curve.segment(Fraction(0), until))
    for piece in obstacle.pieces:
        search = ContactSearch(piece, roots_after=SHORT if sentence.theta is None else DEEP)
        if search.run([along.form(c) for c in piece.constraints]) is not None:
            raise InputError("a curve that meets the obstacle has no clearance certificate")
        listed.append([(until * span.low, until * span.high, span.constraint) for span in search.spans])
    if sentence.theta is not None and any(i is None for spans in listed for _, _, i in spans):
        return None
    return sentence.refuted(listed)


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
