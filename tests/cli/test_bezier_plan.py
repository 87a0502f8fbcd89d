"""The command ``bezier`` as a user runs it, for every method: judged by files, output, message and exit status."""

from __future__ import annotations

import csv
import json
import re
import shutil
import subprocess
import time
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.cli import command
from tests.tables import each

BEZIER, QE = "bezier", "qe"
FILES = {"report.html", "region.json", "certificate.json", "path.csv", "path.json", "region.png", "path.png"}
QUADRATIC = """\
method = "quadratic"
workspace = "ball"
start = [-4, 1, 1]
via = [[-1, 3, 3], [1, 3, 3]]
goal = ["9/2", 1, 1]
"""
CUBIC = """\
method = "cubic"
start = [-3, 0, 1]
via = [[-3, 1, 2], [2, 1, 2]]
goal = [3, 0, 1]
radius = "sqrt(15)"
"""


def more(old: str) -> str:
    return str(Fraction(old) + Fraction(1, 10**6))


def run(*arguments: object, program: str = BEZIER) -> subprocess.CompletedProcess[str]:
    return command.run(program, *arguments)


def refused(process: subprocess.CompletedProcess[str], code: int, *words: str) -> None:
    """One line on stderr, nothing on stdout, the exit status asked for."""
    assert process.returncode == code, (process.stdout, process.stderr)
    assert process.stdout == "" and len(process.stderr.splitlines()) == 1, process.stderr
    assert "Traceback" not in process.stderr
    for word in words:
        assert word in process.stderr


@pytest.fixture(scope="module")
def example(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The folder of an example with pictures, planned once; the first one by the console script."""
    said = {
        "three_balls": "best Q1 = (0, 3, 3)",
        "cubic_joins": "C2 at both joins, proved to lie in the workspace",
        "single_leaves": "LEAVES the ball",
    }

    @cache
    def folder(name: str) -> Path:
        out = tmp_path_factory.mktemp(name) / "out"
        start = command.in_a_shell if name == "three_balls" else command.run
        process = start(BEZIER, "plan", root / "examples" / f"{name}.toml", "--out", out)
        assert process.returncode == 0 and said[name] in process.stdout, process.stderr
        assert process.stderr == "" or name != "three_balls"
        assert sorted(p.name for p in out.parent.iterdir()) == ["out"], "no working folder is left"
        return out

    return folder


@pytest.fixture
def main_example(example: Callable[[str], Path]) -> Path:
    return example("three_balls")


def planned(file: Path, out: Path, code: int) -> dict[str, Any]:
    """A plan without pictures: its JSON."""
    process = run("plan", file, "--out", out, "--no-plots", "--json")
    assert process.returncode == code, process.stderr
    return json.loads(process.stdout)


@each(
    (
        "three_balls",
        FILES,
        ("The problem", "The question", "quantifier-free answer", "The region", "Bounds", "The best", "<svg", "<math")
        + ("Cylindrical description", "Above the table?", "What was certified", "Timings"),
        (2, 1),
    ),
    (
        "cubic_joins",
        (FILES | {"motion.png"}) - {"region.json"},
        ("Formula (7)", "quantifier-free answer", "The best", "Does it ever stop?", "a cusp", "multiplier")
        + ("C² (value, first, second derivative)", "never slower than"),
        (2, 5),
    ),
    (
        "single_leaves",
        (FILES | {"profile.png"}) - {"region.json", "region.png"},
        ("Method 1", "What (4) leaves open", "the conditions for all t", "dual proof", "lexicographically")
        + (" mm</span>",),
        (1, 4),
    ),
)
def test_the_files_and_the_page(
    name: str, files: set[str], parts: tuple[str, ...], drawn: tuple[int, int], example: Callable[[str], Path]
) -> None:
    """The page is whole and needs nothing else."""
    folder = example(name)
    sizes = {path.name: path.stat().st_size for path in folder.iterdir()}
    assert sizes.keys() >= files and all(sizes.values())
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in folder.glob("*.png"))
    page = (folder / "report.html").read_text()
    head = page[: page.rindex("<script>")]
    assert not [part for part in parts if part not in head]
    assert not re.search(r"""<(script|link|img)[^>]+(src|href)\s*=\s*["']?(https?:)?//""", page)
    assert head.count("<canvas") == drawn[0] and head.count("<svg") >= drawn[1] and len(page) < 1_500_000
    assert ("Joins" in head) == (name != "single_leaves")
    assert name != "cubic_joins" or (head.count(parts[-2]) >= 2 and head.count("<svg") == 5)


@each(
    ("three_balls", ("C1 at every join",)),
    ("cubic_joins", ("formula (7)", "C2 at every join")),
    ("single_leaves", ("Method 1*", "keeps its heights")),
)
def test_the_certificates_hold(name: str, words: tuple[str, ...], example: Callable[[str], Path]) -> None:
    assert run("check", example(name) / "certificate.json", program=QE).returncode == 0
    process = (command.in_a_shell if name == "three_balls" else command.run)(BEZIER, "check", example(name))
    assert process.returncode == 0 and all(word in process.stdout for word in words)


def test_the_sampled_path(main_example: Path) -> None:
    lines = (main_example / "path.csv").read_text().splitlines()
    assert any("mm" in line for line in lines if line.startswith("#"))
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert {"t", "x", "y", "z", "vx", "vy", "vz", "segment", "u"} == set(rows[0])
    assert [rows[0][a] for a in "xyz"] == ["-4", "1", "1"] and [rows[-1][a] for a in "xyz"] == ["4.5", "1", "1"]
    times = [float(row["t"]) for row in rows]
    assert times == sorted(times) and times[-1] == 3
    assert {row["segment"] for row in rows} == {"P", "Q", "R"}
    assert all(sum(float(row[a]) ** 2 for a in "xyz") <= 22.25 + 1e-9 for row in rows)


def test_exact_control_points(main_example: Path) -> None:
    stored = json.loads((main_example / "path.json").read_text())
    points = {n: tuple(Fraction(c["exact"]) for c in p) for n, p in stored["points"].items()}
    assert points["Q1"] == (0, 3, 3) and points["P1"] == (-2, 3, 3) and points["R1"] == (2, 3, 3)
    assert stored["curves"]["P"][0] == "P0" and [j["smoothness"] for j in stored["joins"]] == ["C1", "C1"]


def test_region_json_is_a_region(main_example: Path) -> None:
    import qe

    region = qe.Region.from_json((main_example / "region.json").read_text())
    assert region.contains({"q1x": 0, "q1y": 3, "q1z": 3}) and not region.contains({"q1x": 1, "q1y": 3, "q1z": 3})


def test_json_of_an_irrational_optimum(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    found = planned(root / "examples" / "tight_radius.toml", out, 0)
    assert found["status"] == "solved" and found["certified"] is True
    assert found["active"] == ["P1", "R1"] and found["radius"] == {"exact": "5", "decimal": "5"}
    assert found["objective"]["exact"] == "52 - 12*sqrt(13)"
    assert abs(float(found["objective"]["decimal"]) - (52 - 12 * 13**0.5)) < 1e-9
    assert {"method", "points", "files", "seconds"} <= found.keys()
    assert set(found["points"]) == {f"{curve}{k}" for curve in "PQR" for k in range(3)}
    assert sorted(Path(f).name for f in found["files"]) == sorted(p.name for p in out.iterdir())
    assert not (FILES - {"region.png", "path.png"}) - {p.name for p in out.iterdir()}
    assert run("check", out).returncode == 0


def test_the_hemisphere_example(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    found = planned(root / "examples" / "hemisphere_gap.toml", out, 0)
    assert found["workspace"] == "hemisphere"
    assert found["leaves_hemisphere"] == {"allowed": True, "chosen": False}
    page = (out / "report.html").read_text()
    assert "it allows control points below the table" in page and "The corrected region" in page
    assert run("check", out).returncode == 0


def test_no_control_point(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    found = planned(root / "examples" / "no_control_point.toml", out, 3)
    assert found["status"] == "infeasible" and found["points"] == {}
    assert "at least 6" in found["reason"] and "cubic" in found["suggestion"]
    page = (out / "report.html").read_text()
    assert "Why there is no path" in page and "multiplier" in page
    assert not (out / "path.csv").exists()
    assert "no control point exists" in run("check", out).stdout
    words = run("plan", root / "examples" / "no_control_point.toml", "--out", out, "--no-plots")
    assert words.returncode == 3 and "cubic" in words.stdout


@each(
    {
        "a coordinate": ("three_balls", "path.json", '"exact": "3"', '"exact": "4"'),
        "the problem": ("three_balls", "path.json", '"radius_squared": "89/4"', '"radius_squared": "22"'),
        "the smoothness": ("three_balls", "path.json", '"smoothness": "C1"', '"smoothness": "C2"'),
        "the region": ("three_balls", "region.json", '"<="', '"<"'),
        "the table of the path": ("three_balls", "path.csv", "\n0.02,", "\n0.03,"),
        "the points of the summary": ("three_balls", "summary.json", '"decimal": "3"', '"decimal": "4"'),
        "the certificate": ("three_balls", "certificate.json", '"relation":"<="', '"relation":"<"'),
        "a number of a field": ("cubic_joins", "path.json", ("points", "Q1", 0, "in_field", 0), more),
        "a decimal": ("cubic_joins", "path.json", ("points", "P1", 2, "decimal"), more),
        "another smoothness": ("cubic_joins", "path.json", ("joins", 0, "smoothness"), lambda old: "C1"),
        "the problem of the summary": ("cubic_joins", "summary.json", ("problem", "radius_squared"), more),
        "another certificate": ("cubic_joins", "certificate.json", '"relation":"<="', '"relation":"<"'),
        "a height": ("single_leaves", "path.json", ("points", "P3", 1), lambda old: {"exact": "3", "decimal": "3"}),
    }
)
def test_altered_files_are_rejected(
    name: str, file: str, place: Any, new: Any, example: Callable[[str], Path], tmp_path: Path
) -> None:
    """By a text in the place of another, or by what is made of an entry of a JSON file."""
    altered = shutil.copytree(example(name), tmp_path / "out") / file
    text = altered.read_text()
    if isinstance(place, str):
        assert place in text
        altered.write_text(text.replace(place, new, 1))
    else:
        whole = entry = json.loads(text)
        for step in place[:-1]:
            entry = entry[step]
        entry[place[-1]] = new(entry[place[-1]])
        altered.write_text(json.dumps(whole))
    reason = "points: the y coordinates do not satisfy (4)" if name == "single_leaves" else ""
    refused(run("check", tmp_path / "out"), 4, file, reason)


HALF_SPACE = "[[half_space]]\nnormal = {}\noffset = {}\npoints = {}"
CUBIC_ONLY = 'expected this key with method = "cubic" only'


@each(
    (QUADRATIC, "start = [1,2]", "start"),
    (QUADRATIC, 'start = [1,2,"x"]', "start[2]"),
    (QUADRATIC, "start = [1,2,nan]", "start[2]"),
    (QUADRATIC, "via = [[1,1,1]]", "via"),
    (QUADRATIC, 'start = ["1/0",1,1]', "zero"),
    (QUADRATIC, 'colour = "red"', "colour"),
    (QUADRATIC, 'radius = "1/2"', "radius"),
    (QUADRATIC, 'method = "octic"', "method"),
    (QUADRATIC, "via = [[1,1,1],[1,1,1]]", "via[1]"),
    (QUADRATIC, "goal = [", "TOML"),
    (QUADRATIC, "ratio = 2", f"ratio: {CUBIC_ONLY}"),
    (QUADRATIC, "join_speed = 2", f"join_speed: {CUBIC_ONLY}"),
    (CUBIC, "ratio = 0", "ratio: expected"),
    (CUBIC, "ratio = -1", "ratio: expected"),
    (CUBIC, 'ratio = "fast"', "ratio: expected"),
    (CUBIC, "join_speed = 0", "join_speed: expected"),
    (CUBIC, "radius = 1", "radius: expected"),
    (CUBIC, "half_space = 3", "half_space: expected"),
    (CUBIC, '[[half_space]]\nnormal = [0, 0, 1]\noffset = "2"\n', "half_space[0].points: expected"),
    (CUBIC, HALF_SPACE.format([0, 0, 0], 2, '["Q1"]'), "half_space[0].normal: expected"),
    (CUBIC, HALF_SPACE.format([0, 0, 1], 2, '["Q7"]'), "half_space[0].points[0]: expected"),
    (CUBIC, HALF_SPACE.format([0, 0, 1], 2, '["Q1", "Q1"]'), "half_space[0].points[1]: expected"),
    (CUBIC, HALF_SPACE.format([0, 1], 2, '["Q1"]'), "half_space[0].normal: expected"),
    (CUBIC, HALF_SPACE.format([0, 0, 1], '"x"', '["Q1"]'), "half_space[0].offset: expected"),
    (CUBIC, HALF_SPACE.format([0, 0, 1], 2, '["Q1"]\ncolour = 1'), "half_space[0].colour: expected"),
)
def test_bad_problems_get_one_line_and_nothing_is_written(problem: str, line: str, named: str, tmp_path: Path) -> None:
    key = line.split("=")[0].strip()
    kept = [old for old in problem.splitlines() if old.split("=")[0].strip() != key]
    (tmp_path / "p.toml").write_text("\n".join([*kept, line]) + "\n")
    refused(run("plan", tmp_path / "p.toml", "--out", tmp_path / "out"), 2, "p.toml:", named, "expected", "found")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["p.toml"]


def test_files_and_folders_that_cannot_be_used(root: Path, tmp_path: Path) -> None:
    example = root / "examples" / "three_balls.toml"
    refused(run("plan", tmp_path / "none.toml", "--out", tmp_path / "out"), 2, "none.toml", "readable")
    (tmp_path / "taken").write_text("")
    refused(run("plan", example, "--out", tmp_path / "taken"), 2, "taken", "folder")
    refused(run("plan", example, "--out", "/proc/out"), 2, "writable")
    refused(run("check", tmp_path), 2, "certificate.json")
    refused(run("plan", example), 2, "--out")
    refused(run("plan", example, "--out", tmp_path / "out", "--timeout", "-1"), 2, "--timeout")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["taken"]


def test_a_time_limit_leaves_nothing_half_written(root: Path, tmp_path: Path) -> None:
    example = root / "examples" / "three_balls.toml"
    refused(run("plan", example, "--out", tmp_path / "out", "--timeout", "0.001"), 3, "limit")
    assert list(tmp_path.iterdir()) == []


def stuck(channel: object, folder: Path) -> None:
    time.sleep(600)


def test_a_check_holds_its_time_limit(main_example: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    refused(run("check", main_example, "--timeout", "0"), 2, "--timeout")
    assert run("check", main_example, "--timeout", "100").returncode == 0
    monkeypatch.setattr("bezier.check.recheck.recheck", stuck)
    refused(run("check", main_example, "--timeout", "0.01"), 3, "time limit of 0.01 s reached")


def test_a_second_plan_leaves_nothing_of_the_first(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for name, code in (("three_balls", 0), ("single_dip", 3)):
        process = run("plan", root / "examples" / f"{name}.toml", "--out", out, "--no-plots")
        assert process.returncode == code, process.stderr
    pages = {f"derivation_{k}.html" for k in (1, 2, 3)}
    assert {p.name for p in out.iterdir()} == {
        "certificate.json",
        "problem.json",
        "report.html",
        "summary.json",
        *pages,
    }
    assert run("check", out).returncode == 0


def test_pages_of_derivations_that_are_not_written_again_go(root: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for name, count in (("single_dip", 3), ("cubic_joins", 1)):
        run("plan", root / "examples" / f"{name}.toml", "--out", out, "--no-plots")
        assert len(list(out.glob("derivation_*.html"))) == count
    assert 'href="derivation_1.html"' in (out / "report.html").read_text()


def test_help_names_the_commands() -> None:
    text = command.in_a_shell(BEZIER, "--help").stdout
    assert all(command in text for command in ("plan", "check", "compare"))


def test_the_summary_of_cubic_curves(example: Callable[[str], Path]) -> None:
    found = json.loads((example("cubic_joins") / "summary.json").read_text())
    assert found["status"] == "solved" and found["method"] == "cubic" and found["certified"] is True
    assert found["active"] == ["P1", "R2"] and abs(float(found["objective"]["decimal"]) - 8.608561) < 1e-5
    assert {m["condition"] for m in found["multipliers"]} == {"P1", "R2"}
    assert found["joins"] == ["C2", "C2"] and all(float(s["low"]) > 0 for s in found["least_speed"].values())
    assert set(found["points"]) == {f"{curve}{k}" for curve in "PQR" for k in range(4)}


def test_cubic_curves_in_a_hemisphere(root: Path, tmp_path: Path) -> None:
    found = planned(root / "examples" / "cubic_hemisphere.toml", tmp_path / "out", 0)
    assert found["certified"] is True and found["joins"] == ["C2", "C2"]
    assert found["problem"]["half_space"][0]["offset"] == "9/5" and found["problem"]["ratio"] == "1/2"
    process = run("check", tmp_path / "out")
    assert process.returncode == 0 and "a speed of at least 1 at both joins" in process.stdout
    last = (tmp_path / "out" / "path.csv").read_text().splitlines()[-1]
    assert last.startswith("2,"), "1/2 + 1 + 1/2 units of time"


def test_contradictory_half_spaces(tmp_path: Path) -> None:
    problem, out = tmp_path / "p.toml", tmp_path / "out"
    opposite = (HALF_SPACE.format([0, 0, side], offset, '["Q1"]\n') for side, offset in ((1, 3), (-1, -2)))
    problem.write_text(CUBIC + "".join(opposite))
    found = planned(problem, out, 3)
    assert found["status"] == "infeasible" and found["points"] == {} and found["objective"] is None
    assert "Q1.half_space[0]" in found["reason"] and "Q1.half_space[1]" in found["reason"]
    assert run("check", out / "certificate.json", program=QE).returncode == 0
    assert "no control point exists" in run("check", out).stdout
    assert "Why there is no path" in (out / "report.html").read_text()


def test_a_problem_without_a_single_curve(root: Path, tmp_path: Path) -> None:
    found = planned(root / "examples" / "single_dip.toml", tmp_path / "out", 3)
    assert found["status"] == "infeasible" and found["certified"] is True
    assert len(found["dips"]) == 1 and "no curve of degree 7" in found["reason"]
    assert run("check", tmp_path / "out").returncode == 0


def test_a_bad_table_of_method_1(tmp_path: Path) -> None:
    file = tmp_path / "p.toml"
    file.write_text(
        'method = "single"\nstart = [0,0,0]\ngoal = [9,0,0]\n[single]\ndegree = 3\na = 1\nb = 2\nheight_y = 1\n'
    )
    refused(run("plan", file, "--out", tmp_path / "out"), 2, "single.degree", "the least degree that works is")
