"""The command without the repository: any current folder, nothing written beside the packages; what a wheel holds."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import experiments
from experiments import cli
from tests.tables import each

PROJECT = Path(__file__).resolve().parents[2]


def install(folder: Path) -> None:
    """Copy modules and package data of the packages."""
    tool = tomllib.loads((PROJECT / "pyproject.toml").read_text())["tool"]["setuptools"]
    patterns = ["*.py", *tool["package-data"]["*"]]
    for pattern in (*tool["packages"]["find"]["include"], "experiments*"):
        for top in PROJECT.glob(pattern):
            for path in top.rglob("*") if top.is_dir() else ():
                if path.is_file() and any(path.match(p) for p in patterns):
                    target = folder / path.relative_to(PROJECT)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, target)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    install(folder)
    return folder


def run(installed: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(installed), "PYTHONSAFEPATH": "1"}
    command = [sys.executable, "-m", "experiments", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def files(folder: Path) -> set[Path]:
    return {p.relative_to(folder) for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts}


def test_the_classics_run_from_an_installed_package(installed: Path, tmp_path: Path) -> None:
    """They were silently no problems at all, and the report was written beside the installed packages."""
    before = files(installed)
    done = run(installed, tmp_path, "run", "--suite", "classics", "--only", "davenport-heintz", "--limit", "30")
    assert done.returncode == 0, done.stderr
    records = [json.loads(line) for line in (tmp_path / "out" / "corpus.jsonl").read_text().splitlines()]
    found = [r for r in records if r.get("kind", "result") == "result"]
    assert [r["status"] for r in found] == ["solved"]
    assert {r["commit"] for r in records if r.get("kind") == "environment"} == {"unknown"}
    done = run(installed, tmp_path, "report")
    assert done.returncode == 0, done.stderr
    assert {Path("out/corpus.jsonl"), Path("out/benchmarks.md"), Path("out/benchmarks.html")} <= files(tmp_path)
    assert "davenport-heintz" in (tmp_path / "out" / "benchmarks.md").read_text()
    assert files(installed) == before


def test_the_command_of_the_repository_works_in_any_folder(tmp_path: Path) -> None:
    """Outside the repository it said "No module named experiments"; a folder of that name must not take its place."""
    made, elsewhere = tmp_path / "bin", tmp_path / "elsewhere"
    (elsewhere / "experiments").mkdir(parents=True)
    made.mkdir()
    (made / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (made / "python").chmod(0o755)
    make = ["make", "-s", f"BIN={made}", f"CORE={made / 'python'}", f"{made}/experiments"]
    subprocess.run(make, cwd=PROJECT, check=True, timeout=60)
    done = subprocess.run(
        [made / "experiments", "run", "--suite", "classics", "--only", "davenport-heintz", "--limit", "30"],
        cwd=elsewhere,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert (elsewhere / "out" / "corpus.jsonl").exists()


@each("report", "table", "figures", "html")
@each(None, "", '{"kind": "environment", "name": "e"}\n', "spoilt\n")
def test_a_report_without_results_overwrites_nothing(content, command, tmp_path, monkeypatch, capsys):
    """In a fresh clone the tracked page was replaced by an empty table."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "docs").mkdir()
    for name in ("docs/benchmarks.md", "benchmarks.md"):
        (tmp_path / name).write_text("tables")
    if content is not None:
        (tmp_path / "out").mkdir()
        (tmp_path / "out" / "corpus.jsonl").write_text(content)
    before = files(tmp_path)
    out = "." if command == "report" else "benchmarks.md"
    for options in ([], ["--out", out], *([["--docs", "docs"]] if command == "report" else [])):
        assert cli.main([command, *options]) == 2
        assert capsys.readouterr().err.count("experiments: --results: ") == 1
    assert files(tmp_path) == before
    assert (tmp_path / "docs/benchmarks.md").read_text() == (tmp_path / "benchmarks.md").read_text() == "tables"


def test_the_repository_s_own_page_is_written_only_on_request(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    fields = {"set": "s", "solver": "ours", "id": "p", "status": "solved", "seconds": 0.5, "wall": 1.0, "limit": 10.0}
    (tmp_path / "r.jsonl").write_text(json.dumps(fields) + "\n")
    assert cli.main(["report", "--results", "r.jsonl"]) == 0
    assert not (tmp_path / "docs").exists() and (tmp_path / "out/benchmarks.md").exists()
    assert cli.main(["report", "--results", "r.jsonl", "--docs", "docs"]) == 0
    assert (tmp_path / "docs/benchmarks.md").read_text() == (tmp_path / "out/benchmarks.md").read_text()


def test_no_problem_is_an_error(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["run", "--suite", "classics", "--only", "no such problem"]) == 2
    assert "no problem of classics" in capsys.readouterr().err
    monkeypatch.setattr("experiments.suites.corpus.CORPUS", tmp_path)
    assert cli.main(["run", "--suite", "classics"]) == 2
    assert "--suite classics: problems expected, none found" in capsys.readouterr().err
    assert files(tmp_path) == set()


def test_the_corpus_lies_in_the_package() -> None:
    folder = Path(experiments.__file__).parent / "corpus"
    assert {p.stem for p in folder.glob("*.toml")} >= {"timing", "shapes", "wrong_answers"}


@pytest.mark.deep
def test_the_wheel_and_the_source_distribution(tmp_path: Path) -> None:
    """The wheel installs the two packages and nothing of a common name; the source distribution holds the tests."""
    copy = tmp_path / "copy"
    subprocess.run(["git", "clone", "-q", str(PROJECT), str(copy)], check=True)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", str(tmp_path), str(copy)], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        tops = {name.split("/")[0] for name in archive.namelist()}
        archive.extractall(tmp_path / "installed")
    assert {top for top in tops if not top.endswith(".dist-info")} == {"qe", "bezier"}
    done = subprocess.run(
        [sys.executable, "-m", "qe", "eliminate", "ex x. x^2 = b"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path / "installed"), "PYTHONSAFEPATH": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == "b >= 0\n"
