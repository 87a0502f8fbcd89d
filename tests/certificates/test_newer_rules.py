"""Steps of the rules about gathering, rotations, cases and values, made for random formulas: all are accepted."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.api.input import read_formula
from qe.elimination.protocol import Context
from qe.engine.untangle import untangled
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall
from qe.formula.syntax import Formula, Relation
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_broken_producers import accepted
from tests.certificates.test_false_steps import formula, polynomial, simple

RING = Ring.of(("a", "b", "x", "y", "z", "u", "v", "w"))
VECTORS = (("x", "y", "z"), ("u", "v", "w"))


def nested(rng: random.Random) -> Formula:
    """Blocks inside blocks, of either kind, under conjunctions and disjunctions."""

    def part(names: list[str], free: list[str]) -> Formula:
        ring = Ring.of(("a", *free, *names[:1]))
        own = formula(rng, ring, 1)
        if not names:
            return own
        inner = part(names[1:], [*free, names[0]])
        join = conj if rng.random() < 0.6 else disj
        body = join(convert(f, RING) for f in (own, inner, formula(rng, ring, 0)))
        return (exists if rng.random() < 0.6 else forall)(names[:1], body)

    return part(rng.sample(["x", "y", "z"], 3), [])


def turnable(rng: random.Random) -> Formula:
    """Lengths, angles and determinants of vectors, some of them coordinates side by side in equations."""
    dimension = rng.choice((2, 2, 3))
    first, second = ([RING.var(name) for name in names[:dimension]] for names in VECTORS)

    def dot(left: list[Poly], right: list[Poly]) -> Poly:
        return sum((p * q for p, q in zip(left, right, strict=True)), RING.constant(0))

    sizes = [dot(first, first), dot(second, second), dot(first, second)]
    if dimension == 2:
        sizes.append(first[0] * second[1] - first[1] * second[0])
    parts: list[Formula] = []
    for _ in range(rng.randint(1, 3)):
        p = rng.choice(sizes) * rng.choice((1, -2)) + rng.choice(sizes) * rng.choice((0, 0, 1)) - RING.var("a")
        parts.append(atom(p, rng.choice(tuple(Relation))))
    if rng.random() < 0.3:
        parts.append(conj(atom(p - q * 2, Relation.EQ) for p, q in zip(first, second, strict=True)))
    rng.shuffle(parts)
    everywhere = exists if rng.random() < 0.5 else forall  # of both vectors
    if rng.random() < 0.4:
        return everywhere((*VECTORS[0][:dimension], *VECTORS[1][:dimension]), conj(parts))
    inside = (exists if rng.random() < 0.5 else forall)(VECTORS[1][:dimension], disj(parts[:2]))
    outside = conj((inside, atom(sizes[0] - RING.var("b"), rng.choice(tuple(Relation)))))
    return (exists if rng.random() < 0.7 else forall)(VECTORS[0][:dimension], outside)


def solvable(rng: random.Random) -> Formula:
    """A disjunction whose members have equations, beside other conditions."""
    ring = Ring.of(("a", "b", "x", "y"))
    cases = [
        conj((atom(ring.var("x") * rng.choice((1, 2)) - simple(rng, Ring.of(("a", "b"))).convert(ring), Relation.EQ),))
        for _ in range(rng.randint(2, 3))
    ]
    more = [conj((case, formula(rng, ring, 0))) for case in cases]
    return exists(("x", "y"), conj((formula(rng, ring, 1), disj(more), formula(rng, ring, 0))))


def met(rng: random.Random) -> Formula:
    """A variable that stands in one comparison alone, under conditions on its leading coefficient."""
    ring = Ring.of(("a", "b", "x", "y"))
    rest = Ring.of(("a", "b", "y"))
    x, degree = ring.var("x"), rng.choice((1, 2, 3, 4))
    lead = rng.choice([ring.constant(2), ring.var("a"), ring.var("y") ** 2 + 1, ring.var("y")])
    p = x**degree * lead + x * simple(rng, rest).convert(ring) + ring.var("b")
    sign = atom(lead, rng.choice((Relation.GT, Relation.LT, Relation.NE)))
    others = atom(polynomial(rng, rest).convert(ring), rng.choice(tuple(Relation)))
    return exists(("x", "y"), conj((atom(p, rng.choice(tuple(Relation))), sign, others)))


def patterned(rng: random.Random) -> Formula:
    """One polynomial in x, y and z, equal to zero in some of them."""
    ring = Ring.of(("a", "b", "x", "y", "z"))
    degree = rng.choice((2, 3, 4))

    power = rng.choice((1, 2))

    def pattern(name: str, scale: int) -> Poly:
        x = ring.var(name)
        return (x**degree + ring.var("a") * x**power + ring.var("b") ** 2) * scale

    equations = [atom(pattern(name, rng.choice((1, -2, 3))), Relation.EQ) for name in ("x", "y")[: rng.randint(1, 2)]]
    other = atom(pattern("z", rng.choice((1, 2, -1))), rng.choice(tuple(Relation)))
    beside = formula(rng, ring, 0)
    return exists(("x", "y", "z"), conj((*equations, other, beside)))


def exchangeable(rng: random.Random) -> Formula:
    """Conditions on x and y that change places with each other, or stay the same."""
    ring = Ring.of(("a", "x", "y"))
    a, x, y = (ring.gen(i) for i in range(3))

    def own(p: Poly, q: Poly) -> Poly:
        return p**first * n + p * a * k + q**second * m - 1

    parts: list[Formula] = [atom(x**3 + y**3 - x * y * a * rng.randint(1, 3) - rng.randint(0, 2), Relation.EQ)]
    for _ in range(rng.randint(1, 2)):
        first, second, n, k, m = (rng.randint(1, 2) for _ in range(5))
        relation = rng.choice(tuple(Relation))
        if rng.random() < 0.3:
            parts.append(disj((atom(x + y - a, relation), atom((x - y) ** 2 - m, Relation.LT))))
        elif rng.random() < 0.2:
            parts.append(atom((x - y) * (x + y + 1), rng.choice((Relation.EQ, Relation.NE))))
        else:
            parts += [atom(own(x, y), relation), atom(own(y, x), relation)]
    rng.shuffle(parts)
    return exists(("x", "y"), conj(parts))


def steps(given_: Formula, kind: StepKind) -> Iterator[Step]:
    log = RunLog()
    prepare(given_, enabled={kind}, log=log)
    return (step for step in log.steps() if step.rule == kind.value)


MADE = {
    StepKind.GATHERING: nested,
    StepKind.ROTATION: turnable,
    StepKind.DISTRIBUTION: solvable,
    StepKind.TAKES_VALUE: met,
    StepKind.CANCELLING: patterned,
    StepKind.EXCHANGE: exchangeable,
}


@pytest.mark.parametrize("kind", MADE)
@settings(deadline=None, max_examples=20, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_what_the_rule_does_is_accepted(kind: StepKind, seed: int) -> None:
    for step in steps(MADE[kind](random.Random(seed)), kind):
        assert accepted(step), (step.before, step.after)


@pytest.mark.parametrize("kind", MADE)
def test_the_rules_find_something_to_do(kind: StepKind) -> None:
    found = sum(1 for seed in range(60) for _ in steps(MADE[kind](random.Random(seed)), kind))
    assert found >= 8


@settings(deadline=None, max_examples=15, derandomize=True)
@given(seed=st.integers(0, 10**9))
def test_equations_of_answers(seed: int) -> None:
    """Linear equations and products, as they come out of eliminations: each small step has evidence."""
    rng, ring, log = random.Random(seed), Ring.of(("a", "b", "c")), RunLog()
    lines = [ring.gen(i) * rng.choice((1, 2)) - ring.gen(j) * rng.choice((0, 1)) for i, j in combinations(range(3), 2)]
    cases = disj((atom(rng.choice(lines), Relation.NE), atom(rng.choice(lines), Relation.EQ)))
    equation = atom(rng.choice(lines) * rng.choice((*lines, ring.constant(1))), Relation.EQ)
    untangled(conj((equation, cases, atom(rng.choice(lines), Relation.EQ))), Context(Options(), Budget(), log))
    assert all(map(accepted, log.steps()))


@pytest.mark.parametrize(
    ("inside", "proved"),
    [
        ("x - 1 = 0 or x - y > 0", True),
        ("x - 1 = 0 or x - y >= 0", False),
        ("x + 1 = 0 or x - y > 0", False),
        ("x - 1 = 0 or y - x > 0", False),
    ],
)
def test_equations_together_reduce_what_stands_in_disjunctions(inside: str, proved: bool) -> None:
    circles = "x^2 + y^2 = 1 and z^2 + w^2 = 1"
    before = f"ex x, y, z, w. {circles} and (x^2 + y^2 - 2*x + 1 = 0 or x*z^2 + x*w^2 - x^2*y - y^3 > 0)"
    sides = (moved(read_formula(text), RING) for text in (before, f"ex x, y, z, w. {circles} and ({inside})"))
    assert accepted(Step("Groebner basis of the equations", *sides)) is proved
