"""Certificates of former releases about curves and arms: read as sentences; what is altered or false is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

import qe
from bezier.arm.continuous import continuous_motions
from bezier.arm.evidence import certificates, motions_certificate
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.reader import load_arm
from bezier.curves.curve import Bezier
from qe.certify.claims import claim_of
from qe.proof.certificate import digest
from qe.proving.older_kinds import recent
from tests.certificates.restated import evidence_of
from tests.tables import each

RATIONAL = {"minimal_polynomial": ["0", "1"], "interval": ["0", "0"]}
SQRT2 = {"minimal_polynomial": ["-2", "0", "1"], "interval": ["1", "2"]}
ARCH = [["-1", "0"], ["0", "2"], ["1", "0"]]  # (2t - 1, 4t(1 - t)), at most 1 high, y = 1 - x^2
HALVES = [["0", "1/2", 0], ["1/2", "1", 0]]
DISC = {"terms": [[[2, 0], "-1"], [[0, 2], "-1"], [[0, 1], "-6"], [[0, 0], "-8"]], "strict": False}  # around (0, -3)
LEFT = {"terms": [[[1, 0], "-1"]], "strict": False}  # x <= 0
RIGHT = {"terms": [[[1, 0], "1"], [[0, 0], "-1/2"]], "strict": False}  # x >= 1/2


def read(kind: str, payload: Any) -> qe.Certificate:
    """A certificate as a file of version 2 has it, with its digest."""
    whole: dict[str, Any] = {"format": "bezier-qe certificate", "version": 2, "kind": kind, "payload": payload}
    return qe.Certificate.from_json(json.dumps({**whole, "digest": digest(whole)}))


def half_plane(offset: str, strict: bool = False) -> dict[str, Any]:
    """y >= offset."""
    negative = offset.removeprefix("-") if offset.startswith("-") else f"-{offset}"
    return {"terms": [[[0, 1], "1"]] + ([[[0, 0], negative]] if offset != "0" else []), "strict": strict}


def clearance(constraints: list[Any], spans: list[Any], contact: Any = None) -> dict[str, Any]:
    points = [[[c] for c in p] for p in ARCH]
    pieces = [{"constraints": constraints, "spans": spans}]
    given = {"field": RATIONAL, "points": points, "pieces": pieces}
    return given if contact is None else {**given, "contact": contact}


def containment(condition: Any, *breaks: str, points: Any = ARCH, field: Any = RATIONAL) -> dict[str, Any]:
    coordinates = [[c if isinstance(c, list) else [c] for c in p] for p in points]
    return {"field": field, "points": coordinates, "condition": condition, "breaks": list(breaks or ("0", "1"))}


def ball(square: str, *centre: str) -> dict[str, Any]:
    return {"centre": list(centre or ("0", "0")), "radius_squared": [square]}


def side(offset: str, *normal: str) -> dict[str, Any]:
    return {"normal": list(normal), "offset": offset}


@each(
    ([half_plane("3")], [["0", "1", 0]]),
    ([half_plane("2", strict=True)], [["0", "1", 0]]),  # a control point touches; the half-plane is open
    ([half_plane("3/2")], HALVES),
    ([DISC], [["0", "1", 0]]),
    ([LEFT, RIGHT], [["0", "5/8", 1], ["5/8", "1", 0]]),
    ([half_plane("1", strict=True)], HALVES),
)
def test_the_curve_misses(constraints: list[Any], spans: list[Any]) -> None:
    certificate = read("clearance", clearance(constraints, spans))
    assert qe.verify(certificate, core=True).accepted
    sentence, answer = claim_of(recent(certificate)).equivalence or ("", "")
    assert str(sentence).startswith("ex t, x, y. t >= 0 and t - 1 <= 0 and 2*t - x - 1 = 0 and 4*t^2 - 4*t + y = 0 and")
    assert str(answer) == "false"


@each(
    ([half_plane("1")], HALVES, "do not prove"),  # it touches at 1/2
    ([half_plane("0")], HALVES, "do not prove"),
    ([LEFT, RIGHT], [["0", "1", 0]], "do not prove"),  # both are needed
    ([half_plane("3")], [["0", "1/2", 0]], "from 0 to 1"),
    ([half_plane("3")], [], "from 0 to 1"),
    ([half_plane("3")], [["0", "1/2", 0], ["3/4", "1", 0]], "follow one another"),
    ([half_plane("3")], [["1/4", "1", 0]], "follow one another"),
    ([half_plane("3")], [["0", "2", 0]], "from 0 to 1"),
    ([half_plane("3")], [["0", "0", 0], ["0", "1", 0]], "follow one another"),
    ([half_plane("3")], [["0", "1", 1]], "one of 1 constraints"),
    ([half_plane("3")], [["0", "1"]], "low, high, index"),
    ([{"terms": [[[0, 1], "1"]], "strict": "no"}], [["0", "1", 0]], "true, false or null"),
    ([{"terms": [[[1], "1"]], "strict": False}], [["0", "1", 0]], "expected 2 exponents"),
    ([{"terms": [[[0, 1], "1"], [[0, 1], "1"]], "strict": False}], [["0", "1", 0]], "each once"),
    ([{"terms": [[[0, 1]]], "strict": False}], [["0", "1", 0]], "exponents, coefficient"),
    ([{"terms": [[[0, 10**4], "1"]], "strict": False}], [["0", "1", 0]], "a degree up to"),
)
def test_what_is_refused_of_a_clearance(constraints: list[Any], spans: list[Any], reason: str) -> None:
    verdict = qe.verify(read("clearance", clearance(constraints, spans)))
    assert not verdict.accepted and verdict.decided and reason in verdict.reason


def test_a_first_contact() -> None:
    """y >= 3/4 is reached at t = 1/4, where 4t(1-t) = 3/4."""
    wall, before, at = [half_plane("3/4")], [["0", "1/8", 0]], {"after": "1/8", "t": "1/4", "piece": 0}
    assert qe.verify(read("clearance", clearance(wall, before, at)), core=True).accepted
    start = clearance([half_plane("0")], [], {"after": "0", "t": "0", "piece": 0})
    assert qe.verify(read("clearance", start), core=True).accepted
    for wrong in ({"t": "1/5"}, {"t": "1/9"}, {"t": "9/8"}, {"piece": 1}, {"after": "1/4"}):
        assert not qe.verify(read("clearance", clearance(wall, before, {**at, **wrong}))).accepted, wrong
    assert not qe.verify(read("clearance", clearance([half_plane("3/4", strict=True)], before, at))).accepted
    assert not qe.verify(read("clearance", {**clearance([], []), "pieces": []})).accepted


ROOTS = [[["0", "1"], "0"], ["0", ["0", "1"]]]  # from (sqrt 2, 0) to (0, sqrt 2)


@each(
    (containment(side("2", "0", "1")), True),  # y <= 2, of the control points
    (containment(side("1", "0", "1"), "0", "1/2", "1"), True),
    (containment(side("1", "1", "0")), True),
    (containment(ball("1"), "0", "1/2", "1"), True),
    (containment(ball("2", "0", "1")), True),
    (containment(ball("2"), points=ROOTS, field=SQRT2), True),
    (containment(ball("199/100"), points=ROOTS, field=SQRT2), False),
    (containment(side("99/100", "0", "1"), "0", "1/2", "1"), False),
    (containment(side("0", "0", "1")), False),
    (containment(side("0", "1", "0")), False),
    (containment(ball("1", "0", "1")), False),
    (containment(ball("99/100")), False),
    (containment(side("1", "0", "1", "0")), False),
    (containment(ball("4", "0", "0", "0")), False),
    *((containment(side("2", "0", "1"), *breaks), False) for breaks in (("0",), ("0", "1/2"), ("1/2", "1"))),
    (containment(side("2", "0", "1"), "0", "2/3", "1/3", "1"), False),
    (containment(None), False),
)
def test_the_curve_stays_inside(payload: dict[str, Any], is_right: bool) -> None:
    certificate = read("containment", payload)
    verdict = qe.verify(certificate, core=True) if is_right else qe.verify(certificate)
    assert verdict.accepted is is_right and verdict.decided


def test_an_altered_digest_is_seen_in_files_of_former_releases_too() -> None:
    certificate = read("containment", containment(ball("4")))
    data = json.loads(certificate.to_json())
    data["version"] = 2
    with_other = qe.Certificate.from_json(json.dumps({**data, "digest": "0" * 64}))
    assert qe.verify(with_other).step == "digest"


@pytest.mark.parametrize("kind", ["containment", "clearance"])
def test_kinds_of_former_releases_prove_nothing_but_as_sentences(kind: str) -> None:
    assert not qe.verify(qe.Certificate(qe.proof.certificate.Kind(kind), {})).accepted
    assert not qe.verify(read(kind, {})).accepted


EV3 = load_arm("ev3-120")
LINE = {"line": Bezier.of([(10, 40, 80), (40, 100, 20)])}


def motions() -> qe.Certificate:
    found = continuous_motions(EV3, LINE)
    assert found is not None
    return motions_certificate(found)


MADE: dict[str, tuple[Callable[[], qe.Certificate], Callable[[Any], Any]]] = {
    "inverse": (lambda: inverse_certificate(solve(EV3, (10, 40, 80))), lambda p: p.update(count=p["count"] + 1)),
    "branch": (lambda: certificates(joint_path(EV3, LINE))[0][1], lambda p: p["pieces"][0].update(radius=["3"] * 3)),
    "motions": (motions, lambda p: p.update(motions=p["motions"] + 1)),
}


@pytest.mark.parametrize("kind", MADE)
def test_what_was_accepted_is_the_evidence_of_a_sentence(kind: str) -> None:
    make, alter = MADE[kind]
    made = make()
    payload = evidence_of(made)
    certificate = read(kind, payload)
    assert recent(certificate).payload == made.payload
    assert qe.verify(certificate).accepted and qe.verify(certificate, core=True).step == "core"
    alter(payload)
    assert not qe.verify(read(kind, payload)).accepted
    assert not qe.verify(read(kind, {})).accepted and not qe.verify(read(kind, {**payload, "arm": None})).accepted
