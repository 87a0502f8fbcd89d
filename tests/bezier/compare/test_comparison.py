"""Comparing methods: the problems that each method gets, and the text of rows."""

from __future__ import annotations

import doctest
from fractions import Fraction
from pathlib import Path

import pytest

import qe
from bezier.compare.comparison import METHODS, Side, for_method
from bezier.compare.output import bracket, duration
from bezier.curves.enclosure import Enclosure
from bezier.methods.cubic.existence import existence, sentence, trivial_witness
from bezier.problem import PlanMethod, Problem, read_problem
from qe.errors import InputError

CUBIC = """\
method = "cubic"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
ratio = "1/2"
join_speed = "1/10"
[[half_space]]
normal = [0, 0, 1]
offset = 2
points = ["Q1", "Q2"]
"""


def test_a_cubic_problem_for_the_quadratic_method() -> None:
    given = read_problem(CUBIC)
    quadratic, cubic = (for_method(given, method) for method in METHODS)
    assert cubic is given and quadratic.method is PlanMethod.QUADRATIC
    assert (quadratic.ratio, quadratic.join_speed) == (1, 0)
    assert [item.points for item in quadratic.half_spaces] == [("Q1",)]
    assert (quadratic.start, quadratic.via, quadratic.workspace) == (given.start, given.via, given.workspace)
    back = for_method(quadratic, PlanMethod.CUBIC)
    assert [item.points for item in back.half_spaces] == [("Q1", "Q2")] and isinstance(back, Problem)


def test_other_methods_are_refused() -> None:
    from dataclasses import replace

    from bezier.compare.comparison import compare

    with pytest.raises(InputError, match="quadratic"):
        compare(replace(read_problem(CUBIC), method=PlanMethod.SINGLE))


def test_totals_of_a_side() -> None:
    one, two = Enclosure(Fraction(1), Fraction(2)), Enclosure(Fraction(3), Fraction(7, 2))
    side = Side(None, {"P": one, "Q": two}, {"P": one, "Q": Enclosure(Fraction(0), None)})  # type: ignore[arg-type]
    assert side.length == Enclosure(Fraction(4), Fraction(11, 2))
    assert side.curvature == Enclosure(Fraction(1), None)
    assert Side(None, {}, {}).length is None and Side(None, {}, {}).curvature is None  # type: ignore[arg-type]


def test_ends_are_rounded_outwards() -> None:
    third = Fraction(1, 3)
    assert bracket(Enclosure(third, 2 * third), 3) == "[0.333, 0.667]"
    assert bracket(Enclosure(third, third), 3) == "[0.333, 0.334]"
    assert bracket(Enclosure(Fraction(5, 4), Fraction(5, 4))) == "1.25"
    assert bracket(Enclosure(Fraction(1), None)) == "[1, inf]"
    assert bracket(None) == ""
    assert (duration(0.0123), duration(2.5)) == ("12.3 ms", "2.50 s")


def test_existence_theorem_of_the_comparison() -> None:
    found = existence(timeout=60)
    assert found.truth is True
    assert found.witness == ", ".join(f"{name} = {value}" for name, value in trivial_witness().items())
    assert qe.check_witness(sentence(), trivial_witness()) is True
    assert qe.check_witness(sentence(), trivial_witness() | {"q1x": "0"}, timeout=60) is False


def test_the_documentation_is_true(root: Path) -> None:
    outcome = doctest.testfile(str(root / "docs" / "compare.md"), module_relative=False)
    assert outcome.attempted > 12 and outcome.failed == 0
