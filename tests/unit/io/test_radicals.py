"""Comparisons freed of auxiliary values: by substitution of square roots, and by quantifiers elsewhere."""

from fractions import Fraction
from math import isqrt

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Exists, ForAll, Formula, Relation
from qe.io.auxiliaries import MOST_SUBSTITUTED, Auxiliary, Place, settled
from tests.strategies import polynomials
from tests.tables import each

RING = Ring.of(("x", "t", "s"))
X, T, S = (RING.var(name) for name in RING.names)


def square_root(name: str = "s", radicand: Poly = T) -> Auxiliary:
    s = RING.var(name)
    definition = conj((atom(s, Relation.GE), atom(s * s - radicand, Relation.EQ)))
    return Auxiliary(name, definition, atom(radicand, Relation.GE), radicand)


@given(polynomials(RING, max_degree=4), st.sampled_from(tuple(Relation)), st.integers(-3, 3), st.integers(0, 4))
def test_a_square_root_is_substituted(poly: Poly, relation: Relation, x: int, root: int) -> None:
    """At t = root^2 the formula without s says what the polynomial says for s = root."""
    freed = settled(atom(poly, relation), {"s": square_root()}, Place())
    assert "s" not in freed.free and freed.is_quantifier_free
    value = poly.evaluate((x, root * root, root))
    assert holds_at(freed, {"x": x, "t": root * root, "s": 0}) == relation.holds((value > 0) - (value < 0))


@given(st.sampled_from(tuple(Relation)), st.integers(-4, 4), st.integers(-4, 4), st.integers(0, 30))
def test_irrational_roots(relation: Relation, a: int, b: int, t: int) -> None:
    """a + b*sqrt(t) against zero, by floor(sqrt(t * 10^40)): no sum of these is that close to zero without being it."""
    freed = settled(atom(a + b * S, relation), {"s": square_root()}, Place())
    exact = a * a == b * b * t and a * b <= 0
    near = Fraction(isqrt(t * 10**40), 10**20)
    value = Fraction(0) if exact else a + b * near
    assert holds_at(freed, {"x": 0, "t": t, "s": 0}) == relation.holds((value > 0) - (value < 0))


def test_connectives_and_quantifiers_are_gone_through() -> None:
    inner = conj((atom(S - X, Relation.GT), disj((atom(S - 1, Relation.LT), neg(atom(S + X, Relation.EQ))))))
    freed = settled(inner, {"s": square_root()}, Place())
    for x in range(-3, 4):
        for root in range(4):
            point = {"x": x, "t": root**2, "s": 0}
            assert holds_at(freed, point) == (root > x and (root < 1 or root + x != 0))
    bound = Exists(("x",), atom(S * X - 1, Relation.EQ))
    found = settled(bound, {"s": square_root()}, Place())
    assert isinstance(found, Exists) and found.variables == ("x",) and "s" not in found.free
    assert settled(atom(X, Relation.GT), {"s": square_root()}, Place()) == atom(X, Relation.GT)


def cube_root() -> Auxiliary:
    return Auxiliary("s", atom(S**3 - T, Relation.EQ), TRUE)


@each(
    (Place(), Exists),
    (Place(universal=True), ForAll),
    (Place().denied, ForAll),
    (Place(asserted=False, universal=True), Exists),
)
def test_other_values_get_the_quantifier_that_stands_around(place: Place, kind: type[Formula]) -> None:
    found = settled(atom(S - X, Relation.GT), {"s": cube_root()}, place)
    assert isinstance(found, kind)
    definition, gap = cube_root().definition, atom(S - X, Relation.GT)
    body = conj((definition, gap)) if kind is Exists else disj((neg(definition), gap))
    assert found == kind(("s",), body)  # type: ignore[call-arg]


def test_where_a_value_is_partial_the_universal_form_says_where() -> None:
    partial = square_root()._replace(radicand=None)
    found = settled(atom(S - X, Relation.GT), {"s": partial}, Place(universal=True))
    assert str(found).startswith("t >= 0 and all s. ")


@each((True, Exists), (False, ForAll))
def test_loose_values_weaken_what_is_asserted(asserted: bool, kind: type[Formula]) -> None:
    loose = Auxiliary("s", TRUE, TRUE, loose=True)
    gap = atom(S - X, Relation.GT)
    assert settled(gap, {"s": loose}, Place(asserted)) == kind(("s",), gap)  # type: ignore[call-arg]


def test_more_square_roots_than_a_few_are_bound_instead() -> None:
    names = tuple(f"s{k}" for k in range(MOST_SUBSTITUTED + 1))
    ring = Ring.of(("x", *names))
    values = {}
    for name in names:
        s = ring.var(name)
        radicand = ring.var("x") + len(values) + 1
        definition = conj((atom(s, Relation.GE), atom(s * s - radicand, Relation.EQ)))
        values[name] = Auxiliary(name, definition, atom(radicand, Relation.GE), radicand)
    total = sum((ring.var(name) for name in names), ring.constant(0))
    few = settled(atom(ring.var("s0") + ring.var("s1") - 3, Relation.GT), values, Place())
    assert few.is_quantifier_free and few.free == ("x",)
    many = settled(atom(total - 3, Relation.GT), values, Place())
    assert not many.is_quantifier_free and many.free == ("x",)


def test_nested_roots_are_freed_from_the_last_to_the_first() -> None:
    """sqrt(1 + sqrt(t)) > x at t = 9 says 2 > x."""
    ring = Ring.of(("x", "t", "s", "r"))
    x, t, s, r = (ring.var(name) for name in ring.names)
    inner = Auxiliary("s", conj((atom(s, Relation.GE), atom(s * s - t, Relation.EQ))), atom(t, Relation.GE), t)
    outer = Auxiliary(
        "r", conj((atom(r, Relation.GE), atom(r * r - 1 - s, Relation.EQ))), atom(s + 1, Relation.GE), s + 1
    )
    freed = settled(atom(r - x, Relation.GT), {"s": inner, "r": outer}, Place())
    assert set(freed.free) <= {"x", "t"} and freed.is_quantifier_free
    for value in (-5, -2, 0, 1, 2, 3):
        assert holds_at(freed, {"x": value, "t": 9, "s": 0, "r": 0}) == (value < 2)


def test_places() -> None:
    assert Place().denied == Place(False, False) and Place().denied.denied == Place()
    assert Place().inside(True) == Place(True, True)
    assert Place(False).inside(True) == Place(False, False)
    assert Place(False).inside(False) == Place(False, True)
