"""``bezier chain`` and ``bezier.chain``: the same answers, certificates about this chain alone, clear refusals."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import pytest

import bezier
import qe
from bezier.chains.checking import checked
from bezier.chains.reader import load_chain
from bezier.cli.app import main
from qe.errors import CertificateRejected
from qe.proof.certificate import Certificate
from tests.tables import each

EXAMPLES = Path(__file__).resolve().parents[3] / "examples" / "chains"
GOOD = "start = [0, 0]\nvia = [[2, 1], [3, 3]]\ngoal = [5, 2]\n"


@pytest.fixture(scope="module")
def none() -> Any:
    """No chain, with its repairs; whoever changes the certificate takes a copy."""
    given = {"start": [1, -5, -1], "via": [[-2, -4, 4], [-1, 6, 1], [1, 2, 2]], "goal": [-4, -1, -3], "radius": "6.5"}
    return bezier.chain(**given).with_repairs()


@each(("plane.toml", 0), ("none.toml", 3))
def test_the_examples_are_decided_checked_and_drawn(
    file: str, status: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    proof, page = tmp_path / "proof.json", tmp_path / "page.html"
    assert main(["chain", str(EXAMPLES / file), "--certificate", str(proof), "--page", str(page)]) == status
    assert main(["chain", str(EXAMPLES / file), "--check", str(proof)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "accepted"
    text = page.read_text()
    assert text.count("<svg") == (1 if status == 0 else 3) and ("possible with radius" in text) is (status == 3)
    other = next(name for name in ("plane.toml", "none.toml") if name != file)
    assert main(["chain", str(EXAMPLES / other), "--check", str(proof)]) == 4
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_both_doors_say_the_same(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["chain", str(EXAMPLES / "plane.toml"), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    result = bezier.chain(
        start=[-4, 0],
        via=[[-3, 2], [-1, 3], [1, 1.5], [2, 2.5], [3.5, 1]],
        goal=[4, -1],
        radius="17/4",
        durations=[1, 1, 1.2, 0.8, 1, 1],
        half_spaces=[([0, -1], -3.05)],
    )
    assert {key: said[key] for key in result.to_json()} == json.loads(json.dumps(result.to_json()))


def test_repairs_work_and_less_does_not(none: Any) -> None:
    assert not none.feasible and [r.change for r in none.repairs] == ["radius", "via[1]", "durations[1]"]
    assert qe.verify(none.proof).accepted
    points = [[1, -5, -1], [-2, -4, 4], [-1, 6, 1], [1, 2, 2], [-4, -1, -3]]

    def again(radius: Any = "6.5", moved: Any = None, durations: Any = ()) -> bool:
        listed = [*points[:2], moved or points[2], *points[3:]]
        ends = {"start": listed[0], "via": listed[1:-1], "goal": listed[-1]}
        return bool(bezier.chain(**ends, radius=radius, durations=durations).feasible)

    radius, point, duration = none.repairs
    assert again(radius=radius.value[0] * 2) and not again(radius=radius.too_small)
    assert again(moved=point.value)
    distance = sum((a - b) ** 2 for a, b in zip(point.value, points[2], strict=True))
    assert 0 < distance - point.too_small < distance / 10**6
    shorter = [b + (a - b) * 99 / 100 for a, b in zip(point.value, points[2], strict=True)]
    assert not again(moved=shorter)
    assert not again(durations=[1, duration.too_small, 1, 1])


@each(*range(60), daily=3)
def test_altered_certificates_are_refused(seed: int, none: Any) -> None:
    """One number or label of a member changed, or members exchanged: nothing else than the proof is accepted."""
    chance, data = random.Random(seed), json.loads(none.proof.to_json())
    members = data["certificates"]
    member = chance.choice(members)
    kind = seed % 4
    if kind == 0:
        member["label"] = chance.choice([m["label"] for m in members if m["label"] != member["label"]])
    elif kind == 1:
        old = member["label"]
        member["label"] = old.replace("1", "2", 1) if "1" in old else "least value at least 3"
    elif kind == 2:
        text = json.dumps(member["payload"]["start"])
        place = chance.choice([i for i, c in enumerate(text) if c.isdigit()])
        changed = text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1 :]
        member["payload"]["start"] = json.loads(changed)
    else:
        steps = member["payload"]["steps"][0]["evidence"]
        key = "multipliers" if "multipliers" in steps else "values"
        steps[key] = [["7"] if key == "multipliers" else "7" for _ in steps[key]]
    from qe.proof.certificate import digest

    data["digest"] = digest({key: value for key, value in data.items() if key != "digest"})
    with pytest.raises(CertificateRejected):
        checked(none.chain, Certificate.from_json(json.dumps(data)))


@each(
    ("", "start"),
    (GOOD + "radius = -1", "radius"),
    (GOOD + "colour = 1", "colour"),
    (GOOD + "degree = 2.5", "degree"),
    (GOOD + "durations = [1, 0, 1]", "durations[1]"),
    (GOOD + "durations = [[1, 1, 1]]", "durations: expected 3 numbers"),
    (GOOD + "durations = [1, [1], 1]", "durations[1]"),
    (GOOD + "durations = [1, 1]", "durations: expected 3 numbers"),
    (GOOD + "closed = 1", "closed"),
    (GOOD + "closed = true", "goal"),
    (GOOD + "[[half_space]]\nnormal = [0, 0]\noffset = 1", "normal"),
    (GOOD.replace("[2, 1]", "[0, 0]"), "via[0]"),
    (GOOD.replace("[2, 1]", "[2, 1, 4]"), "via[0]"),
    (GOOD.replace("[2, 1]", '"a"'), "via[0]"),
    (GOOD + "ends = 'stop'", "ends"),
    (GOOD + "velocities = [[1, 2]]", "velocities"),
    (GOOD + "total = 3", "total"),
    (GOOD + "durations = 'fast'", "durations"),
    (GOOD + "max_length = 0", "max_length"),
)
def test_bad_files_get_one_line_with_the_key(
    text: str, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "chain.toml"
    file.write_text(text)
    assert main(["chain", str(file)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert key in line and "chain.toml" in line and "expected" in line


def test_certificates_of_regions_and_of_picked_durations(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, proof = tmp_path / "chain.toml", tmp_path / "proof.json"
    file.write_text(GOOD + "radius = 6\n")
    assert main(["chain", str(file), "--region", "C2.1", "--certificate", str(proof)]) == 0
    assert main(["chain", str(file), "--check", str(proof)]) == 0
    said = capsys.readouterr().out
    assert said.count("a chain has C2.1 at") == said.count("no chain has C2.1 beyond") > 20
    wider = proof.read_text().replace("a chain has C2.1 at ", "a chain has C2.2 at ", 1)
    proof.write_text(wider)
    assert main(["chain", str(file), "--check", str(proof)]) == 4
    file.write_text(GOOD + "radius = 6\ndurations = 'free'\ntotal = 5\n")
    assert main(["chain", str(file), "--certificate", str(proof)]) == 0
    assert main(["chain", str(file), "--check", str(proof)]) == 0
    file.write_text(GOOD + "radius = 6\ndurations = 'free'\ntotal = 4\n")
    assert main(["chain", str(file), "--check", str(proof)]) == 4


def test_a_limit_on_time_is_kept() -> None:
    points = [[k, (k * k) % 7] for k in range(52)]
    with pytest.raises(qe.BudgetExceeded):
        bezier.chain(start=points[0], via=points[1:-1], goal=points[-1], radius=60, timeout=1e-3)
    assert isinstance(load_chain(EXAMPLES / "plane.toml").points, tuple)
