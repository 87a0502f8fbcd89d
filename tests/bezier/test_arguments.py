"""Arguments of the public functions, and the command at its place."""

from __future__ import annotations

import inspect
import math
import tomllib
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy

import bezier
import qe
from bezier.interface.function import NAMES, problem_from
from bezier.problem import _KEYS
from tests import wrong_values

WRONG: dict[str, object] = {
    **wrong_values.WRONG,
    "huge": 10**400,
    "inf": -math.inf,
    "large float": 1e308,
    "tiny float": 5e-324,
    "fraction": Fraction(1, 3),
    "decimal": Decimal("0.1"),
    "no decimal": Decimal("nan"),
    "symbol": sympy.Symbol("x"),
    "pi": sympy.pi,
    "zero byte": "a\0b",
    "lines": "a\nb",
    "half a character": "\ud800",
    "long": "9" * 5000,
    "exponent": "1e999999999",
    "view": memoryview(b"xyz"),
    "tuple": (1, 2),
    "mapping": {"a": 1},
    "numbers for names": {1: 2},
    "range": range(3),
    "generator": (k for k in range(3)),
    "np.int64": np.int64(7),
    "np.float64": np.float64(0.25),
    "np.nan": np.float64("nan"),
    "np.bool": np.bool_(True),
    "np empty": np.array([]),
    "np objects": np.array([None, object(), 1], dtype=object),
    "np 0-d": np.array(3),
    "np 3": np.array([1.0, 2.0, 3.0]),
    "np nan 3": np.array([1.0, np.nan, 3.0]),
    "np 3x3": np.zeros((3, 3)),
    "np complex": np.array([1j] * 3),
    "np text": np.array(["a", "b", "c"]),
    "np 4-d": np.zeros((2, 2, 2, 2)),
    "np dates": np.array([np.datetime64("2020-01-01")] * 3),
}
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FOUR: dict[str, Any] = {"start": [-4, 0, 3], "via": [[-2, 1, 3], [2, 1, 3]], "goal": [4, 0, 3], "radius": 6}
CUBIC = {**FOUR, "method": "cubic"}
SINGLE = tomllib.loads((EXAMPLES / "single.toml").read_text())
BODIES: tuple[dict[str, Any], ...] = (
    {"kind": "ball", "centre": [0, 0, 9], "radius": 1},
    {"kind": "box", "low": [0, 0, 9], "high": [1, 1, 10]},
    {"kind": "box", "corner": [0, 0, 9], "edges": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]},
    {"kind": "half_space", "normal": [0, 0, -1], "offset": -9},
    {"kind": "cylinder", "centre": [0, 0], "radius": 1, "bottom": 9, "top": 10},
    {"kind": "capsule", "start": [0, 0, 9], "end": [1, 0, 9], "radius": 1},
    {"kind": "polyhedron", "vertices": [[0, 0, 9], [1, 0, 9], [0, 1, 9], [0, 0, 10]]},
    {"kind": "formula", "formula": "x^2 + y^2 + (z - 9)^2 <= 1"},
)
KEYS = {NAMES.get(key, key): key for key in _KEYS if key != "arm"}
TAKEN = {
    "arm": {"none"},
    "proofs": {"bool"},
    "timeout": {"int", "float", "fraction", "tiny float", "none", "np.int64", "np.float64"},
    "memory": {"int", "none", "np.int64"},
    "progress": {"function", "class"},  # these are called with an event, and what they raise is their own
}


def one_line(call: Callable[[], object], kind: str) -> None:
    """The call works, or says in one line why it does not."""
    try:
        call()
    except (qe.InputError, qe.Unable) as error:
        told = str(error)
        assert "\n" not in told and 10 < len(told) < 500, (kind, told)


@pytest.mark.parametrize("argument", inspect.signature(bezier.plan).parameters)
def test_every_argument_of_plan(argument: str) -> None:
    for kind, value in WRONG.items():
        if argument in KEYS:
            one_line(lambda: problem_from({**FOUR, KEYS[argument]: value}), kind)
        elif kind not in TAKEN.get(argument, ()):
            with pytest.raises(qe.InputError, match=rf"^(bezier.plan: )?{argument}: .{{10,400}}$"):
                bezier.plan(**{**FOUR, argument: value})


def inner() -> Iterator[tuple[str, dict[str, Any], Callable[[object], dict[str, Any]]]]:
    """A title, the problem around it, and the part of it in which one key has the value."""
    for body in BODIES:
        for key, given in {"name": "a", "margin": 1, "above": ["Q1"], **body}.items():
            yield f"{body['kind']}.{key}", FOUR, lambda v, b=body, k=key: {"obstacle": [{**b, k: v}]}
            if isinstance(given, list):
                rest = given[1:]
                yield (
                    f"{body['kind']}.{key}[0]",
                    FOUR,
                    lambda v, b=body, k=key, r=rest: {"obstacle": [{**b, k: [v, *r]}]},
                )
    for key in ("law", "ramp", "duration", "max_speed", "max_acceleration"):
        yield f"timing.{key}", CUBIC, lambda v, k=key: {"timing": {"duration": 20, k: v}}
    for key in ("points", "normal", "offset"):
        plane = {"points": ["Q1"], "normal": [0, 0, 1], "offset": 1}
        yield f"half_space.{key}", FOUR, lambda v, k=key, p=plane: {"half_space": [{**p, k: v}]}
    for key in SINGLE["single"]:
        yield f"single.{key}", SINGLE, lambda v, k=key: {"single": {**SINGLE["single"], k: v}}
    for key in ("ratio", "join_speed", "radius", "workspace"):
        yield key, CUBIC, lambda v, k=key: {k: v}


@pytest.mark.parametrize(("around", "part"), [pytest.param(a, p, id=title) for title, a, p in inner()])
def test_every_key_of_a_table(around: dict[str, Any], part: Callable[[object], dict[str, Any]]) -> None:
    for kind, value in WRONG.items():
        one_line(lambda: problem_from({**around, **part(value)}), kind)


PLAN = bezier.plan(**CUBIC, limits={"duration": 20})
METHODS = {"plan(t)": PLAN.__call__} | {
    name: method for name, method in inspect.getmembers(PLAN, inspect.ismethod) if not name.startswith("_")
}


@pytest.mark.parametrize("name", METHODS)
def test_every_argument_of_what_a_plan_offers(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    required = {"plan(t)": "t", "velocity": "t", "acceleration": "t", "save": "target"}
    given = {"t": 0.5, "target": "path.csv"}
    for argument in inspect.signature(METHODS[name]).parameters:
        for kind, value in WRONG.items():
            if name == "save" and argument == "target" and isinstance(value, str) and "." not in value:
                if value in ("", "a\0b", "\ud800", WRONG["long"]):
                    with pytest.raises(qe.InputError, match="target: the name of a file"):
                        PLAN.save(value)
                continue  # names of folders, which take longer
            named = {required[name]: given[required[name]]} if name in required else {}
            one_line(lambda: METHODS[name](**{**named, argument: value}), kind)


EXTREME: dict[str, dict[str, Any]] = {
    "longest": {"limits": {"duration": 10**50}},
    "shortest": {"limits": {"duration": Fraction(1, 10**50)}},
    "slowest": {"limits": {"max_speed": Fraction(1, 10**50)}},
    "around all": {"obstacles": [{"kind": "box", "low": [0, 0, 8], "high": [1, 1, 10], "margin": 10**50}]},
    "far away": {"obstacles": [{"kind": "ball", "centre": [10**50, 0, 0], "radius": 1}]},
    "smallest": {"obstacles": [{"kind": "ball", "centre": [0, 0, -5], "radius": Fraction(1, 10**50)}]},
}


@pytest.mark.parametrize("case", EXTREME)
def test_the_largest_and_smallest_numbers_are_written_and_checked(case: str, tmp_path: Path) -> None:
    """They overflowed in the decimals of files and pictures, after all had been proved."""
    from bezier.cli import main

    try:
        plan = bezier.plan(**CUBIC, **EXTREME[case])
    except bezier.NoPath as error:
        plan = error.plan
    assert plan.save(tmp_path / "out", pictures=False) and main(["check", str(tmp_path / "out")]) in (0, 3)
    for ask in (plan.to_svg, plan._repr_html_, plan.to_csv, plan.to_ppoly, lambda: plan(plan.duration)):
        one_line(ask, case)
    for key, value in (("duration", 10**51), ("max_speed", Fraction(1, 10**51))):
        with pytest.raises(qe.InputError, match=f"limits.{key}: expected a number of at most 10"):
            bezier.plan(**CUBIC, limits={key: value})


def test_the_command_is_found_at_its_place() -> None:
    from bezier.cli import main
    from bezier.cli.app import COMMANDS

    assert callable(main) and {name for name, *_ in COMMANDS} >= {"plan", "check", "clearance", "compare"}
