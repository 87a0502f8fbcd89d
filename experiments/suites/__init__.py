"""The problem suites by name. How they are run is in ``experiments.solvers``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from experiments.problem import Problem
from experiments.solvers import ABLATIONS
from experiments.suites import corpus, linear, paper, scaling
from qe.errors import InputError


@dataclass(frozen=True, slots=True)
class Suite:
    """``problems`` makes the list; ``solvers`` are those that run it when the caller names none."""

    problems: Callable[[], list[Problem]]
    solvers: tuple[str, ...] = ("ours",)


SUITES = {
    "paper": Suite(paper.problems),
    **{name: Suite(partial(corpus.tagged, name)) for name in ("classics", "textbook", "threads")},
    "literature": Suite(corpus.literature),
    "hard": Suite(corpus.hard),
    "wild": Suite(corpus.wild),
    "scaling": Suite(scaling.problems),
    "linear": Suite(linear.problems),
    "ablation": Suite(corpus.ablation, ("ours", *ABLATIONS)),
}


def suite(name: str) -> Suite:
    """The suite of this name. Raises ``InputError``, naming the suites there are."""
    if name not in SUITES:
        raise InputError(f"--suite: one of {', '.join(SUITES)} (or arm, for run) expected, {name!r} found")
    return SUITES[name]
