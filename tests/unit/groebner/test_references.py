"""Comprehensive Groebner systems from the literature: the same specialised ideals at random points of every segment."""

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

import qe
from qe.api.input import read_polynomial
from qe.exact.ring import Poly
from qe.groebner.system import ComprehensiveGroebnerSystem
from tests.unit.groebner.support import Place, places

CORPUS = Path(__file__).parents[3].parent / "shared" / "corpora" / "cgs_problems.jsonl"
RECORDS = [json.loads(line) for line in CORPUS.read_text().splitlines()] if CORPUS.exists() else []
QUICK = RECORDS[3::12]


def agrees(record: dict[str, Any]) -> int:
    """Compare at random points of all segments, ours and theirs; the number of points compared."""
    ours = solved(record)
    ring, block = ours.polys[0].ring, ours.block
    random = Random(record["name"])

    def read(texts: list[str]) -> list[Poly]:
        return [read_polynomial(t.replace("**", "^"), "entry", known=ring.names)[0].convert(ring) for t in texts]

    theirs = [(read(b["eq"]), read(b["ne"]), read(b["basis"])) for b in record["branches"]]
    within = (read(record["null"]), read(record["nonnull"]))
    compared = 0
    sets = [(s.equal, s.nonzero, s.some) for s in ours] + [(e, n, ()) for e, n, _ in theirs]
    for equal, nonzero, some in sets:
        for place in places(equal, nonzero, some, block.parameters, random)[:2]:
            if not place.satisfies(*within):
                continue
            holding = [s for s in ours if place.satisfies(s.equal, s.nonzero, s.some)]
            assert len(holding) == 1, f"{len(holding)} segments at a point"
            check(place, ours, holding[0].basis, holding[0].leads)
            for e, n, basis in theirs:
                if place.satisfies(e, n):
                    assert place.ideal([*basis, ring.constant(0)], block) == place.ideal(ours.polys, block)
            compared += 1
    return compared


def solved(record: dict[str, Any]) -> ComprehensiveGroebnerSystem:
    def texts(name: str) -> list[str]:
        return [t.replace("**", "^") for t in record[name]]

    return qe.comprehensive_groebner(
        texts("polys"),
        record["variables"],
        record["parameters"],
        record["order"],
        equal=texts("null"),
        nonzero=texts("nonnull"),
        timeout=120,
    )


def check(
    place: Place, ours: ComprehensiveGroebnerSystem, basis: tuple[Poly, ...], leads: tuple[tuple[int, ...], ...]
) -> None:
    """The basis of a segment generates the specialised ideal, and its leading monomials are those of this ideal."""
    zero = ours.polys[0].ring.constant(0)
    assert place.ideal([*basis, zero], ours.block) == place.ideal(ours.polys, ours.block)
    assert set(leads) == place.leads(ours.polys, ours.block)


@pytest.mark.skipif(not RECORDS, reason="the reference systems are not here")
@pytest.mark.parametrize("record", QUICK, ids=[r["name"] for r in QUICK])
def test_some_reference_systems(record: dict[str, Any]) -> None:
    assert agrees(record) >= 1


@pytest.mark.deep
@pytest.mark.skipif(not RECORDS, reason="the reference systems are not here")
@pytest.mark.parametrize("record", RECORDS, ids=[r["name"] for r in RECORDS])
def test_all_reference_systems(record: dict[str, Any]) -> None:
    assert agrees(record) >= 1
