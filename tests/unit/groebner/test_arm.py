"""The arm of three joints whose comprehensive Groebner systems are published (arXiv 2305.12451): the same ideals."""

import functools
import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

import qe
from qe.api.input import read_polynomial
from qe.exact.fglm import changed_order
from qe.exact.groebner import MonomialOrder, groebner_basis
from qe.exact.polynomial_system import LIMITS
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly
from tests.tables import each
from tests.unit.groebner.support import Place, places

ROOT_2 = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
LINES = {"F3": ("50 - 10*s", "25 + 75*s", "100 - 80*s"), "F4": ("10 + 30*s", "40 + 60*s", "80 - 60*s")}
VARIABLES = ("s7", "c7", "s4", "c4", "s1", "c1")
"""In this order the bases stay small: a tenth of a second, where the reverse takes a minute."""


@functools.cache
def system(
    length: int, line: tuple[str, str, str] | None, variables: tuple[str, ...] = VARIABLES, order: str = "grevlex"
) -> qe.ComprehensiveGroebnerSystem:
    x, y, z = line or ("x", "y", "z")
    polys = [
        f"{length}*c1*c4*s7 - 16*c1*c4 + {length}*c1*s4*c7 + 136*c1*s4 - 44*w*c1 + {x}",
        f"{length}*s1*c4*s7 - 16*s1*c4 + {length}*s1*s4*c7 + 136*s1*s4 - 44*w*s1 + {y}",
        f"-{length}*c4*c7 - 136*c4 + {length}*s4*s7 - 16*s4 - 104 - 44*w + {z}",
        *(f"c{k}^2 + s{k}^2 - 1" for k in (1, 4, 7)),
    ]
    return qe.comprehensive_groebner(polys, variables, order=order, constants={"w": ROOT_2})


def compared(ours: qe.ComprehensiveGroebnerSystem, published: list[dict[str, Any]]) -> int:
    """Points of the published segments: which segment of ours has them, and the leading monomials of the ideal there in
    the published order, c1 first. The number of points compared.
    """
    ring, block, random = ours.polys[0].ring, ours.block, Random(1)
    count = 0
    for entry in published:
        zero, nonzero = ([read(t, ours) for t in entry[key]] for key in ("Z", "N"))
        for place in places([*zero, ring.var("w") ** 2 - 2], [], nonzero, block.parameters, random)[:2]:
            (holding,) = [s for s in ours if place.satisfies(s.equal, s.nonzero, s.some)]
            one = ring.constant(0)
            assert place.ideal([*holding.basis, one], block) == place.ideal(ours.polys, block)
            assert leading(place, ours) == set(entry["leading_monomials"])
            count += 1
    return count


def read(text: str, ours: qe.ComprehensiveGroebnerSystem) -> Poly:
    ring = ours.polys[0].ring
    return read_polynomial(text, "entry", known=ring.names)[0].convert(ring)


def leading(place: Place, ours: qe.ComprehensiveGroebnerSystem) -> set[str]:
    """The leading monomials at a point in the lexicographic order with c1 first."""
    names = list(reversed(VARIABLES))
    special = place.ideal(ours.polys, ours.block)
    if len(special) == 1 and special[0].is_constant:
        return {"1"}
    inner = special[0].ring
    order = (*(inner.index[v] for v in names), 0)
    # it is one already: heavy variables before the generator of the field
    weights = (*(1033, 1031, 1021, 1019, 1013, 1009), 1)
    basis = groebner_basis(special, variables=order[-2::-1] + order[-1:], weights=weights, limits=LIMITS)
    assert basis is not None
    try:
        lex = changed_order(basis, MonomialOrder.LEX, order)
    except PositiveDimensional:
        direct = groebner_basis(special, variables=order, order=MonomialOrder.LEX, limits=LIMITS)
        assert direct is not None
        lex = direct
    heads = [lead[: len(names)] for lead in lex.leads]
    return {_name(e, names) for e in heads if any(e)}


def _name(exponents: tuple[int, ...], names: list[str]) -> str:
    parts = [n if k == 1 else f"{n}^{k}" for n, k in zip(names, exponents, strict=True) if k]
    return "*".join(parts)


@each(pytest.param("F3", marks=pytest.mark.deep), "F4")
def test_the_straight_lines(name: str, shared: Path) -> None:
    record = json.loads((shared / "corpora" / "ev3" / f"cgs_{name}_L120.json").read_text())
    assert compared(system(120, LINES[name]), record["segments"]) >= 3


@pytest.mark.deep
@each((120, "cgs_F1_L120"), (112, "cgs_F_L112"))
def test_the_whole_space(length: int, name: str, shared: Path) -> None:
    record = json.loads((shared / "corpora" / "ev3" / f"{name}.json").read_text())
    assert compared(system(length, None), record["segments"]) >= 10


def test_the_number_of_solutions_at_points(shared: Path) -> None:
    ours = system(120, LINES["F4"])
    assert [len(ours.solutions_at([s])) for s in (0, "1/3", 1)] == [4, 4, 4]
    assert ours.at(["-1/3"]).dimension == 0


PUBLISHED = tuple(reversed(VARIABLES))
MIXED = ["c1", "s7", "s1", "c7", "c4", "s4"]


@each(
    (PUBLISHED, "grevlex", LINES["F4"]),
    pytest.param(PUBLISHED, "lex", LINES["F4"], marks=pytest.mark.deep),
    pytest.param(PUBLISHED, "lex", None, marks=pytest.mark.deep),
    pytest.param(PUBLISHED, "grevlex", None, marks=pytest.mark.deep),
    pytest.param(MIXED, "grevlex", None, marks=pytest.mark.deep),
    pytest.param(VARIABLES, "lex", None, marks=pytest.mark.deep),
)
def test_other_orders_of_the_variables(variables: list[str], order: str, line: tuple[str, str, str] | None) -> None:
    """Out of reach for Buchberger's algorithm alone: the same solutions as in the order in which it is quick."""
    ours = system(120, line, variables, order)
    points: list[list[object]] = [["1/3"], [1]] if line else [[10, 40, 80], ["599/66", "824/33", "323/10"]]
    assert [len(ours.solutions_at(p)) for p in points] == [4, 4]
    for zero in ours.solutions_at(points[0]):
        values = [float(zero.values[name]) for name in ("c1", "s1")]
        assert values[0] ** 2 + values[1] ** 2 == pytest.approx(1)
