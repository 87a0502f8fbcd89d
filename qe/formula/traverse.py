"""The traversals of a formula that everything else is written with."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count
from typing import TypeVar, assert_never

from qe.exact.ring import Poly
from qe.formula.build import map_children
from qe.formula.syntax import And, Atom, Atomic, Constant, Exists, ForAll, Formula, Not, Or, Quantified, RootAtom

Name = TypeVar("Name")


def children(formula: Formula) -> tuple[Formula, ...]:
    """The direct subformulas."""
    match formula:
        case And(args) | Or(args):
            return args
        case Not(arg):
            return (arg,)
        case Exists(_, body) | ForAll(_, body):
            return (body,)
        case Constant() | Atom() | RootAtom():
            return ()
        case _:
            assert_never(formula)


def conjuncts(formula: Formula) -> tuple[Formula, ...]:
    """The members of a conjunction; any other formula is its own only member."""
    return formula.args if isinstance(formula, And) else (formula,)


def disjuncts(formula: Formula) -> tuple[Formula, ...]:
    """The members of a disjunction; any other formula is its own only member."""
    return formula.args if isinstance(formula, Or) else (formula,)


def subformulas(formula: Formula) -> Iterator[Formula]:
    """The formula and everything inside it, from the outside in, left to right."""
    yield formula
    for child in children(formula):
        yield from subformulas(child)


def subformula(formula: Formula, place: Sequence[int]) -> Formula:
    """What stands at a place: argument numbers on the way down from the root."""
    for k in place:
        formula = children(formula)[k]
    return formula


def with_child(formula: Formula, k: int, child: Formula) -> Formula:
    """The formula with another direct subformula in the place of one."""
    place = count()
    return map_children(formula, lambda part: child if next(place) == k else part)


def bound_variables(formula: Formula) -> tuple[str, ...]:
    """The names that quantifiers bind, in the order of the quantifiers, without repetition."""
    blocks = (f.variables for f in subformulas(formula) if isinstance(f, Exists | ForAll))
    return tuple(dict.fromkeys(name for block in blocks for name in block))


def rebound(formula: Formula) -> frozenset[str]:
    """The names that a quantifier binds below another one that binds them."""
    if not formula.bound:
        return formula.bound
    inner = frozenset[str]().union(*map(rebound, children(formula)))
    return inner | formula.body.bound.intersection(formula.variables) if isinstance(formula, Quantified) else inner


def clashes(formula: Formula, visible: Iterable[str] = ()) -> frozenset[str]:
    """The names that a quantifier of the formula binds although they are seen there: bound above it, free in the
    formula, or ``visible`` around it.

    Without clashes, what a place sees (the names free or visible there, and those bound above it) keeps its meaning
    everywhere below the place, so that no quantifier captures what is taken from there inwards. Quantifiers beside
    each other may bind one name: neither stands below the other.
    """
    bound = formula.bound
    return rebound(formula) | bound.intersection((*formula.free, *visible)) if bound else bound


def atoms(formula: Formula) -> Iterator[Atomic]:
    """Every atom occurrence, left to right."""
    if isinstance(formula, Atomic):
        yield formula
    else:
        for child in children(formula):
            yield from atoms(child)


def has_root_atoms(formula: Formula) -> bool:
    """Whether a root atom occurs."""
    return not all(isinstance(a, Atom) for a in atoms(formula))


def map_atoms(formula: Formula, change: Callable[[Atomic], Formula]) -> Formula:
    """Replace every atom by a formula and rebuild with the smart constructors; what does not change stays the node."""
    if isinstance(formula, Atomic):
        rebuilt = change(formula)
    else:
        rebuilt = map_children(formula, lambda part: map_atoms(part, change))
    return formula if rebuilt == formula else rebuilt


def polynomials(formula: Formula) -> list[Poly]:
    """The distinct polynomials of the atoms, in order of first occurrence."""
    return list(dict.fromkeys(a.poly for a in atoms(formula)))


def connected(
    parts: Iterable[Formula], names: Callable[[Formula], frozenset[Name]]
) -> tuple[tuple[Formula, ...], list[tuple[frozenset[Name], tuple[Formula, ...]]]]:
    """(parts without a name, groups): two parts are in one group if a chain of shared names connects them.

    Each group comes with its names; groups in the order in which they were completed, their parts in order.
    """
    without: list[Formula] = []
    groups: list[tuple[frozenset[Name], tuple[Formula, ...]]] = []
    for part in parts:
        shared, members = names(part), (part,)
        if not shared:
            without.append(part)
            continue
        touching = [g for g in groups if g[0] & shared]
        groups = [g for g in groups if g not in touching]
        groups.append((shared.union(*(g[0] for g in touching)), sum((g[1] for g in touching), ()) + members))
    return tuple(without), groups
