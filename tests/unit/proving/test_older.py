"""Certificates of former releases: steps by signs had many names, and their lemmas came without cases."""

import json
from typing import Any

import qe
from qe.exact.ring import Ring
from qe.formula.build import convert
from qe.io.text import read
from qe.proof.certificate import Certificate
from qe.proof.entry import formula_to_json
from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS

RING = Ring.of(("a", "b", "x", "y"))
BARE = {"theory": {"polynomials": [], "lemmas": []}}
TURNS = "(a > 0 or b > 0) and (a > 0 or b < 0) and (a < 0 or b > 0) and (a < 0 or b < 0)"


def written(text: str) -> Any:
    return formula_to_json(convert(read(text), RING), quantified=True)


def verdict(rule: str, before: str, after: str, evidence: dict[str, Any]) -> Any:
    """What is said of a certificate that is read, of one step."""
    step = {"rule": rule, "at": [], "before": written(before), "after": written(after), "context": []}
    payload = {"order": list(RING.names), "start": written(before), "steps": [{**step, "evidence": evidence}]}
    data = json.loads(Certificate.derivation((), read("true"), [], read("true")).to_json())
    made = {**data, "payload": {**payload, "answer": written(after)}}
    read_again = Certificate.from_json(json.dumps(made))
    return qe.verify(Certificate.from_json(json.dumps({**made, "digest": read_again.digests[1]})))  # type: ignore[index]


@each("simplification", "standard simplification", "case split on factors")
def test_lemmas_without_cases_get_them(rule: str) -> None:
    """Neither propagation alone nor the alternatives of the last formula refute it."""
    assert verdict(rule, TURNS, "false", BARE).accepted
    assert not verdict("signs", TURNS, "false", {"theory": NO_LEMMAS}).accepted
    assert not verdict(rule, TURNS.replace("a < 0 or b < 0", "a < 0 or b <= 0"), "a > 0", BARE).accepted


def conflict(*atoms: str) -> Any:
    both = " and ".join(atoms)
    free = [v for v in RING.names if v in both]
    step = {"rule": "simplification", "at": [], "before": written(f"ex {', '.join(free)}. {both}"), "after": False}
    return {"atoms": [written(a) for a in atoms], "steps": [{**step, "context": [], "evidence": BARE}]}


def test_a_former_boolean_search_is_read() -> None:
    sentence = f"ex a, b. {TURNS}"
    found = {"refuted": [], "learnt": []}
    by_top = {"refuted": [], "learnt": [[-1]]}  # number 1 is the whole
    assert not verdict("Boolean search", sentence, "false", found).accepted
    assert not verdict("Boolean search", sentence, "false", by_top).accepted
    learnt = {"refuted": [], "learnt": [[-3]]}  # 2 is the first disjunction, 3 is a > 0 (or a < 0) in it
    assert verdict("Boolean search", sentence, "false", learnt).accepted
    other = sentence.replace("a < 0 or b < 0", "a < 0 or b /= 1")
    assert not verdict("Boolean search", other, "false", learnt).accepted


def test_its_conflicts_are_refuted_in_the_language_of_today() -> None:
    evidence = {"refuted": [conflict("x^2 < 0")], "learnt": []}
    assert not verdict("Boolean search", "ex x. x > 0", "false", evidence).accepted
    squares = {"rule": "signs", "at": [], "before": written("ex x. x > 0 and x < 0"), "after": False, "context": []}
    both = {"atoms": [written("x > 0"), written("x < 0")], "steps": [{**squares, "evidence": BARE}]}
    assert verdict("Boolean search", "ex x. x > 0 and x < 0", "false", {"refuted": [both], "learnt": []}).accepted


def root(*coefficients: str) -> Any:
    point = {"coefficients": [*coefficients], "branch": 1, "shift": 0}
    return {"point": point, "guard": True, "formula": None, "settled": []}


@each({}, {"exponent": 1})
def test_test_points_at_roots_of_cubics_become_a_decomposition(more: dict[str, Any]) -> None:
    """The kernel knew a table of what holds at such roots; of the old evidence only that it has them is looked at."""
    points = [root("b", "a", "0", "1")]
    evidence = {"variable": "x", "side": 1, "quadratics": [], "points": points, "parts": [[]], **more}
    block = "ex x. x^3 + a*x + b = 0 and x > 0"
    assert verdict("elimination set", block, "b < 0 or a < 0 and 4*a^3 + 27*b^2 <= 0", evidence).accepted
    assert not verdict("elimination set", block, "b < 0 or a < 0 and 4*a^3 + 27*b^2 < 0", evidence).accepted
