"""Quantifiers as people say them mean what they say: against the same formula with a dot and brackets."""

from __future__ import annotations

import random

import pytest

import qe
from qe.io.text import read

SIGNED = {"positive": "> 0", "negative": "< 0", "nonnegative": ">= 0", "nonzero": "/= 0"}
SETS = {"[0, 1]": "0 <= {0} <= 1", "(0, 2)": "0 < {0} < 2", "ℝ": "{0} = {0}", "[-1, oo)": "{0} >= -1"}
WORDS = {
    True: ("for all", "for every", "for any", "forall", "∀", "given any", "for each"),
    False: ("there exists", "there is", "exists", "∃", "there are"),
}
ATOMS = ("x + y > a", "x*y = a", "x^2 >= a*y", "a*x - y < 1", "x^2 + y^2 <= a", "(x - y)*(x + a) > 0", "x/2 < y + a")


def body(rng: random.Random) -> str:
    count = rng.choice((1, 1, 2))
    return rng.choice((" and ", " or ", " -> ")).join(rng.sample(ATOMS, count))


def quantifier(rng: random.Random, names: list[str]) -> tuple[str, str]:
    """As it is said, and as it is meant, with {} in the place of its formula."""
    universal = rng.random() < 0.5
    said = rng.choice(WORDS[universal])
    conditions: list[str] = []
    match rng.randrange(5):
        case 0:
            said += f" {' and '.join(names) if ' ' in said else ', '.join(names)}"
        case 1:
            word = rng.choice([*SIGNED])
            said += f" {word}{rng.choice(('', ' real numbers', ' reals'))} {', '.join(names)}"
            conditions = [f"{name} {SIGNED[word]}" for name in names]
        case 2:
            within = rng.choice([*SETS])
            said += f" {', '.join(names)} {rng.choice(('in', '∈'))} {within}"
            conditions = [SETS[within].format(name) for name in names]
        case 3:
            bound = f"{rng.choice(('>', '<=', '<'))} {rng.choice(('0', '-1/2'))}"
            said += f" {', '.join(names)} {bound}"
            conditions = [f"{name} {bound}" for name in names]
        case 4:
            names = names[:1]
            conditions = [f"-1 < {names[0]} <= 1/2"]
            said += f" {conditions[0]}"
    join = " -> " if universal else " and "
    under = f"({' and '.join(conditions)}){join}({{}})" if conditions else "({})"
    return said, f"({'all' if universal else 'ex'} {', '.join(names)}. {under})"


@pytest.mark.parametrize("seed", range(120))
def test_what_is_said_is_what_is_meant(seed: int) -> None:
    rng = random.Random(seed)
    names = rng.choice((["x"], ["x", "y"]))
    given, (said, meant) = body(rng), quantifier(rng, names)
    inner, below = quantifier(rng, ["y"]) if names == ["x"] else ("", "{}")
    match rng.randrange(3):
        case 0:
            typed = f"{said}{f' {inner}'.rstrip()}{rng.choice((': ', ', ', ' such that ', '. '))}{given}"
        case 1:
            typed = f"{said}: {inner}, {given}" if inner else f"{said}: {given}"
        case _:
            typed, below = f"{given} {said}", "{}"
    assert qe.equivalent(read(typed), read(meant.format(below.format(given)))), typed
