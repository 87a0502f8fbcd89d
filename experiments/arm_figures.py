"""The suite ``arm``: CPU seconds of every question about the EV3 arm, published times of its authors beside them.

The published figures are of other machines: Core i5-8259U for L = 112 (arXiv 2111.00384), Xeon Silver 4210 and Apple M1
Max for L = 120 (arXiv 2305.12451). Points: the authors' logged ones where the folder ``shared/corpora/ev3`` is beside
the project, and else as many drawn as they drew them, x and y in (-200, 200), z in (0, 300).
"""

from __future__ import annotations

import json
import random
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import hypot, sqrt
from pathlib import Path

import qe
from bezier.arm import inverse
from bezier.arm.evidence import certificates
from bezier.arm.inverse_evidence import inverse_certificate
from bezier.arm.joint_path import joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.kinematics import positions
from bezier.arm.model import Arm
from bezier.arm.pose import rotation_of, solve_pose
from bezier.arm.reader import load_arm
from bezier.arm.study import study
from bezier.curves.curve import Bezier
from bezier.curves.scalar import exactly
from bezier.motion.timelaw import Law, TimeLaw

POINTS = 100
SEED = 11
CORPUS = Path(__file__).resolve().parents[2] / "shared" / "corpora" / "ev3"
VARIABLES = ("s7", "c7", "s4", "c4", "s1", "c1")
STRAIGHT = Bezier.of([(10, 40, 80), (40, 100, 20)])
CUBIC = Bezier.of([(10, 40, 80), (60, 60, 120), (90, 20, 150), (40, 100, 20)])
Point = tuple[Fraction, Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Figure:
    """One line: CPU seconds of each run, what was asked for, what was published (empty: nothing was), and a remark."""

    name: str
    seconds: tuple[float, ...]
    asked: float | None
    published: str = ""
    remark: str = ""

    @property
    def median(self) -> float:
        """The median of the runs."""
        return statistics.median(self.seconds)


def figures(repeat: int = 3) -> Iterator[Figure]:
    """Every figure, as it is measured; ``repeat`` runs of each question, one of each at every point."""
    arm = load_arm("ev3-120")
    line = ("10 + 30*s", "40 + 60*s", "80 - 60*s")
    yield _timed(
        "comprehensive Gröbner system, L = 120",
        lambda: qe.comprehensive_groebner(_system(("x", "y", "z")), VARIABLES, constants=_constants(), process=False),
        repeat,
        2.0,
        "31.6-62.3 s",
    )
    yield _timed(
        "the same of the straight path, parameter s",
        lambda: qe.comprehensive_groebner(_system(line), VARIABLES, constants=_constants(), process=False),
        repeat,
        1.0,
        "485.8 s",
    )
    yield _timed("preparation of the arm, once", lambda: _prepared(arm), repeat, 2.0, "31.6-62.3 s")
    yield from _points()
    yield _timed("certificate at a point, made and checked", _certified, repeat, None)
    moments = [_moment(Fraction(k, 50)) for k in range(51)]
    yield _timed(
        "trajectory of 51 points", lambda: [inverse.solve(arm, p) for p in moments], repeat, 0.3, "0.95-2.25 s"
    )
    yield _timed("straight path, number of solutions", lambda: study(arm, STRAIGHT), repeat, 1.0, "485.8 + 1.1 s")
    yield _timed("straight path, four branches with certificates", lambda: _path(arm, STRAIGHT), repeat, 1.0)
    yield _timed("cubic path, four branches with certificates", lambda: _path(arm, CUBIC), repeat, 5.0)
    yield _timed("joint sequence of 200 samples, with bounds", lambda: _sequence(arm), repeat, 1.0)
    turned = rotation_of((2, 1, -1, 1))
    six = load_arm("six-joints")
    yield _timed("all solutions at a pose, six joints", lambda: solve_pose(six, (120, 90, 200), turned), repeat, None)


def table(found: Sequence[Figure]) -> str:
    """The figures as a table in Markdown."""
    lines = ["| task | here (median) | asked | published | remark |", "|---|---|---|---|---|"]
    for f in found:
        asked = "" if f.asked is None else f"{_shown(f.asked)}{'' if f.median <= f.asked else ' (OVER)'}"
        lines.append(f"| {f.name} | {_shown(f.median)} | {asked} | {f.published} | {f.remark} |")
    return "\n".join(lines)


def _shown(seconds: float) -> str:
    return f"{seconds * 1000:.1f} ms" if seconds < 0.1 else f"{seconds:.2f} s"


def _timed(
    name: str, task: Callable[[], object], repeat: int, asked: float | None, published: str = "", remark: str = ""
) -> Figure:
    seconds = []
    for _ in range(repeat):
        start = time.process_time()
        task()
        seconds.append(time.process_time() - start)
    return Figure(name, tuple(seconds), asked, published, remark)


def _prepared(arm: Arm) -> None:
    inverse.general.cache_clear()
    inverse.geometry_of.cache_clear()
    inverse.general(arm, 0)


def _certified() -> object:
    return inverse_certificate(
        inverse.solve(load_arm("ev3-120"), (Fraction(599, 66), Fraction(824, 33), Fraction(323, 10)))
    )


def _path(arm: Arm, curve: Bezier) -> object:
    return certificates(joint_path(arm, {"curve": curve}))


def _sequence(arm: Arm) -> object:
    return joint_plan(arm, {"line": STRAIGHT}, TimeLaw.of(Law.QUINTIC), Fraction(50), 200)


def _moment(tau: Fraction) -> Point:
    x, y, z = (exactly(c) for c in STRAIGHT.point(6 * tau**5 - 15 * tau**4 + 10 * tau**3))
    return x, y, z


def _points() -> Iterator[Figure]:
    """A query at each logged or drawn point: the time, wrong counts, and the largest distance of a solution's point."""
    for name, length, published in (
        ("queries_L120", 120, "51-107 ms"),
        ("queries_L112", 112, "558 ms"),
        ("points_L120_without_log", 120, ""),
    ):
        arm, seconds, wrong, away = load_arm(f"ev3-{length}"), [], 0, 0.0
        points = list(_listed(name, length))
        inverse.solve(arm, points[0][0])
        for point, count in points:
            start = time.process_time()
            found = inverse.solve(arm, point)
            seconds.append(time.process_time() - start)
            wrong += found.count != count
            if found.solutions:
                reached = positions(arm, [[a or 0.0 for a in s.angles] for s in found.solutions])
                away = max(away, float(abs(reached - [float(c) for c in point]).max()))
        remark = f"{len(points)} points, {wrong} wrong counts, within {away:.0e} mm"
        yield Figure(f"query at a point, {name}", tuple(seconds), 0.003, published, remark)


def _listed(name: str, length: int) -> Iterator[tuple[Point, int]]:
    file = CORPUS / f"{name}.jsonl"
    if file.is_file():
        for text in file.read_text(encoding="utf-8").splitlines():
            row = json.loads(text)
            yield (Fraction(row["x"]), Fraction(row["y"]), Fraction(row["z"])), row["real_solutions"]
        return
    chance = random.Random(f"{name}{SEED}")
    for _ in range(POINTS):
        x, y, z = (
            Fraction(chance.randint(low * 60 + 1, high * 60 - 1), 60)
            for low, high in ((-200, 200), (-200, 200), (0, 300))
        )
        yield (x, y, z), _closed_form((float(x), float(y), float(z)), length)


def _closed_form(point: tuple[float, float, float], length: int) -> int:
    """Two solutions for each sign of the distance from the axis with which the elbow can be placed."""
    x, y, z = point
    upper = sqrt(18752)
    distances = (hypot(side * hypot(x, y) - 44 * sqrt(2), z - 104 - 44 * sqrt(2)) for side in (1, -1))
    return sum(2 for d in distances if abs(upper - length) < d < upper + length)


def _constants() -> dict[str, qe.RealAlgebraic]:
    return {"w": qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)}


def _system(point: Sequence[str]) -> list[str]:
    """The published system: reach(c4, s4, c7, s7) times (c1, s1), the height, and three circles."""
    reach = "(120*c4*s7 - 16*c4 + 120*s4*c7 + 136*s4 - 44*w)"
    height = "-120*c4*c7 - 136*c4 + 120*s4*s7 - 16*s4 - 104 - 44*w"
    x, y, z = point
    circles = [f"c{k}^2 + s{k}^2 - 1" for k in (1, 4, 7)]
    return [f"c1*{reach} + {x}", f"s1*{reach} + {y}", f"{height} + {z}", *circles]
