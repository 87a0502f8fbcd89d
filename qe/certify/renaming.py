"""Rule "renaming": bound variables get other names, and quantifiers of variables that do not occur go.

THEOREM. The name of a bound variable does not matter as long as it captures nothing; ex x A iff A where x is not free
in A, since R is not empty. Both sides are compared with bound variables by the place where they are bound.
"""

from __future__ import annotations

from collections.abc import Mapping

from qe.certify.step import Claim, Context, Limits, only
from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation

Binding = Mapping[str, int]


def check_renaming(claim: Claim, context: Context, limits: Limits) -> None:
    """Both sides are the same but for the names of their bound variables."""
    only(claim)
    if not same_up_to_names(claim.before, claim.after):
        raise claim.fail("the two sides differ in more than the names of bound variables")


def same_up_to_names(left: Formula, right: Formula) -> bool:
    """Whether two formulas are the same up to bound names, idle quantifiers, and how blocks of one kind are joined."""
    return _shape(left, {}, 0) == _shape(right, {}, 0)


def _shape(formula: Formula, bound: Binding, depth: int) -> object:
    """The formula with numbers for bound variables; those of a block are numbered in its order."""
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return _comparison(poly, relation, bound)
        case Not(arg):
            return "not", _shape(arg, bound, depth)
        case And(args) | Or(args):
            return type(formula).__name__, tuple(_shape(a, bound, depth) for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            names = [v for v in variables if v in body.free]
            inner = {**bound, **{name: depth + k for k, name in enumerate(names)}}
            shape = _shape(body, inner, depth + len(names))
            for _ in names:
                shape = (type(formula).__name__, shape)
            return shape
    return None, formula, tuple(sorted(bound.items()))  # root atoms: the same only under the same names


def _comparison(poly: Poly, relation: Relation, bound: Binding) -> object:
    """The terms with numbers for bound and names for free variables; the sign by which an atom is normal depends on the
    order of the variables, so here the first term in an order of its own is positive."""
    names = poly.ring.names
    terms = sorted(
        (sorted((str(bound.get(names[i], f"_{names[i]}")), e) for i, e in enumerate(exponents) if e), coefficient)
        for exponents, coefficient in poly.terms()
    )
    if terms[0][1] < 0:
        terms, relation = [(powers, -c) for powers, c in terms], relation.flipped
    return str(terms), relation.value
