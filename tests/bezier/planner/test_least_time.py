"""``law = "least"``: the least time along a planned path, from both sides, and found again in its folder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

import bezier
import qe
from bezier.cli import main
from bezier.problem import read_problem

POINTS = {"start": [-4, 2, 1], "via": [["-3/2", 2, 3], ["3/2", 2, 3]], "goal": [4, 2, 1], "radius": 6}
LIMITS = {"law": "least", "max_speed": 2, "max_acceleration": "3/2"}
FILE = """radius = 6
start = [-4, 2, 1]
via = [["-3/2", 2, 3], ["3/2", 2, 3]]
goal = [4, 2, 1]
[timing]
law = "least"
max_speed = 2
max_acceleration = "3/2"
"""


def test_the_least_time_is_proved_from_both_sides(tmp_path: Path) -> None:
    planned = bezier.plan(**POINTS, limits=LIMITS)
    motion = planned.motion
    assert planned.certified and motion is not None and motion.keeps_limits and motion.at_least is not None
    assert motion.at_least < motion.duration < motion.at_least * 1005 / 1000
    usual = bezier.plan(**POINTS, limits={**LIMITS, "law": "cubic"}).duration
    assert motion.duration < usual
    times = np.linspace(0, float(motion.duration), 100_001)
    fastest = np.linalg.norm(planned.velocity(times), axis=1).max()
    hardest = np.linalg.norm(planned.acceleration(times), axis=1).max()
    assert 1.999 < fastest <= 2 and 1.499 < hardest <= 1.5
    assert replace(read_problem(FILE), source="") == replace(planned.problem, source="")
    folder = tmp_path / "out"
    planned.save(folder, pictures=False)
    assert main(["check", str(folder)]) == 0  # without a search
    certificate = qe.Certificate.from_json((folder / "certificate.json").read_text())
    parts = [(m.label, m.certificate) for m in certificate.payload]
    fewer = [part for part in parts if not part[0].startswith("least time: piece 3:")]
    assert len(fewer) == len(parts) - 1
    (folder / "certificate.json").write_text(qe.Certificate.bundle(fewer).to_json())
    assert main(["check", str(folder)]) == 4
