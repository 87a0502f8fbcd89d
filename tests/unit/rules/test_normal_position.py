"""Questions in other coordinates come to the same position, with the same answers, proved, and values come back."""

import json
import random
import time
from fractions import Fraction

import pytest

import qe
from experiments.invariance import rewritten
from experiments.suites.corpus import LITERATURE, tagged
from qe.api.input import read_formula
from qe.exact.ring import Ring
from qe.formula.normal import rename_apart, without_clashes
from qe.formula.syntax import Quantified
from qe.formula.traverse import polynomials, subformulas
from qe.io.text import CONSTANTS, read
from qe.rules.lift import Solve, holds_at, value_at
from qe.rules.normal_position import _length, at_steps, steps_to_normal_position
from qe.rules.step import StepKind
from tests.tables import each


def position(text: str) -> tuple[list[Solve], float]:
    """The steps, and the length of the factors that they lead to."""
    formula = read_formula(text)
    polys, ring = polynomials(formula), formula.ring
    assert ring is not None
    blocks = [[ring.index[v] for v in f.variables] for f in subformulas(formula) if isinstance(f, Quantified)]
    steps = steps_to_normal_position(polys, blocks)
    images = (at_steps(p, steps) for p in polys)
    return steps, sum(map(_length, dict.fromkeys(f for p in images for f, _ in p.factors()[1])))


SPHERE = "ex x, y, z. {x}^2 + {y}^2 + {z}^2 = 1 and {x}*{y}*{z} > a and {x} + {y} < b"
PRODUCT = "ex x, y, z. {x}*{y} = a and {y}^3 + {x} - {z}^2 < 1 and {z}*{x}^2 > 2"
OUTER = "ex x. all y, z. {x}^2 + {y}^2 + {z}^2 >= 1 or {x}*{y} > {z}^3"


@each(
    *((text, change) for text in (SPHERE, PRODUCT, OUTER) for change in ("{v} + 1", "7/3*{v} - 1", "2*{v}", "3/5*{v}"))
)
def test_each_variable_changed_alike(text: str, change: str) -> None:
    given = text.format(**{v: v for v in "xyz"})
    assert position(given)[0] == []
    moved = position(text.format(**{v: f"({change.format(v=v)})" for v in "xyz"}))
    assert moved[1] <= position(given)[1]


@each(
    (SPHERE, {"x": "x + y"}),
    (SPHERE, {"z": "z - 2*x"}),
    (SPHERE, {"x": "3*x + y - 1", "y": "y/2 + 4"}),
    (PRODUCT, {"y": "y - 1 + z"}),
    (OUTER, {"y": "y - z"}),
)
def test_sheared(text: str, forms: dict[str, str]) -> None:
    given = {v: v for v in "xyz"}
    moved = position(text.format(**given | {v: f"({form})" for v, form in forms.items()}))
    assert moved[1] <= position(text.format(**given))[1]


@each("ex x. x^2 + a*x + b < 0", "ex x, y. x^2 + y^2 = 1 and x > y", "ex x, y, z. x^3 + y*z = a and x + y + z > 1")
def test_what_is_short_stays(text: str) -> None:
    assert position(text)[0] == []
    assert StepKind.POSITION.value not in [step.rule for step in qe.eliminate(text).derivation.steps]


@each(("x > 0 and y > 0 and z > 0", False), ("x > 0 and y > 0 and v = x*y", False), ("x > y and y > z", True))
def test_the_axes_of_an_orthant_stay(signs: str, moves: bool) -> None:
    """Rules for polynomials on an orthant do not see it in other coordinates, in which the polynomials are shorter."""
    variables = "x, y, v" if "v" in signs else "x, y, z"
    powers = "(x - y)^4 + (x - y)^3 + (x - y)^2*a" if "v" in signs else "(x - y)^4 + (x - y)^3 + (y - z)^4"
    steps = position(f"ex {variables}. {signs} and {powers} < 1")[0]
    assert any(len(step.numerator.variables) > 1 for step in steps) is moves


def test_signs_are_kept() -> None:
    """An even and an odd degree, negative coefficients: the sign at a point is that at its coordinates."""
    ring = Ring.of(("x", "y"))
    x, y = ring.gen(0), ring.gen(1)
    steps = [Solve("x", y - x * 3, ring.constant(2)), Solve("y", y * -5 + x - 7, ring.constant(3))]
    rng = random.Random(5)
    for poly in (x**3 - y * 2, -(x**2) * y + 1, (x - y) ** 2 * (x + 1) * -3, y**3 * -1):
        for _ in range(20):
            new = {"x": Fraction(rng.randint(-9, 9), 4), "y": Fraction(rng.randint(-9, 9), 4)}
            old = dict(new)
            for step in reversed(steps):
                old[step.variable] = Fraction(value_at(step.numerator, old)) / step.denominator.constant_value()  # type: ignore[arg-type]
            assert (value_at(poly, old) > 0) == (value_at(at_steps(poly, steps), new) > 0)
            assert (value_at(poly, old) == 0) == (value_at(at_steps(poly, steps), new) == 0)


@each(
    "(7/3*x - 1)^2 + (7/3*y - 1)^2 = 2 and (7/3*x - 1)*(7/3*y - 1) > 1/2",
    "(x + y)^2 + (x + y)*(2*y - 3)^3 = 5 and (2*y - 3)^2 < x + y",
)
def test_a_point_comes_back(body: str) -> None:
    point = qe.find_instance(body)
    assert point is not None
    assert holds_at(read(body), point)  # type: ignore[arg-type]


def test_a_counterexample_comes_back() -> None:
    question = "all x, y. (5*x - y + 1)^2 + (2*y + 3)^2 > 1 or (5*x - y + 1)*(2*y + 3) < 1/3"
    formula = read(question)
    assert isinstance(formula, Quantified)
    answer = qe.eliminate(question)
    assert answer.truth is False
    assert answer.witness is not None
    assert not holds_at(formula.body, answer.witness)


SMALL = [p for p in tagged("classics") if len(p.formula) < 90]


@each(*range(6), daily=2)
def test_affine_changes_of_the_corpus(seed: int) -> None:
    """The same answers, with certificates that are accepted."""
    rng = random.Random(seed)
    for problem in rng.sample(SMALL, 8):
        formula = rename_apart(without_clashes(read(problem.formula, known=CONSTANTS)))
        changed = rewritten(formula, rng)
        answer = qe.eliminate(changed, check=True, timeout=20)
        assert qe.equivalent(answer.formula, qe.eliminate(formula, timeout=20).formula), (problem.id, seed)
        assert StepKind.POSITION.value not in answer.unchecked_steps, (problem.id, seed)


def test_an_origin_that_all_comparisons_share_is_found_first() -> None:
    """kyoto1999-Ri-3-m#1 in x -> 7/3*x - 1: nine times as slow, as one difference was made an axis before that."""
    order = "0 < {a} and {a} < {b} and 0 < {c} and {c} < {d} -> {b}^2*{d}^2 + {a}^2*{c}^2 > {a}^2*{d}^2 + {b}^2*{c}^2"
    given = "all a, b, c, d. " + order.format(**{v: v for v in "abcd"})
    moved = "all a, b, c, d. " + order.format(**{v: f"(7/3*{v} - 1)" for v in "abcd"})
    assert position(moved)[1] == position(given)[1]


@pytest.mark.skipif(not LITERATURE.is_dir(), reason="the corpora are not beside the project")
@each("redlog/x10y2|affine", "redlog/x10y2|sheared", "qe_problems/dorato97#1|affine", "qepcad_app/#5|affine")
def test_no_problem_is_lost_in_other_coordinates(name: str) -> None:
    lines = (LITERATURE / "invariance.jsonl").read_text().splitlines()
    (text,) = (row["formula"] for row in map(json.loads, lines) if row["id"] == name)
    assert qe.eliminate(text, timeout=30).status.name == "SOLVED"


def test_many_variables_of_which_few_meet_take_little_time() -> None:
    """Every pair of variables was tried, for every polynomial: 19 s for a script with 200 of them."""
    names = [f"x{k}" for k in range(240)]
    ring = Ring.of(names)
    polys = [ring.gen(k) * ring.gen(k + 1) - 3 * ring.gen(k) - 5 for k in range(239)]
    start = time.process_time()
    assert steps_to_normal_position(polys, [range(240)])
    assert time.process_time() - start < 8
