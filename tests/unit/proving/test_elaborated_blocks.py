"""Steps about one block, of rules that are no primitives: those of the theorem are the kernel's, no others are.

A row is a step: before, after, its evidence. What its rule says of it is checked for every row alike: a true step is
accepted, its negation is refused, and so is the step to ``true`` or ``false`` where that is something else.
"""

from typing import Any

import qe
from qe.formula.build import conj, neg
from qe.formula.counting import without_root_atoms
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.formula.traverse import conjuncts
from qe.io.text import read
from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, formula, line, step, written
from tests.unit.proving.elaborated import refused

Row = tuple[str | Formula, str | Formula, Any]
"""Before, after, evidence."""
ALTERNATIVES, PARTS, GUARD = "alternatives", "independent parts", "linear equation solved under a guard"
SHIFT, EXCHANGE, MIRROR = "degree shift", "two variables exchanged", "mirror images of a convex set"
TRANSLATION, SCALING, FORM = "translation of the origin", "homogeneous scaling", "sphere seen along a form"
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


def exponent(by: Any, variable: Any = "x") -> dict[str, Any]:
    return {"variable": variable, "exponent": by, "theory": NO_LEMMAS}


def exchanged(before: str, after: str) -> Row:
    """There are numbers with the sum x and the product y iff x^2 - 4*y >= 0."""
    return f"ex x, y. {before}", f"ex x, y. x^2 - 4*y >= 0 and {after}", {"variables": ["x", "y"]}


SUMS = [
    ("x > 1 and y > 1", "x > 2 and y - x + 1 > 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 >= 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 > 0"),
    ("x <= 1 and y <= 1", "x <= 2 and y - x + 1 >= 0"),
    ("x = 1 and y = 1", "x = 2 and y - x + 1 = 0"),
    ("x /= 1 and y /= 1", "y - x + 1 /= 0"),
]
NO_SUMS = [
    *((pair, both.replace(part, "true")) for pair, both in SUMS for part in both.split(" and ")),
    ("x /= 1 and y /= 1", "x /= 2 and y - x + 1 /= 0"),
    ("x > 1 and y > 1", "x > 2 and y - x + 1 >= 0"),
    ("x >= 1 and y >= 1", "x >= 2 and y - x + 1 > 0"),
    ("x < 1 and y < 1", "x < 2 and y - x + 1 < 0"),
]

# Bodies that are convex by their form.
NEGATED = {"mirror": [["x", "x", -1]]}
SPAN = "x < b and -x < b"


def along(variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {"variable": variable, "weights": [list(w) for w in weights]}


def scaled(values: list[int], variable: str, *weights: tuple[str, str]) -> dict[str, Any]:
    return {**along(variable, *weights), "values": values, "theory": NO_LEMMAS}


XY = ("x", "1"), ("y", "1")
DIAGONAL = along("x", *XY)
DIFFERENCE = "ex x, y. (x - y)^2 < a and x - y > b"
MOVED = "ex y. y^2 < a and -y > b"
CUBES, CUBES_AT_1 = "ex x, y. x^3 + y^3 > 0 and x^2*y > 0", "ex y. 1 + y^3 > 0 and y > 0"
PARABOLA = "ex x, y. x^2 = y and x > 0 and y < a - a + 3*x^2"


def sphere(of: str) -> dict[str, Any]:
    return {"sphere": ["atom", f"{of} - 1", "<"], "variables": ["x", "y"], "form": "a*x + b*y"}


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
    SHIFT: [
        ("ex x. x^4 + a < 0 and x^2 > b", "ex x. x >= 0 and x^2 + a < 0 and x > b", exponent(2)),
        ("ex x. x^6 + a*x^3 + b = 0", "ex x. x^2 + a*x + b = 0", exponent(3)),
        ("ex x. x^3 < a and x < 0", "ex x. x < a and x < 0", exponent(3)),  # the sign of x is that of x^3
        ("ex x. x^2 = a and x > 0 and b < 1", "ex x. x >= 0 and x = a and x > 0 and b < 1", exponent(2)),
        ("ex x, y. x^2*y = a and y^3 < b", "ex x, y. x >= 0 and x*y = a and y^3 < b", exponent(2)),
        ("ex x. ex y. y > 0 and x^2 = y", "ex x, y. x >= 0 and y > 0 and x = y", exponent(2)),
        ("ex x. not (x^4 < a or x^2 = b)", "ex x. x >= 0 and not (x^2 < a or x = b)", exponent(2)),
    ],
    EXCHANGE: [
        *(exchanged(f"x*y = a and {pair}", f"y = a and {both}") for pair, both in SUMS),
        *(exchanged(f"x*y = a and x - y {sign} 0", f"y = a and x^2 - 4*y {sign} 0") for sign in ("=", "/=")),
    ],
    MIRROR: [
        (f"ex x. {SPAN}", "0 < b", NEGATED),
        (f"ex x. {SPAN} and (a > 0 or c^2 = 2)", "0 < b and (a > 0 or c^2 = 2)", NEGATED),
        (f"ex x. {SPAN} and (ex y. y^2 = a)", "0 < b and (ex y. y^2 = a)", NEGATED),
        (f"ex x. {SPAN} and (ex y. x + y < 1 and -x + y < 1)", "0 < b and (ex y. y < 1)", NEGATED),
        ("ex x. a > 0 or x < b and -x < b", "a > 0 or 0 < b", NEGATED),
        ("ex x. all y. y*x < b and -y*x < b or y^2 > 1", "all y. 0 < b or y^2 > 1", NEGATED),
        ("ex x. not (x > a or -x > a)", "a >= 0", NEGATED),
    ],
    TRANSLATION: [
        (DIFFERENCE, MOVED, DIAGONAL),
        (
            "ex x. all y. x - y > a or (ex z. z^2 - 2*z*x + x^2 = b)",
            "all y. -y > a or (ex z. z^2 = b)",
            along("x", ("x", "2"), ("y", "2"), ("z", "2")),
        ),
    ],
    SCALING: [
        (
            CUBES,
            f"({CUBES_AT_1}) or (ex y. y^3 > 0 and 0 > 0) or (ex y. -1 + y^3 > 0 and y > 0)",
            scaled([1, 0, -1], "x", *XY),
        ),
        (PARABOLA, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1"), ("y", "2"))),
        (PARABOLA, "ex y. 1 = y and y < 3", scaled([1], "x", ("x", "1/2"), ("y", "1"))),
        ("ex x, y. not (x <= 0 or x^2 > y)", "ex y. not (1 > y)", scaled([1], "x", ("x", "1"), ("y", "2"))),
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
    SHIFT: [
        ("ex x. x^4 + a < 0", "ex x. x^2 + a < 0", exponent(2)),  # without x >= 0
        ("ex x. x^4 + a < 0", "ex x. x > 0 and x^2 + a < 0", exponent(2)),
        ("ex x. x^6 = a", "ex x. x >= 0 and x^2 = a", exponent(3)),  # for odd exponents it is wrong
        ("ex x. x^3 = a", "ex x. x = a", exponent(2)),
        ("ex x. x^4 + x^2 = a", "ex x. x >= 0 and x + x^2 = a", exponent(4)),
        ("ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0", exponent(2)),
        ("ex x. x^2 = a", "ex x. x >= 0 and x = a", exponent(1)),
        ("all x. x^2 = a", "all x. x >= 0 and x = a", exponent(2)),
        ("ex y. y^2 = x^2", "ex y. y^2 = x", exponent(2)),  # x is not bound here
        ("ex x. x^2 = a and (all x. x^2 > b)", "ex x. x >= 0 and x = a and (all x. x > b)", exponent(2)),
        ("ex x. x^2 = a and x > root(1, x^2 - b)", "ex x. x >= 0 and x = a and x > root(1, x - b)", exponent(2)),
        ("ex x. x^2 = a and x > b", "ex x. x >= 0 and x = a and x > b", exponent(2)),
        *(
            ("ex x. x^2 = a", "ex x. x >= 0 and x = a", malformed)
            for malformed in (exponent("2"), exponent(2, "y"), exponent(2, 7), exponent(2, "q"))
        ),
    ],
    EXCHANGE: [
        *(exchanged(f"x*y = a and {pair}", f"y = a and {both}") for pair, both in NO_SUMS),
        # x > y and y^3 > x^3 have no solution, but both squares are positive wherever x and y differ.
        *(
            exchanged(
                f"x*y = a and x - y {sign} 0 and y^3 - x^3 {sign} 0",
                f"y = a and x^2 - 4*y {sign} 0 and (x^2 - 4*y)*(x^2 - y)^2 {sign} 0",
            )
            for sign in (">", ">=")
        ),
        # A condition on one of the two.
        *(exchanged(f"x*y = a and {at}", "y = a and x > 2") for at in ("x > 1", "x > 1 and y > 2", "(x > 1 or y > 2)")),
    ],
    MIRROR: [
        ("ex x. x /= 0", "0 /= 0", NEGATED),
        ("ex x. x > 1 or x < -1", "0 > 1 or 0 < -1", NEGATED),
        ("ex x. x^2 > b", "0 > b", NEGATED),
        ("ex x. (ex y. x*y > 1 and y > 0 or x*y < -1 and y > 0)", "false", NEGATED),
        ("ex x. (ex y. x*y > 1 and x + y > 1) or (ex z. -x*z > 1 and -x + z > 1)", "false", NEGATED),
        ("ex x. not (x < 1 and -x < 1)", "not (0 < 1 and 0 < 1)", NEGATED),
        ("ex x. a > 1 or not (x < 1 and -x < 1)", "a > 1 or not (0 < 1 and 0 < 1)", NEGATED),
        # Its variables are not looked for.
        ("ex x. a > 1 or x > root(1, x^3 - b) or x < root(1, x^3 + b)", "a > 1", NEGATED),
        # Nothing but the block at the fixed points.
        *((f"ex x. {SPAN}", after, NEGATED) for after in ("0 <= b", "0 < b and a > 0", "ex x. x < b", "true")),
    ],
    TRANSLATION: [
        (DIFFERENCE, MOVED, along("x", ("x", "1"), ("y", "-1"))),  # not constant along it
        (DIFFERENCE, MOVED, along("x", ("x", "1"))),
        (DIFFERENCE, MOVED, along("x", ("x", "0"), ("y", "1"))),  # x does not move
        (DIFFERENCE, MOVED, along("x", ("y", "1"))),
        (DIFFERENCE, "ex y. y^2 < a and y > b", DIAGONAL),
        (DIFFERENCE, "y^2 < a and -y > b", DIAGONAL),
        (DIFFERENCE, MOVED, along("a", ("a", "1"))),
        (DIFFERENCE, MOVED, along("x", ("x", "1"), ("x", "1"))),
        ("ex x. x - y > b", "-y > b", DIAGONAL),  # y is given
        ("all x. x - y > b", "-y > b", along("x", ("x", "1"))),
        ("ex x, y. x - y > b and (all y. y^2 > x - x)", "ex y. -y > b", DIAGONAL),
        ("ex x, y. x > root(1, (x - y)^2 - a, x)", "true", DIAGONAL),
        # A name bound twice, or free and bound.
        ("ex x. (ex y. x - y > a) and (ex x. x > b)", "true", DIAGONAL),
        ("ex x. (ex y. x - y > a) and y > b and x > x - y", "true", DIAGONAL),
    ],
    SCALING: [
        (CUBES, CUBES_AT_1, scaled([1], "x", *XY)),  # other signs of x are not excluded
        (CUBES, CUBES_AT_1, scaled([1], "x", ("x", "1"), ("y", "2"))),  # not homogeneous
        ("ex x. x^2 > a", "1 > a or 0 > a or 1 > a", scaled([1, 0, -1], "x", ("x", "1"))),
        ("ex x, y. x > 0 and y = x", "ex y. y = 2", scaled([1], "x", *XY)),
        ("ex x, y. x > 0 and y = x", "ex y. y = 1", scaled([1], "x", ("x", "0"), ("y", "1"))),
        ("ex x, y. x >= 0 and y = x", "ex y. y = 1", scaled([1], "x", *XY)),
    ],
    FORM: [
        # At a = b = 0 the block says c <= 0, and x^2 < a^2 + b^2 nothing.
        (
            "ex x, y. x^2 + y^2 < 1 and a*x + b*y >= c",
            "ex x. x^2 - a^2 - b^2 < 0 and x >= c",
            sphere("x^2 + y^2"),
        ),
        # a*x^2 + a*y^2 < 1 is no ball where a <= 0.
        (
            "ex x, y. a*x^2 + a*y^2 < 1 and a*x + b*y >= c",
            "ex x. a*x^2 - a^2 - b^2 < 0 and x >= c",
            sphere("a*x^2 + a*y^2"),
        ),
        ("ex x, y. x^2 + x*y + y^2 < 1 and a*x + b*y >= c", "ex x. x >= c", sphere("x^2 + x*y + y^2")),
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


@each(*[(rule, *row) for rule, rows in TRUE_STEPS.items() for row in rows])
def test_a_true_step_is_one_of_the_kernel_and_no_other(rule: str, before: Any, after: Any, evidence: Any) -> None:
    right = formula(after) if isinstance(after, str) else after
    assert refused(rule, before, after, evidence) == ""
    for wrong in (nnf(neg(right)), *({TRUE, FALSE} - {right})):
        assert refused(rule, before, wrong, evidence), wrong


@each(*[(rule, *row) for rule, rows in FALSE_STEPS.items() for row in rows])
def test_a_false_step_is_none(rule: str, before: Any, after: Any, evidence: Any) -> None:
    assert refused(rule, before, after, evidence)


@each(
    (SHIFT, "ex x. x^2 = a and x < 0", "ex x. x >= 0 and x = a and x < 0", exponent(2)),
    (SCALING, "ex x, y. x*y > 0 and x^2 > y^2", "ex y. y > 0 and 1 > y^2", scaled([1], "x", *XY)),
)
def test_a_sign_that_is_known_outside_is_one_of_another_variable(rule: str, before: str, after: str, by: Any) -> None:
    assert refused(rule, before, after, by, given="x > 0")


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
