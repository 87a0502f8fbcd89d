"""Methods side by side: the first answer wins, and no process is left behind."""

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

import qe
from qe.errors import InternalError, QEError
from qe.processes.channel import Channel, WorkerDied
from qe.processes.limits import Limits
from qe.processes.racing import first
from tests.tables import each
from tests.unit.processes.works import asleep, failing, given, gone, wrong
from tests.workers import only_idle_children

pytestmark = pytest.mark.processes

HARD = "ex a, b, c. all x, y. a*x^4*y + b*x*y^3 + c*x^2*y^2 + d*x + g*y + f > a^2*x^3 + b^2*y^5"


EARLY, UNABLE = partial(given, "early"), partial(failing, qe.Unable("cannot"))


def raced(**works: Callable[[Channel], str]) -> tuple[str | None, dict[str, str | QEError]]:
    with only_idle_children():
        return first(works, lambda value: value == "early", Limits(timeout=60))


def test_the_first_answer_ends_the_others() -> None:
    winner, found = raced(slow=asleep, fast=EARLY, wrong=UNABLE)
    assert winner == "fast" and found["fast"] == "early" and "slow" not in found


def test_where_nobody_wins_everything_is_told() -> None:
    winner, found = raced(wrong=UNABLE, dead=gone)
    assert winner is None and str(found["wrong"]) == "cannot" and isinstance(found["dead"], WorkerDied)


def test_an_error_in_a_work_is_a_result_like_others() -> None:
    winner, found = raced(bad=wrong, fast=EARLY)
    assert winner == "fast" and isinstance(found.get("bad", InternalError("")), InternalError)


def test_raced_methods_give_an_equivalent_answer() -> None:
    answer = qe.eliminate("ex x. x^2 + b*x + c = 0", race=("cad", "vs"), timeout=120)
    assert qe.equivalent(answer, "b^2 >= 4*c") and "the first answer was" in answer.explanation


def test_a_method_that_cannot_loses() -> None:
    answer = qe.eliminate("all x. x^6 + a*x > 0", race=["vs", "cad"], timeout=120, check=True)
    assert answer.status is qe.Status.SOLVED and answer.guarantee is qe.Guarantee.CHECKED
    alone = qe.eliminate("all x. x^6 + a*x > 0", race="vs", timeout=120)
    assert alone.status is qe.Status.UNABLE and alone.reason.startswith("vs: ")


def test_a_race_holds_the_limit() -> None:
    answer = qe.eliminate(HARD, race=("auto", "cad"), timeout=0.5)
    assert answer.status is qe.Status.UNABLE and "time" in answer.reason


@each({"method": "cad"}, {"workers": 2}, {"process": False})
def test_a_race_stands_alone(other: dict[str, object]) -> None:
    with pytest.raises(qe.InputError, match="race: cannot go with"):
        qe.eliminate("x > 0", race="cad", **other)  # type: ignore[arg-type]


def test_the_command_races() -> None:
    command = [Path(sys.executable).parent / "qe", "eliminate", "ex x. x^2 + b*x + c = 0", "--race", "vs,cad"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout) == (0, "b^2 - 4*c >= 0\n")
    refused = subprocess.run([*command[:-1], "fast"], capture_output=True, text=True, timeout=120)
    assert refused.returncode == 2 and "race" in refused.stderr
