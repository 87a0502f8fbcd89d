"""Terms in the place of free variables."""

from __future__ import annotations

from collections.abc import Mapping

from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, convert, exists, with_polynomial
from qe.formula.counting import without_root_atoms
from qe.formula.normal import rename_apart
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms, bound_variables, map_atoms
from qe.io import surface as s
from qe.io.lowering import lower, lower_term
from qe.io.sharing import Names
from qe.io.terms import Value


def substitute(formula: Formula, values: Mapping[str, s.Term]) -> Formula:
    """The formula with these terms in the place of free variables, all at once; bound variables are renamed where a
    term has their names. Where a term has no value the result is false."""
    if any(not isinstance(a, Atom) and a.variable in values for a in atoms(formula)):
        formula = without_root_atoms(formula)
    values = {name: term for name, term in values.items() if name in formula.free}
    inside = Names(s.unplaced, lambda name, at: None)
    for term in values.values():
        inside.part(term)
    names = {*inside.all()}
    formula = rename_apart(formula, (*names, *values))
    own = formula.ring
    if own is None or not values:
        return formula
    taken = names.union(own.names)
    stand_ins = [name for k in range(len(taken) + len(values)) if (name := f"u{k + 1}") not in taken]
    meant: list[Formula] = []  # what the stand-ins are equal to, where that is no polynomial
    bound = []
    ring = Ring.of(dict.fromkeys((*own.names, *sorted(names), *stand_ins[: len(values)])))
    formula = convert(formula, ring)
    for old, new in zip(values, stand_ins, strict=False):
        formula = _put(formula, ring.index[old], ring.var(new), ring.constant(1))
    for new, term in zip(stand_ins, values.values(), strict=False):
        polynomial = _polynomial(term)
        if polynomial is None:
            bound.append(new)
            meant.append(lower(s.Comparison([s.Name(new, -1), term], [Relation.EQ], -1), s.unplaced))
        else:
            formula = _put(formula, ring.index[new], polynomial.poly.convert(ring), ring.constant(polynomial.den))
    return trimmed(exists(bound, conj(over_one_ring(*meant, formula))))


def over_one_ring(*parts: Formula) -> tuple[Formula, ...]:
    """The formulas over the ring of all their names."""
    ring = Ring.of(dict.fromkeys(name for part in parts if part.ring is not None for name in part.ring.names))
    return tuple(convert(part, ring) for part in parts)


def trimmed(formula: Formula) -> Formula:
    """The formula over the ring of the names that occur in it."""
    ring = formula.ring
    if ring is None:
        return formula
    used = {name for part in atoms(formula) for name in part.free}.union(bound_variables(formula))
    return convert(formula, Ring.of(name for name in ring.names if name in used))


def _put(formula: Formula, i: int, top: Poly, bottom: Poly) -> Formula:
    """The formula with top/bottom in the place of variable ``i``, for a positive constant ``bottom``."""

    return map_atoms(formula, lambda a: with_polynomial(a, a.poly.at_quotient(i, top, bottom)))


def _polynomial(term: s.Term) -> Value | None:
    try:
        return lower_term(term, s.unplaced, numbers=True)
    except InputError:
        return None
