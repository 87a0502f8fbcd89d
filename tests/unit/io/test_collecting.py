"""The names of a tree in order, and the depth that readers accept."""

from __future__ import annotations

import pytest

from qe.errors import InputError
from qe.formula.relation import Relation
from qe.io import surface as s
from qe.io.collecting import Names, chain
from qe.io.text_parser import TextParser
from tests.tables import each


def fail(message: str, at: int) -> InputError:
    return InputError(f"{message} at {at}")


def collected(text: str) -> tuple[list[str], list[str], list[str], int, list[tuple[str, int]]]:
    met: list[tuple[str, int]] = []
    names = Names(fail, lambda name, at: met.append((name, at)))
    names.node(TextParser(text).whole(), frozenset(), 0)
    return list(names.free), list(names.bound), names.all(), names.special, met


@each(
    ("y > 0 and x > z", "yxz", "", 0),
    ("ex x. x > a and (all y. y > b)", "ab", "xy", 0),
    ("x > 0 and (ex x. x > a)", "xa", "x", 0),
    ("(ex x. x > a) and x > 0", "ax", "x", 0),
    ("not (a > 0 -> b > 0) or (c > 0 <-> d > 0)", "abcd", "", 0),
    ("1/x + a/2 > -y^3", "xay", "", 1),  # a number below needs no name
    ("x^(1/2) + y^2 + z^(2/3) > 0", "xyz", "", 2),
    ("abs(x) + max(y, z, 1) > 0", "xyz", "", 2),
    ("(if a > 0 then b else c) > 0", "abc", "", 1),
    ("a < root(2, x^2 - b, x)", "axb", "", 1),
    ("ex x. a < root(2, x^2 - b, x)", "ab", "x", 1),
    ("true or a = 0", "a", "", 0),
)
def test_names_free_before_bound(text: str, free: str, bound: str, special: int) -> None:
    found = collected(text)
    assert ("".join(found[0]), "".join(found[1]), found[3]) == (free, bound, special)
    assert "".join(found[2]) == free + "".join(name for name in bound if name not in free)


def test_free_names_are_met_with_their_offsets() -> None:
    assert collected("x > y and ex y. y*x > 1")[4] == [("x", 0), ("y", 4), ("x", 18)]


def test_the_variable_of_a_root_counts_where_its_polynomial_lacks_it() -> None:
    assert collected("a < root(1, b, x)")[0] == ["a", "b", "x"]


def nested(depth: int) -> s.Node:
    node: s.Node = s.Comparison([s.Name("x", 0), s.Number(0)], [Relation.GT], 0)
    for _ in range(depth):
        node = s.Negation(node)
    return node


def deep_term(depth: int) -> s.Node:
    term: s.Term = s.Name("x", 0)
    for _ in range(depth):
        term = s.Minus(term)
    return s.Comparison([term], [], 0)


@each(nested, deep_term)
def test_depth_is_bounded(made: object) -> None:
    names = Names(fail, lambda name, at: None)
    names.node(made(s.MAX_DEPTH - 1), frozenset(), 0)  # type: ignore[operator]
    with pytest.raises(InputError, match="nested more than 120 levels"):
        names.node(made(s.MAX_DEPTH), frozenset(), 0)  # type: ignore[operator]


@each(
    lambda t: s.Sum([t, s.Number(1)]),
    lambda t: s.Product(s.Number(2), t, 0),
    lambda t: s.Power(t, s.Number(2), 0),
    lambda t: s.Power(s.Number(2), t, 0),
    lambda t: s.Apply("abs", [t], 0),
    lambda t: s.Root(s.Number(1), t, "x", 0),
    lambda t: s.Choice(s.Truth(True), t, None, 0),
    lambda t: s.Choice(s.Truth(True), s.Number(1), t, 0),
    lambda t: s.Choice(s.Comparison([t], [], 0), s.Number(1), s.Number(2), 0),
)
def test_every_kind_of_term_counts_a_level(step: object) -> None:
    term: s.Term = s.Name("x", 0)
    for _ in range(s.MAX_DEPTH + 1):
        term = step(term)  # type: ignore[operator]
    with pytest.raises(InputError, match="nested"):
        Names(fail, lambda name, at: None).term(term, frozenset(), 0)


def test_long_chains_are_no_depth() -> None:
    """a*b/c… is one level however long it is, and is walked without recursion."""
    term: s.Term = s.Name("x", 0)
    links: list[s.Term] = []
    for k in range(5000):
        term = (s.Product if k % 2 else s.Quotient)(term, s.Name(f"y{k % 3}", k), k)
        links.append(term)
    first, found = chain(term)
    assert first == s.Name("x", 0) and [id(link) for link in found] == [id(link) for link in links]
    names = Names(fail, lambda name, at: None)
    names.term(term, frozenset(), 0)
    assert names.all() == ["x", "y0", "y1", "y2"] and names.special == 2500


def test_a_chain_starts_at_what_is_known() -> None:
    inner = s.Product(s.Name("a", 0), s.Name("b", 1), 0)
    outer = s.Quotient(inner, s.Name("c", 2), 2)
    assert chain(outer, {id(inner)}) == (inner, [outer])
    assert chain(outer) == (s.Name("a", 0), [inner, outer])
    assert chain(s.Number(1)) == (s.Number(1), [])
