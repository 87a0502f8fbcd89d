"""The solvers by name, and how each is started. The programs themselves are ``experiments.adapters``."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from experiments.problem import ROOT
from qe.errors import InputError
from qe.options import Method, Stage

OURS = "ours"
WITHOUT = f"{OURS}-without-"
METHODS = tuple(f"{OURS}-{method.value}" for method in Method if method is not Method.AUTO)
ABLATIONS = tuple(WITHOUT + stage.value for stage in Stage)
PEERS = ("qepcad", "sympy-extras", "semialg", "z3", "cvc5", "yices")
NAMES = (OURS, *METHODS, *ABLATIONS, *PEERS)


@dataclass(frozen=True, slots=True)
class Solver:
    """``command`` reads a task as JSON from standard input, see ``experiments.adapters``; it is started in ``folder``,
    whose packages it imports.
    """

    name: str
    command: tuple[str, ...]
    folder: Path = ROOT


def solver(name: str) -> Solver:
    """The solver of this name. Raises ``InputError``, naming the solvers there are."""
    if name not in NAMES:
        raise InputError(f"--solver: one of {', '.join(NAMES)} expected, {name!r} found")
    return Solver(name, adapter(name))


def adapter(name: str) -> tuple[str, ...]:
    """The command that runs the solver of this name."""
    return sys.executable, "-m", "experiments.adapters", name
