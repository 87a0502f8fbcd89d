"""The reference elimination on sentences and formulas whose answers are known without it."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from experiments import reference
from qe.errors import BudgetExceeded, InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists, forall, iff, neg, root_atom
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, ForAll, Formula, Relation
from qe.options import Budget
from tests.differential.generate import NESTED, SMALL, at_point, random_formula, random_point

RING = Ring.of(["a", "b", "c", "x", "y", "z"])
a, b, c, x, y, z = (RING.gen(i) for i in range(6))


def rel(p: Poly, relation: str) -> Formula:
    return atom(p, Relation(relation))


SENTENCES = [
    ("square is negative", exists(["x"], rel(x * x + 1, "=")), False),
    ("negative root of two", exists(["x"], conj([rel(x * x - 2, "="), rel(x, "<")])), True),
    ("between the roots", exists(["x"], conj([rel(x * x - 2, "<"), rel(x * x - 1, ">"), rel(x, "<")])), True),
    ("every number a square", forall(["x"], exists(["y"], rel(y * y - x, "="))), False),
    ("every number a cube", forall(["x"], exists(["y"], rel(y**3 - x, "="))), True),
    ("every nonnegative number a square", forall(["x"], disj([rel(x, "<"), exists(["y"], rel(y * y - x, "="))])), True),
    ("no largest", exists(["x"], forall(["y"], rel(x - y, ">="))), False),
    (
        "density",
        forall(["x", "y"], disj([rel(x - y, ">="), exists(["z"], conj([rel(x - z, "<"), rel(z - y, "<")]))])),
        True,
    ),
    ("double root only", exists(["x"], conj([rel((x - 1) ** 2, "<="), rel(x - 1, "/=")])), False),
    ("circle meets line", exists(["x", "y"], conj([rel(x * x + y * y - 1, "="), rel(x + y - 1, ">")])), True),
    ("circle tangent to line", exists(["x", "y"], conj([rel(x * x + y * y - 1, "="), rel(y - 1, ">")])), False),
    (
        "tangent ball and plane",
        exists(["x", "y", "z"], conj([rel(x * x + y * y + z * z - 1, "<="), rel(z - 1, ">=")])),
        True,
    ),
    (
        "Davenport-Heintz, with its answer x^2 = 1",
        forall(
            ["x"],
            iff(
                exists(
                    ["c"],
                    forall(
                        ["b", "a"],
                        disj(
                            [
                                neg(
                                    disj(
                                        [
                                            conj([rel(a - x, "="), rel(b - c, "=")]),
                                            conj([rel(a - c, "="), rel(b - 1, "=")]),
                                        ]
                                    )
                                ),
                                rel(a * a - b, "="),
                            ]
                        ),
                    ),
                ),
                rel(x * x - 1, "="),
            ),
        ),
        True,
    ),
    (
        "Cauchy's inequality",
        forall(["a", "b", "x", "y"], rel((a * a + b * b) * (x * x + y * y) - (a * x + b * y) ** 2, ">=")),
        True,
    ),
    (
        "discriminant",
        forall(
            ["a", "b", "c"],
            iff(
                exists(["x"], conj([rel(a * x * x + b * x + c, "="), rel(a, "/=")])),
                conj([rel(a, "/="), rel(b * b - 4 * a * c, ">=")]),
            ),
        ),
        True,
    ),
    (
        "discriminant, degenerate case forgotten",
        forall(["a", "b", "c"], iff(exists(["x"], rel(a * x * x + b * x + c, "=")), rel(b * b - 4 * a * c, ">="))),
        False,
    ),
    (
        "three real roots of a cubic",
        exists(
            ["x", "y", "z"], conj([rel(x - y, "<"), rel(y - z, "<"), *(rel(v**3 - 3 * v + 1, "=") for v in (x, y, z))])
        ),
        True,
    ),
    (
        "four real roots of a cubic",
        exists(
            ["a", "x", "y", "z"],
            conj(
                [rel(a - x, "<"), rel(x - y, "<"), rel(y - z, "<"), *(rel(v**3 - 3 * v + 1, "=") for v in (a, x, y, z))]
            ),
        ),
        False,
    ),
    ("shadowed name", exists(["x"], conj([rel(x - 1, "="), Exists(("x",), rel(x - 2, "="))])), True),
    ("unused variable", Exists(("z",), ForAll(("y",), exists(["x"], rel(x, "=")))), True),
]


@pytest.mark.parametrize(("name", "formula", "expected"), SENTENCES, ids=[s[0] for s in SENTENCES])
def test_sentence(name: str, formula: Formula, expected: bool) -> None:
    assert reference.decide(formula, budget=Budget(20)) is expected
    assert reference.decide(neg(formula), budget=Budget(20)) is not expected


def test_constants() -> None:
    assert reference.decide(TRUE) is True
    assert reference.decide(FALSE) is False
    assert reference.eliminate(forall(["x"], rel(x * x, ">="))) == TRUE


def signs(formula: Formula, **values: int | Fraction) -> bool:
    return at_point(formula, {k: Fraction(v) for k, v in values.items()}) == TRUE


def test_quadratic_with_parameters() -> None:
    """There is a root iff a /= 0 and b^2 >= 4ac, or a = 0 and b /= 0, or all three vanish."""
    answer = reference.eliminate(exists(["x"], rel(a * x * x + b * x + c, "=")))
    assert answer.is_quantifier_free
    assert set(answer.free) <= {"a", "b", "c"}
    for p in range(-2, 3):
        for q in range(-2, 3):
            for r in range(-2, 3):
                expected = q * q >= 4 * p * r if p else q != 0 or r == 0
                assert signs(answer, a=p, b=q, c=r) is expected


def test_ball_and_plane_with_parameter() -> None:
    """The unit disc meets the line x + y = a iff a^2 <= 2."""
    answer = reference.eliminate(exists(["x", "y"], conj([rel(x * x + y * y - 1, "<="), rel(x + y - a, "=")])))
    for value in (Fraction(-3, 2), -1, 0, Fraction(7, 5), Fraction(71, 50), Fraction(3, 2), 4):
        assert signs(answer, a=value) is (value * value <= 2)


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=[pytest.mark.deep] if seed >= 24 else []) for seed in range(200)]
)
def test_elimination_and_decision_agree(seed: int) -> None:
    """Eliminating first and inserting numbers afterwards is the same as deciding with the numbers inserted."""
    rng = random.Random(f"reference {seed}")
    formula = random_formula(rng, rng.choice((*SMALL, NESTED[0])))
    answer = reference.eliminate(formula, budget=Budget(20))
    for _ in range(4):
        point = random_point(rng, formula)
        assert (at_point(answer, point) == TRUE) is reference.decide(at_point(formula, point), budget=Budget(20))


@pytest.mark.parametrize("seed", range(40))
def test_sign_matrix_by_remainders_is_that_by_root_isolation(seed: int) -> None:
    """The induction step on integer polynomials gives the rows that Sturm's theorem gives."""
    rng = random.Random(f"matrix {seed}")
    ps = {}
    for _ in range(rng.randint(1, 3)):
        p = reference._make(0, [rng.randint(-3, 3) for _ in range(rng.randint(2, 4))])
        if not isinstance(p, int):
            ps[p] = None
    polys = list(ps)
    if not polys:
        polys = [(0, (1, 1))]
    expected = [dict(zip(polys, row, strict=True)) for row in reference._sign_rows(tuple(polys))]
    found = _by_remainders(polys)
    assert _condensed(found, polys) == _condensed(expected, polys)


def _by_remainders(polys: list[reference.Toy]) -> reference.Rows:
    """The sign matrix by the induction step alone, down to constants."""
    proper = [p for p in polys if not isinstance(p, int)]
    if not proper:
        rows: reference.Rows = [{}]
    else:
        top = max(proper, key=lambda p: len(p[1]))
        divisors = [reference._derivative(top), *(p for p in proper if p != top)]
        heads = {q: 1 if q[1][-1] > 0 else -1 for q in divisors if not isinstance(q, int)}
        remainders = {q: reference._remainder(top, q, s) for q, s in heads.items()}
        rows = reference._insert(_by_remainders([*divisors, *remainders.values()]), top, divisors, remainders)
    return [{**row, **{p: (p > 0) - (p < 0) for p in polys if isinstance(p, int)}} for row in rows]


def _condensed(rows: reference.Rows, polys: list[reference.Toy]) -> list[tuple[int, ...]]:
    """The rows without the points where nothing vanishes."""
    table = [tuple(row[p] for p in polys) for row in rows]
    result = table[:1]
    for point, after in zip(table[1::2], table[2::2], strict=True):
        if 0 in point:
            result += [point, after]
    return result


def test_input_errors() -> None:
    with pytest.raises(InputError, match="free"):
        reference.decide(rel(x, "="))
    with pytest.raises(InputError, match="root atoms"):
        reference.eliminate(root_atom("x", Relation.EQ, x * x - y, 1))


def test_time_limit_holds() -> None:
    hard = Exists(
        ("a",),
        ForAll(
            ("b",),
            Exists(
                ("x", "y"),
                conj(
                    [
                        rel(x**4 + a * x * x * y + b * y**3 - x, "="),
                        rel(a * y**4 + b * x**3 + x * y - 1, "<"),
                        rel(x * y - a * b, ">"),
                    ]
                ),
            ),
        ),
    )
    with pytest.raises(BudgetExceeded):
        reference.decide(hard, budget=Budget(0.3))


def test_atoms_of_the_answer_are_normalised() -> None:
    answer = reference.eliminate(exists(["x"], conj([rel(2 * a * x - 6, "="), rel(x, ">")])))
    assert answer == Atom(a, Relation.GT)
