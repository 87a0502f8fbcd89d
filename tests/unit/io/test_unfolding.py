"""Comparisons with max, min and abs: unfolded where this is right, with the truth of the values at points."""

import random
from fractions import Fraction

import qe
from qe.formula.evaluate import holds_at
from qe.io import formats
from tests.tables import each

RELATIONS = {"<": Fraction.__lt__, "<=": Fraction.__le__, ">": Fraction.__gt__, ">=": Fraction.__ge__}


@each(
    ("abs(x - a) <= 1", "x - a <= 1 and a - x <= 1"),
    ("max(x, y, z) < 2*a", "x < 2*a and y < 2*a and z < 2*a"),
    ("1 > min(x, y)", "x < 1 or y < 1"),
    ("a - abs(x)/2 >= 0", "2*a - x >= 0 and 2*a + x >= 0"),
    ("-3*max(x, y)*2 <= 1", "-6*x <= 1 or -6*y <= 1"),
    ("abs(x) + abs(y) <= 1", "x + y <= 1 and x - y <= 1 and y - x <= 1 and -x - y <= 1"),
    ("max(x, min(y, z)) >= 1", "x >= 1 or y >= 1 and z >= 1"),
    ("(if x >= 0 then x else -x) <= 1", "x <= 1 and -x <= 1"),
    ("(if a < 2*x then 3*a else 6*x) > 1", "3*a > 1 and 6*x > 1"),
    ("max(x, y) <= min(a, b)", "x <= a and x <= b and y <= a and y <= b"),
)
def test_unfolded(text: str, plain: str) -> None:
    given, expected = formats.read(text), formats.read(plain)
    assert qe.equivalent(given, expected)
    assert len(str(given)) <= len(str(expected)) + 20


@each(
    ("max(1/x, y) > 1", {"x": 0, "y": 2}),
    ("min(sqrt(x), y) < 1", {"x": -1, "y": 0}),
    ("max(x/y, 3) > 1", {"x": 1, "y": 0}),
    ("abs(x/y) + 1 > 0 or max(-1, abs(1/y)) > -2", {"x": 1, "y": 0}),
    ("max(abs(sqrt(x)), 5) > 1", {"x": -1, "y": 0}),
)
def test_a_maximum_has_no_value_where_a_term_has_none(text: str, point: dict[str, int]) -> None:
    assert not holds_at(formats.read(text), point)


def test_other_choices_keep_their_cases() -> None:
    assert qe.equivalent("(if x > 0 then y else -y) < 1", "x > 0 and y < 1 or x <= 0 and -y < 1")
    assert qe.equivalent("(if x > 0 then x else 1) < 1", "x > 0 and x < 1")


def test_many_sums_of_absolute_values_stay_short() -> None:
    text = " + ".join(f"abs(x{k})" for k in range(8)) + " <= 1"
    assert len(str(formats.read(text))) < 100_000


def _term(rng: random.Random, depth: int) -> str:
    if depth == 0 or rng.random() < 0.2:
        return rng.choice(("x", "y", "(2)", "(-1/3)", "x*y", "y**2"))
    parts = [_term(rng, depth - 1) for _ in range(rng.randint(1, 3))]
    kind = rng.choice(("abs", "max", "min", "sum", "scale"))
    if kind == "sum":
        return f"({rng.choice((' + ', ' - ')).join(parts)})"
    if kind == "scale":
        return f"({parts[0]}*{rng.choice(('(2)', '(-3)', '(1/2)', '(-1)'))})"
    return f"{kind}({parts[0]})" if kind == "abs" or len(parts) == 1 else f"{kind}({', '.join(parts)})"


def test_the_truth_is_that_of_the_values() -> None:
    rng = random.Random(5)
    functions = {"abs": abs, "max": lambda *a: max(a), "min": lambda *a: min(a), "F": Fraction}
    for _ in range(150):
        left, right, relation = _term(rng, 3), _term(rng, 2), rng.choice(list(RELATIONS))
        formula = formats.read(f"{left} {relation} {right}".replace("**", "^"))
        if not formula.is_quantifier_free:
            continue  # too many cases: they have names
        for _ in range(6):
            point = {name: Fraction(rng.randint(-6, 6), rng.choice((1, 2))) for name in "xy"}
            exact = (
                eval(t.replace("(1/2)", "F(1,2)").replace("(-1/3)", "F(-1,3)"), functions | point)
                for t in (left, right)
            )
            assert holds_at(formula, point) == RELATIONS[relation](*map(Fraction, exact)), (
                left,
                relation,
                right,
                point,
            )
