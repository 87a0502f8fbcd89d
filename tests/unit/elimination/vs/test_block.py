"""Elimination of blocks: named cases with known answers."""

from fractions import Fraction

from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.candidates import bounds, in_order
from qe.elimination.vs.radical_free import convex_family, lone_quadratic, without_radicals
from qe.elimination.vs.result import BlockResult
from qe.elimination.vs.substitute import Substitution
from qe.exact.ring import Ring
from qe.formula.build import conj, disj
from qe.formula.evaluate import holds_at
from qe.formula.openness import is_open, thinned
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, Formula
from qe.formula.traverse import atoms, conjuncts, polynomials
from qe.io.text import read
from qe.options import Budget
from qe.simplifier.facts import NOTHING
from qe.simplifier.simplify import simplify
from tests.tables import each


def run(text: str) -> BlockResult:
    formula = read(text)
    assert isinstance(formula, Exists)
    return eliminate_block(formula.variables, formula.body, budget=Budget(30), simplify=simplify)


LOWEST_PAIR = (
    "a < 0 and a < b and a < c or b < 0 and b < a and b < c or c < 0 and c < a and c < b or a < 0 and b < 0 and c < 0"
)
GRID: tuple[Fraction | int, ...] = (-2, -1, 0, 1, Fraction(1, 2), 3)


def agree(found: Formula, expected: str, values: tuple[Fraction | int, ...] = GRID) -> None:
    """Both formulas have the same truth value on a grid."""
    wanted = read(expected)
    names = sorted({*found.free, *wanted.free})
    grid: list[dict[str, Fraction | int]] = [{}]
    for name in names:
        grid = [{**point, name: value} for point in grid for value in values]
    for point in grid:
        assert holds_at(found, point) == holds_at(wanted, point), point


@each("(a*x = b and x > 1 and x < 2 or x = 5) and x < c", "(a*x = b and x > 1 or a*x = 1) and x < 4")
def test_where_the_finitely_many_solutions_of_an_alternative_degenerate_its_other_conjuncts_still_begin_to_hold(
    problem: str,
) -> None:
    """At a = b = 0 the first alternative is an interval: its ends were left out of the elimination set."""
    found = run(f"ex x. {problem}").formula
    assert holds_at(found, {"a": 0, "b": 0, "c": 3})
    assert not holds_at(found, {"a": 0, "b": 1, "c": 3})


@each(
    ("ex x. x^2 + b*x + c = 0", "b^2 - 4*c >= 0"),
    ("ex x. a*x^2 + b*x + c = 0", "a /= 0 and b^2 - 4*a*c >= 0 or a = 0 and (b /= 0 or c = 0)"),
    (
        "ex x. a*x + b = 0 and c*x + d > 0",
        "a > 0 and a*d - b*c > 0 or a < 0 and a*d - b*c < 0 or a = 0 and b = 0 and (c /= 0 or d > 0)",
    ),
    ("ex x, y. x^2 + y^2 = 1 and y = a*x + b", "a^2 - b^2 + 1 >= 0"),
    ("ex u, v. x = u*v and y = v and z = u^2", "y /= 0 and y^2*z = x^2 or y = 0 and x = 0 and z >= 0"),
    ("ex x. x > a and x < b and x /= c", "a < b"),
    ("ex x. x >= a and x <= b and x /= c", "a < b or a = b and a /= c"),
    ("ex x. x^4 - a = 0 and x^2 > 1", "a > 1"),
    ("ex x. x^2 = a and x^2 /= b", "a >= 0 and a /= b"),
    ("ex x. x^3 = a and x^3 < b", "a < b"),
    ("ex x. (x - a)*(x - b)*(x - c) > 0 and x < 0", LOWEST_PAIR),
    ("ex x. (x - a)*(x - b) < 0 and x > 1", "(a < b or b < a) and (a > 1 or b > 1)"),
    ("ex x. (x = a or x = b) and x > c", "a > c or b > c"),
    ("ex x. (a*x = 1 or b*x = 2) and x > 3", "a > 0 and 3*a < 1 or b > 0 and 3*b < 2"),
    ("ex x. (a*x = b or x = 2) and x > 3", "a > 0 and b > 3*a or a < 0 and b < 3*a or a = 0 and b = 0"),
    ("ex x. a > 0", "a > 0"),
    ("ex x, y. x > y", "true"),
    ("ex x, y. x + z + a*x <= 100 and y > x", "true or a = 0"),
    ("ex x. x + z + a*x <= 100", "a /= -1 or z <= 100"),
    ("ex x. not (x >= a or x <= b)", "b < a"),
    ("ex x. a*x^2 <= 0 and b*x = 1", "b /= 0 and a <= 0"),
    ("ex x, y. x*y = 1 and x + y = a", "a^2 >= 4"),
    ("ex x. x^2 + a <= 0 and x >= b", "a <= 0 and (b <= 0 or b^2 + a <= 0)"),
    ("ex x. x^2 + a < 0 and x > b", "a < 0 and (b < 0 or b^2 + a < 0)"),
    ("ex x. a*x^2 + x < 0 and a*x^2 + x + 1 > 0 and x > 0", "a < 0"),
)
def test_known_answers(problem: str, answer: str) -> None:
    result = run(problem)
    assert not result.remaining
    assert not set(result.formula.free) & {"x", "u", "v"} - {"x" if problem.startswith("ex u") else ""}
    agree(result.formula, answer)


def test_a_sphere_and_a_plane() -> None:
    """The open ball meets the half-space iff the norm is greater than 1."""
    result = run("ex x, y. x^2 + y^2 < 1 and a*x + b*y > 1")
    assert not result.remaining
    agree(result.formula, "a^2 + b^2 > 1")


@each(
    "ex x. x^2 < 0",
    "ex x. x > 0 and x < 0",
    "ex x, y. x^2 + y^2 < 0",
    "ex x, y. x > y and y > x + 1",
    "ex x, y. x^2 + y^2 = 1 and x + y >= 2",
)
def test_unsatisfiable(text: str) -> None:
    assert run(text).formula == FALSE


@each(
    "ex x, y. x^2 + y^2 < 1 and x + y > 1",
    "ex x, y. x^2 = 2 and y^2 = x + 1",
    "ex x, y, z. x*y = 1 and y*z = 2 and x + z = 5",
    "ex x, y, z. x^2 + y^2 + z^2 = 1 and x = y and z = 2*x",
    "ex x, y. x > 1000 and y > x^2",
    "ex x, y. x^4 = y^2 and y > 5 and x < 0",
    "ex x, y. (x < -3 or x > 7) and y^2 < x",
    "ex x. x^3 = 5 and x > 0",
)
def test_witnesses_satisfy(text: str) -> None:
    from tests.property.test_vs import check_witness

    formula = read(text)
    assert isinstance(formula, Exists)
    result = run(text)
    assert result.formula == TRUE
    check_witness(formula.body, {}, next(result.answers).witness(budget=Budget(10)))


def test_too_high_a_degree_stays() -> None:
    result = run("ex x, y. x^5 - x - a = 0 and y > x and y < b")
    (left,) = result.remaining
    assert left.variables == ("x",)
    assert "y" not in left.body.free


def test_an_equation_of_low_degree_saves_high_ones() -> None:
    """A Gauss constituent of degree 1 makes the degree of all other atoms irrelevant."""
    result = run("ex x. x = a + 1 and x^5 - x > 3")
    assert not result.remaining
    agree(result.formula, "(a + 1)^5 - a - 1 > 3")


def test_a_factored_equation_is_split() -> None:
    result = run("ex x, y. (x - y)*(x^3 + y - 1) = 0 and y > a and x < 0")
    assert all("y" not in r.variables for r in result.remaining)


RING = Ring.of(("a", "x", "y"))


def test_settled_atoms_are_strict_and_tried_before() -> None:
    matrix = read("ex x. x > a and x > b and x >= c and x /= d and x^2 <= f").body  # type: ignore[attr-defined]
    x = next(iter(matrix.args)).poly.ring.index["x"]
    found = bounds(matrix, x, 1, NOTHING)
    assert found is not None
    tried: set[Atom] = set()
    for candidate, settled in in_order(found):
        assert settled <= tried
        assert all(a.relation.is_strict for a in settled)
        if candidate.point.epsilon:
            assert settled == {a for a in tried if a.relation.is_strict and a != candidate.source}
        tried.add(candidate.source)
    assert len(tried) == 5


def test_settled_atoms_lose_only_the_zero_case() -> None:
    matrix = read("ex x. x > a and x > b").body  # type: ignore[attr-defined]
    first, second = matrix.args
    ring = first.poly.ring
    found = bounds(first, ring.index["x"], 1, NOTHING)
    assert found is not None
    point = found[0].point
    assert point.epsilon == 1
    full = Substitution(ring.index["x"], point, NOTHING)(second)
    short = Substitution(ring.index["x"], point, NOTHING, frozenset((second,)))(second)
    agree(full, "a >= b")
    agree(short, "a > b")


@each(
    ("x^2 - a <= 0 and x > b", True),
    ("x^2 - a <= 0 and x^2 - a /= 0 and x > b", True),
    ("a*x^2 - 1 < 0 and a*x^2 - 1 > 0 and (x > b or x = 1)", True),
    ("x^2 - a <= 0 and x^2 - a >= 0 and x > b", False),
    ("x^2 - a = 0 or x > b", False),
    ("(x^2 - a)*(x - b) < 0", False),
    ("x^2 - a < 0 and x^2 - b < 0", False),
    ("(x^2 - a)^2 > 0", False),
    ("x > b", False),
    ("x^3 - a < 0 and x^2 < b", False),
)
def test_lone_quadratic(text: str, alone: bool) -> None:
    matrix = read(text)
    ring = next(iter(polynomials(matrix))).ring
    assert (lone_quadratic(matrix, ring.index["x"]) is not None) == alone


@each(
    ("x^2 - a <= 0 and x^2 - 2*x - b < 0 and x > c", 2),
    ("a - x^2 >= 0 and (a^2 + 1)*x^2 - b < 0", 2),
    ("x^2 - a <= 0 and x^2 - b >= 0", 1),
    ("x^2 - a <= 0 and (x^2 - a < 0 or x > b)", 0),
    ("x^2 - a <= 0 and (x^2 - b < 0 or x > b)", 1),
    ("a*x^2 - 1 <= 0", 0),
    ("a > 0 and a*x^2 - 1 <= 0", 1),
    ("x^2 - a <= 0 or x^2 - b <= 0", 0),
    ("x^2 - 1 <= 0", 0),
    ("x^2 - a = 0 and x^2 - b /= 0", 0),
)
def test_convex_family(text: str, size: int) -> None:
    matrix = read(text)
    x = next(iter(polynomials(matrix))).ring.index["x"]
    assert len(convex_family(matrix, x, NOTHING.extended(conjuncts(matrix)))) == size


def test_vertices_and_crossings_of_circles() -> None:
    """Discs are met by rational points only: no answer mentions a square root."""
    result = run("ex x, y. x^2 + y^2 <= 4 and (x - a)^2 + y^2 <= 1 and (x - 1)^2 + (y - 1)^2 <= 1")
    assert not result.remaining
    assert not any("sqrt" in str(answer) for answer in result.answers)
    third = run("ex x, y. x^2 + y^2 <= 4 and (x - a)^2 + y^2 <= 1 and x = 1 and y = 1").formula
    for value in (Fraction(k, 8) for k in range(-20, 30)):
        if holds_at(third, {"a": value}):
            assert holds_at(result.formula, {"a": value})


def test_incomplete_sources_do_not_settle() -> None:
    matrix = read("x^2 - a < 0 and x > b and x < c")
    found = without_radicals(matrix, next(iter(polynomials(matrix))).ring.index["x"], NOTHING)
    assert found is not None
    quadratic = {a for a in atoms(matrix) if isinstance(a, Atom) and a.poly.total_degree == 2}
    assert all(not settled & quadratic for _, settled in in_order((*reversed(found), *found)))
    assert any(settled for _, settled in in_order(found))


def test_an_equation_written_as_two_inequalities() -> None:
    agree(run("ex x. x^2 - a <= 0 and x^2 - a >= 0 and x > b").formula, "a >= 0 and (b < 0 or b^2 < a)")


def test_thinning() -> None:
    text = "a*x <= 0 and a - 1 >= 0 and x*y - a*y = 0 and (a^2 - a)*y + a*x >= 0"
    weak = read(text)
    assert isinstance(weak, And)
    ring = next(iter(weak.args)).poly.ring
    block = frozenset((ring.index["x"], ring.index["y"]))
    assert not is_open(weak, block)
    thin = thinned(weak, block)
    assert is_open(thin, block)
    agree(thin, "(a*x < 0 or a = 0) and a >= 1 and false and (false or a = 0)")
    thin = thinned(disj(weak.args), block)
    agree(thin, "a*x < 0 or a = 0 or a >= 1 or false or (a^2 - a)*y + a*x > 0 or a = 0")


def test_root_atoms_with_the_variable_stay() -> None:
    from qe.formula.build import root_atom
    from qe.formula.syntax import Relation

    x, a = RING.gen(1), RING.gen(0)
    matrix = conj((root_atom("x", Relation.GT, x**2 - a, 1), Atom(a, Relation.GT)))
    result = eliminate_block(("x",), matrix, budget=Budget(10), simplify=simplify)
    assert result.remaining
    assert result.remaining[0].variables == ("x",)


def test_answers_print() -> None:
    answers = [str(a) for a in run("ex x. a*x^2 + b*x + c = 0").answers]
    assert any("sqrt" in a and "if" in a for a in answers)
