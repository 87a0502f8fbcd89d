"""Problem (4) of Method 1 as formulas for the engine, with numbers or symbols, and the identities (2) and (3)."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from math import comb
from typing import Any

import qe
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.task import Axis, Task
from bezier.methods.single.program import variables
from qe.errors import Unable

VALUE = "v"
"""The variable that stands for the sum of (4)."""


class Symbol(Enum):
    """What may stay a symbol in (4); ``value`` is its name in the formulas, for the ends after the axis: y0, yn."""

    HEIGHT = "h"
    A = "a"
    B = "b"
    START = "0"
    GOAL = "n"


def linearity(degree: int) -> str:
    """(2) as a sentence: with equally spaced x_i, P_x(t) = (1-t) x_0 + t x_n for all x_0, x_n and t."""
    terms = [
        f"{comb(degree, i)}*t^{i}*(1 - t)^{degree - i}*({degree - i}*x0 + {i}*xn)/{degree}" for i in range(degree + 1)
    ]
    return f"all x0, xn, t. {' + '.join(terms)} = (1 - t)*x0 + t*xn"


INVERSE = "all x0, xn, x, t. x0 /= xn -> (x = (1 - t)*x0 + t*xn <-> (xn - x0)*t = x - x0)"
"""(3) as a sentence: t = (x - x_0) / (x_n - x_0) is the one solution of (2) for t."""


def identities_hold(degree: int) -> bool:
    """Whether the engine proves (2) for this degree and (3)."""
    return qe.decide(linearity(degree)) and qe.decide(INVERSE)


def constraints(given: Task, axis: Axis, symbols: Collection[Symbol] = ()) -> list[str]:
    """The conditions of (4), as text; with a or b symbolic also the index condition that p and q stand for."""
    height = "h" if Symbol.HEIGHT in symbols else _number(axis.height or Fraction(0))
    start = f"{axis.name}0" if Symbol.START in symbols else _number(axis.start)
    goal = f"{axis.name}n" if Symbol.GOAL in symbols else _number(axis.goal)
    points = [start, *variables(given, axis), goal]
    times = [
        _time(given, symbol.value) if symbol in symbols else _number(t)
        for symbol, t in zip((Symbol.A, Symbol.B), given.times, strict=True)
    ]
    found = [f"{_at(points, t)} = {height}" for t in times]
    bounds = [start] * given.p + [height] * (given.q - given.p) + [goal] * (given.degree - 1 - given.q)
    found += [f"{name} >= {bound}" for name, bound in zip(points[1:-1], bounds, strict=True)]
    xs = [_number(x) for x in given.abscissae]
    if Symbol.A in symbols:
        found += [f"{xs[given.p]} < a", f"a <= {xs[given.p + 1]}"]
    if Symbol.B in symbols:
        found += [f"{xs[given.q]} <= b", f"b < {xs[given.q + 1]}"]
    return found


def _number(value: Fraction) -> str:
    return f"({value})"


def _time(given: Task, name: str) -> str:
    low, high = given.x_ends
    return f"({_number(1 / (high - low))}*({name} - {_number(low)}))"


def _at(points: list[str], t: str) -> str:
    n = len(points) - 1
    return " + ".join(f"{comb(n, i)}*{t}^{i}*(1 - {t})^{n - i}*{point}" for i, point in enumerate(points))


def total(given: Task, axis: Axis) -> str:
    """The sum of (4) as text."""
    return " + ".join(f"{axis.name}{i}" for i in given.middle)


def attainable(given: Task, axis: Axis, symbols: Collection[Symbol] = ()) -> str:
    """The formula whose free variables are v and the symbols: some solution of (4) has the sum v."""
    matrix = " and ".join([f"{VALUE} = {total(given, axis)}", *constraints(given, axis, symbols)])
    return f"ex {', '.join(variables(given, axis))}. {matrix}"


@dataclass(frozen=True, slots=True)
class Piecewise:
    """``values``: which sums v are attainable; ``least``: v is the least of them. Quantifier-free, in v and symbols."""

    values: Any
    least: Any


def eliminate(given: Task, axis: Axis, symbols: Collection[Symbol] = (), *, timeout: float | None = None) -> Piecewise:
    """Solve (4) by quantifier elimination: linear virtual substitution on min sum y_k, with symbols piecewise.

    Raises ``Unable`` at a limit.
    """
    values = answered(attainable(given, axis, symbols), timeout)
    other = re.sub(rf"\b{VALUE}\b", "w", str(values))
    least = answered(f"({values}) and all w. (({other}) -> w >= {VALUE})", timeout)
    return Piecewise(values, least)


def answered(text: str, timeout: float | None) -> Any:
    """The quantifier-free equivalent. Raises ``Unable`` when none is reached."""
    answer = qe.eliminate(text, timeout=timeout)
    if answer.formula is None:
        raise Unable(answer.reason or "no answer was reached")
    return answer.formula


def closed(given: Task, workspace: Workspace) -> str:
    """Method 1* for one raised axis as one formula in v: (4), and for all t the height, the ball and z >= 0."""
    (axis,) = given.raised
    names = variables(given, axis)
    columns = [[_number(x) for x in given.abscissae]]
    for other in given.axes:
        ends = _number(other.start), _number(other.goal)
        inner = list(names) if other == axis else []
        columns.append([ends[0], *inner, ends[1]])
    at = [_at(column, "t") for column in columns]
    low, high = (_number(t) for t in given.times)
    height = at[1 + given.axes.index(axis)]
    norm = " + ".join(f"({coordinate})^2" for coordinate in at)
    inside = f"{norm} <= {_number(workspace.radius_squared)}"
    if workspace.kind is WorkspaceKind.HEMISPHERE:
        inside = f"({inside} and {at[-1]} >= 0)"
    parts = [f"{VALUE} = {total(given, axis)}", *constraints(given, axis)]
    parts.append(f"(all t. ({low} <= t and t <= {high}) -> {height} >= {_number(axis.height or Fraction(0))})")
    parts.append(f"(all t. (0 <= t and t <= 1) -> {inside})")
    return f"ex {', '.join(names)}. {' and '.join(parts)}"
