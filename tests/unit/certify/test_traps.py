"""Hand-made cell tables that look right at every sample and are wrong: each has one missing argument.

A row is a table, and the place and the reason with which it is refused; tables beside it that have the argument are
accepted (no place, no reason).
"""

from dataclasses import replace
from fractions import Fraction

from qe.certify.verify import verify
from qe.exact.ring import Poly, Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.options import Projection
from qe.proof.cells import Cell, CellTable, Stack
from qe.proof.certificate import Certificate
from tests.tables import each

TABLE = "payload.steps[0].evidence.cells"
BROWN, LAZARD = Projection.BROWN_MCCALLUM, Projection.LAZARD
Constraints = tuple[tuple[int, ...], ...]


def polynomial(text: str, ring: Ring) -> Poly:
    found = convert(read(f"{text} = 0"), ring)
    return found.poly  # type: ignore[attr-defined,no-any-return]


def stack(used: tuple[int, ...], sectors: str, sections: tuple[tuple[int, ...], ...], *cells: Cell) -> Stack:
    return Stack(used, tuple(Fraction(s) for s in sectors.split()), sections, cells)


def leaves(signs: str, truths: str) -> list[Cell]:
    """Cells without a stack, by their signs and truths: yes, no, or not said."""
    kinds = {"y": True, "n": False, "?": None}
    return [Cell(sign, kinds[truth]) for sign, truth in zip(signs.split(), truths, strict=True)]


def over(truth: bool | None, *parts: object) -> Cell:
    """The root, or a cell over it, with its stack."""
    signs, *rest = parts if isinstance(parts[0], str) else ("", *parts)
    return Cell(signs, truth, stack(*rest))  # type: ignore[arg-type]


NOTHING = stack((0,), "0", (), *leaves("+", "n"))
FLAT = over(
    False,
    (0,),
    "-1 1",
    ((0,),),
    *leaves("-", "n"),
    over(False, "0", (), "0", (), over(False, (0,), "0", (), *leaves("-", "n"))),
    *leaves("+", "n"),
)
NULLIFIED = "x y z", "EEE", "x = 0 and x*z + y - 1 = 0", [["x"], [], ["x*z + y - 1"]]
"""x*z + y - 1 is zero on the whole line over (0, 1), but not over the sample (0, 0)."""

CUBIC = "x y", ".E", "y^3 + y + x^2 + 10 = 0", [["27*x^4 + 540*x^2 + 2704"], ["y^3 + y + x^2 + 10"]]
COMPLETE = stack((0,), "-3 0", ((0,),), *leaves("- 0 +", "nyn"))


def cubic(truth: bool, right: Stack) -> Cell:
    return over(None, (0,), "0", (), Cell("+", truth, right))


QUARTIC = "x y", ".E", "x*y^4 + y^2 + 1 = 0", [["x", "4*x - 1"], ["x*y^4 + y^2 + 1"]]
"""At x = 0 it has discriminant 0 as a quartic and no real root."""


def quartic(at_zero: Cell) -> Cell:
    two = stack((0,), "-2 0 2", ((0,), (0,)), *leaves("- 0 + 0 -", "nyn?n"))
    others = [Cell(signs, False, NOTHING) for signs in ("+-", "+0", "++")]
    return over(None, (0, 1), "-1 1/8 1", ((0,), (1,)), Cell("--", True, two), at_zero, *others)


EQUAL = stack((0, 1), "-2 0 2", ((0, 1), (0, 1)), *leaves("++ 00 -- 00 ++", "nynyn"))
"""x^2 - 2 and x^2 - 3 have roots between 1 and 2, but not the same."""
SQUARE = stack((0, 1), "-1 1/2 2", ((0,), (1,)), *leaves("-+ 0+ ++ +0 ++", "nynnn"))
# x = 0 taken for a constraint: the sample 1/2 of x > 0 does not show that y^2 = x - 1 has solutions there.
BESIDE = over(False, (0, 1), "-1 1/2", ((0,),), *(Cell(signs, False, NOTHING) for signs in ("-?", "0-", "+?")))
IMPLIED = over(False, (0, 1), "-1 1/2", ((0,),), *leaves("-? 0- +?", "nnn"))

PARABOLA = stack((0,), "-1 1", ((0,),), *leaves("+ 0 +", "?y?"))
LINE = stack((0, 1), "-1 1", ((0,),), *leaves("-?", "n"), Cell("00", True, PARABOLA), *leaves("+?", "n"))
COLUMN = stack((0,), "0 2", ((0,),), *leaves("-", "n"), Cell("0", True, LINE), *leaves("+", "n"))
POINT = over(True, (0,), "-1 1", ((0,),), *leaves("-", "n"), Cell("0", True, COLUMN), *leaves("+", "n"))
OVER_A_POINT = (
    "x y z w",
    "EEEE",
    "x = 0 and y = 1 and z = 0 and w^2 = x*z + y - 1",
    [["x"], ["y - 1"], ["z", "x*z + y - 1"], ["w^2 - x*z - y + 1"]],
    POINT,
    BROWN,
)
"""x*z + y - 1 beside the constraint z = 0 is zero on the whole line over x = 0, y = 1: what is true there is true, and
nothing is said of other points (over more: ``kernel/test_line.py``)."""

BOTH = "x", "E", "x = 0 and x^2 + 1 > 0", [["x", "x^2 + 1"]]
ONE_LINE = over(True, (0, 1), "-1 1", ((0,),), *leaves("-? 0+ +?", "nyn"))
HALF = over(None, (), "0", (), over(None, (0,), "-1 1", ((0,),), *leaves("- 0 +", "nny")))


def line(count: int) -> Cell:
    return over(True, (0,), "-1 1", ((0,),), *leaves("- 0 +", "ynn")[:count])


ROOT = ".root.stack"


@each(
    {
        "a factor nullified away from the sample": (
            *(*NULLIFIED, FLAT, BROWN, ()),
            *(f"{ROOT}.cells[1].stack.cells[0].stack.used", "may vanish identically"),
        ),
        "which is not closed under Lazard": (*NULLIFIED, FLAT, LAZARD, (), ".factors[2][0]", "trailing coefficient"),
        "a root beyond the outermost samples": (*CUBIC, cubic(False, NOTHING), BROWN, (), None, "missing"),
        "a cell that is true": (*CUBIC, cubic(False, COMPLETE), BROWN, (), f"{ROOT}.cells[0].truth", ""),
        "the complete stack": (*CUBIC, cubic(True, COMPLETE), BROWN, (), "", ""),
        "a degree drop is no double root": (
            *(*QUARTIC, quartic(over(True, "0-", (0,), "-1 1", ((0,),), *leaves("+ 0 +", "nyn"))), BROWN, ()),
            *(f"{ROOT}.cells[1].stack.sections[0]", ""),
        ),
        "a degree drop": (*QUARTIC, quartic(Cell("0-", False, NOTHING)), BROWN, (), "", ""),
        "equal intervals are not equal roots": (
            *("x", ".", "x^2 - 2 = 0 and x^2 - 3 = 0", [["x^2 - 2", "x^2 - 3"]], Cell("", None, EQUAL), BROWN, ()),
            *(f"{ROOT}.sections[0]", "no common root"),
        ),
        "a free variable that is not first": (
            *("x y", "E.", "true", [[], []], Cell("", True), BROWN, ()),
            *(".quantifiers[1]", ""),
        ),
        "an unknown quantifier": ("x y", "XE", "true", [[], []], Cell("", True), BROWN, (), ".quantifiers[0]", ""),
        "a factor of another": ("x y", "..", "x*y + y = 0", [["x"], ["x*y + y"]], Cell("", None), BROWN, (), None, ""),
        "a factor that is a square": (
            *("x y", "..", "y = 0", [[], ["y", "y^2 - 2*y*x + x^2"]]),
            *(over(None, (), "1", (), Cell("", None, SQUARE)), BROWN, (), None, "squarefree"),
        ),
        "a sector beside a constraint is decomposed": (
            *("x y", "EE", "y^2 = x - 1", [["x", "x - 1"], ["y^2 - x + 1"]], BESIDE, BROWN, ((0,), ())),
            *(f"{ROOT}.cells[0].stack.cells", "may change its sign"),
        ),
        "a leaf beside a constraint that is not implied": (
            *("x", "E", "x = 1 or x^2*(x - 1) > 0", [["x", "x - 1"]], IMPLIED, BROWN, ((0,),)),
            *(f"{ROOT}.cells[0].truth", ""),
        ),
        "a factor beside a constraint that is nullified over a point": (*OVER_A_POINT, ((), (), (0,), ()), "", ""),
        "too few lists of constraints": (*OVER_A_POINT, ((), ()), ".constraints", ""),
        "a constraint that is not listed": (*OVER_A_POINT, ((), (), (2,), ()), ".constraints[2]", ""),
        "constraints in another order": (*OVER_A_POINT, ((), (), (1, 0), ()), ".constraints[2]", ""),
        "a constraint": (*BOTH, ONE_LINE, BROWN, ((0,),), "", ""),
        "no constraint restricts Lazard projection": (*BOTH, ONE_LINE, LAZARD, ((0,),), ".projection", ""),
        # Who reads the cells of a table relies on that; what is not used is not known, so nothing else would notice.
        "a factor below the last level that is not used": (
            *("x y", "..", "y > 0", [["x"], ["y"]], HALF, BROWN, ()),
            *(f"{ROOT}.used", "a factor of this level is missing"),
        ),
        "all factors": ("x y", "..", "y > 0", [[], ["y"]], HALF, BROWN, (), "", ""),
        # All cells of a line, also where one of them decides the quantifier.
        "one cell of three": ("x", "E", "x < 0", [["x"]], line(1), BROWN, (), None, "where 3 are needed"),
        "two cells of three": ("x", "E", "x < 0", [["x"]], line(2), BROWN, (), None, "where 3 are needed"),
        "three cells of three": ("x", "E", "x < 0", [["x"]], line(3), BROWN, (), "", ""),
    }
)
def test_a_table_without_an_argument_is_refused_there(
    order: str,
    quantifiers: str,
    matrix: str,
    factors: list[list[str]],
    root: Cell,
    projection: Projection,
    constraints: Constraints,
    step: str | None,
    reason: str,
) -> None:
    names, kinds = tuple(order.split()), tuple(quantifiers.replace(".", " "))
    ring = Ring.of(names)
    lists = tuple(tuple(polynomial(f, ring) for f in level) for level in factors)
    given = convert(read(matrix), ring)
    table = CellTable(names, tuple(kind.strip() for kind in kinds), given, projection, lists, root, constraints)
    verdict = verify(Certificate.cells(table))
    assert verdict.accepted is (step == "")
    assert verdict.accepted or (reason in verdict.reason and step in (None, verdict.step.removeprefix(TABLE)))


def test_roots_of_a_factor_beside_a_constraint_are_not_known() -> None:
    """On x = 1 a section of x^2 - 1 says nothing about the number of smaller roots of x^2 - 4*x."""
    ring = Ring.of(("x",))
    root = over(None, (0, 1), "-2 1/2 2", ((0,), (0,)), *leaves("+? 0+ -? 0- +?", "nnnyn"))
    lists = ((polynomial("x^2 - 1", ring), polynomial("x^2 - 4*x", ring)),)
    matrix = convert(read("x^2 - 1 = 0 and x^2 - 4*x < 0"), ring)
    sound = CellTable(("x",), ("",), matrix, BROWN, lists, root, ((0,),))
    assert verify(Certificate.cells(sound)).accepted
    answer = convert(read("x^2 - 1 = 0 and x > root(1, x^2 - 4*x, x)"), ring)
    assert verify(Certificate.cells(sound, answer)).step == "payload.steps[0].after"
    assert not verify(Certificate.cells(replace(sound, constraints=()))).accepted
