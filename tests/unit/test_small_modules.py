"""Small modules that others rest on: names resolved later, forms for SymPy, workers that know of each other."""

from __future__ import annotations

import math
import os
import runpy
import sys

import pytest

from qe import later, sympy_form
from qe.processes import surroundings
from qe.proof.on_demand import OnDemand


def test_a_name_is_loaded_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(later, "_PROVIDED", {})
    loaded: list[int] = []
    later.provide("it", lambda: loaded.append(1) or "value")
    assert not loaded and later.later("it") == "value" and loaded == [1]
    later.provide("it", lambda: "another")
    assert later.later("it") == "another"
    with pytest.raises(KeyError):
        later.later("nothing")


def test_values_ask_their_writer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sympy_form, "_WRITERS", [])
    sympy_form.written_by(lambda value: ("first", value))
    sympy_form.written_by(lambda value: ("last", value))
    value = sympy_form.SymPyForm()
    assert value._sympy_() == ("last", value)


@pytest.mark.parametrize(
    ("mark", "deadline"),
    [("", None), ("{pid}:12.5", 12.5), ("{pid}:inf", math.inf), ("1:12.5", None), ("{pid}1:3", None)],
)
def test_a_worker_knows_its_deadline(mark: str, deadline: float | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(surroundings.MARK, mark.format(pid=os.getpid()))
    assert surroundings.surrounding_deadline() == deadline
    monkeypatch.delenv(surroundings.MARK)
    assert surroundings.surrounding_deadline() is None


def test_the_package_is_the_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["qe", "--version"])
    with pytest.raises(SystemExit) as end:
        runpy.run_module("qe.__main__", run_name="__main__")
    assert end.value.code == 0 and capsys.readouterr().out.startswith("qe ")
    import qe.__main__ as imported  # importing runs nothing

    assert callable(imported.main)


def test_certificates_are_made_when_asked_for() -> None:
    made: list[int] = []
    promised = OnDemand(lambda: made.append(1) or [])
    assert not made and promised.make() == [] and made == [1]
