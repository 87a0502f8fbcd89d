"""The solvers by name, and how each is started. The programs themselves are ``experiments.adapters``."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from experiments.problem import ROOT
from qe.errors import InputError
from qe.options import Method, Options, Projection, Stage

OURS = "ours"
WITHOUT = f"{OURS}-without-"
METHODS = {f"{OURS}-{method.value}": Options(method=method) for method in Method if method is not Method.AUTO}
PROJECTIONS = {f"{OURS}-cad-{p.value}": Options(method=Method.CAD, projection=p) for p in Projection}
ABLATIONS = {WITHOUT + stage.value: Options(without=frozenset([stage])) for stage in Stage}
ENGINES = {OURS: Options(), **METHODS, **PROJECTIONS, **ABLATIONS}
"""Our engine by name: by default, by one method, decomposition by one projection, without one stage."""

PEERS = ("qepcad", "sympy-extras", "semialg", "z3", "cvc5", "yices")
NAMES = (*ENGINES, *PEERS)


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
