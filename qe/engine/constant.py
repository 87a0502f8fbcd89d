"""Is a quantifier-free formula true, or false, everywhere? Most are neither, and a few points show that."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from qe.formula.build import exists
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import atoms

PATTERNS = ((0,), (1,), (-1,), (1, -2, 3, -5), (-3, 2, -1, 4), (Fraction(1, 7), 2), (9, Fraction(-1, 3)), (1, 8, 64))
"""Coordinates of the points that are tried, repeated as far as needed: signs and sizes in several combinations."""

DEGREES = {1: 40, 2: 8, 3: 3, 4: 2}
"""With so many variables a formula of at most this total degree is decided; with more, linear ones are."""

ATOMS = 40
"""A formula of more atoms is not decided."""


def constant_value(formula: Formula, is_satisfiable: Callable[[Formula], bool]) -> Formula | None:
    """TRUE or FALSE if the quantifier-free formula is equivalent to that and deciding it is cheap, else None.

    ``is_satisfiable`` decides an existential sentence; it is asked only where no point settles the matter.
    """
    names = formula.free
    if not names or not _is_cheap(formula, len(names)):
        return None
    always = _at(formula, names, PATTERNS[0])
    if any(_at(formula, names, pattern) is not always for pattern in PATTERNS[1:]):
        return None
    if holds_at(formula, _middle(formula, names)) is not always:
        return None
    exception = nnf(formula, negate=always)
    if is_satisfiable(exists(names, exception)):
        return None
    return TRUE if always else FALSE


def _at(formula: Formula, names: tuple[str, ...], pattern: tuple[int | Fraction, ...]) -> bool:
    return holds_at(formula, {name: pattern[i % len(pattern)] for i, name in enumerate(names)})


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


def _is_cheap(formula: Formula, size: int) -> bool:
    listed = list(atoms(formula))
    return len(listed) <= ATOMS and max(a.poly.total_degree for a in listed) <= DEGREES.get(size, 1)
