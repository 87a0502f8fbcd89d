"""Reading the corpus files."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass

from experiments.suites.corpus import CORPUS

KEYS = {"id", "citation", "formula", "expected", "tags", "why"}


@dataclass(frozen=True, slots=True)
class Problem:
    """One record; the keys are explained in experiments/corpus/README.md."""

    id: str
    citation: str
    formula: str
    expected: str
    tags: tuple[str, ...]
    why: str
    assume: str | None = None


def records() -> list[tuple[str, dict[str, object]]]:
    """(file name, raw record) of every problem."""
    found = []
    for path in sorted(CORPUS.glob("*.toml")):
        found += [(path.name, record) for record in tomllib.loads(path.read_text())["problem"]]
    return found


def problems() -> list[Problem]:
    """Every problem of the corpus."""
    return [Problem(**{**record, "tags": tuple(record["tags"])}) for _, record in records()]  # type: ignore[arg-type]
