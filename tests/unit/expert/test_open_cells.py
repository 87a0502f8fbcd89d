"""Open cells of a decomposition: every sector once, and stacks that miss or repeat one refused."""

from __future__ import annotations

from copy import deepcopy
from fractions import Fraction
from typing import Any

import pytest

from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.expert.open_cells import open_cells
from qe.proof.entry import Entry
from tests.tables import each
from tests.unit.certify.claims import limits

RING = Ring.of(("x", "y"))
X, Y = RING.var("x"), RING.var("y")
PARABOLA = [[X], [Y**2 - X]]
STACK: Any = [["-1", [["0", "outside"]]], ["4", [["-5/2", "below"], ["0", "inside"], ["3", "above"]]]]


def cells(levels: Any, stack: Any) -> list[tuple[tuple[Fraction, ...], Any]]:
    return [(values, entry.value) for values, entry in open_cells(levels, Entry(stack, "stack"), limits())]


def test_the_cells_with_their_samples() -> None:
    assert cells(PARABOLA, STACK) == [
        ((-1, 0), "outside"),
        ((4, Fraction(-5, 2)), "below"),
        ((4, 0), "inside"),
        ((4, 3), "above"),
    ]


def test_one_level_and_no_factors() -> None:
    assert cells([[]], [["7", "all"]]) == [((7,), "all")]
    assert cells([[X**2 - 2, X]], [[s, s] for s in ("-2", "-1", "1", "2")])[2] == ((1,), "1")
    assert cells([[X**2 + 1]], [["0", "all"]]) == [((0,), "all")]


@each(
    ([[X]], ["1"], "one by one"),
    ([[X]], ["-1", "1", "2"], "one by one"),
    ([[X]], ["1", "-1"], "ascend"),
    ([[X]], ["-1", "-1", "1"], "ascend"),
    ([[X]], ["0", "1"], "a sample is a root"),
    ([[X, X - 1]], ["-1", "2"], "one by one"),
    ([[X, X - 1]], ["-1", "2", "3"], "one by one"),
    ([[X**2 - 2]], ["-2", "2"], "one by one"),
    ([[(X - 1) * (X - 2) * (X - 3)]], ["0", "4"], "one by one"),  # three roots in one gap
    ([[]], [], "for each sector"),
)
def test_samples_that_do_not_separate_the_roots(levels: Any, samples: list[str], reason: str) -> None:
    with pytest.raises(CertificateRejected, match=reason):
        cells(levels, [[s, "leaf"] for s in samples])


def changed(change: Any) -> Any:
    stack = deepcopy(STACK)
    change(stack)
    return stack


@each(
    lambda s: s.pop(),
    lambda s: s.pop(0),
    lambda s: s[1][1].pop(),
    lambda s: s[1][1].pop(1),
    lambda s: s[0].__setitem__(0, "1"),
    lambda s: s[1].__setitem__(0, "0"),
    lambda s: s[1][1][1].__setitem__(0, "2"),
    lambda s: s[1][1].append(["4", "further"]),
    lambda s: s[1].append("more"),
    lambda s: s[0].__setitem__(1, []),
)
def test_any_change_of_a_stack_is_refused(change: Any) -> None:
    with pytest.raises(CertificateRejected):
        cells(PARABOLA, changed(change))
