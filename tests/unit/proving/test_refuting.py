"""Evidence that refutes lists of formulas: read by the checker's theory, no more of it than is needed."""

import pytest

from qe.certify.registry import RULES
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.formula.syntax import TRUE, Formula
from qe.io.text import read
from qe.kernel.boolean import ByLemmas, equivalence
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.options import Budget
from qe.proof.entry import Entry, Json
from qe.proving.goals import is_hopeless, polynomials_outside
from qe.proving.lemmas import refuting
from tests.tables import each

RING = Ring.of(("a", "x", "y", "z"))
LIMITS = limits_of(Budget(), RULES)


def goal(*texts: str) -> list[Formula]:
    return [convert(read(text), RING) for text in texts]


def lemmas(*goals: list[Formula]) -> list[dict[str, Json]] | None:
    evidence = refuting(goals, RING, LIMITS)
    if evidence is None:
        return None
    ByLemmas(lambda claim, context: list(map(tuple, goals)))(
        Claim("signs", TRUE, TRUE, RING, Entry({"theory": evidence}, "evidence"), "step"), (), LIMITS
    )
    assert isinstance(evidence, dict)
    return evidence["lemmas"]  # type: ignore[return-value]


@each(
    (("x > 0", "x <= 0"), 0),
    (("x > 1", "x < 0"), 1),
    (("x > y", "y > z", "z > x"), 1),
    (("x^2 + 2*x + 2 <= 0",), 1),
    (("x^2*y^2 + a^4 + 1 < 0",), 1),
    (("x*y = 0", "x /= 0", "y > 0"), 1),
    (("x = a + 1", "x^2 < a^2 + 2*a + 1"), 1),
    (("x > 0", "x^5 + x < 0"), None),
    (("a = 1", "x = a", "y = x", "y > 2"), None),
)
def test_what_is_refuted(texts: tuple[str, ...], count: int | None) -> None:
    found = lemmas(goal(*texts))
    assert found is not None and (count is None or len(found) == count)


@pytest.mark.parametrize("texts", [("x > 0",), ("x > 1", "x < 2"), ("x^2 + 2*x + 1 <= 0",), ("x*y = 0", "x /= 0")])
def test_what_holds_somewhere_is_not(texts: tuple[str, ...]) -> None:
    assert lemmas(goal(*texts)) is None


def test_all_goals_are_refuted_or_none() -> None:
    false, true = goal("x > 1", "x < 0"), goal("x > 0")
    assert lemmas(false, false) is not None and lemmas(false, true) is None


def test_polynomials_under_quantifiers_stay_outside() -> None:
    found = polynomials_outside(goal("x > 0 and (y = 1 or z /= 2)", "ex z. z*x > a", "x = 0"))
    assert {str(p): e for p, e in found.items()} == {"Poly(x)": True, "Poly(y - 1)": True, "Poly(z - 2)": True}


def test_cases_that_repeat_many_conditions_are_no_search() -> None:
    """Fifteen disjunctions in every case of a product took two to the fifteen cases."""
    rest = " and ".join(f"(x*z + {k}*y /= 0 or y*z + {k} /= 0)" for k in range(1, 16))
    before = f"x*y = 0 and {rest}"
    after = f"x = 0 and {rest} or y = 0 and x /= 0 and {rest}"
    goals = equivalence(*goal(before, after), ())
    assert lemmas(*map(list, goals))


def test_a_condition_that_is_dropped_from_a_case_is_not_taken_for_repeated() -> None:
    wrong = equivalence(*goal("x*y = 0 and (z > 0 or x > 1)", "x = 0 and z > 0 or y = 0 and (z > 1 or x > 1)"), ())
    assert refuting(wrong, RING, LIMITS) is None


def test_values_of_several_variables_are_put_in_at_once() -> None:
    given = goal("2*x - 1 = 0 and y = 0", "8*x^3*z + y*(a + z)^2 - x*y^2 - z /= 0")
    assert len(lemmas(given) or []) == 1


@each(
    (("x > 0", "all y. y*x > z"), True),
    (("ex y. y*x <= z", "all y. y*x > z"), False),
    (("x > 0", "x < 0 or ex y. y*x > z"), True),
    (("x > 0", "x < 0"), False),
)
def test_a_quantified_part_of_which_nothing_else_speaks_is_not_refuted(texts: tuple[str, ...], hopeless: bool) -> None:
    assert is_hopeless(goal(*texts)) is hopeless
    if hopeless:
        assert refuting([goal(*texts)], RING, LIMITS) is None


def test_what_is_no_combination_of_equations_is_seen_by_its_remainder() -> None:
    """Cofactors of x*y - 1 were looked for in three degrees."""
    goals = equivalence(*goal("x^2 + y^2 - 1 = 0 and x*z - y = 0", "x^2 + y^2 - 1 = 0 and x*z^2 - y*z + a = 0"), ())
    assert refuting(goals, RING, LIMITS) is None
    same = equivalence(*goal("x^2 - y*z = 0 and y^2 - x*z = 0", "x^2 - y*z = 0 and y^2 - x*z = 0 and x^3 = y^3"), ())
    assert lemmas(*map(list, same))


def test_a_condition_that_equations_of_high_degree_turn_into_another() -> None:
    """The difference of the equations gives x^2*y^2, but their cofactors have degrees beyond those tried at first."""
    equations = "81*x^6*y^6 + 9*x^2*y^2 - a^2 = 0 and 81*x^6*y^6 + 144*x^2*y^2 - 64*z^2 = 0"
    sides = (f"{equations} and 9*x^4*y^4 - 2 > 0", f"{equations} and a^4 - 128*a^2*z^2 + 4096*z^4 - 4050 > 0")
    assert lemmas(*map(list, equivalence(*goal(*sides), ())))
    wrong = (sides[0], f"{equations} and a^4 - 128*a^2*z^2 + 4096*z^4 - 4051 > 0")
    assert refuting(equivalence(*goal(*wrong), ()), RING, LIMITS) is None
