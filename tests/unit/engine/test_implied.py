"""Inequalities without interior points: the equations of their affine hull, equivalent, shorter and proved."""

import random

import qe
from qe.io import formats
from qe.proof.answer import Guarantee
from tests.tables import each

POINT = """x + 2*y <= 5 and 3*x + y <= 8 and 2*x + y + 4 >= 0 and x + 4*y + 7 >= 0
    and all u, v. (u + 2*v > 5 or 3*u + v > 8 or 2*u + v + 4 < 0 or u + 4*v + 7 < 0 or u + v <= x + y)"""


def test_the_only_optimum_of_a_linear_programme_is_two_equations() -> None:
    answer = qe.eliminate(POINT, check=True)
    assert str(answer.formula) == "x = 11/5 and y = 7/5"
    assert answer.guarantee is Guarantee.CHECKED and not answer.unchecked_steps


@each(
    ("x + y <= 1 and 2*x + y >= 1 and x <= 0 and y <= 1", "x = 0 and y = 1"),
    ("x + y + z <= 1 and x + y + z >= 1 and 2*x >= y and 2*x - y - z >= 3 and x <= 5", None),
    ("x >= 1 and y >= 1 and x + y <= 1 and x >= y", "false"),
    ("x >= 0 and y >= 0 and x + y <= 1", None),
)
def test_equations_come_first(text: str, wanted: str | None) -> None:
    answer = qe.eliminate(f"ex t. t = 0 and {text}", check=True)
    assert answer.guarantee is Guarantee.CHECKED
    assert qe.equivalent(answer.formula, text)
    if wanted is not None:
        assert qe.equivalent(wanted, text) and len(str(answer.formula)) <= len(wanted) + 4


def test_random_polytopes_without_interior_points() -> None:
    rng = random.Random(3)
    for _ in range(25):
        rows = [[rng.randint(-3, 3) for _ in range(3)] for _ in range(rng.randint(3, 5))]
        point = [rng.randint(-2, 2) for _ in range(3)]
        value = [sum(a * b for a, b in zip(row, point, strict=True)) for row in rows]
        form = [f"{r[0]}*x + {r[1]}*y + {r[2]}*z" for r in rows]
        total = " - ".join(f"({f})" for f in form)
        parts = [f"{f} <= {v}" for f, v in zip(form, value, strict=True)]
        parts.append(f"-{total} <= {-sum(value)}".replace("--", "").replace("-(", "0 - (", 1))
        text = " and ".join(parts)
        answer = qe.eliminate(f"ex t. t = 0 and {text}", check=True)
        assert answer.guarantee is Guarantee.CHECKED
        assert qe.equivalent(answer.formula, text), text
        assert len(str(answer.formula)) <= len(str(formats.read(text, "text"))) + 2


@each(
    ("all t. 0 <= t and t <= 1 -> x^2 + (y - t^3)^2 <= 1/4", "x = 0 and y = 1/2"),
    ("all t. 0 <= t and t <= 1 -> (x - t)^2 + (y - t^2)^2 <= 1/2", "x = 1/2 and y = 1/2"),
    ("x^2 + y^2 <= 2 and x + y >= 2 and z <= 3", "x = 1 and y = 1 and z <= 3"),
    ("ex t. t = 0 and x^2 + y^2 <= 1 and (x - 3)^2 + y^2 <= 4", "x = 1 and y = 0"),
    ("x^2 + y^2 + z^2 <= 1 and (x - 2)^2 + y^2 + z^2 <= 1", "x = 1 and y = 0 and z = 0"),
    ("x^2 + y^2 <= 3 and x + y >= 2 and z <= 3", "x^2 + y^2 <= 3 and x + y >= 2 and z <= 3"),
    ("x^2 + y^2 <= 2 and x^2 - y^2 >= 2", None),
)
def test_two_discs_that_touch_are_a_point(text: str, wanted: str | None) -> None:
    """Two touching discs were printed where the point is the answer."""
    answer = qe.eliminate(text, check=True)
    assert answer.guarantee is Guarantee.CHECKED and qe.equivalent(answer.formula, wanted or text)
    assert wanted is None or len(str(answer.formula)) == len(wanted)
    plainly = qe.eliminate(text, without="shortening")
    assert qe.equivalent(plainly.formula, answer.formula)
