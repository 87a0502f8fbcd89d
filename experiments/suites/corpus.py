"""Suites read from files: the project's corpus, and problem sets of the literature in a folder beside the project."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

from experiments.problem import ROOT, Problem
from experiments.suites import paper, scaling
from qe.errors import InputError, QEError
from qe.io.text import CONSTANTS, read

CORPUS = ROOT / "experiments" / "corpus"
MIDDLE_SIZES = ("degree-8", "via-6", "balls-2d-6", "balls-3d-6", "bits-64", "tower-3")
LITERATURE = ROOT.parent / "shared" / "corpora"


def records() -> list[dict[str, Any]]:
    """The raw records of the project's corpus."""
    return [r for path in sorted(CORPUS.glob("*.toml")) for r in tomllib.loads(path.read_text())["problem"]]


def tagged(tag: str) -> list[Problem]:
    """The problems of the corpus with a tag that is the name of a suite, or ``classics``: the others.

    ``textbook``: theorems and conditions of the literature that are known in closed form. ``threads``: questions from
    public threads, as text. ``classics``: classics of the field, odd shapes, wrong answers that systems have given.
    """
    keys, named = ("formula", "expected", "assume"), {"textbook", "threads"}
    chosen = [r for r in records() if (tag in r["tags"] if tag in named else named.isdisjoint(r["tags"]))]
    name = tag if tag in named else "project"
    return [Problem(name, str(r["id"]), **{key: r[key] for key in keys if key in r}) for r in chosen]


def timing_ids() -> list[str]:
    """The problems of the corpus on which systems are timed."""
    return [str(record["id"]) for record in records() if "timing" in record["tags"]]


def ablation() -> list[Problem]:
    """Problems on which stages of the engine matter: timing problems, the paper's formulas, middle sizes of scaling."""
    timing = set(timing_ids())
    found = [p for p in tagged("classics") if p.id in timing]
    found += [p for p in paper.problems() if p.id.endswith("-0")]
    return found + [p for p in scaling.problems() if p.id in MIDDLE_SIZES]


def literature(folder: Path = LITERATURE) -> list[Problem]:
    """The literature sets ``public``, ``realgeom`` and ``classics``. Raises ``InputError`` where they are absent."""
    found = _lines("public", _present(folder) / "public.jsonl") + _lines("realgeom", folder / "timed_realgeom.jsonl")
    named = json.loads((folder / "classics.json").read_text())["problems"]
    return found + [_of_literature("classics", {"assume": _assumed(r["source"]), **r, "id": r["name"]}) for r in named]


def hard(folder: Path = LITERATURE) -> list[Problem]:
    """The literature set ``hard``. Raises ``InputError`` where it is absent."""
    return _lines("hard", _present(folder) / "hard.jsonl")


def wild(folder: Path = LITERATURE) -> list[Problem]:
    """The questions and scripts from public threads that ask for a formula or a truth value and that can be read.

    For a script: whether its assertions can hold together. Raises ``InputError`` where the set is absent.
    """
    lines = (_present(folder) / "wild.jsonl").read_text().splitlines()
    asked = [record for record in map(json.loads, lines) if record["kind"] in ("smt2", "eliminate", "decide")]
    return [Problem("wild", r["id"], text) for r in asked if (text := _of_thread(r)) is not None]


def _of_thread(record: dict[str, Any]) -> str | None:
    """The question as text; None where reading refuses it."""
    from qe.api.input import read_formula
    from qe.formula.build import exists

    script, given = record["kind"] == "smt2", record["text"]
    try:
        if given.startswith("sympy:"):
            import sympy

            given = sympy.sympify(given.removeprefix("sympy:"), evaluate=False)
        found = read_formula(given, "smtlib" if script else record.get("format", "text"))
    except QEError:
        return None
    return str(exists(found.free, found) if script else found)


def _present(folder: Path) -> Path:
    if not folder.is_dir():
        raise InputError(f"--suite literature: expected a folder {folder.parent.name}/{folder.name} beside the project")
    return folder


def _lines(name: str, file: Path) -> list[Problem]:
    return [_of_literature(name, json.loads(line)) for line in file.read_text().splitlines() if line.strip()]


def _assumed(source: str) -> str | None:
    """The assumption that a source states beside its name."""
    _, stated, assumption = source.partition("with assume [")
    return assumption.partition("]")[0] if stated else None


def _of_literature(name: str, record: dict[str, Any]) -> Problem:
    """Assumptions are stated in QEPCAD's square brackets."""
    assume = record.get("assume")
    if assume is not None:
        assume = assume.replace("[", "(").replace("]", ")")
    return Problem(name, record["id"], record["formula"], _answer_of(record), assume)


def _answer_of(record: dict[str, Any]) -> str | None:
    """The expected answer, unless it has other variables than the question: then it is that of another one."""
    expected: str | None = record.get("expected")
    if expected is not None and "free" in record:
        return expected if set(read(expected, known=CONSTANTS).free) <= {*record["free"]} else None
    return expected
