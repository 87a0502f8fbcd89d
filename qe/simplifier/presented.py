"""Answers in the order and shape in which people write them: ``-2 <= a <= 2`` for ``a^2 <= 4``, intervals from left to
right, conditions on single variables first, in the order of the variables."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby, pairwise

from qe.exact.ring import Poly
from qe.formula.build import atom, conj, disj, map_children
from qe.formula.comparison import ranges
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Atom, Formula, Or, Relation
from qe.formula.traverse import atoms
from qe.simplifier.univariate import roots_of

MOST_ENDS, MOST_INTERVALS = 12, 3
"""More are written by the signs of polynomials, where that is shorter."""


def presented(formula: Formula) -> Formula:
    """An equivalent of a quantifier-free formula: as intervals where it is about one variable, has few of them and all
    their ends are rational; in order."""
    if len(formula.free) == 1 and all(isinstance(part, Atom) for part in atoms(formula)):
        return intervals(formula) or ordered(formula)
    return ordered(formula)


def ordered(formula: Formula) -> Formula:
    """The formula with conditions on one variable in front of others in each conjunction, by names and numbers; the two
    sides of a range stay together."""
    if not isinstance(formula, And | Or):
        return formula
    formula = map_children(formula, ordered)
    if not isinstance(formula, And):
        return formula
    blocks: list[list[Formula]] = []
    for part in formula.args:
        if blocks and _bounds_alike(blocks[-1][-1], part):
            blocks[-1].append(part)
        else:
            blocks.append([part])
    blocks.sort(key=lambda block: max(map(_place, block)))
    return conj(part for block in blocks for part in sorted(block, key=_place))


def _bounds_alike(first: Formula, second: Formula) -> bool:
    """Whether two neighbours, of which one is about a single variable, are the sides of a range: ``0 <= x <= y``."""
    mixed = (len(first.free) == 1) != (len(second.free) == 1)
    return mixed and isinstance(first, Atom) and isinstance(second, Atom) and len(ranges([first, second])) == 1


def _place(part: Formula) -> tuple[int, str, int, str, bool, Fraction]:
    if not isinstance(part, Atom) or len(part.poly.variables) > 1:
        return 1 + (not isinstance(part, Atom)), "", 0, "", False, Fraction(0)
    (name,) = part.free
    word = name.rstrip("0123456789")
    curved = part.poly.total_degree > 1
    return 0, word, len(name), name, curved, Fraction(0) if curved else roots_of(part.poly)[0].as_fraction()


def intervals(formula: Formula) -> Formula | None:
    """A formula in one variable as intervals; None where it has many, or ends that are not rational, and where it fails
    at single points only."""
    factors = {factor for part in atoms(formula) for factor, _ in part.poly.factors()[1]}
    linear = [factor for factor in factors if factor.total_degree == 1]
    if len(linear) > MOST_ENDS or any(roots_of(factor) for factor in factors.difference(linear)):
        return None
    ends = {roots_of(factor)[0].as_fraction(): factor for factor in linear}
    points = _between(sorted(ends))
    truths = [holds_at(formula, {formula.free[0]: point}) for point in points]
    runs = [list(run) for true, run in groupby(range(len(points)), truths.__getitem__) if true]
    holes = any(truths[k - 1 : k + 2] == [True, False, True] for k in range(1, len(points), 2))
    if holes or len(runs) > MOST_INTERVALS:
        return None
    return disj(_interval(run[0], run[-1], points, ends) for run in runs)


def _between(ends: Sequence[Fraction]) -> list[Fraction]:
    """The ends with a number before each of them, and one behind all: those between cells of a line."""
    if not ends:
        return [Fraction(0)]
    middle = [(a + b) / 2 for a, b in pairwise(ends)]
    return [x for pair in zip([ends[0] - 1, *middle], ends, strict=True) for x in pair] + [ends[-1] + 1]


def _interval(first: int, last: int, points: Sequence[Fraction], ends: dict[Fraction, Poly]) -> Formula:
    """The cells of the line from one to another; those with an odd number are ``ends``."""
    if first == last and first % 2:
        return atom(ends[points[first]], Relation.EQ)
    low, high = (points[first], Relation.GE), (points[last], Relation.LE)
    if not first % 2:
        low = points[first - 1], Relation.GT
    if not last % 2:
        high = points[min(last + 1, len(points) - 1)], Relation.LT
    return conj(atom(ends[end], relation) for end, relation in (low, high) if end in ends)
