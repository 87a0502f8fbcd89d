"""Words that do not come back as names: they say nothing of a value but that somebody had it."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.architecture.test_rows import MODULES

MOST = {
    "found": 960,
    "left": 440,
    "own": 300,
    "asked": 90,
    "turned": 68,
    "beside": 50,
    "settled": 45,
    "met": 40,
    "apart": 35,
    "lifted": 20,
    "told": 3,
    "spared": 3,
}
"""By the word the names of variables, arguments, attributes, functions and classes that are this: lowered whenever a
folder gets better ones. ``found`` may stay where a search may fail, ``left`` for the side."""


def names(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text())):
        match node:
            case ast.Name(id=name) | ast.arg(arg=name) | ast.Attribute(attr=name):
                yield name
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield name


@cache
def uses() -> Counter[str]:
    files = [path for module, path in dict(MODULES).items() if module.split(".")[0] in ("qe", "bezier")]
    return Counter(name for path in files for name in names(path))


@pytest.mark.parametrize("word", MOST)
def test_a_word_does_not_come_back(word: str) -> None:
    assert uses()[word] <= MOST[word]


def test_names_of_all_sorts_are_seen(tmp_path: Path) -> None:
    (tmp_path / "one.py").write_text("class A:\n    def b(self, c: int) -> None:\n        self.d = e\n")
    assert {"A", "b", "c", "d", "e"} <= set(names(tmp_path / "one.py"))
