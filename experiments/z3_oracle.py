"""Formulas as z3 terms, and z3 as an oracle: an independent solver, trusted only together with others."""

from __future__ import annotations

from typing import Any

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation


def to_z3(formula: Formula) -> Any:
    """The z3 term with the same meaning, with real constants of the same names for the free variables."""
    import z3

    return _term(z3, formula)


def _term(z3: Any, formula: Formula) -> Any:
    match formula:
        case Constant(value):
            return z3.BoolVal(value)
        case Atom(poly, relation):
            return _compare(_polynomial(z3, poly), relation)
        case And(args):
            return z3.And([_term(z3, a) for a in args])
        case Or(args):
            return z3.Or([_term(z3, a) for a in args])
        case Not(arg):
            return z3.Not(_term(z3, arg))
        case Exists(names, body):
            return z3.Exists([z3.Real(n) for n in names], _term(z3, body))
        case ForAll(names, body):
            return z3.ForAll([z3.Real(n) for n in names], _term(z3, body))
    raise TypeError(f"no z3 form of {type(formula).__name__}")


def _polynomial(z3: Any, poly: Poly) -> Any:
    total = z3.RealVal(0)
    for exponents, coefficient in poly.terms():
        term = z3.RealVal(int(coefficient))
        for name, k in zip(poly.ring.names, exponents, strict=True):
            for _ in range(k):
                term = term * z3.Real(name)
        total = total + term
    return total


def _compare(term: Any, relation: Relation) -> Any:
    match relation:
        case Relation.EQ:
            return term == 0
        case Relation.NE:
            return term != 0
        case Relation.LT:
            return term < 0
        case Relation.LE:
            return term <= 0
        case Relation.GT:
            return term > 0
        case Relation.GE:
            return term >= 0


def decide(formula: Formula, *, seconds: float = 2.0) -> bool | None:
    """z3's verdict on a sentence, None when it has none within (about) the limit.

    z3 5.4 eliminates quantifiers over nonlinear reals with its nlqsat procedure.
    """
    import z3

    for name, share in (("nlqsat", 0.3), ("smt", 1.0)):
        solver = z3.Tactic(name).solver()
        solver.set("timeout", int(1000 * share * seconds))
        try:
            solver.add(to_z3(formula))
            verdict = solver.check()
        except z3.Z3Exception:
            continue
        if verdict != z3.unknown:
            return bool(verdict == z3.sat)
    return None
