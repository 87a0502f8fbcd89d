"""``bezier.plan``: the same problems and plans as from TOML files, and one clear line for what is none."""

from __future__ import annotations

import inspect
import pickle
import subprocess
import sys
import tomllib
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

import bezier
import bezier.cli.app
import bezier.plans
import qe
from bezier.cli import main
from bezier.interface.function import NAMES, problem_from
from bezier.planner.outputs import facts
from bezier.planner.planning import make_plan
from bezier.problem import _KEYS, load_problem
from tests.tables import each

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
CURVES = ("obstacle_curves.toml", "arm_curve.toml")
PROBLEMS = sorted(path.name for path in EXAMPLES.glob("*.toml") if path.name not in CURVES)
FOUR = {"start": [-4, 0, 3], "via": [[-2, 1, 3], [2, 1, 3]], "goal": [4, 0, 3], "radius": 6}
CUBIC = {**FOUR, "method": "cubic"}


def values(name: str) -> dict:
    """A problem file as TOML readers give it: its decimals are floats."""
    return tomllib.loads((EXAMPLES / name).read_text())


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_problem_is_that_of_the_file(name: str) -> None:
    own, read = problem_from(values(name)), load_problem(EXAMPLES / name)
    assert {k: getattr(own, k) for k in own.__slots__ if k != "source"} == {
        k: getattr(read, k) for k in read.__slots__ if k != "source"
    }


@each("single.toml", "three_balls.toml", "obstacle_motion.toml")
def test_the_plan_is_that_of_the_file(name: str) -> None:
    plan = bezier.plan(**{NAMES.get(key, key): value for key, value in values(name).items()})
    made = make_plan(load_problem(EXAMPLES / name))
    assert plan.points == made.path.points and plan.curves == made.path.curves
    assert plan.certified and qe.verify(plan.certificate).accepted
    assert plan.to_json() == facts(made)
    again = pickle.loads(pickle.dumps(plan))
    assert again == plan and hash(again) == hash(plan) and plan != made and np.array_equal(again(0.25), plan(0.25))


def test_a_plan_with_an_arm_under_a_limit() -> None:
    """It is made in another process, which sends it back."""
    plan = bezier.plan(**{NAMES.get(key, key): value for key, value in values("ev3_path.toml").items()}, timeout=100)
    assert plan.certified and pickle.loads(pickle.dumps(plan)) == plan


def test_every_key_of_the_file_is_an_argument() -> None:
    arguments = set(inspect.signature(bezier.plan).parameters)
    assert {NAMES.get(key, key) for key in _KEYS} == arguments - {"proofs", "timeout", "memory", "progress"}


@pytest.mark.parametrize(
    "half",
    [0.5, "1/2", "0.5", Decimal("0.5"), Fraction(1, 2), np.float32(0.5), np.array(0.5), sympy.Rational(1, 2)],
    ids=lambda v: type(v).__name__,
)
def test_numbers_of_many_kinds(half: object) -> None:
    assert problem_from({**FOUR, "start": (np.int64(-4), half, 3)}).start == (-4, Fraction(1, 2), 3)


@given(st.floats(-100, 100).filter(lambda x: x == 0 or abs(x) > 1e-49))
def test_a_float_is_the_decimal_that_it_prints(x: float) -> None:
    found = problem_from({**FOUR, "start": np.array([x, 150.0, 0.25]), "radius": 1000}).start
    assert found == (Fraction(repr(x)), 150, Fraction(1, 4))


@given(st.floats(-100, 100, width=32).filter(lambda x: x == 0 or abs(x) > 1e-30))
def test_a_short_float_too(x: float) -> None:
    single = np.float32(x)
    assert problem_from({**FOUR, "start": [single, 150, 1], "radius": 1000}).start[0] == Fraction(str(single))


def test_arrays_of_numpy() -> None:
    rows = np.array([[-4, 0, 3], [-2, 1, 3], [2, 1, 3], [4, 0, 3]])
    for kind in (np.int32, np.float64, np.float32, object):
        a = rows.astype(kind)
        assert problem_from({"start": a[0], "via": a[1:3], "goal": a[3], "radius": 6}).via == ((-2, 1, 3), (2, 1, 3))


@each(
    {
        "no start": ({"start": None}, "start: expected a point of 3 numbers, found no such"),
        "flat": ({"start": [1, 2]}, "start: expected a point of 3 numbers, found an array of 2 values"),
        "text": ({"start": "1, 2, 3"}, 'start: expected a point of 3 numbers, found "1, 2, 3"'),
        "a number": ({"goal": 4}, "goal: expected a point of 3 numbers, found 4"),
        "not a number": ({"goal": [4, 0, float("nan")]}, "goal[2]: expected an integer"),
        "infinite": ({"goal": np.array([4, np.inf, 0])}, "goal[1]: expected an integer"),
        "complex": ({"goal": np.array([4, 1j, 0])}, "goal[0]: expected an integer"),
        "truth": ({"goal": np.array([True, True, False])}, "goal[0]: expected an integer"),
        "dates": ({"goal": [np.datetime64("2020-01-01")] * 3}, "goal[0]: expected an integer"),
        "a set": ({"goal": {4, 0, 3}}, "goal: expected a point of 3 numbers, found a set"),
        "bytes": ({"goal": b"403"}, "goal: expected a point of 3 numbers, found a bytes"),
        "one via": ({"via": [[-2, 1, 3]]}, "via: expected two points of 3 numbers"),
        "no via": ({"via": None}, "via: expected two points of 3 numbers, found no such"),
        "via of words": ({"via": ["a", "b"]}, "via: expected two points"),
        "same point": ({"start": [-2, 1, 3]}, "via[0]: expected a point other than start"),
        "radius": ({"radius": -1}, "radius: expected a positive number"),
        "small radius": ({"radius": 1}, "radius: expected at least 5"),
        "method": ({"method": "quartic"}, 'method: expected "quadratic" or "cubic" or "single", found "quartic"'),
        "method 3": ({"method": 3}, "method: expected"),
        "workspace": ({"workspace": "cube"}, 'workspace: expected "ball" or "hemisphere"'),
        "ratio": ({"ratio": 2}, 'ratio: expected this key with method = "cubic" only'),
        "limits": ({"limits": 5}, "limits: expected a mapping, found 5"),
        "no limit": ({"limits": {}}, "limits.duration: expected a duration, max_speed or max_acceleration, found none"),
        "speed": ({"limits": {"speed": 5}}, "limits.speed: expected one of the keys law, ramp, duration, max_speed"),
        "max speed": ({"limits": {"maxspeed": 5}}, "max_speed is probably meant"),
        "zero speed": ({"limits": {"max_speed": 0}}, "limits.max_speed: expected a number above zero, found 0"),
        "obstacle": ({"obstacles": {"kind": "ball"}}, "obstacles: expected a list of mappings, found a table"),
        "kind": ({"obstacles": [{"kind": "bal"}]}, 'obstacles[0].kind: expected "ball" or'),
        "no kind": ({"obstacles": [{}]}, "obstacles[0].kind: expected"),
        "radius of one": (
            {"obstacles": [{"kind": "ball", "centre": [0, 0, 0], "radius": 0}]},
            "obstacles[0].radius: expected a number above zero, found 0",
        ),
        "misspelt": (
            {"obstacles": [{"kind": "ball", "centre": [0, 0, 0], "radus": 1}]},
            "obstacles[0].radus: expected one of the keys kind, name, margin, above, centre, radius, found the unknown "
            'key "radus"; radius is probably meant',
        ),
        "key": ({"obstacles": [{1: 2}]}, "obstacles[0]: expected a mapping from names, found a key that is a int"),
        "half-space": ({"half_spaces": [{"normal": [0, 0, 0]}]}, "half_spaces[0].offset: expected"),
        "single": ({"single": {"degree": 5}}, 'single: expected this table with method = "single" only'),
        "many": ({"via": np.zeros((20_000, 3))}, "via: expected at most 10000 entries, found 20000"),
        "large": ({"start": [10**60, 0, 0]}, "start[0]: expected a number of at most 10^50"),
        "larger": ({"start": [Fraction(1, 10**9000), 0, 0]}, "start[0]: expected an integer"),
        "obstacle?": ({"obstacle": []}, "obstacle: no argument of this name; obstacles is probably meant"),
        "timing?": ({"timing": {}}, "timing: no argument of this name; limits is probably meant"),
        "gaol": ({"gaol": 1}, "gaol: no argument of this name; goal is probably meant"),
        "timeout": ({"timeout": -1}, "timeout: a positive number of seconds expected, -1 found"),
        "memory": ({"memory": 0.5}, "memory: a positive whole number of MiB expected"),
        "progress": ({"progress": 5}, "progress: a function of one event expected"),
    }
)
def test_misuse_is_said_in_one_line(more: Any, told: str) -> None:
    with pytest.raises(qe.InputError) as caught:
        bezier.plan(**{**FOUR, **more})
    message = str(caught.value)
    assert told in message and "\n" not in message and len(message) < 400


def test_a_list_in_itself_is_refused() -> None:
    loop: list = []
    loop.append(loop)
    with pytest.raises(qe.InputError, match="lists at most 8 deep"):
        bezier.plan(**{**FOUR, "start": loop})


def test_arguments_without_a_name_and_missing_ones() -> None:
    with pytest.raises(qe.InputError, match="arguments by name expected"):
        bezier.plan([0, 0, 1], [1, 0, 1])
    with pytest.raises(qe.InputError, match="goal: expected a point of 3 numbers, found no such argument"):
        bezier.plan(start=[0, 0, 1])


def test_no_path_is_an_error_with_its_proof(tmp_path: Path) -> None:
    given = {NAMES.get(key, key): value for key, value in values("single_dip.toml").items()}
    with pytest.raises(bezier.NoPath) as caught:
        bezier.plan(**given)
    plan, told = caught.value.plan, str(caught.value)
    assert isinstance(caught.value, qe.Unable) and "\n" not in told
    assert plan.outcome is bezier.Outcome.INFEASIBLE and qe.verify(plan.certificate).accepted
    for ask in (lambda: plan(0), lambda: plan.curves, lambda: plan.length, plan.to_svg, lambda: plan.duration):
        with pytest.raises(qe.Unable):
            ask()
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == told and again.plan.outcome is plan.outcome
    assert "infeasible" in repr(plan) and "certificates: accepted" in str(plan)


def test_a_motion_that_is_too_fast_is_no_path() -> None:
    told = r"max_speed = 1 mm/s is EXCEEDED; kept at all times with duration = "
    with pytest.raises(bezier.NoPath, match=told) as caught:
        bezier.plan(**CUBIC, limits={"duration": 1, "max_speed": 1})
    assert caught.value.plan.outcome is bezier.Outcome.TOO_FAST and caught.value.plan.curves


def test_a_start_in_an_obstacle_is_no_path() -> None:
    around = {"kind": "ball", "name": "cage", "centre": [-4, 0, 1], "radius": 0.5}
    given = {NAMES.get(key, key): value for key, value in values("single.toml").items()}
    with pytest.raises(bezier.NoPath) as caught:
        bezier.plan(**{**given, "obstacles": [{**around, "centre": given["start"]}]})
    told, plan = str(caught.value), caught.value.plan
    assert told.startswith("no path exists: the start") and "obstacle cage" in told and "\n" not in told
    assert plan.outcome is bezier.Outcome.INFEASIBLE and qe.verify(plan.certificate).accepted


def test_limits_of_time_hold() -> None:
    with pytest.raises(qe.BudgetExceeded):
        bezier.plan(**CUBIC, timeout=0.01)
    steps: list = []
    plan = bezier.plan(**CUBIC, timeout=60, progress=steps.append)
    assert plan.certified and steps


def test_the_folder_is_that_of_the_command(tmp_path: Path) -> None:
    plan = bezier.plan(**CUBIC)
    files = plan.save(tmp_path / "out", pictures=False)
    assert sorted(file.name for file in files) == sorted(file.name for file in (tmp_path / "out").iterdir())
    assert not [file for file in files if file.suffix == ".png"]
    assert main(["check", str(tmp_path / "out")]) == 0


def test_the_module_is_light_and_complete() -> None:
    script = (
        "import sys, bezier\nassert set(bezier.__all__) <= set(dir(bezier))\n"
        "print([m for m in ('flint', 'numpy', 'scipy', 'bezier.plans', 'qe') if m in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout == "[]\n"
    for name in bezier.__all__:
        assert getattr(bezier, name) is getattr(bezier, name)
    assert inspect.isfunction(bezier.plan)
    with pytest.raises(AttributeError, match="no attribute 'plam'"):
        _ = bezier.plam
