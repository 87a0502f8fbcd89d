"""Blocks first: which parts of a block's body are eliminated before the others, for the equations that they give.

A statement such as "two circles are the same curve" has quantifiers of its own, few variables, and says equations; what
stands beside it is then about other numbers. Whatever is chosen here, a conjunction stays equivalent when some of its
parts are replaced by what they are equivalent to.
"""

from __future__ import annotations

from collections.abc import Iterator

from qe.formula.block import Block
from qe.formula.build import conj
from qe.formula.syntax import And, Atom, Exists, ForAll, Formula, Relation
from qe.formula.traverse import atoms, conjuncts

BOUND, FREE, ATOMS = 2, 3, 8
"""An early part has at most so many bound and free variables and comparisons."""


def early_parts(body: Formula) -> tuple[Formula, Formula] | None:
    """(the parts to be eliminated first, the rest) of a conjunction; None where there are none, or nothing quantified
    besides.

    The parts share their free variables; of several such groups the one with the fewest variables, then most parts.
    """
    parts = conjuncts(body)
    groups: dict[frozenset[str], list[Formula]] = {}
    for part in parts:
        if _is_small_block(part):
            groups.setdefault(frozenset(part.free), []).append(part)
    several = [(names, group) for names, group in groups.items() if len(group) > 1]
    if not several:
        return None
    _, chosen = min(several, key=lambda group_of: (len(group_of[0]), -len(group_of[1])))
    rest = [part for part in parts if part not in chosen]
    if all(part.is_quantifier_free for part in rest):
        return None
    return conj(chosen), conj(rest)


def _is_small_block(part: Formula) -> bool:
    if not isinstance(part, Exists | ForAll) or not part.body.is_quantifier_free:
        return False
    return len(part.variables) <= BOUND and 0 < len(part.free) <= FREE and sum(1 for _ in atoms(part.body)) <= ATOMS


def equations(formula: Formula, variables: tuple[str, ...]) -> Iterator[Atom]:
    """The equations among the conjuncts that bind one of the variables."""
    for part in conjuncts(formula):
        if isinstance(part, Atom) and part.relation is Relation.EQ and not set(variables).isdisjoint(part.free):
            yield part


def gathered_block(formula: Formula) -> Block | None:
    """The existential block of a conjunction together with the conditions that preparation moved out of it."""
    args = formula.args if isinstance(formula, And) else (formula,)
    blocks = [a for a in args if isinstance(a, Exists)]
    if len(blocks) != 1:
        return None
    rest = [a for a in args if a is not blocks[0]]
    body = conj((*rest, blocks[0].body))
    return Block(blocks[0].variables, body) if body.is_quantifier_free else None
