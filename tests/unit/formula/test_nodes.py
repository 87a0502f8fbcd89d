"""Formulas as values: nodes, relations, constructors, counting, blocks."""

import copy
import os
import pickle
import subprocess
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise, permutations
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from qe.api.input import read_formula
from qe.errors import InternalError
from qe.exact.ring import Ring
from qe.formula import block as module
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, disj, exists, forall, iff, implies, neg, root_atom
from qe.formula.counting import without_root_atoms
from qe.formula.evaluate import holds_at, substituted
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, FormulaNode, Or, Relation, RootAtom
from qe.formula.traverse import atoms, children, has_root_atoms, map_atoms
from qe.io.text import read
from qe.simplifier.simplify import _MOST, _remembered, simplify
from tests.strategies import RELATIONS, formulas
from tests.tables import each

ROOT = Path(__file__).resolve().parents[3]
FACTS = [vars(FormulaNode)[name] for name in ("_hash", "free", "is_quantifier_free", "ring")]


def occurring_free(formula: Formula) -> set[str]:
    """The definition, by walking through the whole formula."""
    if isinstance(formula, Atom | RootAtom):
        names = {formula.poly.ring.names[i] for i in formula.poly.variables}
        return names | ({formula.variable} if isinstance(formula, RootAtom) else set())
    bound = set(formula.variables) if isinstance(formula, Exists | ForAll) else set()
    return {name for child in children(formula) for name in occurring_free(child)} - bound


def quantified(formula: Formula) -> bool:
    return isinstance(formula, Exists | ForAll) or any(map(quantified, children(formula)))


@given(formulas(max_quantifiers=3, root_atoms=True))
def test_nodes_know_what_occurs_in_them(formula: Formula) -> None:
    rings = {a.poly.ring for a in atoms(formula)}
    assert len(rings) <= 1
    assert formula.ring is (rings.pop() if rings else None)
    names = () if formula.ring is None else formula.ring.names
    free = occurring_free(formula)
    for _ in range(2):  # found, and then remembered
        assert formula.free == tuple(name for name in names if name in free)
        assert formula.is_quantifier_free is not quantified(formula)


@each(
    ("x > 0 and (ex y. y > x)", ("x",)),
    ("(ex y. y > x) or z = 0 or x = 1", ("z", "x")),
    ("not (all x, z. x*y > z)", ("y",)),
)
def test_one_quantifier_among_other_parts(text: str, free: tuple[str, ...]) -> None:
    formula = read(text)
    assert set(formula.free) == set(free)
    assert formula.is_quantifier_free is not quantified(formula)


@given(formulas(max_quantifiers=2, root_atoms=True), formulas(max_quantifiers=2, root_atoms=True))
def test_equality_and_hash_see_the_formula_only(one: Formula, other: Formula) -> None:
    stored = pickle.dumps(one)
    twin = pickle.loads(stored)
    for fact in FACTS:
        with pytest.raises(AttributeError):
            fact.__get__(twin)
    for knows in (hash, lambda f: f.free, lambda f: f.is_quantifier_free, lambda f: f.ring, simplify):
        knows(one)
    assert one == twin == copy.deepcopy(one) == copy.copy(one)
    assert hash(one) == hash(twin)
    assert repr(one) == repr(twin)
    assert pickle.dumps(one) == stored
    assert (one == other) == (str(one) == str(other)) == (other in {one})


@given(formulas(max_quantifiers=1, root_atoms=True))
def test_converted_only_where_the_ring_changes(formula: Formula) -> None:
    ring = formula.ring
    if ring is None:
        return
    assert convert(formula, ring) is formula
    longer = Ring.of((*ring.names, "more"))
    there = convert(formula, longer)
    assert {a.poly.ring for a in atoms(there)} == {longer}
    assert convert(there, ring) == formula


@given(formulas(max_quantifiers=1, root_atoms=True))
def test_a_simplified_formula_is_not_simplified_again(formula: Formula) -> None:
    found = simplify(formula)
    equal = pickle.loads(pickle.dumps(found))
    with pytest.MonkeyPatch.context() as patch:
        patch.delattr("qe.simplifier.simplify._node")
        assert simplify(found) is found
        assert simplify(equal) is equal


def test_the_simplifier_forgets() -> None:
    memory: dict[object, Formula] = {}
    sizes = [len(memory) for k in range(3 * _MOST) if _remembered(memory, k, TRUE) == TRUE]
    assert max(sizes) == _MOST and sizes.count(1) == 3


@given(formulas(max_quantifiers=2, root_atoms=True))
def test_what_does_not_change_stays_the_node(formula: Formula) -> None:
    normal = nnf(formula)
    assert nnf(normal) is normal
    assert conj((normal,)) is disj((normal,)) is normal
    assert conj((TRUE, normal, normal)) is disj((normal, FALSE)) is normal
    assert map_atoms(normal, lambda leaf: leaf) is normal
    assert nnf(neg(neg(normal))) == normal


def test_joined_parts_are_flattened_and_met_once() -> None:
    x, y, z = read("x > 0 and y > 0 and z > 0").args
    assert conj((conj((x, y)), conj((y, x)))) == conj((x, y))
    assert conj((x, conj((x, y)))) == conj((x, y))
    assert conj((conj((x, y)), z)).args == (x, y, z)
    assert conj((And((x, x)),)) == x == disj((Or((x, x)),))


def test_nothing_is_known_under_assumptions() -> None:
    assumed = read("x > 0")
    there = simplify(read("x > 0 or x = -3"), assumed)
    assert there == TRUE
    kept = simplify(read("x > 1"), assumed)
    assert kept == read("x > 1")
    assert simplify(kept, read("x > 2")) == TRUE  # what is simple by itself is not simple under assumptions


def test_the_variable_of_a_root_atom_occurs_whatever_the_polynomial_is() -> None:
    ring = Ring.of(("x", "y"))
    assert (root_atom("x", Relation.LT, ring.var("x") - ring.var("y"), 1)).free == ("x", "y")


def test_constants_have_no_ring_and_no_variables() -> None:
    for constant in (TRUE, FALSE, exists(("x",), TRUE)):
        assert (constant.ring, constant.free, constant.is_quantifier_free) == (None, (), True)


def test_and_or_of_the_same_parts_differ() -> None:
    parts = [read("x > 0"), read("x < 1")]
    assert conj(parts) != disj(parts)
    assert len({conj(parts), disj(parts)}) == 2
    assert Exists(("x",), parts[0]) != ForAll(("x",), parts[0])


@each(lambda f: f.free, lambda f: f.is_quantifier_free, hash, lambda f: f.ring, lambda f: convert(f, f.ring))
def test_questions_to_large_formulas_are_answered_at_once(ask) -> None:
    ring = Ring.of(("x", "y", "z"))
    x, y, z = (ring.var(name) for name in ring.names)
    found = [atom(x * y * k + z * x - k, Relation.GT) for k in range(1, 3000)]
    formula = And(tuple(disj(pair) for pair in pairwise(found)))
    ask(formula)
    start = time.process_time()
    for _ in range(1000):
        ask(formula)
    assert time.process_time() - start < 3  # a walk through the formula takes ten milliseconds each time


def test_hashes_are_the_same_in_every_process_of_one_seed() -> None:
    """So that nothing that is ever gone through in the order of a set differs between runs that could be alike."""
    script = "from qe.io.text import read; print(hash(read('x > 0 and (y < 1 or ex z. z*x = 1)')))"
    run = [sys.executable, "-c", script]
    seeded = {**os.environ, "PYTHONHASHSEED": "1"}
    found = {subprocess.run(run, capture_output=True, check=True, env=seeded, cwd=ROOT).stdout for _ in range(2)}
    assert len(found) == 1


SIGNS = (-1, 0, 1)


@pytest.mark.parametrize("relation", list(Relation))
def test_negation_turning_and_strictness_by_definition(relation: Relation) -> None:
    python = {"=": "==", "/=": "!="}.get(relation.value, relation.value)
    for sign in SIGNS:
        truth = eval(f"{sign} {python} 0")
        assert relation.holds(sign) is truth
        assert (sign in relation.signs) is truth
        assert relation.negated.holds(sign) is not truth
        assert relation.flipped.holds(-sign) is truth
    assert relation.negated.negated is relation and relation.flipped.flipped is relation
    assert relation.is_strict is (0 not in relation.signs)


NARROW, WIDE = Ring.of(("x",)), Ring.of(("x", "y"))
SMALL = atom(NARROW.var("x"), Relation.GT)
LARGE = atom(WIDE.var("x") - 1, Relation.LT)
ROOT_ATOM = root_atom("x", Relation.EQ, WIDE.var("x") ** 3 - WIDE.var("y"), 1)


@each(conj, disj, And, Or)
@pytest.mark.parametrize(
    "foreign",
    [
        LARGE,
        ROOT_ATOM,
        neg(ROOT_ATOM),
        conj((LARGE, ROOT_ATOM)),
        disj((LARGE, ROOT_ATOM)),
        exists(["y"], ROOT_ATOM),
        forall(["x"], LARGE),
    ],
    ids=str,
)
def test_a_formula_over_two_rings_is_an_error_where_it_is_built(
    join: Callable[[tuple[Formula, ...]], Formula], foreign: Formula
) -> None:
    own = atom(NARROW.var("x") + 2, Relation.NE)
    for parts in permutations((SMALL, own, foreign)):
        with pytest.raises(InternalError, match=r"over two rings: Ring\(x(, y)?\) and Ring\(x(, y)?\)"):
            join(parts)
    assert join((SMALL, own)).ring is NARROW


@each(implies, iff)
def test_implications_are_over_one_ring(join: Callable[[Formula, Formula], Formula]) -> None:
    with pytest.raises(InternalError):
        join(SMALL, LARGE)
    assert join(convert(SMALL, WIDE), LARGE).ring is WIDE


def test_constants_go_with_every_ring() -> None:
    assert conj((TRUE, SMALL)) is SMALL
    assert And((TRUE, SMALL)).ring is NARROW
    assert And((TRUE, TRUE)).ring is None


POLYNOMIALS = ["x^2 - y", "x^3 - 3*x + y", "y*x^2 + x - 1", "y*x", "x^2*(x - y)", "x^2 + 1 + y^2", "y^2 - 1"]
INDICES = [1, 2, 3, -1, -2, -3]


@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from(POLYNOMIALS),
    st.sampled_from(INDICES),
    RELATIONS,
    st.integers(-4, 4),
    st.sampled_from([-1, 0, 1, 2, 4]),
)
def test_same_truth_at_points(text: str, k: int, relation: Relation, x: int, y: int) -> None:
    sides = read_formula(f"{text} = 0 or x = y")
    poly = next(iter(sides.args)).poly  # type: ignore[attr-defined]
    given_atom = root_atom("x", relation, poly, k)
    counted = without_root_atoms(given_atom)
    assert not has_root_atoms(counted) and set(counted.free) <= {"x", "y"}
    assert qe.decide(substituted(counted, {"x": x, "y": y})) is holds_at(given_atom, {"x": x, "y": y})


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.integers(-3, 3), min_size=1, max_size=5),
    st.sampled_from(["1", "x^2 - 2", "(x - 1)^2*(2*x + 1)", "x^4 - 5*x^2 + 5"]),
    st.sampled_from(INDICES),
    RELATIONS,
)
def test_the_roots_of_a_polynomial_in_one_variable_are_numbers(
    lower: list[int], factor: str, k: int, relation: Relation
) -> None:
    shown = " + ".join(f"({c})*x^{e}" for e, c in enumerate([*lower, 1]))
    poly = next(iter(read_formula(f"({shown})*({factor}) = 0 or x = 7").args)).poly  # type: ignore[attr-defined]
    given_atom = root_atom("x", relation, poly, k)
    plain = without_root_atoms(given_atom)
    assert plain.is_quantifier_free and not has_root_atoms(plain)
    for x in (Fraction(n, 4) for n in range(-12, 13)):
        assert holds_at(plain, {"x": x}) is holds_at(given_atom, {"x": x})


def test_formulas_without_root_atoms_are_left_alone() -> None:
    formula = read_formula("ex x. x^2 < a")
    assert without_root_atoms(formula) is formula


@each(
    ("ex c. c <= root(2, 4*b^3 + 27*c^2)", "b < 0"),  # two roots in c only there
    ("all x. x < root(-1, x^2 - y) or x >= root(-1, x^2 - y)", "y >= 0"),  # false where there is no root
    ("x = root(1, x^2 - y)", "x^2 = y and x <= 0"),
    ("all t_0. t_0 > root(1, t_0 - a) -> t_0 > b", "b <= a"),  # the new names are new
)
def test_questions_about_roots_are_answered(text: str, expected: str) -> None:
    answer = qe.eliminate(text)
    assert answer.formula is not None and not has_root_atoms(answer.formula)
    assert qe.equivalent(answer.formula, expected)
    assert qe.equivalent(text, expected)


def of(text: str) -> Block:
    found = Block.of(read(text))
    assert found is not None
    return found


def test_what_is_read_off_a_block() -> None:
    block = of("all x, y. a*x^3 + b < 0 or x = 1 or x = 1")
    assert block.universal and block.is_flat and block.free == ("a", "b")
    assert (block.degree, block.curved, block.occurring, block.total) == (3, 1, 1, 3)
    assert [repr(p) for p in block.polynomials] == ["Poly(a*x^3 + b)", "Poly(x - 1)"]
    assert [str(part) for part in block.conditions] == ["a*x^3 + b >= 0", "x /= 1"]


@each("ex x. x^2 < a or not x = 1", "all x. x^2 > a -> x = 1", "ex x. all y. x = y")
def test_the_dual_is_existential_and_in_normal_form(text: str) -> None:
    block = of(text)
    dual = block.dual
    assert isinstance(dual.formula, Exists) and dual.body.is_normal and dual.dual is dual
    assert block.asked(dual.formula) == (block.formula if isinstance(block.formula, ForAll) else dual.formula)


def test_the_normal_form_is_found_once(monkeypatch: pytest.MonkeyPatch) -> None:
    times: list[object] = []
    normal = module.nnf
    monkeypatch.setattr(module, "nnf", lambda *args, **negate: times.append(args) or normal(*args, **negate))
    block = of("all x. x^2 + a*x > 0 or x < 1")
    for _ in range(3):
        assert block.positive is block.dual.body and block.conditions
    assert len(times) == 1


def test_what_is_no_block() -> None:
    assert Block.of(read("x > 0 and (ex y. y = x)")) is None
