"""Solutions near infinity are taken first; the rest may be told apart by the sign of one polynomial."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import written
from tests.unit.proving.elaborated import refused

RULE = "infinity first"


def by(cases: list[str], parts: list[Any] | None = None, variable: str = "x") -> dict[str, Any]:
    parts = [[] for _ in range(len(cases) + 1)] if parts is None else parts
    return {"variable": variable, "cases": [written(case) for case in cases], "parts": parts}


def test_true_near_infinity_is_all() -> None:
    assert refused(RULE, "ex x. x^2 > a", "true", by(["true"])) == ""
    assert refused(RULE, "ex x. x < a", "true", by(["true"])) == ""
    assert refused(RULE, "all x. x^2 < a", "false", by(["true"])) == ""
    assert refused(RULE, "ex x. x^2 < a", "true", by(["true"])) != ""
    assert refused(RULE, "all x. x^2 < a", "true", by(["true"])) != ""


def test_nothing_near_infinity_leaves_the_block() -> None:
    block = "ex x. x^2 < a"
    assert refused(RULE, block, block, by(["true"])) == ""
    cases = "(ex x. x^2 < a and b > 0) or (ex x. x^2 < a and b <= 0)"
    assert refused(RULE, block, cases, by(["b > 0", "b <= 0"])) == ""
    three = "(ex x. x^2 < a and b > 0) or (ex x. x^2 < a and b = 0) or (ex x. x^2 < a and b < 0)"
    assert refused(RULE, block, three, by(["b > 0", "b = 0", "b < 0"])) == ""
    assert refused(RULE, block, three, by(["b > 0", "b <= 0"]))
    assert refused(RULE, block, "ex x. x^2 < a and b > 0", by(["b > 0", "b <= 0"]))


@each(["b > 0", "b < 0"], ["b > 0"], ["b > 0", "c <= 0"], [])
def test_cases_that_leave_something_out(cases: list[str]) -> None:
    after = " or ".join(f"(ex x. x^2 < a and {case})" for case in cases) or "false"
    assert refused(RULE, "ex x. x^2 < a", after, by(cases))


@each(
    ("ex x. x^2 < a", by(["true"], [[]]), "expected 2 lists"),
    ("ex x. x^2 < a", by(["true"], variable="a"), "the one variable"),
    ("ex x, y. x^2 < y", by(["true"]), "the one variable"),
    ("x > a", by(["true"]), "the one variable"),
    ("ex x. x > root(1, x^2 - a, x)", by(["true"]), "no root atoms"),
)
def test_what_is_refused(before: str, evidence: Any, reason: str) -> None:
    assert refused(RULE, before, before, evidence), reason
