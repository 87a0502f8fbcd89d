"""Real terms with case distinctions (``ite``, absolute values, minima): exclusive, exhaustive guarded terms.

A comparison of such terms is the disjunction over all combinations of cases of (guards and comparison). As exactly one
combination of guards holds at every point, the disjunction is equivalent to the comparison under either polarity.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from math import prod
from typing import NamedTuple

from qe.formula.syntax import Relation
from qe.io import surface as s
from qe.io.terms import TermError

MAX_CASES = 512


class Case(NamedTuple):
    """``term`` where all ``guards`` hold."""

    guards: tuple[s.Node, ...]
    term: s.Term


Cases = tuple[Case, ...]


def plain(term: s.Term) -> Cases:
    """A term without a case distinction."""
    return (Case((), term),)


def choose(condition: s.Node, then: Cases, other: Cases) -> Cases:
    """``then`` where the condition holds, ``other`` elsewhere."""
    negated = s.Negation(condition)
    yes = tuple(Case((condition, *case.guards), case.term) for case in then)
    return _limited(yes + tuple(Case((negated, *case.guards), case.term) for case in other))


def combine(operands: Sequence[Cases], build: Callable[[list[s.Term]], s.Term]) -> Cases:
    """``build`` applied to the operands, in every combination of their cases."""
    if all(len(operand) == 1 for operand in operands):
        guards = tuple(guard for operand in operands for guard in operand[0].guards)
        return (Case(guards, build([operand[0].term for operand in operands])),)
    if prod(map(len, operands)) > MAX_CASES:
        raise TermError(f"more than {MAX_CASES} cases in one term")
    return tuple(
        Case(tuple(guard for case in choice for guard in case.guards), build([case.term for case in choice]))
        for choice in product(*operands)
    )


def compare(left: Cases, relation: Relation, right: Cases, at: int) -> s.Node:
    """``left relation right``."""
    links: list[s.Node] = []
    if len(left) * len(right) > MAX_CASES:
        raise TermError(f"more than {MAX_CASES} cases in one comparison")
    for a, b in product(left, right):
        link = s.Comparison([a.term, b.term], [relation], at)
        guards = (*a.guards, *b.guards)
        links.append(s.Every([*guards, link]) if guards else link)
    return links[0] if len(links) == 1 else s.Some(links)


def _limited(cases: Cases) -> Cases:
    if len(cases) > MAX_CASES:
        raise TermError(f"more than {MAX_CASES} cases in one term")
    return cases
