"""Every solver on small problems: answers equivalent to the known ones, in the names of the problem."""

import json
import shutil
import subprocess
import sys

import pytest

from experiments.adapters.__main__ import PEERS
from experiments.adapters.answer import Limits, NotSupported
from experiments.adapters.ours import ours
from experiments.compare import Verdict, compare
from experiments.solvers import ENGINES, NAMES, OURS
from qe.errors import Unable
from qe.io.text import read
from tests.tables import each

LIMITS = Limits(20.0, 1500)
QEPCAD = pytest.param("qepcad", marks=pytest.mark.skipif(not shutil.which("qepcad"), reason="qepcad is not installed"))
SENTENCES = {
    "ex x, y. x^2 + y^2 <= 1 and x*y > 1/2": "false",
    "all x. x^2 + 1 > 0": "true",
    "all x. x^2 > 0": "false",
    "ex x. x^3 = 2": "true",
}
WITH_PARAMETERS = {
    "ex x. x > 0 and a_1*x = v0": "a_1*v0 > 0 or a_1 = 0 and v0 = 0",
    "all x. x^2 + b*x + 1 >= 0": "b^2 <= 4",
}


def solve(name, formula):
    adapter = ours(name) if name in ENGINES else PEERS[name]
    return adapter(read(formula), LIMITS)


@pytest.mark.parametrize(
    "name",
    [OURS, "ours-cad", "ours-cad-mccallum", "ours-without-partial", "sympy-extras", "z3", "cvc5", "yices", QEPCAD],
)
def test_sentences(name):
    for formula, expected in SENTENCES.items():
        answer = solve(name, formula)
        assert answer.text == expected and answer.seconds > 0


@pytest.mark.parametrize("name", [OURS, "ours-vs", "sympy-extras", QEPCAD])
def test_parameters(name):
    for formula, expected in WITH_PARAMETERS.items():
        assert compare(solve(name, formula).text, expected) is Verdict.EQUIVALENT


def test_semialg():
    assert solve("semialg", "ex x. x^2 + 1 < 0").text == "false"
    assert compare(solve("semialg", "ex x. x > 0 and x < b_1").text, "b_1 > 0") is Verdict.EQUIVALENT


@each("z3", "cvc5", "yices")
def test_smt_solvers_take_sentences_only(name):
    with pytest.raises(NotSupported):
        solve(name, "ex x. x^2 = a")


def test_yices_takes_one_block():
    with pytest.raises(NotSupported, match="one block"):
        solve("yices", "all x. ex y. y > x")


def test_a_form_with_square_roots_is_translated_back():
    answer = solve("sympy-extras", "all x. x >= 0 and x <= 1 -> h^2 + 2*h*x^2 <= 7 + x")
    assert compare(answer.text, "(h >= 0 and h^2 + 2*h <= 8) or (h < 0 and h^2 <= 7)") is Verdict.EQUIVALENT


def test_our_inability_is_told():
    balls = " and ".join(f"(x - {i})^2 + (y - a*{i})^2 + (z - b)^2 <= {7 + i}" for i in range(6))
    with pytest.raises(Unable, match="time"):
        ours("ours-cad")(read(f"ex x, y, z. {balls}"), Limits(0.2, 1500))


def test_all_names_have_an_adapter():
    assert set(NAMES) == {*ENGINES, *PEERS}


def test_the_program(root):
    task = {"formula": "ex x. x^2 = a", "limit": 5, "memory": 1000}
    command = [sys.executable, "-m", "experiments.adapters", "z3"]
    done = subprocess.run(command, input=json.dumps(task), capture_output=True, text=True, cwd=root, check=True)
    ready, report = map(json.loads, done.stdout.splitlines())
    assert ready == {"ready": True} and report["status"] == "unsupported" and "sentences only" in report["message"]
