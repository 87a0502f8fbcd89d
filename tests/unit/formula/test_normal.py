"""Normal forms, against brute force: they are laws of first-order logic, so any finite universe must agree."""

from __future__ import annotations

import itertools
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from qe.formula.normal import Quantifier, close, nnf, prenex, rename, rename_apart
from qe.formula.syntax import Atom, Exists, ForAll, Formula, Not, Or, RootAtom
from qe.formula.traverse import children, is_quantifier_free, ring_of
from qe.io.text import read
from tests.strategies import formulas
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
    assert is_quantifier_free(matrix)
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
    assert str(apart) == "x > 0 and (ex x_1. y - x_1 > 0 and all x_2. x_2^2 - y >= 0) and ex y_1. x - y_1 = 0"
    ring = ring_of(apart)
    assert ring is not None and ring.names[:2] == ("x", "y")


def test_fresh_names_avoid_all_names_in_use() -> None:
    apart = rename_apart(read("x + x_1 > 0 and (ex x. x > x_1)"))
    assert str(apart) == "x + x_1 > 0 and ex x_2. x_1 - x_2 < 0"


def test_a_bound_root_variable_is_renamed_with_its_polynomial() -> None:
    apart = rename_apart(read("x > 0 and (ex x. x < root(1, x^2 - y))"))
    assert str(apart) == "x > 0 and ex x_1. x_1 < root(1, x_1^2 - y)"


def test_a_first_quantifier_keeps_its_name() -> None:
    formula = read("(ex x. x > a) and (ex x. x < a)")
    assert str(rename_apart(formula)) == "(ex x. a - x < 0) and ex x_1. a - x_1 > 0"


def test_rename_keeps_the_meaning() -> None:
    formula = read("x > y and x < root(1, x^2 - y)")
    assert str(rename(formula, {"x": "u"})) == "u - y > 0 and u < root(1, u^2 - y)"


def test_quantifier_dual() -> None:
    assert Quantifier.EXISTS.dual is Quantifier.FORALL and Quantifier.FORALL.dual is Quantifier.EXISTS


def test_atoms_of_a_nested_formula_stay_atoms() -> None:
    assert isinstance(nnf(read("not (x > 0 and not y > 0)")), Or)
    assert isinstance(nnf(read("not not x > 0")), Atom)
