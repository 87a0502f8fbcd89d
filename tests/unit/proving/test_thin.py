"""Universal blocks that are false, or true only where a linear equation of the parameters holds."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, line, step
from tests.unit.proving.elaborated import refused

RULE = "degenerate truth set"


def by(values: list[str], parts: list[Any], equation: Any = None, variable: str = "y") -> dict[str, Any]:
    written = [equation[0], line(equation[1])] if equation else None
    return {"variable": variable, "values": values, "equation": written, "parts": parts}


def contradiction(before: str) -> list[Any]:
    return [step("signs", before, "false", {"theory": NO_LEMMAS})]


SIGNS = [contradiction(f"ex a. a >= 0 and a <= 0 and a {sign} 0") for sign in "<>"]
TWICE = "all y. (2*a - b)*y >= 0 and a > 1"
HALF = [contradiction(f"ex a, b. 2*a - b >= 0 and a > 1 and 2*a - b <= 0 and 2*a - b {sign} 0") for sign in "><"]


@each(
    ("all y. a*y > 1", "false", by(["0"], [[]])),
    ("all y. a*y > 1 or y > 3", "false", by(["5", "0"], [[]])),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], SIGNS, ["a", "a"])),
    (TWICE, "2*a - b = 0 and (all y. b > 2)", by(["1", "-1"], HALF, ["a", "2*a - b"])),
    (TWICE, "2*a - b = 0 and (all y. a > 1)", by(["1", "-1"], HALF, ["b", "2*a - b"])),
)
def test_instances_without_a_common_solution(before: str, after: str, evidence: Any) -> None:
    assert refused(RULE, before, after, evidence) == ""


@each(
    ("all y. a*y > 1", "false", by(["1"], [[]]), "no common solution"),
    ("all y. a*y > 1", "false", by([], [[]]), "no common solution"),
    ("all y. a*y > 1", "true", by(["0"], [[]]), "not what the theorem gives"),
    ("all y. a*y > 1", "a = 0", by(["0"], [[]]), "not what the theorem gives"),
    ("all y. a*y > 1", "false", by(["0"], [[], []]), "expected 1 lists"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], SIGNS[:1], ["a", "a"]), "expected 2 lists"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], [SIGNS[0], SIGNS[0]], ["a", "a"]), "does not stand there"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], [SIGNS[0], []], ["a", "a"]), "no common solution"),
    ("all y. a*y >= 0", "a /= 0", by(["1", "-1"], SIGNS, ["a", "a"]), "not what the theorem gives"),
    (TWICE, "2*a - b = 0", by(["1", "-1"], HALF, ["a", "2*a - b"]), "not what the theorem gives"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], SIGNS, ["a", "a + y"]), "an equation of the parameters"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], SIGNS, ["a", "a^2"]), "linear in the variable"),
    ("all y. a*y >= 0", "a = 0", by(["1", "-1"], SIGNS, ["y", "y"]), "a variable of the block"),
    ("ex y. a*y > 1", "false", by(["0"], [[]]), "universal block"),
    ("all y, x. a*y > x", "false", by(["0"], [[]]), "universal block"),
    ("all y. a*y > 1", "false", by(["0"], [[]], variable="x"), "universal block"),
    ("all y. (ex x. x > y) and a*y > 1", "false", by(["0"], [[]]), "quantifier-free"),
)
def test_what_is_refused(before: str, after: str, evidence: Any, reason: str) -> None:
    assert refused(RULE, before, after, evidence), reason
