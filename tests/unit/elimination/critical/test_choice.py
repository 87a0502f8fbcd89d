"""When the planner takes critical values."""

import qe
from qe.engine.conditions import convex_conditions
from qe.formula.block import Block
from qe.io import formats
from qe.options import Options
from tests.tables import each

BALLS = "(y - a)^2 + (z - b)^2 <= 1 and y^2 + z^2 <= 4"


@each(
    (("y", "z"), BALLS, True),
    (("y", "z"), f"{BALLS} and 4 - y^2 - a >= 0", True),
    (("y", "z"), BALLS.replace("<= 1", "< 1"), False),
    (("y", "z"), f"{BALLS} and y*z <= a", False),
    (("y", "z"), f"{BALLS} and y = a", False),
    (("y", "z"), f"{BALLS} or y <= a", False),
    (("y", "z"), BALLS.replace("b", "b - c"), False),
    (("y",), "(y - a)^2 + (z - b)^2 <= 1 and y^2 <= 4", False),
    (("y", "z"), "y + z <= a and y >= b and z >= 0", False),
)
def test_convex_conditions_on_several_variables(variables: tuple[str, ...], body: str, expected: bool) -> None:
    problem = Block(variables, formats.read(body, "text"))
    assert (convex_conditions(problem, Options()) is not None) is expected


def test_the_story_tells_it_and_the_method_can_be_asked_for() -> None:
    answer = qe.eliminate(f"ex y, z. {BALLS}", without="balls")
    assert "critical" in answer.stats and str(answer.formula) == "a^2 + b^2 <= 9"
    asked = qe.eliminate("ex y. y^2 <= 1 and y^2 + x*y + x^3 <= 2", method="critical")
    assert "critical" in asked.stats
    assert qe.equivalent(asked, qe.eliminate("ex y. y^2 <= 1 and y^2 + x*y + x^3 <= 2", method="cad"))
    refused = qe.eliminate("ex y. y^2 + x*y^3 = 1 and x*y > 2", method="critical")
    assert refused.formula is None and "bounded" in refused.reason


def test_universal_blocks_by_negation() -> None:
    text = "all y. y^2 <= 1 -> y^3 + x*y <= 2"
    assert qe.equivalent(qe.eliminate(text, method="critical"), qe.eliminate(text, method="cad"))


def test_quantifiers_inside() -> None:
    for relation in ("<", "<="):
        text = f"ex y. y^2 <= 4 and (all z. z^2 <= 1 -> z {relation} x + y)"
        assert qe.equivalent(qe.eliminate(text, method="critical"), qe.eliminate(text, method="cad"))


def test_hypersurfaces_that_are_left_open_are_not_handed_to_another_method() -> None:
    """The inner set is not convex, and leaves curves open on which only decomposition would go on."""
    text = "ex y. y^2 <= 4 and (all z. z^2 <= 1 -> z <= x*y)"
    alone = qe.eliminate(text, method="critical")
    assert alone.formula is None and "critical values alone" in alone.reason
