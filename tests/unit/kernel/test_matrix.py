"""Three-valued truth from signs of factors: what is said with some signs hidden is the truth at the point."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Formula, Relation, RootAtom
from qe.io.text import read
from qe.kernel.arithmetic.products import FactorLists
from qe.kernel.matrix import Situation, compiled, strengthened

RING = Ring.of(("x", "y"))
X, Y = RING.gen(0), RING.gen(1)
FACTORS = ((X, X - 1), (Y - X, Y + 1, X * Y - 1))
LISTS = FactorLists(RING, FACTORS)
PRODUCTS = (X, X - 1, -2 * (Y - X), X**2 * (Y + 1), (X * Y - 1) ** 2 * X, (Y - X) * (Y + 1) ** 3, 1 - X * Y)


@st.composite
def matrices(draw: st.DrawFn, depth: int = 2) -> Formula:
    if not depth or draw(st.booleans()):
        return atom(draw(st.sampled_from(PRODUCTS)), draw(st.sampled_from(tuple(Relation))))
    parts = [draw(matrices(depth - 1)) for _ in range(draw(st.integers(2, 3)))]
    return draw(st.sampled_from((conj, disj, lambda fs: neg(conj(fs)))))(parts)


NUMBERS = st.fractions(-2, 2, max_denominator=2)


def situation(point: dict[str, Fraction], hidden: set[tuple[int, int]]) -> Situation:
    signs: list[list[int | None]] = []
    for level, factors in enumerate(FACTORS):
        values = [f.evaluate([point["x"], point["y"]]) for f in factors]
        signs.append([None if (level, i) in hidden else (v > 0) - (v < 0) for i, v in enumerate(values)])
    return Situation(signs, [(), ()], [frozenset(), frozenset()], [frozenset(), frozenset()], [0, 0])


@given(matrices(), NUMBERS, NUMBERS, st.sets(st.tuples(st.integers(0, 1), st.integers(0, 2)), max_size=3))
def test_nothing_wrong_is_said(matrix: Formula, x: Fraction, y: Fraction, hidden: set[tuple[int, int]]) -> None:
    test, point = compiled(matrix, LISTS, "matrix"), {"x": x, "y": y}
    truth = holds_at(matrix, point)
    assert test(situation(point, set())) is truth
    assert test(situation(point, hidden)) in (truth, None)


def test_what_follows_although_a_sign_is_hidden() -> None:
    hidden, point = {(1, 2)}, {"x": Fraction(2), "y": Fraction(3)}

    def said(text: str) -> bool | None:
        return compiled(convert(read(text), RING), LISTS, "matrix")(situation(point, hidden))

    assert said("x*y = 1") is None
    assert said("(x*y - 1)^2*x >= 0") is True
    assert said("(x*y - 1)^2*x < 0") is False
    assert said("x > 0 or x*y = 1") is True
    assert said("x < 0 and x*y = 1") is False
    assert said("not x*y > 1") is None


@pytest.mark.parametrize("text", ["y > 1", "x + 3 = 0", "(y - x)*(y - 1) < 0", "ex z. z > x", "x < root(1, x*y - 1)"])
def test_what_is_not_made_of_listed_factors(text: str) -> None:
    formula = read(text)
    with pytest.raises(CertificateRejected):
        compiled(convert(formula, Ring.of(("x", "y", "z")) if "z" in text else RING), LISTS, "matrix")


def test_roots_by_the_sections_of_their_stack() -> None:
    """x between the second and the third of three sections, of which factor 0 has the first and the third."""
    x = Ring.of(("x",)).gen(0)
    lists = FactorLists(x.ring, ((x**4 - 2, x),))

    def said(text: str | Formula, position: int, isolated: frozenset[int] = frozenset((0, 1))) -> bool | None:
        formula = read(text) if isinstance(text, str) else text
        test = compiled(convert(formula, Ring.of(("x",))), lists, "answer")
        sections = ((0,), (1,), (0,))
        signs: list[list[int | None]] = [[None, None]]
        return test(Situation(signs, [sections], [isolated], [frozenset()], [position]))

    assert said("x > root(1, x^4 - 2)", 4) is True
    assert said("x > root(2, x^4 - 2)", 4) is False
    assert said("x < root(2, x^4 - 2)", 4) is True
    assert said("x = root(2, x^4 - 2)", 5) is True
    assert said("x >= root(-1, x^4 - 2)", 5) is True
    assert said("x > root(-2, x^4 - 2)", 1) is False
    assert said("x > root(1, x^4 - 2)", 4, frozenset((1,))) is None  # its roots are not known there
    for k, position in ((3, 0), (-3, 6), (-4, 6)):  # there are two
        assert said(RootAtom("x", Relation.NE, x**4 - 2, k), position) is False


def lists_of(low: str, high: str) -> FactorLists:
    """Factors in x, and in x and y."""
    return FactorLists(
        RING, [[convert(read(f"{f} = 0"), RING).poly for f in level.split(", ")] for level in (low, high)]
    )  # type: ignore[attr-defined]


def over(*signs: int | None, level: tuple[int | None, ...] | None = None) -> Situation:
    """A cell of the line, with the signs of the factors in x; of the plane with those of the other factors."""
    rows: list[list[int | None]] = [list(signs), *([] if level is None else [list(level)])]
    some = [()] * len(rows)
    return Situation(rows, list(some), [frozenset()] * len(rows), [frozenset()] * len(rows), [0] * len(rows))


def test_roots_of_a_product_that_is_zero_on_the_whole_line() -> None:
    lists = lists_of("x, x - 1", "y, y - 1")
    test = compiled(convert(read("y = root(1, x*y)"), RING), lists, "matrix")

    def said(x: int, nullified: frozenset[int] = frozenset()) -> bool | None:
        sections: list[tuple[tuple[int, ...], ...]] = [(), ((0,), (1,))]
        return test(
            Situation([[x, -1], [0, -1]], sections, [frozenset(), frozenset((0,))], [frozenset(), nullified], [0, 1])
        )

    assert said(1) is True and said(-1) is True
    assert said(0) is False
    assert said(1, frozenset((0,))) is False
    assert said(1, frozenset((1,))) is True  # another factor


def test_roots_on_a_level_that_was_not_decomposed() -> None:
    """y^2 - x has no root for x < 0, one for x = 0, two at most elsewhere."""
    lists = lists_of("x", "y^2 - x, x*y^2 + y + 1")

    def said(text: str, x: int | None) -> bool | None:
        return compiled(convert(read(text), RING), lists, "matrix")(over(x))

    for relation in ("<", "="):
        assert [said(f"y {relation} root(1, y^2 - x)", x) for x in (-1, 0, 1, None)] == [False, None, None, None]
        assert [said(f"y {relation} root(-2, y^2 - x)", x) for x in (-1, 0, 1, None)] == [False, False, None, None]
        assert [said(f"y {relation} root(3, y^2 - x)", x) for x in (-1, 0, 1, None)] == [False] * 4


@pytest.mark.parametrize(
    ("text", "said"),
    [  # for the signs -, 0, + of x - 1
        ("y^2 + 2*y + x < 0", (None, False, False)),
        ("y^2 + 2*y + x <= 0", (None, None, False)),
        ("y^2 + 2*y + x = 0", (None, None, False)),
        ("-y^2 - 2*y - x > 0", (None, False, False)),
        ("-y^2 - 2*y - x >= 0", (None, None, False)),
        ("y^2 + 2*y + x > 0", (None, None, None)),
        ("y^2 + 2*y + x >= 0", (None, None, None)),
        ("y^2 + 2*y + x /= 0", (None, None, None)),
        ("y^2 + 2*y + x >= 0 or y > 0", (None, True, True)),
        ("y^2 + 2*y + x > 0 or y > 0", (None, None, True)),
        ("y^2 + 2*y + x /= 0 or y > 0", (None, None, True)),
        ("y^2 + 2*y + x < 0 or y > 0", (None, None, None)),
        ("x*y^2 + y - 3 < 0", (None, None, None)),
        ("y^2 + y + x <= 0", (None, None, None)),  # its discriminant is not listed
        ("y^2 + 1 = 0", (False, False, False)),
    ],
)
def test_a_quadratic_condition_needs_a_discriminant(text: str, said: tuple[bool | None, ...]) -> None:
    lists = lists_of("x - 1", "y^2 + 2*y + x, y, x*y^2 + y - 3, y^2 + y + x, y^2 + 1")
    unrestricted = (frozenset[int](), frozenset[int]())
    test = strengthened(convert(read(text), RING), lists, unrestricted, "matrix")
    assert tuple(test(over(s)) for s in (-1, 0, 1)) == said


@pytest.mark.parametrize("constraint", [frozenset((0,)), frozenset((1,)), frozenset((2,)), frozenset[int]()])
@pytest.mark.parametrize("text", ["y^2 = x and y = 1", "y = 1 and y^2 = x", "y^2 /= x or y /= 1"])
def test_two_equations_need_a_resultant_that_is_zero(text: str, constraint: frozenset[int]) -> None:
    lists = lists_of("x, x - 1", "y^2 - x, y - 1, y + 5")
    test = strengthened(convert(read(text), RING), lists, (frozenset(), constraint), "matrix")
    decided = "or" in text if constraint & {0, 1} else None
    assert [test(over(1, s)) for s in (-1, 0, 1)] == [decided, None, decided]
    assert test(over(1, 1, level=(0, 0, 1))) is ("or" not in text if decided is None else decided)
