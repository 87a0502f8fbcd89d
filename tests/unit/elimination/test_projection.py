import random

import qe


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
