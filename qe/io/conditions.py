"""A whole text: conditions with commas between them, variables that share one, quantifiers behind them all.

``a, b, c > 0, a + b + c = 1`` says ``a > 0 and b > 0 and …``, and ``x^2 >= a for all x`` says ``all x. x^2 >= a``.
What readers may take in two ways is refused: a comma next to ``or``, ``->`` and quantifiers, ``0 < a, b < 1``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.collecting import Names
from qe.io.text_errors import SyntaxFailure
from qe.spelling import WORD

SHARING = re.compile(rf"{WORD}(?:\s*,\s*{WORD})+(?=\s*(?:[<>=≤≥≠]|!=|/=))")
"""Variables in front of the comparison that they share."""
_LOOSE = s.Some | s.Implication | s.Equivalence
_QUANTIFIED = s.Quantification | s.Quantity
_MORE, _LESS = frozenset((Relation.GT, Relation.GE)), frozenset((Relation.LT, Relation.LE))


def shared(names: Sequence[s.Name], condition: s.Node, before: s.Node | None, at: int) -> s.Node:
    """The condition on its first variable for all of these as well; in ``0 < a, b, c < 1`` all lie between."""
    if not isinstance(condition, s.Comparison):
        raise SyntaxFailure("variables with commas between them stand in front of one comparison: a, b > 0", at)
    sharing: list[s.Term] = [*names]
    conditions: list[s.Node] = []
    if isinstance(before, s.Comparison) and _may_be_between(before, condition):
        conditions += [before._replace(sides=[*before.sides[:-1], name]) for name in (*names, condition.sides[0])]
        sharing.append(before.sides[-1])
    conditions += [condition._replace(sides=[name, *condition.sides[1:]]) for name in sharing]
    return s.Every([*conditions, condition])


def together(parts: Sequence[s.Node], at: int, *, quantified: bool = False) -> s.Node:
    """The conditions as one; ``quantified``: quantifiers follow. What has the variable of ``exists`` in front of it is
    under that: ``exists t: x = t^2, y = t^3``."""
    first, *rest = parts
    if rest and isinstance(first, s.Quantification) and not first.universal and all(_has(p, first.names) for p in rest):
        return first._replace(body=together([first.body, *rest], at))
    bare = [part.part if isinstance(part, s.Negation) else part for part in parts]
    mixed = len(parts) > 1 and any(isinstance(part, _LOOSE) for part in bare)
    scoped = bare if quantified else bare[:-1]
    if (
        mixed
        or any(isinstance(part, _QUANTIFIED) for part in scoped)
        or (quantified and isinstance(bare[0], s.Equivalence))
    ):
        reason = "a comma or a quantifier behind or, ->, <-> and quantifiers is ambiguous"
        raise SyntaxFailure(f"{reason}; write and, brackets, or {{…, …}}", at)
    for left, right in pairwise(parts):
        one, other = _end(left, -1), _end(right, 0)
        if isinstance(one, s.Comparison) and isinstance(other, s.Comparison) and _may_be_between(one, other):
            raise SyntaxFailure("0 < a, b < 1 is ambiguous; write and, as in 0 < a < 1 and 0 < b < 1", at)
    return s.Every(list(parts)) if len(parts) > 1 else parts[0]


def _has(node: s.Node, names: Sequence[str]) -> bool:
    """Whether one of the names occurs free in a formula."""
    free: list[str] = []
    Names(s.unplaced, lambda name, at: free.append(name)).part(node)
    return not {*names}.isdisjoint(free)


def _may_be_between(left: s.Comparison, right: s.Comparison) -> bool:
    """Whether ``0 < a`` and ``b < 1`` may say of both that they lie between the numbers."""
    match left, right:
        case (
            s.Comparison([s.Number() | s.Minus(s.Number()), *_, s.Name(a)], [*_, one]),
            s.Comparison([s.Name(b), *_], [other, *_]),
        ):
            return a != b and ({one, other} <= _MORE or {one, other} <= _LESS)
    return False


def _end(node: s.Node, at: int) -> s.Node:
    while isinstance(node, s.Every):
        node = node.parts[at]
    return node
