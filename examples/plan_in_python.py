"""A path over a ball for an arm, planned from Python, and what other programs get of it.

Run with ``python examples/plan_in_python.py [folder]``; with a folder, the files are written there.
"""

import sys
from pathlib import Path

import numpy as np

import bezier
import qe

corners = np.array([[-1.5, 2, 3], [1.5, 2, 3]])
plan = bezier.plan(
    method="cubic",
    start=[-4, 2, 1],
    via=corners,
    goal=[4, 2, 1],
    radius=6,
    obstacles=[{"kind": "ball", "name": "balloon", "centre": [0, 2, 1], "radius": 1.5, "margin": 0.05}],
    limits={"law": "quintic", "max_speed": 2, "max_acceleration": 1.5},
)
print(plan)
print("proved              ", plan.certified)
print("clear of the balloon", plan.clearance.to_json(6)["low"], "mm")

seconds = np.linspace(0, float(plan.duration), 5)
for time, place, velocity in zip(seconds, plan(seconds), plan.velocity(seconds)):
    print(f"{time:6.3f} s   at {np.round(place, 4) + 0.0}   {np.linalg.norm(velocity):.4f} mm/s")

try:
    bezier.plan(start=[-4, 2, 1], via=corners, goal=[4, 2, 1], radius=6, limits={"max_sped": 2})
except qe.InputError as error:
    print(error)

if len(sys.argv) > 1:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for ending in ("csv", "json", "npz", "yaml", "gcode", "svg"):
        plan.save(folder / f"path.{ending}")
    plan.save(folder / "all")  # as `bezier plan` does, for `bezier check`
