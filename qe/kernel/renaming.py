"""Rule "renaming": bound variables get other names, and quantifiers of variables that do not occur go.

THEOREM. The name of a bound variable does not matter as long as it captures nothing; ex x A iff A where x is not free
in A, since R is not empty. Both sides are compared with bound variables by the place where they are bound.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from qe.exact.ring import Poly
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.kernel.negation import normal

Binding = Mapping[str, int]


def shape(formula: Formula) -> object:
    """A value that is the same for formulas that are the same up to bound names, idle quantifiers, and how blocks of
    one kind are joined."""
    return _shape(formula, {}, 0)


def arranged(formula: Formula) -> object:
    """As ``shape``, and the same for formulas whose conjunctions and disjunctions have the same parts in any order."""
    return _shape(formula, {}, 0, lambda parts: tuple(sorted(set(parts), key=repr)))


def is_same(one: Formula, other: Formula) -> bool:
    """Whether formulas are the same up to names of bound variables, order, and where negations stand."""
    return arranged(normal(one)) == arranged(normal(other))


def _shape(
    formula: Formula, bound: Binding, depth: int, join: Callable[[list[object]], tuple[object, ...]] = tuple
) -> object:
    """The formula with numbers for bound variables; those of a block are numbered in its order."""
    match formula:
        case Constant(value):
            return value
        case Atom(poly, relation):
            return _comparison(poly, relation, bound)
        case Not(arg):
            return "not", _shape(arg, bound, depth, join)
        case And(args) | Or(args):
            parts = [part for a in args for part in _parts(a, type(formula))]
            return type(formula).__name__, join([_shape(part, bound, depth, join) for part in parts])
        case Exists(variables, body) | ForAll(variables, body):
            names = [v for v in variables if v in body.free]
            inner = {**bound, **{name: depth + k for k, name in enumerate(names)}}
            found = _shape(body, inner, depth + len(names), join)
            for _ in names:
                found = (type(formula).__name__, found)
            return found
        case RootAtom(variable, relation, poly, k):
            place = bound.get(variable, f"_{variable}")
            return "root", str(place), relation.value, k, _comparison(poly, Relation.EQ, bound)
    raise TypeError(f"not a formula: {formula!r}")


def _parts(formula: Formula, kind: type[Formula]) -> tuple[Formula, ...]:
    """The formula as members of a conjunction (disjunction), where it is one once its idle quantifiers are gone."""
    while isinstance(formula, Exists | ForAll) and not set(formula.variables) & set(formula.body.free):
        formula = formula.body
    return formula.args if isinstance(formula, And | Or) and type(formula) is kind else (formula,)


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
