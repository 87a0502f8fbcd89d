"""Normal forms, walks of formulas, values at points."""

import itertools
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from qe.errors import InputError
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj
from qe.formula.evaluate import holds_at, truth_under
from qe.formula.normal import Quantifier, close, nnf, prenex, rename, rename_apart
from qe.formula.syntax import Atom, Exists, ForAll, Formula, Not, Or, Relation, RootAtom
from qe.formula.traverse import (
    atoms,
    bound_variables,
    children,
    conjuncts,
    connected,
    disjuncts,
    polynomials,
    subformulas,
)
from qe.io.text import read
from tests.strategies import formulas, points, rationals
from tests.tables import each
from tests.universe import UNIVERSE, holds


def binders(formula: Formula) -> list[str]:
    own = list(formula.variables) if isinstance(formula, Exists | ForAll) else []
    return own + [name for child in children(formula) for name in binders(child)]


def nots(formula: Formula) -> list[Formula]:
    own = [formula.arg] if isinstance(formula, Not) else []
    return own + [arg for child in children(formula) for arg in nots(child)]


quantified = formulas(names=("x", "y"), max_quantifiers=4, root_atoms=True)
places = st.fixed_dictionaries({name: st.sampled_from(UNIVERSE) for name in ("x", "y")})


@given(quantified, places, st.booleans())
def test_nnf_is_equivalent_without_inner_negation(formula: Formula, point: dict[str, Fraction], negate: bool) -> None:
    result = nnf(formula, negate=negate)
    assert holds(result, point) == (holds(formula, point) != negate)
    assert all(isinstance(arg, RootAtom) for arg in nots(result))


@given(quantified, places)
def test_rename_apart(formula: Formula, point: dict[str, Fraction]) -> None:
    result = rename_apart(formula)
    bound = binders(result)
    assert len(set(bound)) == len(bound)
    assert not set(bound) & set(formula.free)
    assert set(result.free) <= set(formula.free)
    assert holds(result, point) == holds(formula, point)
    for part in walk(result):
        if isinstance(part, Exists | ForAll):
            assert set(part.variables) <= set(part.body.free), "vacuous quantifiers are dropped"


@given(quantified, places)
def test_prenex(formula: Formula, point: dict[str, Fraction]) -> None:
    prefix, matrix = prenex(formula)
    assert matrix.is_quantifier_free
    assert all(a[0] is not b[0] and a[1] and b[1] for a, b in itertools.pairwise(prefix))
    assert holds(close(prefix, matrix), point) == holds(formula, point)


def walk(formula: Formula) -> list[Formula]:
    return [formula, *(part for child in children(formula) for part in walk(child))]


@each(
    ("(ex x. x > a) and (all y. y^2 >= a)", "EA"),
    ("(ex x. all y. x > y) and (ex z. all w. z > w + a)", "EA"),
    ("(ex x. all y. x > y) and (all z. ex w. z > w + a)", "EAE"),
    ("(ex x. x > a) -> (all y. y > a)", "A"),
    ("not (ex x. all y. x < y and y < a)", "AE"),
    ("(ex x. x > a) <-> (ex x. x < a)", "EA"),
    ("ex x. x > 0 and a > 0", "E"),
    ("ex x. ex y. x > y", "E"),
    ("a > 0", ""),
    ("ex x. a > 0", ""),
    ("ex x. true", ""),
)
def test_prenex_has_few_blocks(text: str, blocks: str) -> None:
    prefix, _ = prenex(read(text))
    assert "".join(kind.value for kind, _ in prefix) == blocks


def test_shadowing_and_clashes_are_resolved() -> None:
    apart = rename_apart(read("x > 0 and (ex x. x < y and (all x. x^2 >= y)) and (ex y. y = x)"))
    assert str(apart) == "x > 0 and (ex x_1. y > x_1 and all x_2. y <= x_2^2) and ex y_1. x = y_1"
    ring = apart.ring
    assert ring is not None and ring.names[:2] == ("x", "y")


@each(
    {
        "fresh names avoid all names in use": (
            "x + x_1 > 0 and (ex x. x > x_1)",
            "x + x_1 > 0 and ex x_2. x_1 < x_2",
        ),
        "a bound root variable is renamed with its polynomial": (
            "x > 0 and (ex x. x < root(1, x^2 - y))",
            "x > 0 and ex x_1. x_1 < root(1, x_1^2 - y)",
        ),
        "a first quantifier keeps its name": (
            "(ex x. x > a) and (ex x. x < a)",
            "(ex x. a < x) and ex x_1. a > x_1",
        ),
    }
)
def test_names_apart(text: str, apart: str) -> None:
    assert str(rename_apart(read(text))) == apart


def test_rename_keeps_the_meaning() -> None:
    formula = read("x > y and x < root(1, x^2 - y)")
    assert str(rename(formula, {"x": "u"})) == "u > y and u < root(1, u^2 - y)"


def test_quantifier_dual() -> None:
    assert Quantifier.EXISTS.dual is Quantifier.FORALL and Quantifier.FORALL.dual is Quantifier.EXISTS


def test_atoms_of_a_nested_formula_stay_atoms() -> None:
    assert isinstance(nnf(read("not (x > 0 and not y > 0)")), Or)
    assert isinstance(nnf(read("not not x > 0")), Atom)


RING = Ring.of(("a", "b", "c", "d", "e"))


def test_members() -> None:
    both, either, one = read("x > 0 and y > 0"), read("x > 0 or y > 0"), read("x > 0")
    assert conj(conjuncts(both)) == both and len(conjuncts(both)) == 2
    assert conjuncts(either) == (either,) and conjuncts(one) == (one,)
    assert disj(disjuncts(either)) == either and len(disjuncts(either)) == 2
    assert disjuncts(both) == (both,)


def test_subformulas_come_from_the_outside_in() -> None:
    formula = read("(ex x. x > a and not x < root(1, x^2 - 2)) or b = 0")
    found = list(subformulas(formula))
    assert found[0] is formula
    assert [f for f in found if f in set(atoms(formula))] == list(atoms(formula))
    assert any(isinstance(f, Not) for f in found) and any(isinstance(f, Exists) for f in found)


def test_bound_variables_in_order_without_repetition() -> None:
    assert bound_variables(read("ex y, x. (all z. x < z) or (ex x. x = y)")) == ("y", "x", "z")
    assert bound_variables(read("x > 0")) == ()


@given(st.lists(st.sets(st.sampled_from(RING.names)).map(frozenset), max_size=6))
def test_connected_parts(shares: list[frozenset[str]]) -> None:
    """Groups partition the parts, share no name, and cannot be split further."""
    parts = [
        atom(sum((RING.var(n) for n in sorted(names)), RING.constant(0)) * RING.var("e") ** 2 - k, Relation.GT)
        for k, names in enumerate(shares, start=1)
    ]
    block = frozenset("abcd")
    outside, groups = connected(parts, lambda part: block.intersection(part.free))
    assert sorted(map(str, (*outside, *(p for _, members in groups for p in members)))) == sorted(map(str, parts))
    assert all(not block & set(p.free) for p in outside)
    seen: set[str] = set()
    for names, members in groups:
        assert names == frozenset().union(*(block & set(p.free) for p in members))
        assert not names & seen
        seen |= names
        reached = {members[0]}
        for _ in members:
            known = {n for p in reached for n in p.free if n in block}
            reached |= {p for p in members if known & set(p.free)}
        assert reached == set(members)


HALF = Fraction(1, 2)


@each(
    ("x^2 + y^2 <= 1", {"x": Fraction(3, 5), "y": Fraction(4, 5)}, True),
    ("x^2 + y^2 < 1", {"x": Fraction(3, 5), "y": Fraction(4, 5)}, False),
    ("x = 1/3 and not y > 0", {"x": Fraction(1, 3), "y": 0}, True),
    ("x /= 0 or y = 7", {"x": 0, "y": 7}, True),
    ("true", {}, True),
    ("x < root(2, x^2 - y)", {"x": 1, "y": 2}, True),
    ("x < root(2, x^2 - y)", {"x": 2, "y": 2}, False),
    ("x = root(1, x^2 - y)", {"x": -2, "y": 4}, True),
    ("x = root(-1, x^2 - y)", {"x": 2, "y": 4}, True),
    ("x >= root(1, x^2 - y)", {"x": 0, "y": 0}, True),
    ("x >= root(2, x^2 - y)", {"x": 0, "y": 0}, False),
    ("x /= root(1, x^2 - y)", {"x": 0, "y": -1}, False),
    ("not x /= root(1, x^2 - y)", {"x": 0, "y": -1}, True),
    ("x /= root(1, x*y)", {"x": 3, "y": 0}, False),
    ("x > root(-2, (x-1)^2*(x-2)*(x-y))", {"x": HALF + 1, "y": 5}, False),
    ("x > root(-3, (x-1)^2*(x-2)*(x-y))", {"x": HALF + 1, "y": 5}, True),
)
def test_holds_at(text: str, point: dict[str, Fraction], expected: bool) -> None:
    assert holds_at(read(text), point) is expected


@each(("x > y", "y"), ("ex y. x > y", "quantifier-free"))
def test_what_cannot_be_evaluated_is_said(text: str, named: str) -> None:
    with pytest.raises(InputError, match=named):
        holds_at(read(text), {"x": 1})


def test_more_values_than_variables_are_welcome() -> None:
    assert holds_at(read("x > 0"), {"x": 1, "unrelated": 5})


@given(formulas(names=("x", "y")), points(("x", "y")), st.data())
def test_partial_truth_is_right_under_every_completion(
    formula: Formula, point: dict[str, Fraction], data: st.DataObject
) -> None:
    known = {p: data.draw(st.booleans()) for p in polynomials(formula)}

    def sign(poly: Poly) -> int | None:
        value = poly.evaluate([point["x"], point["y"]])
        return (value > 0) - (value < 0) if known[poly] else None

    partial = truth_under(formula, sign)
    whole = holds_at(formula, point)
    assert partial in (None, whole)
    if all(known.values()):
        assert partial is whole


@given(rationals(), rationals(), st.sampled_from(tuple(Relation)), st.sampled_from((1, 2, -1, -2)))
def test_root_atoms_follow_the_square_root(x: Fraction, y: Fraction, relation: Relation, k: int) -> None:
    poly = read("x^2 - y^2 = 0").poly  # type: ignore[attr-defined]
    roots = sorted({y, -y})
    expected = False
    if abs(k) <= len(roots):
        root = roots[k - 1] if k > 0 else roots[k]
        expected = relation.holds((x > root) - (x < root))
    assert holds_at(RootAtom("x", relation, poly, k), {"x": x, "y": y}) is expected
