"""Border points, paths of any degree against points, merged branches, and bad input, each told in one clear line."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

import qe
from bezier.arm.critical import Reason
from bezier.arm.inverse import solve
from bezier.arm.reader import load_arm, read_exact
from bezier.arm.study import study
from bezier.cli import main
from bezier.curves.curve import Bezier
from qe.errors import Unable
from tests.tables import each

ARM = load_arm("ev3-120")


def test_every_edge_case(shared: Path) -> None:
    cases = json.loads((shared / "corpora/ev3/edge_cases.json").read_text())["cases"]
    assert len(cases) == 9
    for case in cases:
        found = solve(ARM, [read_exact(case[c]) for c in "xyz"])
        expected = case["distinct_real_solutions"]
        if isinstance(expected, str):
            assert found.free == ("theta1",) and len(found.solutions) == 2
        else:
            assert found.count == expected, case["name"]
        if case["per_sign_of_rho"]:
            x, y = (float(read_exact(case[c])) for c in "xy")
            outwards = sum(
                (s.values[0].cosine[0] * x + s.values[0].sine[0] * y) > 0 for s in found.solutions if s.values[0]
            )
            assert [outwards, len(found.solutions) - outwards] == case["per_sign_of_rho"], case["name"]
        assert any(s.multiple for s in found.solutions) == (
            "border" in case["name"] or isinstance(expected, str)  # on the axis both signs of the root of x² + y² meet
        )


CURVES = {
    "conic": [(150, 0, 60), (150, 220, 200), (-160, 120, 330)],
    "out and in again": [(100, 20, 100), (600, 50, 200), (-300, 300, 100), (100, 100, 250), (20, 90, 150)],
}


@each("conic", pytest.param("out and in again", marks=pytest.mark.deep))
def test_curves_of_any_degree(name: str) -> None:
    """The square root of x² + y² is no polynomial along these; the counts are those of single points."""
    curve = Bezier.of(CURVES[name])
    found = study(ARM, curve)
    marks = [float(p.s) for p in found.specials]
    for (low, high), part in zip(pairwise(marks), found.stretches, strict=True):
        for k in range(1, 6):
            s = Fraction(low) + (Fraction(high) - Fraction(low)) * k / 6
            assert solve(ARM, curve.point(s)).count == part.count
    assert found.is_reachable == all(p.count for p in found.stretches)


def test_two_branches_merge_and_end_at_an_exact_place() -> None:
    """Straight up through the top of the torus: the height there is that of the border."""
    top = read_exact("104 + 44*sqrt(2) + 8*sqrt(293) + 120")
    found = study(ARM, Bezier.of([(0, 1, 300), (0, 1, 500)]))
    merging = [p for p in found.specials if Reason.MERGE in p.reasons]
    assert found.stretches[-1].count == 0 and merging
    x = 1 - float(read_exact("44*sqrt(2)"))
    radius = float(top) - float(read_exact("104 + 44*sqrt(2)"))
    border = float(read_exact("104 + 44*sqrt(2)")) + (radius**2 - (float(read_exact("44*sqrt(2)")) - 1) ** 2) ** 0.5
    assert abs(300 + 200 * float(merging[-1].s) - border) < 1e-9 and x < 0
    assert merging[-1].inverse.count == 1 and merging[-1].inverse.solutions[0].multiple


def test_a_path_along_the_border_is_named() -> None:
    with pytest.raises(Unable, match=r"everywhere along the curve: (solutions meet|on the axis)"):
        study(ARM, Bezier.of([(0, 0, 100), (0, 0, 150)]))


@each(
    (["ik", "nobody", "1", "2", "3"], "expected a file .toml or .urdf"),
    (["ik", "six-joints", "1", "2", "3"], "--quaternion W X Y Z"),
    (["ik", "six-joints", "1", "2", "3", "--quaternion", "0", "0", "0", "0"], "not all 0"),
    (["ik", "ev3-120", "1", "2", "x"], "expected an exact number"),
    (["ik", "ev3-120", "1", "2", "3", "--quaternion", "1", "0", "0", "0"], "three parallel axes"),
)
def test_the_command_says_it_in_one_line(
    arguments: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) != 0
    told = capsys.readouterr().err.strip()
    assert message in told.replace("\n", " ") and not list(tmp_path.iterdir())


def test_negative_coordinates_are_taken_as_typed(capsys: pytest.CaptureFixture[str]) -> None:
    """``-50`` was taken for an option."""
    for minus in "-−":
        assert main(["ik", "ev3-120", "100", f"{minus}50", "20"]) == 0
        assert "at (100, -50, 20) mm\n4 solutions (proved)" in capsys.readouterr().out
    assert main(["ik", "planar-3r", "-1/2", "-0.5", "0", "--quaternion", "1", "0", "0", "-1"]) == 0
    assert "at (-0.5, -0.5, 0) mm, turned" in capsys.readouterr().out


def test_systems_that_do_not_fit() -> None:
    """Dependent or doubled parameters, and segments with infinitely many solutions."""
    with pytest.raises(qe.InputError):
        qe.comprehensive_groebner(["a*x - b"], ["x"], ["a", "a"])
    with pytest.raises(qe.InputError):
        qe.comprehensive_groebner(["a*x - b"], ["x", "a"], ["a", "b"])
    found = qe.real_root_classification(["a*x - b"], ["x"])
    assert found.at({"a": 0, "b": 0}) is None and found.at({"a": 0, "b": 1}) == 0
    system = qe.comprehensive_groebner(["a*x - b"], ["x"])
    with pytest.raises(qe.Unable):
        system.solutions_at({"a": 0, "b": 0})
