import random
from fractions import Fraction

import qe
from qe.formula.evaluate import holds_at
from tests.tables import each


def test_shadows_are_equivalent_to_what_substitution_says():
    rng = random.Random(5)
    for _ in range(12):
        names = ["x", "y", "z", "a", "b"]
        parts = []
        for _ in range(6):
            terms = " + ".join(f"({rng.randint(-2, 2)})*{n}" for n in rng.sample(names, 3))
            parts.append(f"{terms} + a {rng.choice(['<', '<=', '='])} {rng.randint(-3, 5)}")
        text = f"ex x, y, z. {' and '.join(parts)}"
        ours = qe.eliminate(text, process=False).formula
        other = qe.eliminate(text, method="vs", process=False).formula
        assert qe.equivalent(ours, other, process=False)


def test_nothing_is_left_that_follows_from_the_rest():
    text = "ex x, y, z. a <= x and x <= y and y < z and z <= b and x + 1 <= z + 5 and a <= b + 7"
    assert str(qe.eliminate(text, process=False).formula) in ("a - b < 0", "b - a > 0")


def test_universal_blocks_and_empty_sets():
    assert str(qe.eliminate("all x, y, z. x > a or y > x or z >= y or z < b", process=False).formula) == "a - b <= 0"
    assert str(qe.eliminate("ex x, y, z. x < y and y < z and z < x and x > a", process=False).formula) == "false"


@each(
    ("all x, y, z. abs(x) + abs(y) + abs(z) <= 1 -> a*x + b*y + c*z <= d", "|a| <= d and |b| <= d and |c| <= d"),
    ("all x, y. x >= 0 and y >= x -> a*x + b*y >= 0", "b >= 0 and a + b >= 0"),
    ("ex x, y. 0 < x and x < 1 and y = 2*x and a*x + b*y > c", "c < 0 or a + 2*b > c"),
    ("ex x, y. x + y = 1 and a*x + b*y = 0", "a /= b or a = 0"),
    ("ex x. 0 <= x and x <= 1 and a*x = b", "b >= 0 and a >= b or b <= 0 and a <= b"),
    ("ex x. x > 1 and x < 0 and a*x > b", "false"),
    ("ex x, y. 0 <= x and x <= 1 and y > 2 and y < 1 and a*x*y >= b*x - b*x", "false"),
    (
        "all x, y, z. max(abs(x), abs(y), abs(2*z - 1)) <= 1 -> a*x*y*z <= b",
        "abs(a) <= b",
    ),
    (
        "all x, y. x > 0 and y > 0 and x + y < 1 -> a*x <= b and b*y <= a + 1",
        "b >= 0 and a <= b and a + 1 >= b and a >= -1",
    ),
)
def test_a_linear_form_with_parameters_over_a_polyhedron(text: str, answer: str) -> None:
    ours = qe.eliminate(text, process=False).formula
    assert qe.equivalent(ours, answer, process=False)
    assert len(str(ours)) < 100


def test_linear_forms_over_polyhedra_have_the_truth_of_their_values() -> None:
    """Strict and weak conditions, empty and unbounded sets, lines: by the sentence that is left at a point."""
    rng = random.Random(8)

    def linear(names: list[str], relations: list[str]) -> str:
        terms = " + ".join(f"({rng.randint(-2, 2)})*{v}" for v in names)
        return f"{terms} {rng.choice(relations)} {rng.randint(-2, 3)}"

    for k in range(30):
        names = ["x", "y", "z"][: rng.randint(1, 3)]
        rows = [linear(names, ["<", ">="] if k % 3 else ["<=", ">=", "="]) for _ in range(rng.randint(1, 4))]
        form = " + ".join(f"({rng.choice('abc')} - {rng.randint(0, 1)})*{v}" for v in names)
        body = f"{' and '.join(rows)} and {form} {rng.choice(['<', '<=', '=', '/='])} {rng.choice('abc')}"
        answer = qe.eliminate(f"ex {', '.join(names)}. {body}", process=False).formula
        for _ in range(3):
            point = {name: Fraction(rng.randint(-3, 3), rng.choice((1, 2))) for name in "abc"}
            there = "".join(f"({point[c]})" if c in point else c for c in body.replace("and", "&"))
            said = qe.decide(f"ex {', '.join(names)}. {there.replace('&', 'and')}", process=False)
            assert holds_at(answer, point) == bool(said), (body, point)
