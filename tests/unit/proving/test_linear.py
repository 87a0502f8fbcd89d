"""The two cases of a coefficient that may vanish, in steps of the kernel."""

from typing import Any

import pytest

from tests.tables import each
from tests.unit.certify.claims import line
from tests.unit.proving.elaborated import refused

RULE = "linear equation solved under a guard"
BEFORE = "ex x. a*x = b and x > c"
AFTER = "(a /= 0 and a*b > a^2*c) or (ex x. a = 0 and b = 0 and x > c)"


def by(*solved: list[Any]) -> dict[str, Any]:
    return {"solved": [*solved]}


SOLVED = ["x", line("a*x - b"), None]


@each(
    (BEFORE, AFTER, SOLVED),
    (BEFORE.replace("c", "c^2"), AFTER.replace("c", "c^2"), SOLVED),
    (
        "ex x, y. a*x = b and x > y",
        "(ex y. a /= 0 and a*b > a^2*y) or (ex x, y. a = 0 and b = 0 and x > y)",
        SOLVED,
    ),
    ("ex x. a*x = b and c > 0", "(a /= 0 and c > 0) or (ex x. a = 0 and b = 0 and c > 0)", SOLVED),
    ("ex x. a*x = 0 and x = c", "(a /= 0 and a*c = 0) or (ex x. a = 0 and x = c)", ["x", line("a*x"), None]),
    (
        "ex x. (a + b)*x = c and x^3 < 1",
        "(a + b /= 0 and (a + b)*c^3 < (a + b)^4) or (ex x. a + b = 0 and c = 0 and x^3 < 1)",
        ["x", line("(a + b)*x - c"), None],
    ),
)
def test_two_cases(before: str, after: str, solved: list[Any]) -> None:
    assert not refused(RULE, before, after, by(solved))


@each(
    "(a /= 0 and b > a*c) or (ex x. a = 0 and b = 0 and x > c)",
    "a*b > a^2*c or (ex x. a = 0 and b = 0 and x > c and x < 0)",
    "(a /= 0 and a*b > a^2*c) or (ex x. a = 0 and x > c)",
    "a /= 0 and a*b > a^2*c",
)
def test_other_cases(after: str) -> None:
    assert refused(RULE, BEFORE, after, by(SOLVED))


OTHER: list[list[Any]] = [[], [SOLVED, SOLVED], [["x", line("b*x - a"), None]], [["y", line("a*x - b"), None]]]


@pytest.mark.parametrize("solved", OTHER)
def test_other_evidence(solved: list[Any]) -> None:
    assert refused(RULE, BEFORE, AFTER, by(*solved))
