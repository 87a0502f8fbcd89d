"""The benchmark of clearance: proofs for whole curves beside sampling at 1,000 points per curve.

Run it with ``python -m experiments.bench_obstacles``. The random curves and obstacles come from a fixed seed, and all
their numbers are rational; sampling uses floating point, as a program without exact arithmetic would.
"""

from __future__ import annotations

import random
import time
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

import numpy as np

from bezier.curves.curve import Bezier
from bezier.obstacles.bodies import Body, Cylinder, HalfSpaceBody, Rounded
from bezier.obstacles.clearance import Along, Clear, Contact, examine
from bezier.obstacles.obstacle import Obstacle, ObstacleKind, from_body
from bezier.obstacles.polyhedron import Point, parallelepiped, point, segment
from bezier.pictures.mesh import sampled
from experiments.bench import Row, median
from qe.arguments import rational

SAMPLES = 1000
CURVES, OBSTACLES = 1000, 20


def ball(centre: Sequence[Fraction], radius: Fraction) -> Obstacle:
    """A ball."""
    return from_body("ball", ObstacleKind.BALL, Rounded(point(tuple(centre)), radius))


def scene(count: int, seed: int = 5) -> list[Obstacle]:
    """Balls, boxes with and without margin, cylinders and capsules in a cube of side 20."""
    pick = random.Random(seed)

    def number(low: int, high: int) -> Fraction:
        return Fraction(pick.randint(100 * low, 100 * high), 100)

    def place() -> Point:
        return tuple(number(-10, 10) for _ in range(3))

    found = []
    for i in range(count):
        corner, sizes = place(), [number(1, 3) for _ in range(3)]
        sides = [tuple(sizes[k] if k == j else Fraction(0) for j in range(3)) for k in range(3)]
        end = tuple(c + number(1, 3) for c in corner)
        body: Body = (
            Rounded(point(corner), sizes[0]),
            Rounded(parallelepiped(corner, sides), Fraction(0)),
            Cylinder((corner[0], corner[1]), sizes[0] / 2, corner[2], corner[2] + sizes[1]),
            Rounded(segment(corner, end), sizes[0] / 2),
            Rounded(parallelepiped(corner, sides), Fraction(1, 4)),
        )[i % 5]
        found.append(from_body(f"obstacle {i}", ObstacleKind.POLYHEDRON, body))
    return found


def cubics(count: int, seed: int = 7) -> list[Bezier]:
    """Random cubic curves in the same cube."""
    pick = random.Random(seed)
    return [
        Bezier.of([[Fraction(pick.randint(-1000, 1000), 100) for _ in range(3)] for _ in range(4)])
        for _ in range(count)
    ]


@dataclass(frozen=True, slots=True)
class Near:
    """A ball that a curve dips into by so little, or touches, that no sample lies in it."""

    what: str
    curve: Bezier
    obstacle: Obstacle


def hidden_contacts() -> list[Near]:
    """Contacts between the samples k/999: the arch has its top at t = 1/2, the slanted one at t = 1/3."""
    arch = Bezier.of([(-2, 0, 0), (0, 0, 4), (2, 0, 0)])
    slanted = Bezier.of([(0, 0, 0), (1, 0, 2), (3, 0, -2)])  # z = 4t - 6t^2
    top = slanted.point(Fraction(1, 3) + Fraction(1, 5000))
    return [
        Near("dips 1e-7 into a ball", arch, ball((Fraction(0), Fraction(0), Fraction(3)), 1 + Fraction(1, 10**7))),
        Near("touches a ball", arch, ball((Fraction(0), Fraction(0), Fraction(3)), Fraction(1))),
        Near(
            "passes through a ball of radius 1e-4", slanted, ball([rational(c, "top") for c in top], Fraction(1, 10**4))
        ),
    ]


def sampled_contact(curve: Bezier, obstacle: Obstacle) -> bool:
    """Whether one of ``SAMPLES`` equally spaced points, in floating point, lies in the obstacle."""
    points = sampled(curve.points, SAMPLES)
    inside = np.zeros(SAMPLES, dtype=bool)
    for piece in obstacle.pieces:
        held = np.ones(SAMPLES, dtype=bool)
        for constraint in piece.constraints:
            value = sum(float(c) * np.prod(points ** np.array(e), axis=1) for e, c in constraint.terms)
            held &= value >= 0
        inside |= held
    return bool(inside.any())


def sampling_misses() -> str:
    """What sampling says of the contacts constructed to lie between its points, and what the proof says."""
    found = []
    for near in hidden_contacts():
        proof, samples = examine(near.curve, near.obstacle), sampled_contact(near.curve, near.obstacle)
        assert isinstance(proof, Contact)
        said = "finds it too" if samples else "misses it"
        found.append(f"     {near.what}: the proof finds it at t = {float(proof.t[0]):.9f}, sampling {said}")
    return "\n".join(found)


def single_pairs() -> list[Row]:
    """One cubic curve against one convex obstacle: clear after subdivision, contact, close miss."""
    curve = Bezier.of([(-3, 0, 0), (-1, 1, 4), (1, -1, 4), (3, 0, 0)])  # z = 12 t (1-t), at most 3
    low, high = tuple(map(Fraction, (-1, -1, 0))), [Fraction(2), Fraction(2), Fraction(2)]
    sides = [tuple(high[k] if k == j else Fraction(0) for j in range(3)) for k in range(3)]
    cases: dict[str, Body] = {
        "ball, close miss": Rounded(point(tuple(map(Fraction, (0, 0, 4)))), Fraction(99, 100)),
        "ball, contact": Rounded(point(tuple(map(Fraction, (0, 0, 4)))), Fraction(11, 10)),
        "ball, tangent": Rounded(point(tuple(map(Fraction, (0, 0, 4)))), Fraction(1)),
        "box, clear": Rounded(parallelepiped(low, sides), Fraction(0)),
        "half-space, clear": HalfSpaceBody(tuple(map(Fraction, (0, 0, -1))), Fraction(-31, 10)),
        "cylinder, clear": Cylinder((Fraction(0), Fraction(0)), Fraction(1), Fraction(0), Fraction(5, 2)),
        "capsule, clear": Rounded(segment(low, tuple(map(Fraction, (1, 1, 1)))), Fraction(1, 2)),
    }
    rows = []
    for name, body in cases.items():
        obstacle = from_body(name, ObstacleKind.POLYHEDRON, body)
        rows.append(Row(f"one cubic, {name}", 0.005, median(partial(examine, curve, obstacle))))
    return rows


def many_pairs(curves: int = CURVES, obstacles: int = OBSTACLES) -> tuple[Row, list[tuple[Bezier, Obstacle, bool]]]:
    """Random curves against a scene; the row, and for each pair whether it is clear."""
    things, pairs = scene(obstacles), []
    begin = time.perf_counter()
    for curve in cubics(curves):
        along = Along(curve)
        pairs += [(curve, thing, isinstance(examine(along, thing), Clear)) for thing in things]
    seconds = time.perf_counter() - begin
    met = sum(not clear for *_, clear in pairs)
    row = Row(f"{curves} cubics, {obstacles} obstacles", 60.0, seconds, note=f"{met} of {len(pairs)} pairs meet")
    return row, pairs


def main() -> None:
    """Print the table."""
    for row in single_pairs():
        print(row)
    row, pairs = many_pairs()
    print(row)
    begin = time.perf_counter()
    samples = [sampled_contact(curve, thing) for curve, thing, _ in pairs[: len(pairs) // 10]]
    print(f"     sampling a tenth of the pairs at {SAMPLES} points: {time.perf_counter() - begin:.1f} s")
    wrong = sum(seen and clear for seen, (*_, clear) in zip(samples, pairs, strict=False))
    missed = sum(not seen and not clear for seen, (*_, clear) in zip(samples, pairs, strict=False))
    print(f"     contacts that sampling missed there: {missed}; clear pairs that it called contacts: {wrong}")
    print(sampling_misses())


if __name__ == "__main__":
    main()
