"""Where a claim is false: points at which its two sides differ, by solvers that share nothing with the engine.

Numbers are put in for the free variables, and what is left, a sentence, is decided by the textbook procedure
(``experiments.reference``) where it is small, and by z3 elsewhere. Nothing is counted as false that neither decides.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction

from experiments import reference, z3_oracle
from qe.errors import Unable
from qe.formula.build import atom, conj, disj, exists, forall, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, RootAtom
from qe.formula.traverse import polynomials, subformulas
from qe.options import Budget

Point = Mapping[str, Fraction]

NUMBERS = tuple(map(Fraction, ("0", "0", "1", "-1", "2", "-2", "3", "-3", "1/2", "-5/4", "7")))
SECONDS = 0.1
"""For one sentence."""


def at(formula: Formula, point: Point) -> Formula | None:
    """The formula at a point; a name that a quantifier binds is another variable below it. None for root atoms below
    quantifiers, of which the reference knows nothing."""
    match formula:
        case Atom(poly, relation):
            for i in poly.variables:
                if poly.ring.names[i] in point:
                    poly = poly.at_rational(i, point[poly.ring.names[i]])
            return atom(poly, relation)
        case RootAtom():
            known = set(formula.free) <= set(point)
            return Constant(holds_at(formula, {n: point[n] for n in formula.free})) if known else None
        case And(args) | Or(args):
            parts = [p for a in args if (p := at(a, point)) is not None]
            return (conj if isinstance(formula, And) else disj)(parts) if len(parts) == len(args) else None
        case Not(arg):
            inner = at(arg, point)
            return None if inner is None else neg(inner)
        case Exists(variables, body) | ForAll(variables, body):
            inner = at(body, {n: v for n, v in point.items() if n not in variables})
            return None if inner is None else (exists if isinstance(formula, Exists) else forall)(variables, inner)
    return formula


def truth(formula: Formula, point: Point) -> bool | None:
    """The truth of a formula at a point for all its free variables; None where nobody decides it in time."""
    sentence = at(formula, point)
    if sentence is None or isinstance(sentence, Constant):
        return None if sentence is None else sentence.value
    bound = [n for f in subformulas(sentence) if isinstance(f, Exists | ForAll) for n in f.variables]
    if len(bound) > 1 and is_flat(sentence):
        return _existence(sentence)
    try:
        return reference.decide(sentence, budget=Budget(SECONDS))
    except (Unable, RecursionError):
        return z3_oracle.decide(sentence, seconds=SECONDS)


def is_flat(sentence: Formula) -> bool:
    """Whether it is one block over a formula without quantifiers."""
    return isinstance(sentence, Exists | ForAll) and sentence.body.is_quantifier_free


def _existence(sentence: Formula) -> bool | None:
    """Whether there is a solution, or none of the negation, by z3's search for one."""
    import z3

    assert isinstance(sentence, Exists | ForAll)
    solver = z3.Solver()
    solver.set("timeout", int(2000 * SECONDS))
    body = z3_oracle.to_z3(sentence.body)
    verdict = solver.check(body if isinstance(sentence, Exists) else z3.Not(body))
    return None if verdict == z3.unknown else (verdict == z3.sat) is isinstance(sentence, Exists)


def points(rng: random.Random, formulas: Sequence[Formula], names: Sequence[str], count: int) -> list[Point]:
    """Small numbers; at half of the points a polynomial of the formulas is zero, if one is linear in some name."""
    linear = [
        (p, n)
        for f in formulas
        for p in polynomials(f)
        for n in names
        if p.degree(p.ring.index[n]) == 1 and {p.ring.names[i] for i in p.variables} <= set(names)
    ]
    found: list[Point] = []
    for _ in range(count if names else 1):
        point = {name: rng.choice(NUMBERS) for name in names}
        if linear and rng.random() < 0.5:
            poly, name = rng.choice(linear)
            values = [point.get(n, Fraction(0)) for n in poly.ring.names]
            rest, slope = (Fraction(c.evaluate(values)) for c in poly.coefficients(poly.ring.index[name]))
            point[name] = -rest / slope if slope else point[name]
        found.append(point)
    return found


def counterexample(
    rng: random.Random, before: Formula, after: Formula, facts: Sequence[Formula], count: int = 8
) -> tuple[Point, bool] | None:
    """A point where the facts hold and the two sides differ, with the truth of ``before`` there."""
    formulas = (after, before, *facts)
    names = sorted({n for f in formulas for n in f.free})
    undecided = 0
    for point in points(rng, formulas, names, count):
        if undecided < 2 and all(truth(f, point) is True for f in facts):
            right = truth(after, point)
            left = None if right is None else truth(before, point)
            undecided += left is None
            if left is not None and left is not right:
                return point, left
    return None
