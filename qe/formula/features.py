"""How large a formula is: counts that need no algebra."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import islice

from qe.exact.ring import Poly
from qe.formula.syntax import Formula, Or
from qe.formula.traverse import atoms, children, has_root_atoms, subformulas

SMALL_DEGREE = {1: 40, 2: 12, 3: 4, 4: 2}
"""An answer in so many variables is small up to this total degree: its whole space is decomposed in no time."""


def is_small(formula: Formula, degrees: Mapping[int, int] = SMALL_DEGREE) -> bool:
    """Whether a shorter equivalent is easily found, if there is one: few variables and low ``degrees``."""
    polys, count = [a.poly for a in atoms(formula)], len(formula.free)
    curved = count == 2 and any(len(p.variables) == 2 and p.total_degree > 1 for p in polys)
    # with a curve in the plane, an atom of a conjunction may follow from the others
    if not (curved and len(polys) > 1) and not any(isinstance(part, Or) for part in subformulas(formula)):
        return False
    return max((p.total_degree for p in polys), default=0) <= degrees.get(count, 0)


def is_short(formula: Formula, terms: int) -> bool:
    """Whether no root atom occurs, and at most so many terms stand in all atoms."""
    return not has_root_atoms(formula) and length(formula)[1] <= terms


def length(formula: Formula) -> tuple[int, int]:
    """Atoms, and terms of their polynomials."""
    polys = [a.poly for a in atoms(formula)]
    return len(polys), sum(p.term_count() for p in polys)


MOST_ATOMS = 300
MOST_TERMS, MOST_DEGREE, MOST_BITS, MOST_WEIGHT = 60, 40, 2000, 300
_LONG_TEXT = 20_000
_POWER = re.compile(r"(?:\^|\*\*)\s*(\d+)")


def may_block(formula: Formula) -> bool:
    """Whether one resultant, factorization or root isolation about the formula may take some tenths of a second.

    ``total degree ^ (number of variables)`` of a polynomial, for at most three of its variables, measures the size of
    its resultants. A guess in both directions: it decides where work is done, never its result.
    """
    listed = list(islice(atoms(formula), MOST_ATOMS + 1))
    return len(listed) > MOST_ATOMS or any(_is_large(a.poly) for a in listed)


def written_out(formula: Formula) -> tuple[int, int]:
    """How many subformulas there are, every occurrence counted, and how many different nodes."""
    sizes: dict[int, int] = {}

    def size(f: Formula) -> int:
        if (known := sizes.get(id(f))) is None:
            known = sizes[id(f)] = 1 + sum(map(size, children(f)))
        return known

    return size(formula), len(sizes)


def _is_large(poly: Poly) -> bool:
    degree, variables, terms = poly.total_degree, len(poly.variables), poly.term_count()
    if terms > MOST_TERMS or degree > MOST_DEGREE:
        return True
    return degree ** min(variables, 3) > MOST_WEIGHT or poly.height_bits() > MOST_BITS


def text_may_block(text: str, most: int = MOST_DEGREE) -> bool:
    """Whether reading may take long: a long text, or powers above ``most`` that may have to be multiplied out."""
    if len(text) > _LONG_TEXT:
        return True
    return any(len(k) > 2 or int(k) > most for k in _POWER.findall(text))
