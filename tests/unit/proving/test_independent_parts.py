"""Conjuncts without a common variable of the block, solved apart and by steps of their own."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, step, written
from tests.unit.proving.elaborated import refused

RULE = "independent parts"


def piece(body: str, *steps: Any, together: Any = False) -> dict[str, Any]:
    return {"body": written(body), "together": together, "steps": list(steps)}


def solved(body: str, variable: str, equation: str, after: str) -> dict[str, Any]:
    evidence = {"solved": [[variable, equation, 1]], "theory": NO_LEMMAS}
    return step("linear equation solved", f"ex {variable}. {body}", after, evidence)


X = piece("x = a and x > b", solved("x = a and x > b", "x", "-a + x", "a > b"))
Y = piece("y = c and y^3 < b", solved("y = c and y^3 < b", "y", "-c + y", "c^3 < b"))
BLOCK = "ex x, y. x = a and x > b and y = c and y^3 < b and a > 0"
ANSWER = "a > 0 and a > b and c^3 < b"


def test_the_conjunction_of_what_the_parts_lead_to() -> None:
    assert refused(RULE, BLOCK, ANSWER, {"pieces": [X, Y]}) == ""
    stays = "a > 0 and a > b and (ex y. y = c and y^3 < b)"
    assert refused(RULE, BLOCK, stays, {"pieces": [X, piece("y = c and y^3 < b")]}) == ""


def test_a_part_solved_together_with_what_holds_beside() -> None:
    """With a > 0 known the coefficient is positive; what was used stays as a conjunct."""
    before = "ex x, y. a > 0 and a*x = b and x > c and y > b"
    one = step(
        "linear equation solved",
        "ex x. a > 0 and a*x = b and x > c",
        "a > 0 and b > a*c",
        {"solved": [["x", "a*x - b", 1]], "theory": NO_LEMMAS},
    )
    evidence = {"pieces": [piece("a*x = b and x > c", one, together=True), piece("y > b")]}
    assert refused(RULE, before, "a > 0 and b > a*c and (ex y. y > b)", evidence) == ""
    alone = {"pieces": [piece("a*x = b and x > c", one), piece("y > b")]}
    assert refused(RULE, before, "a > 0 and b > a*c and (ex y. y > b)", alone)


@each(
    (BLOCK, "a > b and c^3 < b", [X, Y], "not the conjunction"),  # what stands beside is left out
    (BLOCK, "a > 0 and a > b", [X], "a conjunct is missing"),
    (BLOCK, ANSWER, [X, X], "share a variable"),
    (BLOCK, ANSWER, [X, Y, piece("y > 7")], "share a variable"),
    ("ex x, y. x = a and y > x and y = c and a > 0", "a > 0", [piece("x = a"), piece("y > x and y = c")], "share"),
    (BLOCK, f"{ANSWER} and (ex y. y > 7)", [X, piece("y = c and y^3 < b and y > 7")], "not made of conjuncts"),
    (BLOCK.replace("ex", "all"), ANSWER, [X, Y], "existential block"),
    (BLOCK, "false", [X, Y], "not the conjunction"),
)
def test_other_parts(before: str, after: str, pieces: Any, reason: str) -> None:
    assert refused(RULE, before, after, {"pieces": pieces}), reason


def test_one_part_that_is_false_is_enough() -> None:
    never = step("signs", "ex x. x > a and x < a", "false", {"theory": NO_LEMMAS})
    before = "ex x, y. x > a and x < a and y > b and c > 0"
    assert refused(RULE, before, "false", {"pieces": [piece("x > a and x < a", never)]}) == ""
    assert refused(RULE, before, "c > 0", {"pieces": [piece("x > a and x < a", never)]})


def test_only_what_was_known_is_taken_away_again() -> None:
    """What is not known stays in the answer of a part, also inside a disjunction."""
    before = "ex x. c > 0 and (x > a or c > 0)"
    one = step("signs", "ex x. c > 0 and (x > a or c > 0)", "c > 0", {"theory": NO_LEMMAS})
    assert refused(RULE, before, "c > 0", {"pieces": [piece("x > a or c > 0", one, together=True)]}) == ""


def test_one_part_of_all_conjuncts() -> None:
    assert refused(RULE, "ex x. x = a and x > b", "a > b", {"pieces": [X]}) == ""


def test_what_was_known_is_true_inside_a_part() -> None:
    """c > 0 stands beside, so that of "c > 0 or a > b" nothing is left."""
    before = "ex x. c > 0 and x = a and (c > 0 or x > b)"
    one = solved("c > 0 and x = a and (c > 0 or x > b)", "x", "-a + x", "c > 0 and (c > 0 or a > b)")
    evidence = {"pieces": [piece("x = a and (c > 0 or x > b)", one, together=True)]}
    assert refused(RULE, before, "c > 0", evidence) == ""
