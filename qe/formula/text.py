"""The text syntax as a notation; ``qe.io.text`` says what it is, and reads it."""

from __future__ import annotations

from qe.exact.ring import Poly
from qe.formula.notation import Notation, polynomial, positive
from qe.formula.relation import Relation
from qe.spelling import quoted_if_needed


def _quantifier(universal: bool, names: tuple[str, ...]) -> str:
    return f"{'all' if universal else 'ex'} {', '.join(map(quoted_if_needed, names))}. "


def _root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
    return f"{quoted_if_needed(variable)} {relation.value} root({k}, {polynomial(positive(poly), TEXT)})"


TEXT = Notation(
    name=quoted_if_needed,
    relation=lambda relation: relation.value,
    quantifier=_quantifier,
    root=_root,
    conjunction=" and ",
    disjunction=" or ",
    negation="not ",
    true="true",
    false="false",
)
