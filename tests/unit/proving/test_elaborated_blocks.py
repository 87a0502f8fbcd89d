"""Steps about one block, of rules that are no primitives: those of the theorem are the kernel's, no others are.

A row is a step: before, after, its evidence. What its rule says of it is checked for every row alike: a true step is
accepted, its negation is refused, and so is the step to ``true`` or ``false`` where that is something else.
"""

from typing import Any

import qe
from qe.formula.build import conj
from qe.formula.counting import without_root_atoms
from qe.formula.traverse import conjuncts
from qe.io.text import read
from tests.tables import each
from tests.unit.certify.claims import line, written
from tests.unit.proving.elaborated import Row, is_a_step_and_no_other_is, refused, rows

GUARD = "linear equation solved under a guard"
FAR, ZEROS = "infinity first", "conditions on zeros that follow"
ROOTS = "roots counted"


# The two cases of a coefficient that may vanish.
LINE = {"solved": [["x", line("a*x - b"), None]]}
BEFORE = "ex x. a*x = b and x > c"
CASES = "(a /= 0 and a*b > a^2*c) or (ex x. a = 0 and b = 0 and x > c)"
PLANE = "(ex y. a /= 0 and a*b > a^2*y) or (ex x, y. a = 0 and b = 0 and x > y)"
SUM = "(a + b /= 0 and (a + b)*c^3 < (a + b)^4) or (ex x. a + b = 0 and c = 0 and x^3 < 1)"


NOT_BOTH, EITHER = "(x /= 0 or y /= 0)", "(x = 0 or y = 0)"


def far(cases: list[str], parts: list[Any] | None = None, variable: str = "x") -> dict[str, Any]:
    parts = [[] for _ in range(len(cases) + 1)] if parts is None else parts
    return {"variable": variable, "cases": [written(case) for case in cases], "parts": parts}


def told_apart(*cases: str) -> str:
    return " or ".join(f"(ex x. x^2 < a and {case})" for case in cases) or "false"


def without(gone: str, kept: str) -> Row:
    return f"ex x, y. {gone} and {kept}", f"ex x, y. {kept}", {}


def counted(text: str, first: int = 0, last: int | None = None) -> Row:
    """Comparisons with roots in numbers of roots, or only some conjuncts of them."""
    after = without_root_atoms(read(text))
    return read(text), conj(conjuncts(after)[first:last]) if first or last else after, {}


RELATIONS = (">", ">=", "=", "<", "<=", "/=")
AT_ROOT = {k: [f"x {relation} root({k}, x^2 - a, x)" for relation in RELATIONS] for k in (1, -1, 2)}
MAY_VANISH = "x > root(1, b*x - a, x)"
BESIDE = "c > 0 and not x > root(1, x - a, x) and (ex y. y > root(1, y^3 - x, y))"
OTHER_ROOTS = [(one, other) for k, at in AT_ROOT.items() for one in at for other in (at if k == 1 else at[:1])]

TRUE_STEPS: dict[str, list[Row]] = {
    GUARD: [
        (BEFORE, CASES, LINE),
        (BEFORE.replace("c", "c^2"), CASES.replace("c", "c^2"), LINE),
        ("ex x, y. a*x = b and x > y", PLANE, LINE),
        ("ex x. a*x = b and c > 0", "(a /= 0 and c > 0) or (ex x. a = 0 and b = 0 and c > 0)", LINE),
        (
            "ex x. a*x = 0 and x = c",
            "(a /= 0 and a*c = 0) or (ex x. a = 0 and x = c)",
            {"solved": [["x", line("a*x"), None]]},
        ),
        ("ex x. (a + b)*x = c and x^3 < 1", SUM, {"solved": [["x", line("(a + b)*x - c"), None]]}),
    ],
    FAR: [
        ("ex x. x^2 > a", "true", far(["true"])),
        ("ex x. x < a", "true", far(["true"])),
        ("all x. x^2 < a", "false", far(["true"])),
        ("ex x. x^2 < a", "ex x. x^2 < a", far(["true"])),  # nothing near infinity leaves the block
        ("ex x. x^2 < a", told_apart("b > 0", "b <= 0"), far(["b > 0", "b <= 0"])),
        ("ex x. x^2 < a", told_apart("b > 0", "b = 0", "b < 0"), far(["b > 0", "b = 0", "b < 0"])),
    ],
    ZEROS: [
        *(without(NOT_BOTH, kept) for kept in ("x*y + 2 < 0", "x*y - 2 > 0", "x^2 + y^2 /= 0")),
        *(without(NOT_BOTH, kept) for kept in ("(x*y - 2 > 0 or x /= 0)", "(x*y - 2 > 0 and z > 0)")),
        # A power is positive only where it is even and its variable is not zero.
        *(without(EITHER, kept) for kept in ("x^2*y^2 <= 0", "-x^2*y^2 >= 0")),
        ("all x, y. x = 0 and y = 0 or x*y + 2 >= 0", "all x, y. x*y + 2 >= 0", {}),
    ],
    ROOTS: [
        *(counted(atom) for at in AT_ROOT.values() for atom in at),
        counted(MAY_VANISH),
        counted(BESIDE),
        ("c > 0", "c > 0", {}),
    ],
}

FALSE_STEPS: dict[str, list[Row]] = {
    GUARD: [
        (BEFORE, "(a /= 0 and b > a*c) or (ex x. a = 0 and b = 0 and x > c)", LINE),
        (BEFORE, "a*b > a^2*c or (ex x. a = 0 and b = 0 and x > c and x < 0)", LINE),
        (BEFORE, "(a /= 0 and a*b > a^2*c) or (ex x. a = 0 and x > c)", LINE),
        (BEFORE, "a /= 0 and a*b > a^2*c", LINE),
        (BEFORE, CASES, {"solved": []}),
        (BEFORE, CASES, {"solved": LINE["solved"] * 2}),
        (BEFORE, CASES, {"solved": [["x", line("b*x - a"), None]]}),
        (BEFORE, CASES, {"solved": [["y", line("a*x - b"), None]]}),
    ],
    FAR: [
        ("ex x. x^2 < a", "true", far(["true"])),
        ("all x. x^2 < a", "true", far(["true"])),
        ("ex x. x^2 < a", told_apart("b > 0", "b = 0", "b < 0"), far(["b > 0", "b <= 0"])),
        ("ex x. x^2 < a", "ex x. x^2 < a and b > 0", far(["b > 0", "b <= 0"])),
        # Cases that are not all.
        *(
            ("ex x. x^2 < a", told_apart(*cases), far(cases))
            for cases in (["b > 0", "b < 0"], ["b > 0"], ["b > 0", "c <= 0"], [])
        ),
        ("ex x. x^2 < a", "ex x. x^2 < a", far(["true"], [[]])),
        ("ex x. x^2 < a", "ex x. x^2 < a", far(["true"], variable="a")),
        ("ex x, y. x^2 < y", "ex x, y. x^2 < y", far(["true"])),
        ("x > a", "x > a", far(["true"])),
        ("ex x. x > root(1, x^2 - a, x)", "ex x. x > root(1, x^2 - a, x)", far(["true"])),
    ],
    ZEROS: [
        *(without(NOT_BOTH, kept) for kept in ("x*y + 2 > 0", "x*y - 2 < 0", "x*y + 2 >= 0", "x^2 + y^2 = 0")),
        *(
            without(NOT_BOTH, kept)
            for kept in ("x*y + z < 0", "x*y + z /= 0", "x + z^2 > 0", "(x*y - 2 > 0 or z /= 0)")
        ),
        *(without(EITHER, kept) for kept in ("x^2*y^2 >= 0", "x^2*y^2 > 0", "x*y^2 <= 0", "x^2*z^2 <= 0")),
        ("all x, y. x = 0 and y = 0 or x*y + 2 < 0", "all x, y. x*y + 2 < 0", {}),
        (f"ex x, y. {NOT_BOTH} and x*y > 2", f"all x, y. {NOT_BOTH} and x*y > 2", {}),
        (f"ex x, y. {NOT_BOTH} and x*y > 2", "ex x. x*y > 2", {}),
        (f"ex x, y. {NOT_BOTH} and x*y > 2", "ex x, y. x*y > 2 and x > 0", {}),
        ("ex x, y. (ex z. x*z /= 0) and x*y > 2", "ex x, y. x*y > 2", {}),
    ],
    ROOTS: [
        *((read(one), counted(other)[1], {}) for one, other in OTHER_ROOTS if one != other),
        counted(MAY_VANISH, 0, 1),  # a polynomial that may vanish has no roots then
        counted(BESIDE, 1),
        ("c > 0", "c >= 0", {}),
        ("c > 0", "c > 0", {"theory": 1}),
    ],
}


@each(*rows(TRUE_STEPS))
def test_a_true_step_is_one_of_the_kernel_and_no_other(rule: str, before: Any, after: Any, evidence: Any) -> None:
    assert is_a_step_and_no_other_is(rule, before, after, evidence)


@each(*rows(FALSE_STEPS))
def test_a_false_step_is_none(rule: str, before: Any, after: Any, evidence: Any) -> None:
    assert refused(rule, before, after, evidence)


def test_names_of_roots_that_the_formula_has_are_others() -> None:
    answer = qe.eliminate("x <= root(1, b*x - a) and t_0 > x", check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps


def test_the_kernel_alone_believes_roots_that_are_counted() -> None:
    answer = qe.eliminate("all y. x < root(2, x^2 - y) or y < 3", check=True, process=False)
    assert answer.certificate is not None and qe.verify(answer.certificate, core=True).accepted
