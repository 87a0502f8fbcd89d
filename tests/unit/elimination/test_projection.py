import random
from fractions import Fraction

import qe
from qe.convex.cone import dot
from qe.convex.vertices import Generated
from qe.elimination import projection
from qe.exact.quadratic_form import solve_linear
from qe.formula.block import Block
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula
from qe.formula.traverse import conjuncts, disjuncts
from qe.io.text import read
from tests.tables import each
from tests.unit.proving.elaborated import refused


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
    assert str(qe.eliminate(text, process=False).formula) in ("a < b", "b > a")


def test_universal_blocks_and_empty_sets():
    assert str(qe.eliminate("all x, y, z. x > a or y > x or z >= y or z < b", process=False).formula) == "a <= b"
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


def by_generators(names: list[str], body: str) -> Formula | None:
    """What the rule itself says, without the methods that would answer in its place."""
    return projection._by_generators(Block(tuple(names), read(body)), lambda: None)


def test_linear_forms_over_polyhedra_have_the_truth_of_their_values() -> None:
    """Strict and weak conditions, empty and unbounded sets, lines: by the sentence that is left at a point."""
    rng, answered = random.Random(8), 0
    names = ["x", "y", "z"]
    for k in range(60):
        relations = ["<", ">="] if k % 3 == 0 else ["<=", ">=", "<=", ">=", "="]
        rows = [
            " + ".join(f"({rng.randint(-2, 2)})*{v}" for v in names) + f" {rng.choice(relations)} {rng.randint(-2, 3)}"
            for _ in range(rng.randint(1, 5))
        ]
        form = " + ".join(f"({rng.choice('abc')} - {rng.randint(0, 1)})*{v}" for v in names)
        body = f"{' and '.join(rows)} and {form} {rng.choice(['<', '<=', '=', '/='])} {rng.choice('abc')}"
        answer = by_generators(names, body)
        if answer is None:
            continue
        answered += 1
        for _ in range(4):
            point = {name: Fraction(rng.randint(-2, 2)) for name in "abc"}
            there = "".join(f"({point[c]})" if c in point else c for c in body.replace("and", "&"))
            said = qe.decide(f"ex x, y, z. {there.replace('&', 'and')}", process=False)
            assert holds_at(answer, point) == bool(said), (body, point)
    assert answered > 30


@each(
    ("x > 0 and y > 0 and z > 0 and x + y + z < 1 and a*x + b*y >= c", None),  # depends on the boundary
    ("x >= 0 and y >= 0 and x + y <= 1 and z = 1 and a*x*y + z > b", None),  # not linear along the edges
    ("x >= 0 and y >= 1 and z >= 0 and a*x >= b", "a > 0 or b <= 0"),
    ("x > 0 and x < 0 and y > 0 and z > 0 and a*x > b", "false"),
    ("x >= 1 and x <= -1 and y > 0 and z > 0 and a*x /= b", "false"),
    ("x >= 0 and x <= 0 and y > x and y < x and z = 1 and a*z > b", "false"),
    ("x >= 0 and y >= 0 and z = 0 and a*x + b*y >= 1", "a > 0 or b > 0"),
)
def test_what_holds_at_no_vertex_may_hold_in_a_direction(body: str, answer: str | None) -> None:
    ours = by_generators(["x", "y", "z"], body)
    assert (ours is None) == (answer is None)
    assert ours is None or answer is None or qe.equivalent(ours, answer, process=False)


def test_a_short_row_that_follows_from_longer_ones_is_left_out() -> None:
    text = "ex z. a + b <= z and a - b <= z and a - 3 <= z and z <= 2"
    assert qe.eliminate(text, process=False).formula == qe.eliminate(text.replace(" and a - 3 <= z", "")).formula


def test_an_answer_at_ten_vertices_is_no_decomposition_of_four_parameters() -> None:
    """None of its conditions follows from the others: there is nothing to shorten (it took over 20 s to try)."""
    rows = "x + y <= 2 and 3*x - z <= 4 and y - 2*x + 3*z <= 5 and x - 3*y - z <= 5"
    box = " and ".join(f"{v} >= -3 and {v} <= 3" for v in "xyz")
    answer = qe.eliminate(f"ex x, y, z. {rows} and {box} and a*x + b*y + c*z > k", process=False, timeout=5)
    assert answer.reason == "no proof was asked for" and len(disjuncts(answer.formula)) > 9


@each(
    "all x, y, z. abs(x) + abs(y) + abs(z) <= 1 -> a*x + b*y + c*z <= d",
    "all x, y. x > 0 and y > 0 and x + y < 1 -> a*x + b*y <= c",  # open: no vertex belongs to it
    "ex x, y. x >= 0 and y >= x and a*x + b*y >= 1",  # along directions
    "ex x, y. x + y >= 1 and (a*x + b*y >= c or a*x > b)",  # along lines, two conditions
    "ex x, y, z. 0 <= x and x <= 1 and 0 <= y and y <= z and z <= 1 and a*x*y + b*x*z > c",
    "ex x, y, z. x <= y and y <= z and z <= x + 1 and x >= 0 and a*x + b*y + c*z > 0",
    "ex x, y. x >= 0 and y >= 0 and x + y <= 1 and (x*a - x*a^2 > 1 or b*x + y >= 0)",  # true at a vertex
)
def test_answers_by_vertices_and_directions_are_proved(text: str) -> None:
    answer = qe.eliminate(text, check=True, process=False)
    assert (answer.guarantee, answer.unchecked_steps) == (qe.Guarantee.CHECKED, ())
    assert len(answer.certificate.to_json()) < 25_000


def test_no_other_answer_than_that_at_the_vertices_is_proved() -> None:
    """Conditions at vertices left out, added or with another relation."""
    block = "ex x, y. x >= 0 and y >= 0 and x + y <= 1 and a*x + b*y >= c"
    assert not refused("projection", block, "c <= 0 or a >= c or b >= c", {})
    for after in ("c <= 0 or a >= c", "c <= 0 or a >= c or b > c", "c <= 0 or a >= c or b >= c or a + b >= c"):
        assert refused("projection", block, after, {}), after


def test_the_largest_function_of_a_triangulation_tells_the_simplex() -> None:
    """A point is a combination without negative weights of the generators of one of the pieces with that function."""
    rng = random.Random(2)
    names = ("x", "y", "z")
    for k in range(12):
        rows = [f"{rng.randint(-2, 2)}*x + {rng.randint(-2, 2)}*y + {rng.randint(-2, 2)}*z <= {rng.randint(1, 3)}"]
        rows += [f"{v} >= -2" for v in names] + [f"{v} <= 2" for v in names[: k % 4]]
        polyhedron = Generated.of(names, conjuncts(read(" and ".join(rows))), lambda: None)
        assert polyhedron is not None
        pieces, rays = polyhedron.pieces(), list(polyhedron.cone.rays)
        assert pieces
        for _ in range(5):
            weights = [rng.randint(0, 3) for _ in rays]
            point = tuple(sum(w * c for w, c in zip(weights, column)) for column in zip(*rays))
            values = [Fraction(dot(f[:-1], point), f[-1]) for f, _ in pieces]
            _, spanning = pieces[values.index(max(values))]
            solution = solve_linear(list(zip(*spanning)), point, len(spanning))
            assert solution is not None and min(solution.particular) >= 0
