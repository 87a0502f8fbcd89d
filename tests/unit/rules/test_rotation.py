"""Rotations: which are found, what they leave, and that nothing is fixed that is not free."""

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.formula.syntax import Exists, ForAll, Formula
from qe.formula.traverse import polynomials
from qe.io.text import read
from qe.rules.lift import holds_at
from qe.rules.rotation import invariant_plane, rotations
from qe.rules.step import StepKind
from tests.property.prepare_support import prepared_with_rules
from tests.tables import each

VECTORS = "ex a1, a2, a3, b1, b2, b3. a1^2 + a2^2 + a3^2 = 1 and b1^2 + b2^2 + b3^2 = 4 and a1*b1 + a2*b2 + a3*b3 = c"


def turned(text: str) -> Formula:
    return prepared_with_rules(read(text), enabled={StepKind.ROTATION})[0].formula


def names(formula: Formula) -> set[str]:
    return set(formula.variables) if isinstance(formula, Exists | ForAll) else set()


def test_two_vectors_in_space_leave_one_length_and_two_coordinates() -> None:
    """The first vector on an axis, the second in a plane with it: three of six coordinates are left."""
    assert len(names(turned(VECTORS))) == 3
    answer = qe.eliminate(VECTORS)
    assert answer.formula == read("-2 <= c and c <= 2")


def test_all_rotations_of_space_are_found() -> None:
    body = read(VECTORS).body  # type: ignore[attr-defined]
    index = body.args[0].poly.ring.index
    pairs = [
        (index[u], index[v])
        for u in ["a1", "a2", "a3", "b1", "b2", "b3"]
        for v in ["a1", "a2", "a3", "b1", "b2", "b3"]
        if u < v
    ]
    found = rotations(polynomials(body), [tuple(sorted(p)) for p in pairs])  # type: ignore[misc]
    assert len(found) == 3
    assert all(len(skew) == 2 for skew in found)


@each(
    "ex x, y. x^2 + y^2 < a and x > b",  # a direction is named
    "ex x, y. x^2 + 2*y^2 < a and x*y > 1",  # an ellipse
    "ex x, y. x^2 - y^2 > a and x*y > 1",  # hyperbolic angles only
    "ex x. all y. x^2 + y^2 > a and x^2*y^2 < b",  # a rotation would mix two quantifiers
    "all x, y. x^3 + y^3 > 0 or x^2 + y^2 > a",
    "ex x, y. (x = 0 or y /= 0) and x^2 + y^2 < a",  # components in a formula that is no vector's
)
def test_what_is_not_symmetric_stays(text: str) -> None:
    assert prepared_with_rules(read(text), enabled={StepKind.ROTATION})[1] == []


def test_inner_blocks_turn_with_the_outer_one() -> None:
    """The nearest point of a disc to a point at distance r: the angle of the point does not matter."""
    text = "ex x, y. x^2 + y^2 = r and all u, v. u^2 + v^2 /= 1 or (x - u)^2 + (y - v)^2 >= s"
    assert len(names(turned(text))) == 1
    far = qe.eliminate("ex x, y. x^2 + y^2 = 4 and all u, v. u^2 + v^2 /= 1 or (x - u)^2 + (y - v)^2 >= s")
    assert far.formula == read("s - 1 <= 0")


def test_components_are_taken_together() -> None:
    text = "ex x, y, u, v. x^2 + y^2 = a and u^2 + v^2 = b and (x /= u or y /= v) and x*u + y*v = c"
    assert len(names(turned(text))) == 3
    equal = "ex x, y, u, v. x = u and y = v and x^2 + y^2 = a and x*v - y*u >= b"
    assert len(names(turned(equal))) == 3


def test_a_name_bound_twice_is_left_alone() -> None:
    body = read("x^2 + y^2 < a and (ex u, v. u*x + v*y > b and u^2 + v^2 = 1)")
    twice = Exists(("u", "x", "y"), body)
    assert invariant_plane(twice.variables, twice.body, ()) is None


@st.composite
def invariant(draw: st.DrawFn) -> str:
    """Conditions on lengths and angles of two vectors of the plane, with a parameter."""
    terms = ["(x^2 + y^2)", "(u^2 + v^2)", "(x*u + y*v)", "(x*v - y*u)"]

    def condition() -> str:
        left = f"{draw(st.integers(-2, 2))}*{draw(st.sampled_from(terms))} + {draw(st.sampled_from(terms))}"
        right = draw(st.sampled_from(["k", "1", "-1", "2*k", "0"]))
        return f"{left} {draw(st.sampled_from(['<=', '<', '=', '/=']))} {right}"

    prefix = draw(st.sampled_from(["ex x, y, u, v.", "all x, y, u, v.", "ex x, y. all u, v.", "all x, y. ex u, v."]))
    joint = draw(st.sampled_from([" and ", " or "]))
    return f"{prefix} x^2 + y^2 = 1 and ({condition()}{joint}{condition()})"


@settings(max_examples=6, deadline=None)
@given(invariant(), st.sampled_from([Fraction(-1), Fraction(0), Fraction(1, 2), Fraction(1), Fraction(2)]))
def test_answers_are_the_same_without_it(text: str, value: Fraction) -> None:
    text = text.replace("k", f"({value})")
    found = [qe.eliminate(text, timeout=2, without=without).formula for without in ((), ("symmetry",))]
    assert None in found or found[0] == found[1], text


def test_witnesses_come_back() -> None:
    text = "ex x, y, u, v. x^2 + y^2 = 2 and u^2 + v^2 = 3 and x*u + y*v = 1 and x*v - y*u < 0"
    answer = qe.eliminate(text)
    assert answer.witness is not None
    assert set(answer.witness) == {"x", "y", "u", "v"}
    body = read(text).body  # type: ignore[attr-defined]
    assert holds_at(body, answer.witness)  # type: ignore[arg-type]
