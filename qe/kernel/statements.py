"""Theorems as data: what the files in ``qe/theorems`` say.

A file has a ``family``, a ``source`` and a list ``theorem``. Each has a ``name``, the quantified ``block``, what is
``given``, the ``answer`` (all as in ``qe.kernel.reading``), and ``proof`` (a file with derivations of it) or ``axiom``
(why it is believed). ``letters`` names what polynomials stand for, and ``bound`` what a part binds. ``let`` names terms
and formulas, each of which may use the others; ``fixed`` has terms for letters that are not needed. ``vectors`` says
how many components a letter or variable has, c[0], c[1], ...: a quantifier binds them all. ``for`` has words for marks
such as {low}: there is one theorem for each choice. A key of several marks has words for each of them; "2-12" stands
for the numbers from 2 to 12. For the engine alone are ``parameters``, the least number of them with which it is used,
and ``dense``: every condition has all variables of the block.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import Any

from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import Formula
from qe.kernel.reading import Language, Let, Reading, Tree, parsed


@dataclass(frozen=True, slots=True)
class Row:
    """A theorem of a file before words for its marks are chosen, with what all theorems of the file share."""

    name: str
    family: str
    data: Mapping[str, Any]
    shared: Mapping[str, Any]

    def table(self, key: str) -> Mapping[str, Any]:
        """A table of the file, with what the theorem has of it."""
        return {**self.shared.get(key, {}), **self.data.get(key, {})}

    def choices(self, size: frozenset[int] | None = None) -> Iterator[tuple[str, ...]]:
        """All choices of words for its marks; ``size``: those of which {n} may be one, if there is such a mark."""
        words = []
        for key, listed in self.data.get("for", {}).items():
            span = isinstance(listed, str) and re.fullmatch(r"(\d+)-(\d+)", listed)
            numbers = map(str, range(int(span[1]), int(span[2]) + 1)) if span else listed
            words.append([w for w in numbers if key != "n" or size is None or int(w) in size])
        yield from product(*words)

    def marks(self, words: Sequence[str]) -> dict[str, str]:
        """The word of each mark."""
        pairs = [zip(key.split(), word.split(), strict=True) for key, word in zip(self.data.get("for", {}), words)]
        return {mark: word for pair in pairs for mark, word in pair}


@cache
def rows() -> Mapping[str, Row]:
    """The theorems of all files, by name."""
    listed = [Row(row["name"], data["family"], row, data) for data in _files() for row in data["theorem"]]
    by_name = {row.name: row for row in listed}
    if len(by_name) < len(listed):
        raise InputError("theorems: a name is given twice")
    return by_name


def _files() -> Iterator[dict[str, Any]]:
    import tomllib
    from importlib.resources import files

    for file in sorted(files("qe").joinpath("theorems").iterdir(), key=lambda f: f.name):
        if file.name.endswith(".toml"):
            yield tomllib.loads(file.read_text("utf-8"))


@dataclass(frozen=True, slots=True)
class Theorem:
    """Where ``given`` holds, ``block`` <-> ``answer``, whatever real numbers the ``letters`` stand for.

    ``bound``: the names that a part binds. ``trees``: the parts. ``axiom``: why it is believed; empty where
    derivations, ``proof``, show it.
    """

    name: str
    words: tuple[str, ...]
    family: str
    letters: tuple[str, ...]
    bound: Mapping[str, tuple[str, ...]]
    trees: Mapping[str, Tree]
    language: Language
    source: str
    axiom: str
    proof: str

    @property
    def variables(self) -> tuple[str, ...]:
        """Those that a part binds."""
        return tuple(dict.fromkeys(name for names in self.bound.values() for name in names))

    def formula(self, part: str, letters: Mapping[str, Poly], variables: Mapping[str, str], ring: Ring) -> Formula:
        """The block, what is given, or the answer, with polynomials for letters and names for variables."""
        names = {name: variables[name] for name in self.bound.get(part, ())}
        values = {**letters, **{name: ring.var(other) for name, other in names.items()}}
        return Reading(self.language, values, names, ring).formula(self.trees[part], {})


@cache
def theorem(name: str, words: tuple[str, ...] = ()) -> Theorem | None:
    """The theorem of this name with these words for its marks, if there is one."""
    row = rows().get(name)
    if row is None or words not in set(row.choices()):
        return None
    marks = row.marks(words)
    trees = {part: parsed(row.data.get(part, "true"), marks) for part in ("block", "given", "answer")}
    lets = dict(_let(key, text, marks) for key, text in {**row.table("fixed"), **row.table("let")}.items())
    language = Language(lets, {key: number(text, marks) for key, text in row.table("vectors").items()})
    keys = ("source", "axiom", "proof", "letters")
    source, why, proof, letters = (row.data.get(key, row.shared.get(key, "")) for key in keys)
    bound = {part: _names(text, language) for part, text in row.table("bound").items()}
    used = Theorem(name, words, row.family, _names(letters, language), bound, trees, language, source, why, proof)
    if len({*used.letters, *used.variables}) < len(used.letters) + len(used.variables):
        raise InputError(f"theorems: {name}: a name is used twice")
    return used


def _names(text: str, language: Language) -> tuple[str, ...]:
    """The names in a text, those of the components for a vector."""
    return tuple(part for name in text.split() for part in language.parts(name))


def _let(key: str, text: str, marks: Mapping[str, str]) -> tuple[str, Let]:
    name, _, params = key.partition("(")
    return name, (tuple(p.strip() for p in params.rstrip(")").split(",") if p), parsed(text, marks))


def number(text: str, marks: Mapping[str, str]) -> int:
    """A number such as {n} + 1."""
    return Reading(Language(), {}, {}, Ring.of(())).number(parsed(text, marks), {})
