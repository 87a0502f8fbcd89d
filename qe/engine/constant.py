"""Is a quantifier-free formula true, or false, everywhere? Most are neither, and a few points show that."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from fractions import Fraction

from qe.formula.build import exists
from qe.formula.evaluate import holds_at
from qe.formula.features import features
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import atoms

PATTERNS = ((0,), (1,), (-1,), (1, -2, 3, -5), (-3, 2, -1, 4), (Fraction(1, 7), 2), (9, Fraction(-1, 3)), (1, 8, 64))
"""Coordinates of the points that are tried, repeated as far as needed: signs and sizes in several combinations."""

COORDINATES = tuple(
    Fraction(k, n) for k, n in ((0, 1), (1, 10), (1, 3), (1, 2), (1, 1), (2, 1), (-1, 2), (-1, 1), (-3, 1))
)
SCATTERED = 60
"""How many points with these coordinates are tried before a question that is not cheap."""

DEGREES = {1: 40, 2: 8, 3: 3, 4: 2}
"""With so many variables a formula of at most this total degree is decided; with more, linear ones are."""

MANY = 20
"""The closure of a question in more variables is not asked for: a chain of 300 differences took minutes."""

ATOMS, LONG = 40, 1000
"""A formula of more atoms is not decided; one of more than ``LONG`` is not even evaluated."""


def constant_value(
    formula: Formula, is_satisfiable: Callable[[Formula], bool], question: Formula | None = None
) -> Formula | None:
    """TRUE or FALSE if the quantifier-free formula is equivalent to that and deciding it is cheap, else None.

    ``is_satisfiable`` decides a sentence; it is asked only where no point settles it. Where the formula seems to
    hold nowhere and is larger than the ``question`` that it answers, it is asked about that: with all variables
    quantified the question leaves a freedom of order that the answer has lost (the existential closure).
    """
    names = formula.free
    if not names:
        return None
    cheap = _is_cheap(formula, len(names))
    if not cheap and (question is None or not _closes(question) or sum(1 for _ in atoms(formula)) > LONG):
        return None
    always = _at(formula, names, PATTERNS[0])
    if not cheap and always:
        return None
    if any(_at(formula, names, pattern) is not always for pattern in PATTERNS[1:]):
        return None
    if holds_at(formula, _middle(formula, names)) is not always:
        return None
    if not cheap and any(_at(formula, names, pattern) for pattern in _scattered(len(names))):
        return None
    exception = nnf(formula, negate=always)
    if question is not None and not always and (not cheap or _size(question) < _size(formula)):
        exception = question
    if is_satisfiable(exists(exception.free, exception)):
        return None
    return TRUE if always else FALSE


def _at(formula: Formula, names: tuple[str, ...], pattern: tuple[int | Fraction, ...]) -> bool:
    return holds_at(formula, {name: pattern[i % len(pattern)] for i, name in enumerate(names)})


def _scattered(size: int) -> Iterator[tuple[Fraction, ...]]:
    """More points, the same ones each time, for a question that takes longer than looking at them."""
    chosen = random.Random(size)
    for _ in range(SCATTERED):
        yield tuple(chosen.choice(COORDINATES) for _ in range(size))


def _middle(formula: Formula, names: tuple[str, ...]) -> dict[str, Fraction]:
    """The middle of the box around the vertices of the parabolas on the axes: for balls, of their centres.

    Balls that meet mostly meet there, where the small coordinates above seldom are.
    """
    vertices: dict[str, list[Fraction]] = {name: [] for name in names}
    for atom in atoms(formula):
        ring = atom.poly.ring
        slopes: dict[int, dict[int, int]] = {}
        for exponents, coefficient in atom.poly.terms():
            if sum(exponents) in (1, 2) and max(exponents) == sum(exponents):
                slopes.setdefault(exponents.index(sum(exponents)), {})[sum(exponents)] = int(coefficient)
        for index, slope in slopes.items():
            if 2 in slope:
                vertices[ring.names[index]].append(Fraction(-slope.get(1, 0), 2 * slope[2]))
    return {name: (min(v) + max(v)) / 2 if v else Fraction(0) for name, v in vertices.items()}


def _closes(question: Formula) -> bool:
    """Whether quantifying all its variables may make a question easier: it has quantifiers, and few variables."""
    if question.is_quantifier_free:
        return False
    return len(question.free) + len(features(question).bound) <= MANY


def _size(formula: Formula) -> int:
    return sum(a.poly.term_count() for a in atoms(formula))


def _is_cheap(formula: Formula, size: int) -> bool:
    listed = list(atoms(formula))
    return len(listed) <= ATOMS and max(a.poly.total_degree for a in listed) <= DEGREES.get(size, 1)
