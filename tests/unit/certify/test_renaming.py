"""Formulas that are the same up to the names of bound variables."""

from __future__ import annotations

import pytest

from qe.certify.renaming import shape
from qe.formula.syntax import And, Exists, ForAll, Formula
from qe.io.text import read


def _beside(idle: type[Exists] | type[ForAll], first: str, *inside: str) -> Formula:
    """A conjunction with another one behind a quantifier that binds nothing."""
    whole = read(" and ".join((first, *inside)))
    assert isinstance(whole, And)
    return And((whole.args[0], idle(("z",), And(whole.args[1:]))))


@pytest.mark.parametrize("idle", [Exists, ForAll])
def test_what_an_idle_quantifier_held_apart_joins_its_neighbours(idle: type[Exists] | type[ForAll]) -> None:
    given = _beside(idle, "x > 0", "y > 0", "x*y > 1")
    assert shape(given) == shape(read("x > 0 and y > 0 and x*y > 1"))
    assert shape(given) != shape(read("x > 0 and (y > 0 or x*y > 1)"))
