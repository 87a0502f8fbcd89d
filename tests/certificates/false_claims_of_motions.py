"""Certificates of all continuous motions of an arm, made at random, mostly near places where solutions meet, and what
shows that a claim of theirs is false: the motions counted once more by the planner."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.arm.continuous import continuous_motions
from bezier.arm.evidence import motions_certificate
from bezier.arm.reader import load_arm, read_arm
from bezier.curves.curve import Bezier
from qe.errors import QEError, Unable
from qe.proof.certificate import Certificate
from tests.certificates.false_claims_of_arms import Data, toml_of
from tests.certificates.mutation import evidence_in
from tests.certificates.restated import is_stated

MILLIMETRES = (-100, -30, -20, -10, 0, 0, 10, 20, 30, 50, 100)
HEIGHTS = (70, 100, 100, 130, 200)


def motions(rng: random.Random) -> Certificate | None:
    """One or two short curves near the axis and the inner borders."""
    arm = load_arm(rng.choice(("ev3-120", "shoulder-3r", "shoulder-3r", "cylindrical")))
    point = _point(rng)
    curves = {}
    for k in range(rng.choice((1, 1, 2))):
        points = [point, *(_point(rng) for _ in range(rng.choice((1, 1, 2))))]
        curves[str(k)], point = Bezier.of(points), points[-1]
    try:
        found = continuous_motions(arm, curves)
        return None if found is None else motions_certificate(found)
    except Unable:
        return None


def _point(rng: random.Random) -> tuple[int, int, int]:
    return rng.choice(MILLIMETRES), rng.choice(MILLIMETRES), rng.choice(HEIGHTS)


def other_motions(rng: random.Random, data: Data) -> bool:
    """Whether the numbers are others than those of the motions that are found."""
    if not is_stated(data):
        return True
    payload: Any = evidence_in(data)
    curves = {str(k): Bezier.of([tuple(map(Fraction, p)) for p in c]) for k, c in enumerate(payload["curves"])}
    ends = list(curves.values())
    if any(a.points[-1] != b.points[0] for a, b in pairwise(ends)):
        return True
    try:
        found = continuous_motions(read_arm(toml_of(payload["arm"])), curves)
    except QEError:
        return False
    if found is None:
        return False
    solutions = [len(arcs.labels) for arcs in found.arcs]
    through = [len(junction.passes) for junction in found.junctions]
    return bool([payload[key] for key in ("solutions", "through", "motions")] != [solutions, through, found.count])
