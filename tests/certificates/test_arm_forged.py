"""Certificates of the arm with one entry altered: none of them is accepted."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

import pytest

import qe
from bezier.arm.evidence import certificates
from bezier.arm.inverse import solve
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.model import Arm
from bezier.arm.reader import load_arm, read_route
from bezier.curves.curve import Bezier
from qe.certify.verify import verify_json
from tests.certificates.mutation import EVIDENCE, Path, evidence_in, leaves, lists, other_numbers, replaced, without
from tests.certificates.restated import verdict_by

EV3 = load_arm("ev3-120")


def path_certificate(arm: Arm, curves: dict[str, Bezier]) -> Any:
    bundle = qe.Certificate.bundle(certificates(joint_path(arm, curves))[:1])
    assert qe.verify(bundle).accepted
    return json.loads(bundle.to_json())


def at_a_point(arm: str, *point: int | Fraction) -> Any:
    return json.loads(inverse_certificate(solve(load_arm(arm), point)).to_json())


MADE = {
    "point": lambda: at_a_point("ev3-120", Fraction(599, 66), Fraction(824, 33), Fraction(323, 10)),
    "two for one last joint": lambda: at_a_point("shoulder-3r", 50, 40, 120),
    "line": lambda: path_certificate(EV3, read_route("[[curve]]\npoints = [[10, 40, 80], [40, 100, 20]]\n")),
    "two curves": lambda: path_certificate(
        EV3,
        read_route(
            "[[curve]]\npoints = [[10, 40, 80], [40, 100, 20]]\n[[curve]]\npoints = [[40, 100, 20], [60, 90, 30]]\n"
        ),
    ),
}


def altered(step: Any) -> Iterator[tuple[Path, Any]]:
    """The evidence of a step with numbers far away, lists without an element. A box that is larger on one side, or a
    piece with other bounds of its own derivatives, may still be right: boxes are altered by moving both ends only."""
    evidence = {"evidence": step["evidence"]}

    def read(text: str) -> Any:
        return json.loads(text)["evidence"]

    for path, value in leaves(evidence):
        if "solutions" in path:
            continue
        if isinstance(value, int) and not isinstance(value, bool):
            yield path, read(replaced(evidence, path, value + 1))
        elif isinstance(value, str) and value.lstrip("-")[:1].isdigit():
            yield from ((path, read(replaced(evidence, path, other))) for other in other_numbers(value))
    for path, node in lists(evidence):
        if "solutions" in path and len(path) > path.index("solutions") + 1 and isinstance(node[0], str):
            moved = [str(Fraction(end) + 1) for end in node]
            yield path, read(replaced(evidence, path, moved))
        yield from ((path, read(without(evidence, path, k))) for k in range(len(node)))


@pytest.mark.parametrize(
    "name", ["point", "two for one last joint", "line", pytest.param("two curves", marks=pytest.mark.deep)]
)
def test_no_altered_entry_is_accepted(name: str) -> None:
    """Neither with the sentence as it is, nor with the one that the altered evidence says."""
    whole = MADE[name]()
    assert verify_json(json.dumps(whole)).accepted
    place: Path = EVIDENCE if "payload" in whole else ("certificates", 0, *EVIDENCE)
    step = (whole if "payload" in whole else whole["certificates"][0])["payload"]["steps"][0]
    listed = list(altered(step))
    for path, evidence in Random(5).sample(listed, min(len(listed), 12)):
        verdict = verify_json(replaced(whole, place, evidence))
        assert not verdict.accepted and verdict.step != "digest", path
        # without its first or last piece a branch is shorter, and followed all the same
        if path[-1] != "pieces":
            assert not verdict_by(step["rule"], evidence).accepted, path


def test_no_solution_is_no_solution() -> None:
    whole = at_a_point("ev3-112", 600, 0, 10)
    nearer = replaced(whole, (*EVIDENCE, "point", 0), [["100", 1]])
    for text in (replaced(whole, (*EVIDENCE, "count"), 2), nearer):
        assert not verify_json(text).accepted


def test_the_arm_of_the_path_of_a_plan() -> None:
    """The certificate of one arm is none for another."""
    whole = MADE["line"]()
    rows = evidence_in(whole["certificates"][0])["arm"]["rows"]
    assert rows[-1]["a"] == "120"
    assert not verify_json(replaced(whole, ("certificates", 0, *EVIDENCE, "arm", "rows", 7, "a"), "112")).accepted
