"""Smart constructors: the only way formulas are built, so that the invariants of ``syntax`` hold."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import assert_never

from qe.exact.descartes import most_real_roots
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import (
    FALSE,
    TRUE,
    And,
    Atom,
    Atomic,
    Constant,
    Exists,
    ForAll,
    Formula,
    Not,
    Or,
    Relation,
    RootAtom,
)


def atom(poly: Poly, relation: Relation) -> Formula:
    """``poly relation 0`` with the polynomial normalised; TRUE or FALSE for a constant polynomial."""
    if poly.is_constant:
        value = poly.constant_value()
        return TRUE if relation.holds((value > 0) - (value < 0)) else FALSE
    unit, primitive = poly.normal()
    return Atom(primitive, relation if unit > 0 else relation.flipped)


def conj(args: Iterable[Formula]) -> Formula:
    """Conjunction, flattened, without duplicates; FALSE absorbs; of nothing: TRUE."""
    return _joined(args, And, TRUE, FALSE)


def disj(args: Iterable[Formula]) -> Formula:
    """Disjunction, flattened, without duplicates; TRUE absorbs; of nothing: FALSE."""
    return _joined(args, Or, FALSE, TRUE)


def _joined(args: Iterable[Formula], kind: type[And] | type[Or], nothing: Constant, all_of_it: Constant) -> Formula:
    seen: dict[Formula, None] = {}
    whole: And | Or | None = None
    for arg in args:
        if isinstance(arg, Constant):
            if arg.value is all_of_it.value:
                return all_of_it
        elif isinstance(arg, kind):
            whole = whole or arg
            seen.update(dict.fromkeys(arg.args))
        else:
            seen[arg] = None
    if len(seen) <= 1:
        return next(iter(seen), nothing)
    joined = tuple(seen)
    return whole if whole is not None and whole.args == joined else kind(joined)  # a node knows more than a new one


def neg(arg: Formula) -> Formula:
    """Negation: constants, atoms and double negations are resolved at once."""
    match arg:
        case Constant(value):
            return FALSE if value else TRUE
        case Atom(poly, relation):
            return Atom(poly, relation.negated)
        case Not(inner):
            return inner
    return Not(arg)


def implies(left: Formula, right: Formula) -> Formula:
    """left -> right, as (not left) or right."""
    return disj((neg(left), right))


def iff(left: Formula, right: Formula) -> Formula:
    """left <-> right, as two implications."""
    return conj((implies(left, right), implies(right, left)))


def exists(variables: Iterable[str], body: Formula) -> Formula:
    """Existential closure over ``variables``; adjacent blocks are joined."""
    return _closed(variables, body, Exists)


def forall(variables: Iterable[str], body: Formula) -> Formula:
    """Universal closure over ``variables``; adjacent blocks are joined."""
    return _closed(variables, body, ForAll)


def _closed(variables: Iterable[str], body: Formula, kind: type[Exists] | type[ForAll]) -> Formula:
    names = tuple(dict.fromkeys(variables))
    if not names or isinstance(body, Constant):
        return body
    if isinstance(body, kind):
        return kind(tuple(v for v in names if v not in body.variables) + body.variables, body.body)
    return kind(names, body)


def root_atom(variable: str, relation: Relation, poly: Poly, k: int) -> Formula:
    """``variable relation root_k(poly)``, with the polynomial normalised; FALSE where it cannot have |k| real roots."""
    if abs(k) > most_real_roots(poly, poly.ring.index[variable]):
        return FALSE
    return RootAtom(variable, relation, poly.normal()[1], k)


def map_children(formula: Formula, change: Callable[[Formula], Formula]) -> Formula:
    """The formula with every direct subformula changed; what has none stays the node."""
    match formula:
        case And(args) | Or(args):
            return (conj if isinstance(formula, And) else disj)(map(change, args))
        case Not(arg):
            return neg(change(arg))
        case Exists(variables, body) | ForAll(variables, body):
            return (exists if isinstance(formula, Exists) else forall)(variables, change(body))
        case Constant() | Atom() | RootAtom():
            return formula
        case _:
            assert_never(formula)


def with_polynomial(atomic: Atomic, poly: Poly) -> Formula:
    """The atom with another polynomial, normalised."""
    if isinstance(atomic, Atom):
        return atom(poly, atomic.relation)
    return root_atom(atomic.variable, atomic.relation, poly, atomic.k)


def convert(formula: Formula, ring: Ring) -> Formula:
    """The same formula with its polynomials in another ring (by variable name); equal parts are converted once."""
    known: dict[Formula, Formula] = {}

    def converted(f: Formula) -> Formula:
        if f.ring is ring:
            return f
        if f not in known:
            if isinstance(f, Atomic):
                known[f] = with_polynomial(f, f.poly.convert(ring))
            else:
                known[f] = map_children(f, converted)
        return known[f]

    return converted(formula)


JOINS: dict[str, Callable[..., Formula]] = {
    "and": lambda *parts: conj(parts),
    "or": lambda *parts: disj(parts),
    "implies": implies,
    "not": neg,
    "xor": lambda left, right: neg(iff(left, right)),
}
"""What joins formulas, by its name."""
