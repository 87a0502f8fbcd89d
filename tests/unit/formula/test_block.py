"""Blocks of quantifiers: what is read off them, and that it is worked out once."""

from __future__ import annotations

import pytest

from qe.formula import block as module
from qe.formula.block import Block
from qe.formula.syntax import Exists, ForAll
from qe.io.text import read
from tests.tables import each


def of(text: str) -> Block:
    found = Block.of(read(text))
    assert found is not None
    return found


def test_what_is_read_off_a_block() -> None:
    block = of("all x, y. a*x^3 + b < 0 or x = 1 or x = 1")
    assert block.universal and block.is_flat and block.free == ("a", "b")
    assert (block.degree, block.curved, block.occurring, block.total) == (3, 1, 1, 3)
    assert [repr(p) for p in block.polynomials] == ["Poly(a*x^3 + b)", "Poly(x - 1)"]
    assert [str(part) for part in block.conditions] == ["a*x^3 + b >= 0", "x - 1 /= 0"]


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
