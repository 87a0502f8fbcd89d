"""Blocks about one polynomial by signs: right at numbers in place of the parameters, short, and within limits."""

import random

import pytest

import qe
from qe.elimination.rootsigns import forms, theory
from qe.elimination.rootsigns.method import answer
from qe.elimination.rootsigns.question import read
from qe.elimination.rootsigns.theory import Place, Root, Shape
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.evaluate import substituted
from qe.formula.syntax import Constant, Formula
from qe.formula.traverse import atoms
from qe.io.text import read as formula
from qe.options import Budget
from tests.tables import each

RELATIONS = ("=", "<", "<=", ">", ">=")
BESIDE = (
    "",
    "and x > 0",
    "and x >= 0",
    "and 2*x < 3",
    "and x <= u",
    "and x >= -1 and x < 2",
    "and x >= u and x <= 1",
)
CONDITIONS = ("and x^2 + s*x + t > 0", "and s*x^2 + t >= 0", "and s*x + t /= 0", "and x^2 - s < 0")


def by_signs(question: Formula) -> Formula:
    problem = Block.of(question)
    assert problem is not None and problem.body.ring is not None
    x = problem.body.ring.index["x"]
    found = read(problem.dual.body, x)
    assert found is not None
    return answer(found, x, Budget())


def product_of(rng: random.Random, degree: int) -> list[int]:
    """The coefficients of a polynomial of at most this degree, many of whose roots are multiple."""
    found = [rng.choice((1, 1, -1, 2))]
    wanted = degree if rng.random() < 0.85 else rng.randint(0, degree)
    while len(found) <= wanted:
        line = [rng.randint(-2, 2), rng.choice((1, 1, 2))]
        factor = line if rng.random() < 0.7 or wanted < len(found) + 1 else [rng.randint(0, 3), rng.randint(-3, 3), 1]
        for _ in range(rng.choice((1, 2, 3))):
            if len(found) + len(factor) - 2 <= wanted:
                wide = [0] * (len(found) + len(factor) - 1)
                for i, c in enumerate(found):
                    for j, d in enumerate(factor):
                        wide[i + j] += c * d
                found = wide
    return found + [0] * (degree + 1 - len(found))


def agrees(text: str, degree: int, rng: random.Random, points: int) -> None:
    """The formula for a general polynomial, at special ones, and what decomposition says of these."""
    names = [f"c{k}" for k in range(degree + 1)]
    general = " + ".join(f"{name}*x^{k}" for k, name in enumerate(names))
    question = formula(text.replace("f", general))
    found = by_signs(question)
    for _ in range(points):
        values = dict(zip(names, product_of(rng, degree), strict=True))
        values |= {name: rng.randint(-3, 3) for name in question.free if name not in values}
        left = substituted(found, values)
        truth = left.value if isinstance(left, Constant) else qe.decide(left, without="roots", process=False)
        assert truth is qe.decide(substituted(question, values), without="roots", process=False), (text, values)


@pytest.mark.parametrize("seed", range(6))
def test_at_numbers_it_says_what_decomposition_says(seed: int) -> None:
    rng = random.Random(seed)
    degree = 2 + seed % 2
    agrees(f"ex x. f {rng.choice(RELATIONS)} 0 {rng.choice(BESIDE)}", degree, rng, 4)
    agrees(f"ex x. f = 0 {rng.choice(CONDITIONS)}", 3, rng, 4)


@pytest.mark.deep
@pytest.mark.parametrize("relation", RELATIONS)
def test_of_degree_four_too(relation: str) -> None:
    rng = random.Random(4)
    for beside in BESIDE[:6]:
        agrees(f"ex x. f {relation} 0 {beside}", 4, rng, 30)
    for condition in CONDITIONS:
        agrees(f"ex x. f = 0 {condition}", 4, rng, 30)


def test_double_pairs_and_triple_roots_of_a_quartic_are_told_apart() -> None:
    """(x^2 - 1)^2 is nowhere negative, (x - 1)^3*(x + 3) is; both have two real roots and discriminant 0."""
    found = by_signs(formula("ex x. x^4 + p*x^2 + q*x + r < 0"))
    assert substituted(found, {"p": -2, "q": 0, "r": 1}) == Constant(False)
    assert substituted(found, {"p": -6, "q": 8, "r": -3}) == Constant(True)


def expanded(kind: theory.RootType, values: list[int], lead: int) -> list[Poly]:
    """Coefficients of a polynomial with these real roots; pairs are +-i, +-2i, …"""
    ring = Ring.of(())
    found = [ring.constant(lead)]
    for k, (root, multiplicity) in enumerate(kind):
        factor = [(k + 1) ** 2, 0, 1] if root in (Root.PAIR, Root.ZERO_PAIR) else [-values[k], 1]
        for _ in range(multiplicity):
            wide = [ring.constant(0)] * (len(found) + len(factor) - 1)
            for i, c in enumerate(found):
                for j, d in enumerate(factor):
                    wide[i + j] = wide[i + j] + c * d
            found = wide
    return found


@each(2, 3, 4)
def test_the_signs_of_every_type_of_roots_are_listed(degree: int) -> None:
    rng, shape = random.Random(degree), Shape(degree, Place.RAY, True, invariant=degree == 4)
    listed = {(signs, kind) for signs, _, kind in theory.rows(shape)}
    for kind in theory.types(shape):
        for lead in (1, -1):
            sizes = rng.sample(range(1, 9), len(kind))
            values = [s * (r.value if isinstance(r.value, int) else 0) for s, (r, _) in zip(sizes, kind, strict=True)]
            f = expanded(kind, values, lead)
            one = f[0].ring.constant(1)
            polys = {("c", k): p for k, p in enumerate(f)}
            polys |= {("P", k): p for k, p in enumerate(forms.minors(f, [one], Budget()), 1)}
            polys |= {("A", k): p for k, p in enumerate(forms.minors(f, [one - one, one], Budget()), 1)}
            if degree == 4:
                polys["I", 0] = 12 * (f[4] * f[0]) - 3 * (f[3] * f[1]) + f[2] * f[2]
            numbers = [polys[name].constant_value() for name in shape.names]
            assert (tuple((v > 0) - (v < 0) for v in numbers), kind) in listed


@each(
    ("ex x. x > 0 and x^4 + a*x^3 + b*x^2 + c*x + d = 0", 14),
    ("all x. x^4 + p*x^2 + q*x + r > 0", 5),
    ("all x. 0 <= x and x <= 1 -> a*x^4 + b*x^3 + c*x^2 + d*x + k > 0", 18),
    ("ex x. x^4 + p*x^2 + q*x + r = 0 and x^2 + s*x + t < 0", 22),
)
def test_questions_about_quartics_have_short_answers(text: str, most: int) -> None:
    found = qe.eliminate(text, process=False)
    assert "roots by signs" in {step.rule for step in found.derivation.steps}
    assert sum(1 for _ in atoms(found.formula)) <= most


def test_huge_numbers_and_powers_end() -> None:
    huge = 10**400
    found = by_signs(formula(f"ex x. x^3 + a*x + b = 0 and {huge}*x > {huge + 1} and x < c^1000"))
    assert qe.decide(substituted(found, {"a": 0, "b": -8, "c": 2}), process=False)
    assert not qe.decide(substituted(found, {"a": 0, "b": -1, "c": 2}), process=False)
    with pytest.raises(qe.Unable):
        by_signs(formula("ex x. x^4 + a*x^3 + b*x + c = 0 and x > (a + b + c + d)^30"))
    other = formula("ex x. x^10000 + a*x + b = 0 and x > c")
    problem = Block.of(other)
    assert problem is not None and read(problem.body, problem.body.ring.index["x"]) is None
