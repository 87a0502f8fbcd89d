"""Truth of formulas: exactly at a rational point, and three-valued from a sign oracle."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import assert_never

from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.syntax import And, Atom, Atomic, Constant, Exists, ForAll, Formula, Not, Or, RootAtom
from qe.formula.traverse import map_atoms
from qe.truth import Truth, conjunction, disjunction, negation

SignOracle = Callable[[Poly], int | None]
RootOracle = Callable[[RootAtom], Truth]


def holds_at(formula: Formula, point: Mapping[str, Fraction | int]) -> bool:
    """Whether a quantifier-free formula holds at a rational point, decided in exact arithmetic.

    ``point`` gives a value for every variable that occurs; more are allowed. Raises ``InputError`` for a
    missing variable and for a quantified formula.
    """
    ring = formula.ring
    missing = [name for name in formula.free if name not in point]
    if missing:
        raise InputError(f"no value for {', '.join(missing)}")
    values = tuple([Fraction(point.get(name, 0)) for name in ring.names] if ring is not None else ())

    truth = truth_under(formula, lambda poly: poly.sign_at(values), lambda atom: _root_holds(atom, values))
    if truth is None:
        raise InputError("only a quantifier-free formula has a truth value at a point")
    return truth


def substituted(formula: Formula, values: Mapping[str, Fraction | int]) -> Formula:
    """A quantifier-free formula without root atoms, with rational numbers for variables; its ring stays the same."""

    def put(atomic: Atomic) -> Formula:
        poly = atomic.poly
        if isinstance(atomic, RootAtom):
            raise InputError("numbers are not put into root atoms")
        for i in poly.variables:
            name = poly.ring.names[i]
            if name in values:
                poly = poly.at_rational(i, Fraction(values[name]))
        return atom(poly, atomic.relation)

    return map_atoms(formula, put)


def at_quotients(formula: Formula, quotients: Mapping[str, tuple[Poly, int]]) -> Formula:
    """The formula with p/n, n > 0, for variables, one after the other; root atoms stay as they are."""

    def put(atomic: Atomic) -> Formula:
        if isinstance(atomic, RootAtom):
            return atomic
        poly = atomic.poly
        for name, (top, bottom) in quotients.items():
            poly = poly.at_quotient(poly.ring.index[name], top, poly.ring.constant(bottom))
        return atom(poly, atomic.relation)

    return map_atoms(formula, put) if quotients else formula


def truth_under(formula: Formula, sign: SignOracle, root: RootOracle | None = None) -> Truth:
    """The truth value that follows from the known signs (Kleene's strong logic), None if it does not follow.

    ``sign(poly)`` is -1, 0, 1, or None where it is not known; ``root(atom)`` is the truth of a root atom.
    Quantified parts are unknown. A result other than None is the truth value under every completion.
    """
    match formula:
        case Atom(poly, relation):
            known = sign(poly)
            return None if known is None else relation.holds(known)
        case RootAtom():
            return None if root is None else root(formula)
        case And(args):
            return conjunction(truth_under(arg, sign, root) for arg in args)
        case Or(args):
            return disjunction(truth_under(arg, sign, root) for arg in args)
        case Not(arg):
            return negation(truth_under(arg, sign, root))
        case Constant(value):
            return value
        case Exists() | ForAll():
            return None
        case _:
            assert_never(formula)


def _root_holds(atom: RootAtom, values: Sequence[Fraction]) -> bool:
    """``x relation root_k(poly)`` at a rational point: false where there is no k-th root, or poly vanishes in x."""
    ring = atom.poly.ring
    main = ring.index[atom.variable]
    poly = atom.poly
    for i in poly.variables:
        if i != main:
            poly = poly.at_rational(i, values[i])
    if not poly.degree(main):
        return False
    roots = real_roots(poly.to_univariate(main))
    if abs(atom.k) > len(roots):
        return False
    root = roots[atom.k - 1] if atom.k > 0 else roots[atom.k]
    value = RealAlgebraic.rational(values[main])
    return atom.relation.holds((value > root) - (value < root))
