"""Features of formulas."""

from __future__ import annotations

from qe.formula.features import features
from qe.io.text import read


def test_a_typical_problem() -> None:
    found = features(read("ex p, q. all s. p = 2*a - 1 and p^2 + q^2*s <= 27 and s^3 /= a"))
    assert found.free == ("a",)
    assert found.bound == ("p", "q", "s")
    assert (found.atoms, found.total_degree) == (3, 3)


def test_quantifiers_inside_and_root_atoms() -> None:
    found = features(read("(ex x. x > y) and not (all z, x. x < root(1, x^2*y - 2*z))"))
    assert found.free == ("y",)
    assert found.bound == ("x", "z")
    assert found.atoms == 2


def test_nothing() -> None:
    found = features(read("true"))
    assert (found.free, found.bound, found.atoms, found.total_degree) == ((), (), 0, 0)
