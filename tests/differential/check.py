"""Comparing what the engine made of a formula with the oracles, at rational points."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from experiments import reference, z3_oracle
from qe.errors import BudgetExceeded
from qe.formula.build import conj, disj
from qe.formula.syntax import And, Constant, Exists, ForAll, Formula, Not, Or
from qe.formula.traverse import children
from qe.options import Budget
from tests.differential.generate import at_point, random_point


def oracle(sentence: Formula, *, seconds: float = 1.0) -> bool | None:
    """The truth of a sentence by the reference elimination, or else by z3 where it is installed, or None."""
    if isinstance(sentence, Constant):
        return sentence.value
    try:
        return reference.decide(sentence, budget=Budget(seconds))
    except BudgetExceeded:
        pass
    try:
        return z3_oracle.decide(sentence, seconds=seconds)
    except ImportError:
        return None


@dataclass(frozen=True, slots=True)
class Comparison:
    """At how many points the oracles decided both formulas, and a point where they differ (None: none was found)."""

    decided: int
    difference: dict[str, Fraction] | None


def compare(
    before: Formula, after: Formula, rng: random.Random, *, points: int = 4, seconds: float = 1.0
) -> Comparison:
    """The two formulas at random points. New free names are refused."""
    assert set(after.free) <= set(before.free), "the answer has new free variables"
    decided = 0
    for _ in range(points if before.free else 1):
        point = random_point(rng, before)
        left = oracle(at_point(before, point), seconds=seconds)
        right = oracle(at_point(after, point), seconds=seconds)
        if left is not None and right is not None:
            decided += 1
            if left != right:
                return Comparison(decided, point)
    return Comparison(decided, None)


def smaller(formula: Formula) -> list[Formula]:
    """Formulas one step smaller: an argument dropped or taken alone, a quantified body with a part dropped."""
    match formula:
        case And(args) | Or(args):
            join = conj if isinstance(formula, And) else disj
            dropped = [join(args[:i] + args[i + 1 :]) for i in range(len(args))]
            deeper = [join((*args[:i], s, *args[i + 1 :])) for i, a in enumerate(args) for s in smaller(a)]
            return [*args, *dropped, *deeper]
        case Not(arg):
            return [arg, *(Not(s) for s in smaller(arg))]
        case Exists(names, body) | ForAll(names, body):
            return [type(formula)(names, s) for s in smaller(body)]
    return list(children(formula))


def reduced(formula: Formula, fails: Callable[[Formula], bool]) -> Formula:
    """A formula that still fails and none of whose one step smaller ones does."""
    while True:
        following = next((s for s in smaller(formula) if not isinstance(s, Constant) and fails(s)), None)
        if following is None:
            return formula
        formula = following
