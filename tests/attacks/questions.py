"""Random questions from templates.

In a template ``{n}`` is a small number, ``{s}`` one that is not 0, ``{p}`` a positive
one, ``{R}`` any relation, ``{O}`` an inequality, ``{<}`` and ``{>}`` one that is strict or not, ``{L}`` a linear form
in a and b, ``{Q}`` a condition on x that may have a block, ``{this|that}`` one of these. Letters change places in half
of the questions, so that no order of the variables is preferred.
"""

from __future__ import annotations

import random
import re
from collections.abc import Collection
from dataclasses import dataclass

from qe.formula.syntax import Formula
from qe.io.text import read
from qe.options import Method, Options, Stage

PARTS = {
    "n": ("(-2)", "(-1)", "0", "1", "2", "3"),
    "s": ("(-2)", "(-1)", "1", "2", "3"),
    "p": ("1", "2", "3", "4"),
    "R": ("=", "/=", "<", "<=", ">", ">="),
    "O": ("<", "<=", ">", ">="),
    "<": ("<", "<="),
    ">": (">", ">="),
    "L": ("a", "b", "a + b", "2*a - 1", "a - b", "b + 1", "1 - a"),
    "Q": (
        "(all z. z {O} x or a*z {R} b)",
        "(all z. z^2 + x {O} b or z {O} a)",
        "(ex z. z^2 {R} b*x and z {O} a)",
        "x {O} {n}",
        "b {O} {n}",
    ),
}


@dataclass(frozen=True, slots=True)
class Row:
    """Templates of the questions, the method that is to answer them, and what it is to do without."""

    templates: tuple[str, ...]
    method: Method = Method.AUTO
    without: frozenset[Stage] = frozenset()

    def question(self, rng: random.Random) -> Formula:
        """A random question. Not every one makes the rule fire."""
        text = filled(rng, rng.choice(self.templates))
        return read(with_other_letters(rng, text) if rng.random() < 0.5 else text)

    @property
    def options(self) -> Options:
        """How it is to be answered: with whatever evidence there is."""
        return Options(method=self.method, certify=True, without=self.without)


def filled(rng: random.Random, template: str) -> str:
    """A text without open places."""

    def part(hole: re.Match[str]) -> str:
        this = rng.choice(PARTS.get(hole[1]) or hole[1].split("|"))
        return rng.choice(PARTS[this]) if this.isalpha() and this in PARTS else this

    while "{" in template:  # the innermost first
        template = re.sub(r"{([^{}]*)}", part, template)
    return template


def with_other_letters(rng: random.Random, text: str) -> str:
    """The question with its letters exchanged."""
    letters = sorted(set(re.findall(r"\b[a-z]\b", text)))
    other = dict(zip(letters, rng.sample(letters, len(letters)), strict=True))
    return re.sub(r"\b[a-z]\b", lambda found: other[found[0]], text)


def row(*templates: str, method: Method = Method.AUTO, without: Collection[Stage] = ()) -> Row:
    return Row(templates, method, frozenset(without))
