"""Hand-made cell tables that look right at every sample and are wrong: each has one missing argument."""

from dataclasses import replace
from fractions import Fraction

from qe.certify.verify import verify
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import Formula, Relation
from qe.io.text import read
from qe.kernel.verdict import Verdict
from qe.options import Projection
from qe.proof.cells import Cell, CellTable, Stack
from qe.proof.certificate import Certificate
from tests.tables import each

TABLE = "payload.steps[0].evidence.cells"
BROWN, LAZARD = Projection.BROWN_MCCALLUM, Projection.LAZARD


def _poly(text: str, names: tuple[str, ...]) -> Poly:
    ring = Ring.of(names)
    found = convert(read(f"{text} = 0"), ring)
    return found.poly  # type: ignore[attr-defined,no-any-return]


def _stack(used: tuple[int, ...], sectors: str, sections: tuple[tuple[int, ...], ...], *cells: Cell) -> Stack:
    return Stack(used, tuple(Fraction(s) for s in sectors.split()), sections, cells)


def _verdict(
    order: tuple[str, ...],
    quantifiers: tuple[str, ...],
    matrix: Formula,
    factors: list[list[str]],
    root: Cell,
    projection: Projection = BROWN,
    constraints: tuple[tuple[int, ...], ...] = (),
) -> Verdict:
    lists = tuple(tuple(_poly(f, order) for f in level) for level in factors)
    table = CellTable(order, quantifiers, convert(matrix, Ring.of(order)), projection, lists, root, constraints)
    return verify(Certificate.cells(table))


def _leaf(signs: str, truth: bool | None) -> Cell:
    return Cell(signs, truth)


def _flat() -> Cell:
    flat = Cell("", False, _stack((0,), "0", (), _leaf("-", False)))
    middle = Cell("0", False, _stack((), "0", (), flat))
    return Cell("", False, _stack((0,), "-1 1", ((0,),), _leaf("-", False), middle, _leaf("+", False)))


def test_a_factor_nullified_away_from_the_sample() -> None:
    """x*z + y - 1 is zero on the whole line over (0, 1), but not over the sample (0, 0)."""
    root = _flat()
    names = ("x", "y", "z")
    verdict = _verdict(names, ("E",) * 3, read("x = 0 and x*z + y - 1 = 0"), [["x"], [], ["x*z + y - 1"]], root)
    assert not verdict.accepted
    assert "may vanish identically" in verdict.reason
    assert verdict.step == f"{TABLE}.root.stack.cells[1].stack.cells[0].stack.used"


def test_the_same_table_is_not_closed_under_lazard() -> None:
    names, factors = ("x", "y", "z"), [["x"], [], ["x*z + y - 1"]]
    verdict = _verdict(names, ("E",) * 3, read("x = 0 and x*z + y - 1 = 0"), factors, _flat(), LAZARD)
    assert verdict.step == f"{TABLE}.factors[2][0]"
    assert "trailing coefficient" in verdict.reason


def _cubic(right: Stack) -> Verdict:
    """E y. y^3 + y + x = 0, with discriminant of one sign: factors at level 0 are none."""
    root = Cell("", None, _stack((0,), "0", (), Cell("+", False, right)))
    return _verdict(
        ("x", "y"),
        ("", "E"),
        read("y^3 + y + x^2 + 10 = 0"),
        [["27*x^4 + 540*x^2 + 2704"], ["y^3 + y + x^2 + 10"]],
        root,
    )


def test_a_root_beyond_the_outermost_samples_is_missed() -> None:
    verdict = _cubic(_stack((0,), "0", (), _leaf("+", False)))
    assert not verdict.accepted
    assert "missing" in verdict.reason


def test_the_complete_stack_of_the_same_cubic() -> None:
    stack = _stack((0,), "-3 0", ((0,),), _leaf("-", False), _leaf("0", True), _leaf("+", False))
    verdict = _cubic(stack)
    assert verdict.step == f"{TABLE}.root.stack.cells[0].truth"  # the cell says False, E y is True
    table_cell = replace(Cell("+", True, stack))
    root = Cell("", None, _stack((0,), "0", (), table_cell))
    names = ("x", "y")
    factors = [["27*x^4 + 540*x^2 + 2704"], ["y^3 + y + x^2 + 10"]]
    assert _verdict(names, ("", "E"), read("y^3 + y + x^2 + 10 = 0"), factors, root).accepted


def test_a_degree_drop_is_not_a_double_root() -> None:
    """x*y^4 + y^2 + 1 at x = 0 has discriminant 0 as a quartic and no real root."""
    f = "x*y^4 + y^2 + 1"
    false_stack = _stack((0,), "-1 1", ((0,),), _leaf("+", False), _leaf("0", True), _leaf("+", False))
    none = Cell("++", False, _stack((0,), "0", (), _leaf("+", False)))
    quarter = Cell("+0", False, _stack((0,), "0", (), _leaf("+", False)))
    small = Cell("+-", False, _stack((0,), "0", (), _leaf("+", False)))
    two = _stack(
        (0,),
        "-2 0 2",
        ((0,), (0,)),
        _leaf("-", False),
        _leaf("0", True),
        _leaf("+", False),
        _leaf("0", None),
        _leaf("-", False),
    )
    negative = Cell("--", True, two)

    def root(at_zero: Cell) -> Cell:
        return Cell("", None, _stack((0, 1), "-1 1/8 1", ((0,), (1,)), negative, at_zero, small, quarter, none))

    def verdict(at_zero: Cell) -> Verdict:
        return _verdict(("x", "y"), ("", "E"), read(f"{f} = 0"), [["x", "4*x - 1"], [f]], root(at_zero))

    honest = Cell("0-", False, _stack((0,), "0", (), _leaf("+", False)))
    assert str(verdict(honest)) == "accepted"
    wrong = verdict(Cell("0-", True, false_stack))
    assert wrong.step == f"{TABLE}.root.stack.cells[1].stack.sections[0]"


def test_equal_intervals_are_not_equal_roots() -> None:
    """x^2 - 2 and x^2 - 3 have roots between 1 and 2, but not the same."""
    merged = _stack(
        (0, 1),
        "-2 0 2",
        ((0, 1), (0, 1)),
        *(_leaf(s, t) for s, t in [("++", False), ("00", True), ("--", False)]),
        _leaf("00", True),
        _leaf("++", False),
    )
    names = ("x",)
    ring = Ring.of(names)
    both = conj([atom(_poly("x^2 - 2", names), Relation.EQ), atom(_poly("x^2 - 3", names), Relation.EQ)])
    verdict = _verdict(names, ("",), both, [["x^2 - 2", "x^2 - 3"]], Cell("", None, merged))
    assert ring is Ring.of(names)
    assert verdict.step == f"{TABLE}.root.stack.sections[0]"
    assert "no common root" in verdict.reason


@each((("E", ""), f"{TABLE}.quantifiers[1]"), (("X", "E"), f"{TABLE}.quantifiers[0]"))
def test_free_variables_come_first(quantifiers: tuple[str, str], step: str) -> None:
    root = Cell("", True)
    assert _verdict(("x", "y"), quantifiers, read("true"), [[], []], root).step == step


def test_a_list_must_be_squarefree_and_coprime() -> None:
    root = Cell("", None)
    verdict = _verdict(("x", "y"), ("", ""), read("x*y + y = 0"), [["x"], ["x*y + y"]], root)
    assert not verdict.accepted
    leaves = [_leaf(signs, signs[0] == "0") for signs in ("-+", "0+", "++", "+0", "++")]
    over = Cell("", None, _stack((0, 1), "-1 1/2 2", ((0,), (1,)), *leaves))
    root = Cell("", None, _stack((), "1", (), over))
    verdict = _verdict(("x", "y"), ("", ""), read("y = 0"), [[], ["y", "y^2 - 2*y*x + x^2"]], root)
    assert "squarefree" in verdict.reason


def test_a_sector_beside_a_constraint_is_decomposed() -> None:
    """x = 0 taken for a constraint: the sample 1/2 of x > 0 does not show that y^2 = x - 1 has solutions there."""
    flat = _stack((0,), "0", (), _leaf("+", False))
    cells = (Cell("-?", False, flat), Cell("0-", False, flat), Cell("+?", False, flat))
    root = Cell("", False, _stack((0, 1), "-1 1/2", ((0,),), *cells))
    factors = [["x", "x - 1"], ["y^2 - x + 1"]]
    verdict = _verdict(("x", "y"), ("E", "E"), read("y^2 = x - 1"), factors, root, constraints=((0,), ()))
    assert verdict.step == f"{TABLE}.root.stack.cells[0].stack.cells"
    assert "may change its sign" in verdict.reason


def test_a_leaf_beside_a_constraint_that_is_not_implied() -> None:
    cells = (_leaf("-?", False), _leaf("0-", False), _leaf("+?", False))
    root = Cell("", False, _stack((0, 1), "-1 1/2", ((0,),), *cells))
    verdict = _verdict(("x",), ("E",), read("x = 1 or x^2*(x - 1) > 0"), [["x", "x - 1"]], root, constraints=((0,),))
    assert verdict.step == f"{TABLE}.root.stack.cells[0].truth"


def _over_a_nullified_factor(constraints: tuple[tuple[int, ...], ...]) -> Verdict:
    """x*z + y - 1 beside the constraint z = 0 is zero on the whole line over x = 0, y = 1."""
    parabola = _stack((0,), "-1 1", ((0,),), _leaf("+", None), _leaf("0", True), _leaf("+", None))
    line = _stack((0, 1), "-1 1", ((0,),), _leaf("-?", False), Cell("00", True, parabola), _leaf("+?", False))
    column = _stack((0,), "0 2", ((0,),), _leaf("-", False), Cell("0", True, line), _leaf("+", False))
    root = Cell("", True, _stack((0,), "-1 1", ((0,),), _leaf("-", False), Cell("0", True, column), _leaf("+", False)))
    names = ("x", "y", "z", "w")
    matrix = read("x = 0 and y = 1 and z = 0 and w^2 = x*z + y - 1")
    factors = [["x"], ["y - 1"], ["z", "x*z + y - 1"], ["w^2 - x*z - y + 1"]]
    return _verdict(names, ("E",) * 4, matrix, factors, root, constraints=constraints)


def test_a_factor_beside_a_constraint_may_be_nullified_over_a_point() -> None:
    """What is true there is true, and nothing is said of other points (over more: ``kernel/test_line.py``)."""
    assert _over_a_nullified_factor(((), (), (0,), ())).accepted


@each(
    (((), ()), f"{TABLE}.constraints"),
    (((), (), (2,), ()), f"{TABLE}.constraints[2]"),
    (((), (), (1, 0), ()), f"{TABLE}.constraints[2]"),
)
def test_lists_that_are_no_constraints(constraints: tuple[tuple[int, ...], ...], step: str) -> None:
    assert _over_a_nullified_factor(constraints).step == step


def test_no_constraint_restricts_lazard_projection() -> None:
    cells = (_leaf("-?", False), _leaf("0+", True), _leaf("+?", False))
    root = Cell("", True, _stack((0, 1), "-1 1", ((0,),), *cells))
    question = (("x",), ("E",), read("x = 0 and x^2 + 1 > 0"), [["x", "x^2 + 1"]], root)
    assert _verdict(*question, constraints=((0,),)).accepted
    assert _verdict(*question, LAZARD, ((0,),)).step == f"{TABLE}.projection"


def test_roots_of_a_factor_beside_a_constraint_are_not_known() -> None:
    """On x = 1 a section of x^2 - 1 says nothing about the number of smaller roots of x^2 - 4*x."""
    signs = ("+?", "0+", "-?", "0-", "+?")
    cells = tuple(_leaf(s, s == "0-") for s in signs)
    root = Cell("", None, _stack((0, 1), "-2 1/2 2", ((0,), (0,)), *cells))
    names, ring = ("x",), Ring.of(("x",))
    lists = ((_poly("x^2 - 1", names), _poly("x^2 - 4*x", names)),)
    matrix = convert(read("x^2 - 1 = 0 and x^2 - 4*x < 0"), ring)
    sound = CellTable(names, ("",), matrix, BROWN, lists, root, ((0,),))
    assert verify(Certificate.cells(sound)).accepted
    answer = convert(read("x^2 - 1 = 0 and x > root(1, x^2 - 4*x, x)"), ring)
    assert verify(Certificate.cells(sound, answer)).step == "payload.steps[0].after"


def test_a_decomposition_shows_all_factors_of_a_level_below_the_last() -> None:
    """Who reads the cells of a table relies on that; what is not used is not known, so nothing else would notice."""
    leaves = [_leaf(sign, sign == "+") for sign in "-0+"]
    over = Cell("", None, _stack((0,), "-1 1", ((0,),), *leaves))
    root = Cell("", None, _stack((), "0", (), over))
    verdict = _verdict(("x", "y"), ("", ""), read("y > 0"), [["x"], ["y"]], root)
    assert (verdict.step, verdict.reason) == (f"{TABLE}.root.stack.used", "a factor of this level is missing")
    assert _verdict(("x", "y"), ("", ""), read("y > 0"), [[], ["y"]], root).accepted


def test_a_decomposition_shows_all_cells_of_a_line() -> None:
    """Also where one of them decides the quantifier."""
    leaves = [_leaf("-", True), _leaf("0", False), _leaf("+", False)]
    for count in (1, 2, 3):
        root = Cell("", True, _stack((0,), "-1 1", ((0,),), *leaves[:count]))
        verdict = _verdict(("x",), ("E",), read("x < 0"), [["x"]], root)
        assert verdict.accepted is (count == 3) and (count == 3 or "where 3 are needed" in verdict.reason)
