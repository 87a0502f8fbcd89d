"""The text syntax as a notation; ``qe.io.text`` says what it is, and reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from qe.exact.ring import Poly
from qe.formula.notation import Notation, polynomial, positive
from qe.formula.relation import Relation
from qe.spelling import CONSTANTS, between_quotes, is_product, quoted_if_needed


def text_notation(free: Iterable[str], bound: Iterable[str] = ()) -> Notation:
    """The notation for a formula with these variables: what is named like constants or products is quoted."""
    names = {*free, *bound}
    doubtful = {name: between_quotes(name) for name in free if name in CONSTANTS or is_product(name, names, {*bound})}
    return _notation(lambda name: doubtful.get(name) or quoted_if_needed(name)) if doubtful else TEXT


def _notation(spelled: Callable[[str], str]) -> Notation:
    def quantifier(universal: bool, names: tuple[str, ...]) -> str:
        return f"{'all' if universal else 'ex'} {', '.join(map(spelled, names))}. "

    def root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
        return f"{spelled(variable)} {relation.value} root({k}, {polynomial(positive(poly), notation)})"

    notation = Notation(name=spelled, quantifier=quantifier, root=root, customary=True)
    return notation


TEXT = _notation(quoted_if_needed)
