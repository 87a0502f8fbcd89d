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
from tests.unit.certify.claims import NO_LEMMAS, line, step, written
from tests.unit.proving.elaborated import Row, is_a_step_and_no_other_is, refused, rows

ALTERNATIVES, PARTS, GUARD = "alternatives", "independent parts", "linear equation solved under a guard"
THIN, FAR, ZEROS = "degenerate truth set", "infinity first", "conditions on zeros that follow"
ROOTS = "roots counted"


def solved(body: str, variable: str, equation: str, after: str) -> dict[str, Any]:
    """The step by which a linear equation ends a block."""
    evidence = {"solved": [[variable, equation, 1]], "theory": NO_LEMMAS}
    return step("linear equation solved", f"ex {variable}. {body}", after, evidence)


def signs(before: str, after: str = "false") -> dict[str, Any]:
    return step("signs", before, after, {"theory": NO_LEMMAS})


# The parts of a disjunction solved one by one, each by steps of its own.
TWO = "ex x. x = a and b > 0 or x = c and x > 1"
ONE, OTHER = "x = a and b > 0", "x = c and x > 1"
STEPS = [solved(ONE, "x", "-a + x", "b > 0")], [solved(OTHER, "x", "-c + x", "c > 1")]


def pieces(texts: list[str], *parts: list[Any]) -> dict[str, Any]:
    return {"pieces": [written(text) for text in texts], "parts": list(parts)}


# Conjuncts without a common variable of the block, solved apart and by steps of their own.
def piece(body: str, *steps: Any, together: Any = False) -> dict[str, Any]:
    return {"body": written(body), "together": together, "steps": list(steps)}


def parts(*of: dict[str, Any]) -> dict[str, Any]:
    return {"pieces": list(of)}


X = piece("x = a and x > b", solved("x = a and x > b", "x", "-a + x", "a > b"))
Y = piece("y = c and y^3 < b", solved("y = c and y^3 < b", "y", "-c + y", "c^3 < b"))
BLOCK = "ex x, y. x = a and x > b and y = c and y^3 < b and a > 0"
ANSWER = "a > 0 and a > b and c^3 < b"
POSITIVE = "ex x, y. a > 0 and a*x = b and x > c and y > b"
POSITIVE_ANSWER = "a > 0 and b > a*c and (ex y. y > b)"
POSITIVE_EVIDENCE = {"solved": [["x", "a*x - b", 1]], "theory": NO_LEMMAS}
POSITIVE_PART = "ex x. a > 0 and a*x = b and x > c", "a > 0 and b > a*c", POSITIVE_EVIDENCE
POSITIVE_STEP = step("linear equation solved", *POSITIVE_PART)
KNOWN = solved("c > 0 and x = a and (c > 0 or x > b)", "x", "-a + x", "c > 0 and (c > 0 or a > b)")
NEVER = piece("x > a and x < a", signs("ex x. x > a and x < a"))
EMPTY = "ex x, y. x > a and x < a and y > b and c > 0"

# The two cases of a coefficient that may vanish.
LINE = {"solved": [["x", line("a*x - b"), None]]}
BEFORE = "ex x. a*x = b and x > c"
CASES = "(a /= 0 and a*b > a^2*c) or (ex x. a = 0 and b = 0 and x > c)"
PLANE = "(ex y. a /= 0 and a*b > a^2*y) or (ex x, y. a = 0 and b = 0 and x > y)"
SUM = "(a + b /= 0 and (a + b)*c^3 < (a + b)^4) or (ex x. a + b = 0 and c = 0 and x^3 < 1)"


def thin(values: list[str], parts: list[Any], equation: Any = None, variable: str = "y") -> dict[str, Any]:
    at = [equation[0], line(equation[1])] if equation else None
    return {"variable": variable, "values": values, "equation": at, "parts": parts}


ALWAYS, TWICE = "all y. a*y >= 0", "all y. (2*a - b)*y >= 0 and a > 1"
NOWHERE = [[signs(f"ex a. a >= 0 and a <= 0 and a {sign} 0")] for sign in "<>"]
HALF = [[signs(f"ex a, b. 2*a - b >= 0 and a > 1 and 2*a - b <= 0 and 2*a - b {sign} 0")] for sign in "><"]
BOTH = ["1", "-1"]
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
    ALTERNATIVES: [
        (TWO, "b > 0 or c > 1", pieces([ONE, OTHER], *STEPS)),
        (TWO, f"b > 0 or (ex x. {OTHER})", pieces([ONE, OTHER], STEPS[0], [])),  # no step: the part stays as it is
    ],
    PARTS: [
        (BLOCK, ANSWER, parts(X, Y)),
        (BLOCK, "a > 0 and a > b and (ex y. y = c and y^3 < b)", parts(X, piece("y = c and y^3 < b"))),
        # With a > 0 known the coefficient is positive; what was used stays as a conjunct.
        (POSITIVE, POSITIVE_ANSWER, parts(piece("a*x = b and x > c", POSITIVE_STEP, together=True), piece("y > b"))),
        (EMPTY, "false", parts(NEVER)),  # one part that is false is enough
        # Only what was known is taken away again, also inside a disjunction.
        (
            "ex x. c > 0 and (x > a or c > 0)",
            "c > 0",
            parts(piece("x > a or c > 0", signs("ex x. c > 0 and (x > a or c > 0)", "c > 0"), together=True)),
        ),
        ("ex x. x = a and x > b", "a > b", parts(X)),
        # c > 0 stands beside, so that of "c > 0 or a > b" nothing is left.
        (
            "ex x. c > 0 and x = a and (c > 0 or x > b)",
            "c > 0",
            parts(piece("x = a and (c > 0 or x > b)", KNOWN, together=True)),
        ),
    ],
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
    THIN: [
        ("all y. a*y > 1", "false", thin(["0"], [[]])),
        ("all y. a*y > 1 or y > 3", "false", thin(["5", "0"], [[]])),
        (ALWAYS, "a = 0", thin(BOTH, NOWHERE, ["a", "a"])),
        (TWICE, "2*a - b = 0 and (all y. b > 2)", thin(BOTH, HALF, ["a", "2*a - b"])),
        (TWICE, "2*a - b = 0 and (all y. a > 1)", thin(BOTH, HALF, ["b", "2*a - b"])),
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
    ALTERNATIVES: [
        (TWO, "b > 0", pieces([ONE, OTHER], *STEPS)),
        (TWO, "b > 0 and c > 1", pieces([ONE, OTHER], *STEPS)),
        (TWO, "b > 0", pieces([ONE], STEPS[0])),
        (TWO, "b > 0 or c > 1", pieces([ONE, OTHER, "b < 0"], *STEPS, [])),
        (TWO, "b > 0 or c > 1", pieces([ONE, OTHER], STEPS[0])),
        (TWO, "b > 0 or c > 1", pieces([ONE, OTHER], *STEPS, [])),
        (TWO, "b > 0 or c > 1", pieces([ONE, OTHER], STEPS[1], STEPS[0])),
        (TWO.replace("ex", "all"), "b > 0 or c > 1", pieces([ONE, OTHER], *STEPS)),
    ],
    PARTS: [
        (BLOCK, "a > b and c^3 < b", parts(X, Y)),  # what stands beside is missing
        (BLOCK, "a > 0 and a > b", parts(X)),  # a conjunct is missing
        (BLOCK, ANSWER, parts(X, X)),
        (BLOCK, ANSWER, parts(X, Y, piece("y > 7"))),
        ("ex x, y. x = a and y > x and y = c and a > 0", "a > 0", parts(piece("x = a"), piece("y > x and y = c"))),
        (BLOCK, f"{ANSWER} and (ex y. y > 7)", parts(X, piece("y = c and y^3 < b and y > 7"))),
        (BLOCK.replace("ex", "all"), ANSWER, parts(X, Y)),
        (BLOCK, "false", parts(X, Y)),
        (POSITIVE, POSITIVE_ANSWER, parts(piece("a*x = b and x > c", POSITIVE_STEP), piece("y > b"))),
        (EMPTY, "c > 0", parts(NEVER)),
    ],
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
    THIN: [
        ("all y. a*y > 1", "false", thin(["1"], [[]])),
        ("all y. a*y > 1", "false", thin([], [[]])),
        ("all y. a*y > 1", "true", thin(["0"], [[]])),
        ("all y. a*y > 1", "a = 0", thin(["0"], [[]])),
        ("all y. a*y > 1", "false", thin(["0"], [[], []])),
        (ALWAYS, "a = 0", thin(BOTH, NOWHERE[:1], ["a", "a"])),
        (ALWAYS, "a = 0", thin(BOTH, [NOWHERE[0], NOWHERE[0]], ["a", "a"])),
        (ALWAYS, "a = 0", thin(BOTH, [NOWHERE[0], []], ["a", "a"])),
        (ALWAYS, "a /= 0", thin(BOTH, NOWHERE, ["a", "a"])),
        (TWICE, "2*a - b = 0", thin(BOTH, HALF, ["a", "2*a - b"])),
        (ALWAYS, "a = 0", thin(BOTH, NOWHERE, ["a", "a + y"])),
        (ALWAYS, "a = 0", thin(BOTH, NOWHERE, ["a", "a^2"])),
        (ALWAYS, "a = 0", thin(BOTH, NOWHERE, ["y", "y"])),
        ("ex y. a*y > 1", "false", thin(["0"], [[]])),
        ("all y, x. a*y > x", "false", thin(["0"], [[]])),
        ("all y. a*y > 1", "false", thin(["0"], [[]], variable="x")),
        ("all y. (ex x. x > y) and a*y > 1", "false", thin(["0"], [[]])),
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


def test_a_wrong_step_in_a_part_is_named() -> None:
    wrong = [solved(OTHER, "x", "-c + x", "c >= 1")]
    said = refused(ALTERNATIVES, TWO, "b > 0 or c >= 1", pieces([ONE, OTHER], STEPS[0], wrong))
    assert said.startswith("evidence.parts[1][0]: linear equation solved")


def test_names_of_roots_that_the_formula_has_are_others() -> None:
    answer = qe.eliminate("x <= root(1, b*x - a) and t_0 > x", check=True, process=False)
    assert answer.guarantee is qe.Guarantee.CHECKED and not answer.unchecked_steps


def test_the_kernel_alone_believes_roots_that_are_counted() -> None:
    answer = qe.eliminate("all y. x < root(2, x^2 - y) or y < 3", check=True, process=False)
    assert answer.certificate is not None and qe.verify(answer.certificate, core=True).accepted
