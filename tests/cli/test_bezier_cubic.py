"""``bezier plan`` and ``bezier check`` for three cubic curves."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from tests.cli.test_bezier_plan import QE, refused, run
from tests.tables import each

PROBLEM = """\
method = "cubic"
start = [-3, 0, 1]
via = [[-3, 1, 2], [2, 1, 2]]
goal = [3, 0, 1]
radius = "sqrt(15)"
"""


@pytest.fixture(scope="module")
def joins(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example with pictures, planned once."""
    out = tmp_path_factory.mktemp("cubic") / "out"
    process = run("plan", root / "examples" / "cubic_joins.toml", "--out", out)
    assert process.returncode == 0, process.stderr
    assert "C2 at both joins, proved to lie in the workspace" in process.stdout
    return out


def planned(tmp_path: Path, text: str) -> tuple[int, dict[str, object], Path]:
    (tmp_path / "p.toml").write_text(text)
    out = tmp_path / "out"
    process = run("plan", tmp_path / "p.toml", "--out", out, "--no-plots", "--json")
    assert process.returncode in (0, 3), process.stderr
    return process.returncode, json.loads(process.stdout), out


def test_the_files_and_the_page(joins: Path) -> None:
    names = {path.name for path in joins.iterdir() if path.stat().st_size}
    assert names >= {"report.html", "certificate.json", "path.json", "path.csv", "region.png", "path.png", "motion.png"}
    page = (joins / "report.html").read_text()
    head = page[: page.rindex("<script>")]
    for part in ("Formula (7)", "quantifier-free answer", "The best", "Does it ever stop?", "a cusp", "multiplier"):
        assert part in head
    assert head.count("C² (value, first, second derivative)") >= 2 and "never slower than" in head
    assert head.count("<canvas") == 2 and head.count("<svg") == 5


def test_the_certificates_hold(joins: Path) -> None:
    assert run("check", joins / "certificate.json", program=QE).returncode == 0
    process = run("check", joins)
    assert process.returncode == 0 and "formula (7)" in process.stdout and "C2 at every join" in process.stdout


def test_the_summary(joins: Path) -> None:
    found = json.loads((joins / "summary.json").read_text())
    assert found["status"] == "solved" and found["method"] == "cubic" and found["certified"] is True
    assert found["active"] == ["P1", "R2"] and abs(float(found["objective"]["decimal"]) - 8.608561) < 1e-5
    assert {m["condition"] for m in found["multipliers"]} == {"P1", "R2"}
    assert found["joins"] == ["C2", "C2"] and all(float(s["low"]) > 0 for s in found["least_speed"].values())
    assert set(found["points"]) == {f"{curve}{k}" for curve in "PQR" for k in range(4)}


@each(
    ("path.json", ("points", "Q1", 0, "in_field", 0)),
    ("path.json", ("points", "P1", 2, "decimal")),
    ("path.json", ("joins", 0, "smoothness")),
    ("summary.json", ("problem", "radius_squared")),
    ("certificate.json", None),
)
def test_altered_files_are_rejected(name: str, path: tuple[object, ...] | None, joins: Path, tmp_path: Path) -> None:
    for file in joins.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    text = (tmp_path / name).read_text()
    if path is None:
        assert '"relation":"<="' in text
        (tmp_path / name).write_text(text.replace('"relation":"<="', '"relation":"<"', 1))
    else:
        whole = place = json.loads(text)
        *steps, last = path
        for step in steps:
            place = place[step]
        place[last] = "C1" if last == "smoothness" else str(Fraction(place[last]) + Fraction(1, 10**6))
        (tmp_path / name).write_text(json.dumps(whole))
    refused(run("check", tmp_path), 4, name)


def test_the_hemisphere_example(root: Path, tmp_path: Path) -> None:
    text = (root / "examples" / "cubic_hemisphere.toml").read_text()
    code, found, out = planned(tmp_path, text)
    assert code == 0 and found["certified"] is True and found["joins"] == ["C2", "C2"]
    assert found["problem"]["half_space"][0]["offset"] == "9/5" and found["problem"]["ratio"] == "1/2"
    process = run("check", out)
    assert process.returncode == 0 and "a speed of at least 1 at both joins" in process.stdout
    assert (out / "path.csv").read_text().splitlines()[-1].startswith("2,"), "1/2 + 1 + 1/2 units of time"


def test_contradictory_half_spaces(tmp_path: Path) -> None:
    more = '[[half_space]]\nnormal = [0, 0, {}]\noffset = {}\npoints = ["Q1"]\n'
    code, found, out = planned(tmp_path, PROBLEM + more.format(1, 3) + more.format(-1, -2))
    assert code == 3 and found["status"] == "infeasible" and found["points"] == {} and found["objective"] is None
    assert "Q1.half_space[0]" in found["reason"] and "Q1.half_space[1]" in found["reason"]
    assert run("check", out / "certificate.json", program=QE).returncode == 0
    assert "no control point exists" in run("check", out).stdout
    assert "Why there is no path" in (out / "report.html").read_text()


BAD = {
    "ratio = 0": "ratio",
    "ratio = -1": "ratio",
    'ratio = "fast"': "ratio",
    "join_speed = 0": "join_speed",
    "radius = 1": "radius",
    "half_space = 3": "half_space",
    '[[half_space]]\nnormal = [0, 0, 1]\noffset = "2"\n': "half_space[0].points",
    '[[half_space]]\nnormal = [0, 0, 0]\noffset = 2\npoints = ["Q1"]': "half_space[0].normal",
    '[[half_space]]\nnormal = [0, 0, 1]\noffset = 2\npoints = ["Q7"]': "half_space[0].points[0]",
    '[[half_space]]\nnormal = [0, 0, 1]\noffset = 2\npoints = ["Q1", "Q1"]': "half_space[0].points[1]",
    '[[half_space]]\nnormal = [0, 1]\noffset = 2\npoints = ["Q1"]': "half_space[0].normal",
    '[[half_space]]\nnormal = [0, 0, 1]\noffset = "x"\npoints = ["Q1"]': "half_space[0].offset",
    '[[half_space]]\nnormal = [0, 0, 1]\noffset = 2\npoints = ["Q1"]\ncolour = 1': "half_space[0].colour",
}


@pytest.mark.parametrize("more", BAD)
def test_bad_problems_get_one_line_and_nothing_is_written(tmp_path: Path, more: str) -> None:
    kept = [line for line in PROBLEM.splitlines() if line.split("=")[0] != more.split("=")[0]]
    (tmp_path / "p.toml").write_text("\n".join([*kept, more]) + "\n")
    process = run("plan", tmp_path / "p.toml", "--out", tmp_path / "out")
    refused(process, 2, "p.toml:", f"{BAD[more]}: expected", "found")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["p.toml"]


@each("ratio", "join_speed")
def test_keys_of_the_cubic_method_only(key: str, tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(PROBLEM.replace("cubic", "quadratic") + f"{key} = 2\n")
    refused(run("plan", tmp_path / "p.toml", "--out", tmp_path / "out"), 2, key, "cubic")
