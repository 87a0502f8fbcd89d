"""Features of formulas."""

from __future__ import annotations

import pytest

from qe.formula.features import Shape, features
from qe.formula.syntax import Relation
from qe.io.text import read


def test_a_typical_problem() -> None:
    f = features(read("ex p, q. all s. p = 2*a - 1 and p^2 + q^2*s <= 27 and s^3 /= a"))
    assert f.free == ("a",)
    assert f.bound == ("p", "q", "s")
    assert f.blocks == (2, 1)
    assert f.alternations == 1
    assert f.outermost_universal is False
    assert f.degrees == {"a": 1, "p": 2, "q": 2, "s": 3}
    assert f.occurrences == {"a": 2, "p": 2, "q": 1, "s": 2}
    assert f.linear_in == frozenset() and f.quadratic_in == {"p", "q"}
    assert (f.atoms, f.polynomials, f.total_degree, f.equations) == (3, 3, 3, 1)
    assert f.max_terms == 3 and f.max_bits == 5
    assert f.relations == {Relation.EQ: 1, Relation.LE: 1, Relation.NE: 1}
    assert f.shape is Shape.CONJUNCTION
    assert not f.is_sentence and not f.one_block and not f.all_strict
    assert f.max_bound_degree == 3


@pytest.mark.parametrize(
    ("text", "blocks", "alternations", "shape"),
    [
        ("x > 0", (), 0, Shape.ATOM),
        ("true", (), 0, Shape.CONSTANT),
        ("x > 0 or y < 1", (), 0, Shape.DISJUNCTION),
        ("x > 0 or y < 1 and x < 2", (), 0, Shape.MIXED),
        ("(ex x. x > y) and y > 0", None, 0, Shape.MIXED),
        ("ex x. not ex y. x > y", None, 1, Shape.MIXED),
        ("ex x. not all y. x > y", None, 0, Shape.MIXED),
        ("all x. ex y. all z. x > y*z", (1, 1, 1), 2, Shape.ATOM),
    ],
)
def test_prefix_and_shape(text: str, blocks: tuple[int, ...] | None, alternations: int, shape: Shape) -> None:
    f = features(read(text))
    assert (f.blocks, f.alternations, f.shape) == (blocks, alternations, shape)


def test_flags() -> None:
    assert features(read("ex x. x^2 < y")).all_strict
    assert not features(read("x < root(1, x^2 - y)")).all_strict
    assert features(read("ex x, y. x > y")).one_block
    assert features(read("ex x, y. x > y")).linear_in == {"x", "y"}
    assert features(read("x > 0")).is_quantifier_free
    assert features(read("all x. x > 0")).outermost_universal is True
    assert features(read("x > 0")).outermost_universal is None
    assert features(read("ex x. x > 0 or x < root(1, x^2 - 2)")).root_atoms == 1
