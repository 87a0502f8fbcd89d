"""Problem (4) of Method 1 as formulas for the engine, with numbers or symbols, and the identities (2) and (3)."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import lru_cache
from typing import Any

import qe
from bezier.curves.workspace import Workspace, WorkspaceKind
from bezier.input.task import Axis, Task
from bezier.methods.control import statements as st
from bezier.methods.control.optimal_path import answered as has_answer
from bezier.methods.single.program import variables
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, forall, implies
from qe.formula.normal import rename
from qe.formula.syntax import Formula, Relation

VALUE = "v"
"""The variable that stands for the sum of (4)."""
OTHER = "w"
"""Another such sum."""


class Symbol(Enum):
    """What may stay a symbol in (4); ``value`` is its name in the formulas, for the ends after the axis: y0, yn."""

    HEIGHT = "h"
    A = "a"
    B = "b"
    START = "0"
    GOAL = "n"


def linearity(degree: int) -> st.Statement:
    """(2) as a sentence: with equally spaced x_i, P_x(t) = (1-t) x_0 + t x_n for all x_0, x_n and t."""
    first, last, t = st.names(("x0", "xn", "t"))
    spaced = [
        st.product(
            st.number(Fraction(1, degree)),
            st.total((st.product(st.number(degree - i), first), st.product(st.number(i), last))),
        )
        for i in range(degree + 1)
    ]
    return st.for_all(("x0", "xn", "t"), st.equal(st.bernstein(spaced, t), _between(first, last, t)))


def inverse() -> st.Statement:
    """(3) as a sentence: t = (x - x_0) / (x_n - x_0) is the one solution of (2) for t."""
    first, last, x, t = st.names(("x0", "xn", "x", "t"))
    here = st.equal(x, _between(first, last, t))
    solved = st.equal(st.product(st.difference(last, first), t), st.difference(x, first))
    same = st.grouped(st.implies(here, solved), st.implies(solved, here))
    return st.for_all(("x0", "xn", "x", "t"), st.implies(st.atomic(first, Relation.NE, last), same))


def _between(first: st.Term, last: st.Term, t: st.Term) -> st.Term:
    return st.total((st.product(st.difference(st.number(1), t), first), st.product(t, last)))


def identities(degree: int) -> dict[str, st.Statement]:
    """(2) for this degree and (3), by name."""
    return {"identity (2)": linearity(degree), "identity (3)": inverse()}


@lru_cache(maxsize=32)
def proved_identities(degree: int) -> Mapping[str, Any]:
    """The engine's answers to (2) for this degree and (3), asked once for each degree."""
    return {name: answered(statement.formula, None) for name, statement in identities(degree).items()}


def identities_hold(degree: int) -> bool:
    """Whether the engine proves them."""
    return all(answer.truth is True for answer in proved_identities(degree).values())


def constraints(given: Task, axis: Axis, symbols: Collection[Symbol] = ()) -> list[st.Statement]:
    """The conditions of (4); with a or b symbolic also the index condition that p and q stand for."""
    height: st.Term = st.name("h") if Symbol.HEIGHT in symbols else _number(axis.height or Fraction(0))
    start: st.Term = st.name(f"{axis.name}0") if Symbol.START in symbols else _number(axis.start)
    goal: st.Term = st.name(f"{axis.name}n") if Symbol.GOAL in symbols else _number(axis.goal)
    points = [start, *st.names(variables(given, axis)), goal]
    times = [
        _time(given, symbol.value) if symbol in symbols else _number(t)
        for symbol, t in zip((Symbol.A, Symbol.B), given.times, strict=True)
    ]
    result: list[st.Statement] = [st.equal(st.bernstein(points, t), height) for t in times]
    bounds = [start] * given.p + [height] * (given.q - given.p) + [goal] * (given.degree - 1 - given.q)
    result += [st.at_least(point, bound) for point, bound in zip(points[1:-1], bounds, strict=True)]
    xs = [_number(x) for x in given.abscissae]
    a, b = st.names((Symbol.A.value, Symbol.B.value))
    if Symbol.A in symbols:
        result += [st.below(xs[given.p], a), st.at_most(a, xs[given.p + 1])]
    if Symbol.B in symbols:
        result += [st.at_most(xs[given.q], b), st.below(b, xs[given.q + 1])]
    return result


def _number(value: Fraction) -> st.Term:
    return st.bracketed(st.number(value))


def _time(given: Task, name: str) -> st.Term:
    low, high = given.x_ends
    return st.bracketed(st.product(_number(1 / (high - low)), st.difference(st.name(name), _number(low))))


def total(given: Task, axis: Axis) -> st.Term:
    """The sum of (4)."""
    return st.total(st.names(f"{axis.name}{i}" for i in given.middle))


def attainable(given: Task, axis: Axis, symbols: Collection[Symbol] = ()) -> st.Statement:
    """The formula whose free variables are v and the symbols: some solution of (4) has the sum v."""
    matrix = st.every(st.equal(st.name(VALUE), total(given, axis)), *constraints(given, axis, symbols))
    return st.exists(variables(given, axis), matrix)


@dataclass(frozen=True, slots=True)
class Piecewise:
    """``values``: which sums v are attainable; ``least``: v is the least of them. Quantifier-free, in v and symbols."""

    values: Formula
    least: Formula


def eliminate(given: Task, axis: Axis, symbols: Collection[Symbol] = (), *, timeout: float | None = None) -> Piecewise:
    """Solve (4) by quantifier elimination: linear virtual substitution on min sum y_k, with symbols piecewise.

    Raises ``Unable`` at a limit.
    """
    values = answered(attainable(given, axis, symbols).formula, timeout).formula
    other = rename(values, {VALUE: OTHER})
    ring = Ring.of(dict.fromkeys((VALUE, *values.free, OTHER)))
    no_less = atom(ring.var(OTHER) - ring.var(VALUE), Relation.GE)
    smallest = forall((OTHER,), implies(convert(other, ring), no_less))
    return Piecewise(values, answered(conj((convert(values, ring), smallest)), timeout).formula)


def answered(question: Formula, timeout: float | None) -> Any:
    """The answer with a quantifier-free equivalent. Raises ``Unable`` when none is reached."""
    return has_answer(qe.eliminate(question, timeout=timeout))


def closed(given: Task, workspace: Workspace) -> st.Statement:
    """Method 1* for one raised axis as one formula in v: (4), and for all t the height, the ball and z >= 0."""
    (axis,) = given.raised
    columns: list[list[st.Term]] = [[_number(x) for x in given.abscissae]]
    for other in given.axes:
        inner = st.names(variables(given, axis)) if other == axis else ()
        columns.append([_number(other.start), *inner, _number(other.goal)])
    t, zero = st.name("t"), st.number(0)
    at = [st.bernstein(column, t) for column in columns]
    low, high = (_number(time) for time in given.times)
    kept = st.at_least(at[1 + given.axes.index(axis)], _number(axis.height or Fraction(0)))
    inside: st.Statement = st.at_most(st.squares(at), _number(workspace.radius_squared))
    if workspace.kind is WorkspaceKind.HEMISPHERE:
        inside = st.grouped(inside, st.at_least(at[-1], zero))
    parts = [st.equal(st.name(VALUE), total(given, axis)), *constraints(given, axis)]
    parts.append(st.for_all(["t"], st.implies(st.grouped(st.between(low, t, high)), kept)))
    parts.append(st.for_all(["t"], st.implies(st.grouped(st.between(zero, t, st.number(1))), inside)))
    return st.exists(variables(given, axis), st.every(*parts))
