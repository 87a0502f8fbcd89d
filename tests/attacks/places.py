"""Parts of formulas: where they stand, and others in their place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from qe.formula.build import conj, disj, exists, forall, neg
from qe.formula.syntax import And, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import children
from qe.proof.step import Place


def places(formula: Formula, path: Place = ()) -> Iterator[tuple[Place, Formula]]:
    """All parts of a formula, with the way down to them."""
    yield path, formula
    for k, child in enumerate(children(formula)):
        yield from places(child, (*path, k))


def put(formula: Formula, place: Place, new: Formula) -> Formula:
    """The formula with another part at a place."""
    if not place:
        return new
    match formula:
        case And(args) | Or(args):
            k = place[0]
            join = conj if isinstance(formula, And) else disj
            return join((*args[:k], put(args[k], place[1:], new), *args[k + 1 :]))
        case Not(arg):
            inner = put(arg, place[1:], new)
            return neg(inner) if isinstance(inner, Constant) else Not(inner)
        case Exists(variables, body) | ForAll(variables, body):
            return same(formula)(variables, put(body, place[1:], new))
    raise AssertionError(formula)


def same(f: Exists | ForAll) -> Callable[[Sequence[str], Formula], Formula]:
    """The builder of the quantifier that the formula begins with."""
    return exists if isinstance(f, Exists) else forall
