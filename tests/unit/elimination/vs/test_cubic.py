"""Sign conditions at roots of cubics against the roots themselves."""

import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import product

import pytest

import qe
from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.clusters import asks_one
from qe.elimination.vs.cubic import at_cubic
from qe.elimination.vs.points import SOME, CubicRoot
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert, disj, exists, neg
from qe.formula.evaluate import holds_at
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Exists, Formula, Relation
from qe.formula.traverse import atoms
from qe.io.text import read
from qe.options import Budget
from qe.simplifier.simplify import simplify
from tests.tables import each
from tests.unit.elimination.vs.line import satisfiable, specialise

RING = Ring.of(("q", "u", "v", "w", "x"))
X = RING.gen(4)


def table(g: Poly, relation: Relation, f: Poly, index: int) -> Formula:
    x = g.ring.index["x"]
    return at_cubic(g, x, relation, CubicRoot(f.coefficients(x), index), None, atom)  # type: ignore[arg-type]


def polynomial(*coefficients: int) -> Poly:
    """From degree 0 up."""
    return sum((c * X**k for k, c in enumerate(coefficients)), RING.constant(0))


def others() -> Iterator[tuple[int, ...]]:
    """Coefficients of polynomials of degree at most 2, and some beyond it."""
    yield from product((-2, -1, 0, 1), (-3, -1, 0, 2), (-1, 0, 2))
    yield from ((1, -2, 0, 1), (0, -2, 1, -1), (1, 0, 0, 0, -1), (-2, 1, 0, 0, 1, 1))


ROOTS = [(-1, 0, 2), (-3, -1, 0), (0, 0, 1), (-1, -1, 2), (-2, 1, 1), (0, 1, 1), (-1, -1, -1)]
"""All real types with D >= 0: three simple roots, a double one on either side, a triple one."""


def value(coefficients: tuple[int, ...], at: int) -> int:
    return sum(c * at**k for k, c in enumerate(coefficients))


def sign(number: int) -> int:
    return (number > 0) - (number < 0)


@pytest.mark.parametrize("roots", ROOTS)
def test_three_real_roots(roots: tuple[int, int, int]) -> None:
    for lead in (1, -2):
        f = lead * (X - roots[0]) * (X - roots[1]) * (X - roots[2])
        slope = slope_of(f)
        for g in (*list(others())[lead % 3 :: 3], slope, tuple(-c for c in slope)):
            signs = [sign(value(g, r)) for r in roots]
            for relation in Relation:
                expected = [relation.holds(s) for s in signs]
                for index, holds in enumerate([*expected, any(expected)], start=1):
                    assert table(polynomial(*g), relation, f, index) == (TRUE if holds else FALSE), (roots, g, index)


def slope_of(f: Poly) -> tuple[int, ...]:
    return tuple(int(c.constant_value()) for c in f.derivative(4).coefficients(4))


@pytest.mark.parametrize("roots", ROOTS)
def test_factors_that_may_vanish(roots: tuple[int, int, int]) -> None:
    """A multiple q*f' of the derivative was said not to be 0 at a simple root, for q = 0, too."""
    q, lead = RING.gen(0), RING.gen(1)
    f = (X - roots[0]) * (X - roots[1]) * (X - roots[2])
    for g in (slope_of(f), *list(others())[::7]):
        for relation, index in product(Relation, (1, 2, 3, SOME)):
            formula = table(q * polynomial(*g), relation, lead * f, index)
            for here, a in ((-1, 1), (0, 1), (0, -2), (2, -2)):
                at = [relation.holds(sign(here * value(g, r))) for r in roots]
                found = holds_at(formula, {"q": Fraction(here), "u": Fraction(a)})
                assert found is (any(at) if index == SOME else at[index - 1]), (g, relation, index, here, a)


@each(1, -3)
def test_one_real_root(lead: int) -> None:
    for real, middle, square in ((-1, 0, 1), (0, 1, 2), (2, 2, 1), (1, -1, 1)):
        quadratic = (X - middle) ** 2 + square
        f = lead * (X - real) * quadratic
        multiples = [tuple(int(c.constant_value()) for c in (m * quadratic).coefficients(4)) for m in (1, -2)]
        for g in (*list(others())[lead % 4 :: 4], *multiples):
            for relation in Relation:
                holds = relation.holds(sign(value(g, real)))
                assert table(polynomial(*g), relation, f, 0) == (TRUE if holds else FALSE), (f, g, relation)


LETTERS = Ring.of(("a", "b", "c", "d", "u", "v", "w", "x"))


@each("u*x^2 + v*x + w = 0", "v*x^4 - x + u*w = 0", "u*(3*a*x^2 + 2*b*x + c) = 0")
@pytest.mark.parametrize("relation", Relation)
def test_all_coefficients_as_letters(text: str, relation: Relation) -> None:
    """The formulas with letters, at numbers for them, against the value at the root."""
    f, g = (convert(read(t), LETTERS).poly for t in ("a*x^3 + b*x^2 + c*x + d = 0", text))  # type: ignore[union-attr]
    formulas = [table(g, relation, f, index) for index in range(5)]
    chance = random.Random(f"{text} {relation}")
    for _ in range(25):
        lead, numbers = chance.choice((1, -2)), [chance.randint(-2, 2) for _ in range(6)]
        roots = sorted(numbers[:3]) if chance.random() < 0.6 else numbers[:1]
        last = (-roots[1] - roots[2], roots[1] * roots[2]) if len(roots) == 3 else (2, chance.randint(2, 3))
        cubic = (-roots[0] * last[1], last[1] - roots[0] * last[0], last[0] - roots[0], 1)
        values = dict(zip("dcbauvw", map(Fraction, (*(lead * k for k in cubic), *numbers[3:])), strict=True))
        at = [holds_at(atom(g, relation), {**values, "x": Fraction(r)}) for r in roots]
        expected = {0: at[0]} if len(at) == 1 else {1: at[0], 2: at[1], 3: at[2], SOME: any(at)}
        for index, holds in expected.items():
            assert holds_at(formulas[index], values) is holds, (values, roots, index)


LE, LT = Relation.LE, Relation.LT
CASES = [
    (1, 1, RING.gen(0), LE),
    (0, 1, RING.gen(0), LE),
    *(
        pytest.param(*case, relation, marks=pytest.mark.deep)
        for case in ((1, 1, RING.gen(0)), (-1, 1, RING.gen(0)), (0, 1, RING.gen(0)), (None, 0, RING.constant(1)))
        for relation in (LE, LT)
    ),
]
"""Leading coefficient of g (None: a letter), and p, q for the roots -p, 0, q of f. Any cubic with real roots and
any g is one of these (or f = x^3) up to a translation, positive factors of x and g, and the mirror (x3 becomes x1)."""


@each(*CASES)
def test_decomposition_proves_the_table(square: int | None, p: int, q: Poly, relation: Relation) -> None:
    """There are no cubic and no quadratic polynomial for which the formula and the value at the root differ."""
    u = RING.gen(1) if square is None else RING.constant(square)
    v, w = RING.gen(2), RING.gen(3)
    g, f = u * X**2 + v * X + w, X * (X + p) * (X - q)
    for index, at_the_root in ((1, u * p * p - v * p + w), (2, w)):
        formula, truth = table(g, relation, f, index), atom(at_the_root, relation)
        differ = disj((conj((formula, nnf(neg(truth)))), conj((truth, nnf(neg(formula))))))
        question = exists(("q", "u", "v", "w"), conj((atom(q, Relation.GE), differ)))
        assert qe.decide(question, without="cubic") is False


@each(
    ("x > q", True),
    ("x > q and u > 0 or x < w and v = 1", True),
    ("x > q and x < u", False),
    ("u > 0 and (x > q or (x < u and x < v))", False),
    ("x > q and x^3 = v*x + w", True),
    ("x > q and x^3 > v*x + u", True),
)
def test_what_asks_one_thing_of_a_root(text: str, expected: bool) -> None:
    """Of x^3 = v*x + w: what is constant there counts as nothing."""
    formula = read(f"({text}) and q + u + v + w + x = 0")
    body = convert(formula, RING).args[:-1]  # type: ignore[union-attr]
    f = X**3 - RING.gen(2) * X - RING.gen(3)
    for part in (conj(body),):
        assert asks_one(part, 4, CubicRoot(f.coefficients(4), SOME)) is expected  # type: ignore[arg-type]


BLOCKS = [
    "ex x. x^3 + a*x + b = 0 and x > a",
    "ex x. a*x^3 + b*x^2 + x = 1 and x^2 < a",
    "ex x. x^3 + a*x + b < 0 and x > b and x < 1",
    "ex x. x^3 - a*x >= b and x^3 + b*x <= a",
    "ex x. (a*x^3 + b*x > 1 or x < b) and x^2 >= a",
    "ex x. (x - a)^2*(x + b) > 0 and x*b < 1 and x > -1",
    "ex x. a*x^3 + b*x^2 + 1 /= 0 and x^2 = a + b",
    "ex x. x^3 = a*x and (x > b or x < 0 and x^2 > b)",
]


@pytest.mark.parametrize("text", BLOCKS)
def test_blocks_of_degree_three(text: str) -> None:
    """The same truth as by the roots at every point of a grid, and values for x where it is true."""
    block = read(text)
    assert isinstance(block, Exists) and block.ring is not None
    x = block.ring.index["x"]
    found = eliminate_block(("x",), block.body, budget=Budget(20), simplify=simplify, highest=3)
    assert not found.remaining
    for a, b in product((-2, -1, 0, 1, 3), (-2, Fraction(-1, 2), 0, 1)):
        values = {"a": Fraction(a), "b": Fraction(b)}
        expected = satisfiable(specialise(block.body, values), x)
        assert holds_at(found.formula, values) is expected, values
        if expected and a > 0:
            answer = next(r for r in found.answers if holds_at(r.guard, values))
            assert holds_at_value(block.body, values, answer.witness(values, budget=Budget(20))["x"])


def holds_at_value(body: Formula, values: dict[str, Fraction], x: object) -> bool:
    from qe.exact.sample import Point
    from qe.formula.evaluate import truth_under

    assert body.ring is not None
    line = specialise(body, values)
    if line in (TRUE, FALSE):
        return line == TRUE
    point = Point.of(Ring.of(("x",)), [x])  # type: ignore[list-item]
    return truth_under(convert(line, Ring.of(("x",))), point.sign) is True


def test_answers_are_short() -> None:
    """One condition is asked of any of three roots at a time; two roots of the falling kind are not tried."""

    def size(text: str) -> int:
        block = read(text)
        assert isinstance(block, Exists)
        found = eliminate_block(("x",), block.body, budget=Budget(20), simplify=simplify, highest=3)
        return sum(1 for _ in atoms(found.formula))

    assert size("ex x. x^3 + a*x + b = 0 and c*x + d > 0") <= 6
    assert size("ex x. x^3 + a*x + b = 0 and x^3 + c*x + d = 0") == 1
    assert size("ex x. x^3 + a*x^2 + b*x + c <= 0 and x >= 0 and x <= 1") <= 8
