"""Sets of which much is known, and everything that regions say of them: contracts over one table.

A row is a set and what is known: its dimension, its number of components, its closure and interior, its volume (a
SymPy number; a ``float`` where only digits are known; ``None`` where no closed form is found), a point, its fibres.
"""

import math
import pickle
from dataclasses import dataclass, field
from fractions import Fraction
from fractions import Fraction as F
from typing import Any

import pytest
import sympy as sp

import qe
from qe.api.input import read_formula
from qe.decomposition.interval import Interval
from qe.exact.algebraic import RealAlgebraic
from qe.formula.build import disj
from qe.io.substitution import over_one_ring
from qe.options import Budget
from qe.regions.region import Region
from qe.regions.topology import boundary, closure, interior
from tests.tables import each

ROOT = RealAlgebraic.from_root([-2, 0, 1], 1, 2)
BALL = "x^2 + y^2 + z^2 <= 1"
ANNULUS = "x^2 + y^2 <= 4 and x^2 + y^2 > 1"
CURVES = "(y^2 = x or y = 5) and (x <= 1 or x = 4)"
BOX = "0 <= x and x <= 1 and 0 <= y and y <= x and 0 <= z"
Ends = tuple[object, object, bool, bool]


@dataclass(frozen=True)
class Known:
    """What is known of a set; nothing is said of the rest."""

    dimension: int | None = None
    parts: int | None = None
    closed: str = ""
    opened: str = ""
    volume: Any = ...
    inside: tuple[object, ...] = ()
    fibres: dict[tuple[object, ...], list[Ends]] = field(default_factory=dict)


SETS = {
    "x^2 + y^2 + z^2 <= 1 and (x - 2)^2 + y^2 + z^2 <= 1": Known(0, 1, inside=(1, 0, 0)),
    f"{BALL} and {BALL}": Known(3, 1, inside=(0, 0, 0)),
    "x^2 + y^2 + z^2 = 1 and (x - 1)^2 + y^2 + z^2 = 1": Known(
        1, inside=("1/2", 0, RealAlgebraic.from_root([-3, 0, 4], 0, 1))
    ),
    "x^2 + y^2 <= 1 and x > 1": Known(-1, 0, "false", "false", 0),
    "x^2 + y^2 = 1 and y = x": Known(0, 2),
    "x^2 + y^2 = 1": Known(1, 1, volume=0, inside=("3/5", "4/5")),
    "x^2 + y^2 < 1": Known(2, 1, "x^2 + y^2 <= 1", "x^2 + y^2 < 1", sp.pi, ("0.5", 0)),
    "x = 1 and y > 0": Known(1, 1, "x = 1 and y >= 0", "false", inside=(1, 3)),
    # What has a length, an area, a volume.
    "x^2 <= 2": Known(volume=2 * sp.sqrt(2)),
    "x^2 < 2 and x > -1": Known(volume=sp.sqrt(2) + 1),
    "0 <= x and x <= 3 or x = 7": Known(1, 2, volume=3),
    "x^5 - 4*x < 1 and x > 0": Known(volume=sp.CRootOf(sp.Symbol("x") ** 5 - 4 * sp.Symbol("x") - 1, 2)),
    "x^2 < 0": Known(-1, 0, "false", "false", 0),
    "x^2 + y^2 <= 4": Known(
        volume=4 * sp.pi,
        fibres={
            (): [(-2, 2, True, True)],
            (0,): [(-2, 2, True, True)],
            (ROOT,): [(-ROOT, ROOT, True, True)],
            (2,): [(0, 0, True, True)],
            (3,): [],
        },
    ),
    "x^2 + y^2/4 <= 1 and y > 0": Known(volume=sp.pi),
    "1 <= x^2 + y^2 and x^2 + y^2 <= 4": Known(parts=1, volume=3 * sp.pi),
    "x > 0 and y > 0 and x + y < 1": Known(volume=sp.Rational(1, 2)),
    "0 <= x and x <= 1 and 0 <= y and y <= x": Known(volume=sp.Rational(1, 2)),
    "y > x^2 and y < 1": Known(volume=sp.Rational(4, 3)),
    "y >= x^2 and y <= 1": Known(volume=sp.Rational(4, 3)),
    "y^2 < x and x < 2": Known(volume=8 * sp.sqrt(2) / 3),
    "x*y < 1 and 2*x > 1 and x < 3 and y > 0": Known(volume=sp.log(6)),
    "y^2 - x^2 < 1 and x^2 < 1": Known(volume=2 * sp.sqrt(2) + 2 * sp.asinh(1)),
    "(x - 1)^2 + y^2 <= 1 and x^2 + y^2 <= 1": Known(volume=2 * sp.pi / 3 - sp.sqrt(3) / 2),
    "(x - 10^20)^2 + y^2 <= 1": Known(volume=sp.pi),
    "x^4 + y^4 <= 1": Known(volume=3.7081493546),
    "x^2 + 2*y^2 + 3*z^2 + x*y <= 1": Known(volume=8 * sp.pi / (3 * sp.sqrt(21))),  # not axis-parallel
    f"{BALL} and (x - 1)^2 + y^2 + z^2 <= 1": Known(volume=5 * sp.pi / 12),  # a lens
    f"{BALL} and x + z >= 0": Known(volume=2 * math.pi / 3),
    f"{BALL} and z >= y": Known(volume=2 * math.pi / 3),
    "x^2 + y^2 + z^2 <= 4": Known(volume=32 * sp.pi / 3),
    "x^2 + y^2 + z^2 <= 4 and x >= 1": Known(volume=5 * sp.pi / 3),
    f"{BOX} and z <= x*y": Known(volume=sp.Rational(1, 8)),
    f"{BOX} and z <= x + y": Known(volume=sp.Rational(1, 2)),
    "y^2 < x^3 - x + 2 and x < 1": Known(volume=None),
    "y^2 < x^3 and x < 1": Known(volume=None),
    "x^4 + y^4 < 1": Known(volume=None),
    "x > 0": Known(1, 1, "x >= 0", "x > 0", None),
    # Closures and interiors, of convex sets by other relations and of others by the definition.
    "x^2 + y^2 < 1 and y >= 0": Known(2, 1, "x^2 + y^2 <= 1 and y >= 0", "x^2 + y^2 < 1 and y > 0"),
    "x^2 + y^2 <= 1 and x + y > 1": Known(2, 1, "x^2 + y^2 <= 1 and x + y >= 1", "x^2 + y^2 < 1 and x + y > 1"),
    "x = 1 and y < 2": Known(1, 1, "x = 1 and y <= 2", "false"),
    "x^2 + y^2 < 1 and x >= 1": Known(-1, 0, "false", "false"),
    "x^2 <= 0 and y > 0": Known(1, 1, "x = 0 and y >= 0", "false"),
    "x^3 - x^2 > 0": Known(1, 1, "x >= 1", "x > 1"),
    "x^2*(1 - x) >= 0 and x > 0": Known(1, 1, "0 <= x and x <= 1", "0 < x and x < 1"),
    "x^3 - x^2 >= 0": Known(1, 2, "x >= 1 or x = 0", "x > 1"),
    "x /= 0 and x <= 1": Known(1, 2, "x <= 1", "x < 1 and x /= 0"),
    "x < 0 or x >= 1": Known(1, 2, "x <= 0 or x >= 1", "x < 0 or x > 1"),
    "x^2 + y^2 + z^2 < 1 and x > 0": Known(3, 1, f"{BALL} and x >= 0", "x^2 + y^2 + z^2 < 1 and x > 0"),
    "x^2 + y^2 < 1 and x > 1 and z > 0": Known(-1, 0, "false", "false"),  # the weak conditions have points
    "x^2 + y^2 <= 1 and x = 1 and z > 0": Known(1, 1, "x = 1 and y = 0 and z >= 0", "false"),
    "z*(x^2 + y^2) > 0": Known(3, 1, "z >= 0", "z*(x^2 + y^2) > 0"),
    # Components.
    "x > 0 and x < 1 or x = 2 or x > 3": Known(1, 3),
    "x^3 - 3*x + 1 = 0": Known(0, 3),
    "x*y > 1": Known(2, 2, "x*y >= 1", "x*y > 1"),
    "x*y = 1": Known(1, 2, "x*y = 1", "false"),
    "x*y >= 0": Known(2, 1),
    "x*y > 0": Known(2, 2),
    "x*y = 0 and x^2 + y^2 > 0": Known(1, 4, "x*y = 0", "false"),
    "x^2 + y^2 < 1 or x = 1 and y = 0": Known(2, 1),
    "y^2 = x^3 - x": Known(1, 2),
    "y^2 = x^2*(x - 1)": Known(1, 2),
    "y^2 = x^2*(x + 1)": Known(1, 1),
    "y^2 > x^2*(x + 1)": Known(2, 1),
    "y^2 < x^2*(x + 1)": Known(2, 2),
    "x*y^2 > 1": Known(2, 2),
    "x*y^2 < 1 and x > 0": Known(2, 1),
    "1 < x^2 + y^2 and x^2 + y^2 < 4 and y /= 0": Known(2, 2),
    "ex y. x = y^2": Known(1, 1, "x >= 0", "x > 0"),
    # What is left for the next variable.
    ANNULUS: Known(
        2,
        1,
        fibres={
            (): [(-2, 2, True, True)],
            (0,): [(-2, -1, True, False), (1, 2, False, True)],
            (2,): [(0, 0, True, True)],
            (3,): [],
            (1,): [(-RealAlgebraic.from_root([-3, 0, 1], 1, 2), 0, True, False)]
            + [(0, RealAlgebraic.from_root([-3, 0, 1], 1, 2), False, True)],
            (ROOT,): [(-ROOT, ROOT, True, True)],
        },
    ),
    CURVES: Known(
        1,
        fibres={
            (): [(None, 1, False, True), (4, 4, True, True)],
            (4,): [(v, v, True, True) for v in (-2, 2, 5)],
            (-3,): [(5, 5, True, True)],
            (2,): [],
        },
    ),
    "x > 0 and y = y": Known(2, fibres={(): [(0, None, False, False)], (1,): [(None, None, False, False)], (0,): []}),
}


BY_RELATIONS = list(SETS)[list(SETS).index("x^2 + y^2 < 1 and y >= 0") :][:5]
"""Convex sets: their closures and interiors are the same conditions with other relations."""


def region(text: str) -> Region:
    names = [name for name in "xyz" if name in text.replace("ex y. x = y^2", "x")]
    return qe.region(text, order=names)


@pytest.mark.parametrize("text", SETS)
def test_a_set_is_what_it_is_known_to_be(text: str) -> None:
    given, known = region(text), SETS[text]
    assert known.dimension is None or given.dimension == known.dimension
    assert given.is_empty == (given.dimension < 0)
    assert max((piece.dimension for piece in given.cells), default=-1) == given.dimension
    assert qe.verify(given.certificate).accepted
    assert not known.inside or given.contains(dict(zip(given.order, known.inside, strict=True)))
    assert all(given.contains(p) for p in given.sample_points()) and bool(given.sample_points()) != given.is_empty
    assert not any(given.complement().contains(p) for p in given.sample_points())
    again = Region.from_json(given.to_json())
    assert again.table == given.table and qe.verify(again.certificate).accepted
    assert pickle.loads(pickle.dumps(given)).formula == given.formula


@each(*[(text, known.parts) for text, known in SETS.items() if known.parts is not None])
def test_components(text: str, count: int) -> None:
    whole = region(text)
    parts = whole.components()
    assert len(parts) == count
    assert all(len(part.components()) == 1 for part in parts)
    assert not any(a.is_subset(b) or not a.is_disjoint(b) for a in parts for b in parts if a is not b)
    assert not parts or qe.equivalent(disj(over_one_ring(*(p.formula for p in parts))), whole.formula)


@each(*[(text, known.closed, known.opened) for text, known in SETS.items() if known.closed])
def test_closure_interior_and_boundary(text: str, closed: str, opened: str) -> None:
    given = region(text)
    assert qe.equivalent(given.closure().formula, closed) and qe.equivalent(given.interior().formula, opened)
    answers = [made(read_formula(text), given.order, Budget()) for made in (closure, interior, boundary)]
    assert text not in BY_RELATIONS or all(answer.is_quantifier_free for answer in answers[:2])
    for answer, meant in zip(answers, (closed, opened, f"({closed}) and not ({opened})"), strict=True):
        assert qe.equivalent(answer, meant)


@each(*[(text, known.volume) for text, known in SETS.items() if known.volume is not ...])
def test_measures_are_enclosed_and_exact_where_there_is_a_closed_form(text: str, value: object) -> None:
    given = region(text)
    if value is None:
        with pytest.raises(qe.Unable):
            given.exact_volume()
        return
    error = 0.1 if "z" in text else 0.01
    low, high = given.volume(error)
    assert low <= float(value) * (1 + 1e-9) and float(value) * (1 - 1e-9) <= high  # type: ignore[arg-type]
    assert high - low <= Fraction(error) * high
    if not isinstance(value, float):
        assert sp.simplify(given.exact_volume() - value).equals(0)


@each(*[(text, prefix, ends) for text, known in SETS.items() for prefix, ends in known.fibres.items()])
def test_fibres(text: str, prefix: tuple[Any, ...], ends: list[Ends]) -> None:
    given = region(text)
    found = given.fibre(list(prefix))
    assert [(i.lower, i.upper, i.lower_closed, i.upper_closed) for i in found] == ends
    assert found == given.fibre(dict(zip(given.order, prefix))) and all(isinstance(i, Interval) for i in found)
    for interval in found:
        for end, closed in ((interval.lower, interval.lower_closed), (interval.upper, interval.upper_closed)):
            assert end is None or (end in interval) is closed
        if len(prefix) == 1:
            for value in (interval.simplest(), *(e for e in (interval.lower, interval.upper) if e is not None)):
                assert given.contains({"x": prefix[0], "y": value}) is (value in interval)
    if len(prefix) == 1:  # between and beyond them there is nothing
        tried = [F(k, 3) for k in range(-20, 21)]
        inside = [v for v in tried if given.contains({"x": prefix[0], "y": v})]
        assert inside == [v for v in tried if any(v in i for i in found)]
