"""Claims of the paper's references on the inverse kinematics of the EV3 arm, which the paper builds on."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import qe
from bezier.arm.evidence import certificates
from bezier.arm.inverse import solve
from bezier.arm.joint_path import joint_path
from bezier.arm.joint_plan import joint_plan
from bezier.arm.reader import load_arm
from bezier.arm.study import study
from bezier.curves.curve import Bezier
from bezier.motion.timelaw import Law, TimeLaw
from paper_repro.claim import Evidence, Fact, Table, Verdict, claim

POINT = (Fraction(599, 66), Fraction(824, 33), Fraction(323, 10))
GOAL = (40, 100, 20)
STARTS = ((10, 40, 80), (50, 25, 100))
SHARED = ((Fraction(756424, 10**6), Fraction(993797, 10**6)), (Fraction(792322, 10**6), Fraction(994717, 10**6)))


@claim(
    key="arm-four-solutions",
    place="Reference [10] (arXiv 2305.12451), sections 4 and 5",
    title="The EV3 follows two straight paths, with four solutions throughout",
    says="For all s in [0, 1] the inverse kinematic problem has a solution on the straight paths from (10, "
    "40, 80) and from "
    "(50, 25, 100) to (40, 100, 20); the quantifier elimination names 0.756424 and 0.993797 on the first one.",
    verdict=Verdict.REPRODUCED,
    finding="Four solutions for every $s$, each followed as a continuous motion, with certificates. The two "
    "numbers are places "
    "where two solutions share the sine of the last joint; nothing happens to the arm there.",
)
def four_solutions() -> Iterator[Evidence]:
    """The number of solutions is constant between exact critical parameters; branches are chains of
    Krawczyk boxes."""
    arm = load_arm("ev3-120")
    for start, published in zip(STARTS, SHARED, strict=True):
        line = Bezier.of([start, GOAL])
        found = study(arm, line)
        yield Fact(f"from {start}: four solutions for every $s$ in $[0, 1]$", [p.count for p in found.stretches] == [4])
        path = joint_path(arm, {"line": line})
        proved = all(qe.verify(c).accepted for _, c in certificates(path))
        yield Fact(
            f"from {start}: four continuous motions, certificates accepted", proved and len(path.whole_runs) == 4
        )
        gaps = [abs(Fraction(float(s)) - p) for s, p in zip(found.shared, published, strict=True)]
        yield Fact(f"from {start}: the sine is shared where published", max(gaps) < Fraction(1, 10**6))


@claim(
    key="arm-33-segments",
    place="References [9] and [10], section 3",
    title="The comprehensive Gröbner system has 33 segments",
    says="The comprehensive Gröbner system of the inverse kinematic problem consists of 33 segments, of "
    "which 13 or 15 have "
    "real points.",
    verdict=Verdict.DIFFERS,
    finding="The number belongs to the computation, not to the problem. There $\\sqrt 2$ was an indeterminate, "
    "so segments occur "
    "several times; with $w^2 = 2$ exact there are fewer, and their ideals agree at every point.",
)
def segments() -> Iterator[Evidence]:
    """The system is computed again over the field of $\\sqrt 2$."""
    start = time.process_time()
    found = qe.comprehensive_groebner(
        _system(), ["s7", "c7", "s4", "c4", "s1", "c1"], constants={"w": qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)}
    )
    seconds = time.process_time() - start
    yield Fact("fewer than 33 segments", len(found.segments) < 33)
    yield Table(
        ("segments here", "published", "CPU seconds here"), ((str(len(found.segments)), "33", f"{seconds:.2f}"),)
    )


@claim(
    key="arm-times",
    place="References [9] and [10], tables of times",
    title="Times of the inverse kinematics",
    says="0.56 s for a point with L = 112; with L = 120 0.05 to 0.11 s after 31.6 to 62.3 s for the system, "
    "0.95 to 2.25 s for 51 "
    "points of a path, 485.8 s and 1.1 s for the proof of a whole straight path.",
    verdict=Verdict.NOT_TESTABLE,
    finding="Times of other machines. The same questions here are in the table: milliseconds for a point, a "
    "fraction of a second "
    "for a whole path.",
)
def times() -> Iterator[Evidence]:
    """CPU time of one run of each question."""
    arm = load_arm("ev3-120")
    line = Bezier.of([STARTS[0], GOAL])
    solve(arm, POINT)
    moments = [line.point(Fraction(k, 50)) for k in range(51)]
    rows = (
        ("all solutions at a point", _seconds(lambda: solve(arm, POINT)), "0.05-0.56"),
        ("51 points", _seconds(lambda: [solve(arm, p) for p in moments]), "0.95-2.25"),
        ("the whole straight path", _seconds(lambda: study(arm, line)), "485.8 + 1.1"),
    )
    yield Table(("question", "CPU seconds here", "published"), rows)


@claim(
    key="arm-joint-sequence",
    place="Section 5, last paragraph; Section 1, fourth paragraph",
    title="The sequence of joints for the Bézier path",
    says="Future work: the joint configurations along the planned Bézier path by inverse kinematics.",
    verdict=Verdict.SOLVED,
    finding="A sequence of least joint change along a cubic path, one continuous motion throughout, with "
    "bounds of velocities "
    'and accelerations that hold at all times. In one command: bezier plan with arm = "ev3".',
)
def joint_sequence() -> Iterator[Evidence]:
    """A cubic Bézier curve, 11 samples of the time law of arXiv 2305.12451, T = 50 s."""
    curve = Bezier.of([(10, 40, 80), (60, 60, 120), (90, 20, 150), (40, 100, 20)])
    plan = joint_plan(load_arm("ev3-120"), {"curve": curve}, TimeLaw.of(Law.QUINTIC), Fraction(50), 11)
    yield Fact("every point of the curve is reached, one motion is kept from start to goal", plan.is_proved)
    assert plan.motion is not None, "it is proved"
    rows = [
        (joint.name, f"{float(v.finite[1]):.4f}", f"{float(a.finite[1]):.4f}")
        for joint, v, a in zip(plan.motion.joints, plan.motion.speeds, plan.motion.accelerations, strict=True)
    ]
    yield Table(("joint", "at most, rad/s", "at most, rad/s²"), rows)


def _seconds(task: Callable[[], Any]) -> str:
    start = time.process_time()
    task()
    return f"{time.process_time() - start:.4f}"


def _system() -> list[str]:
    reach = "(120*c4*s7 - 16*c4 + 120*s4*c7 + 136*s4 - 44*w)"
    circles = [f"c{k}^2 + s{k}^2 - 1" for k in (1, 4, 7)]
    height = "-120*c4*c7 - 136*c4 + 120*s4*s7 - 16*s4 - 104 - 44*w + z"
    return [f"c1*{reach} + x", f"s1*{reach} + y", height, *circles]


CLAIMS = (four_solutions, segments, times, joint_sequence)
