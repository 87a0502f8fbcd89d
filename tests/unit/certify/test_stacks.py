"""Roots of one factor over a sample: all of them listed, one in each section, and no others."""

from __future__ import annotations

from fractions import Fraction

import pytest

from qe.certify.arithmetic.fibre import Fibre, fibre, values
from qe.certify.arithmetic.triangular import Point
from qe.certify.stacks import check_roots, have_common_root
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.syntax import Atom
from qe.io.text import read

RING = Ring.of(("x",))


def poly(text: str) -> Fibre:
    found = read(f"{text} = 0")
    assert isinstance(found, Atom)
    return fibre(Point(), found.poly, 0)


def fail(entry: str, reason: str) -> CertificateRejected:
    return CertificateRejected(entry, reason)


def checked(text: str, sectors: list[int], listed: list[int], discriminant: int | None = None) -> None:
    f, at = poly(text), values(tuple(map(Fraction, sectors)))
    check_roots(f, f.signs(at), at, listed, discriminant, fail)


@pytest.mark.parametrize(
    ("text", "sectors", "listed", "discriminant"),
    [
        ("x", [-1, 1], [0], None),
        ("x^2 - 2", [-2, 0, 2], [0, 1], None),
        ("x^2 + 1", [0], [], None),
        ("x^2 + 1", [0], [], -1),
        ("x^2", [-1, 1], [0], 0),
        ("x^2*(x - 3)", [-1, 1, 4], [0, 1], None),
        ("(x - 1)^2*(x - 5)^2", [0, 2, 6], [0, 1], 0),
        ("x^3 - 3*x + 1", [-3, 0, 1, 2], [0, 1, 2], 1),
        ("x^4 + 1", [0], [], 1),
        ("x^4 - 2", [-2, 0, 2], [0, 1], -1),
        ("x*(x^2 + 1)", [-1, 1, 2], [0], None),
    ],
)
def test_all_roots_one_by_one(text: str, sectors: list[int], listed: list[int], discriminant: int | None) -> None:
    checked(text, sectors, listed, discriminant)


@pytest.mark.parametrize(
    ("text", "sectors", "listed", "discriminant", "reason"),
    [
        ("x", [-1, 1], [], None, "not listed"),
        ("x", [1, 2], [], None, "missing"),
        ("x", [1, 2], [0], None, "no root here"),
        ("x^2 - 2", [-2, 0, 2], [0], None, "not listed"),
        ("x^2 - 2", [-2, 2], [], None, "missing"),
        ("x^2 - 2", [-2, 0], [0], None, "missing"),
        ("x^2 + 1", [-1, 1], [0], None, "no root here"),
        ("x^2 + 1", [-1, 1], [0], -1, "no root here"),
        ("x^2", [-1, 1], [], 0, "not listed|missing"),
        ("x^3 - 3*x + 1", [-3, 2], [0], 1, "missing"),
        ("(x - 1)^2*(x - 5)^2", [0, 2, 6], [0], 0, "missing|not listed"),
        ("(x - 1)^2*(x - 5)^2", [0, 6], [0], 0, "missing|no root here"),
        ("x^4 - 2", [0, 2], [0], -1, "missing"),
        (
            "(x^2 + 1)*(x^2 - 1)*(x^2 - 4)",
            [5],
            [],
            -1,
            "missing",
        ),  # three pairs would have this sign, too
    ],
)
def test_roots_missing_or_invented(
    text: str, sectors: list[int], listed: list[int], discriminant: int | None, reason: str
) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        checked(text, sectors, listed, discriminant)


@pytest.mark.parametrize(
    ("f", "g", "ends", "common"),
    [
        ("x^2 - 2", "x^4 - 4", (1, 2), True),
        ("x^2 - 2", "x^2 - 3", (1, 2), False),
        ("(x - 1)^2", "x^2 - 1", (0, 2), True),
        ("(x - 1)*(x - 5)", "(x + 3)*(x - 5)", (0, 2), False),  # they share another root
        ("x^3 - 2", "x^2 - 2", (1, 2), False),
    ],
)
def test_common_roots(f: str, g: str, ends: tuple[int, int], common: bool) -> None:
    assert have_common_root(poly(f), poly(g), Point(), values(tuple(map(Fraction, ends)))) is common
