"""No quantifier captures what a checker takes inwards: certificates in which one binds a name that it sees are refused,
and each checker that substitutes refuses by itself to go below a quantifier that binds what it brings in."""

from __future__ import annotations

import random
import re
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.certify.registry import RULES
from qe.certify.verify import verify
from qe.errors import CertificateRejected
from qe.exact.ring import Ring
from qe.formula.build import atom, conj, convert, disj, exists, forall, neg
from qe.formula.evaluate import substituted
from qe.formula.syntax import TRUE, And, Atom, Constant, Exists, Formula, Not, Or, Quantified, Relation
from qe.formula.traverse import children
from qe.io.text import read
from qe.kernel.step import Claim
from qe.kernel.substitution import mapped
from qe.kernel.verdict import Verdict
from qe.proof.certificate import Certificate, written
from qe.proof.entry import Entry, formula_to_json
from qe.proof.step import Place
from qe.proving.elaborators import ELABORATORS
from tests.attacks.formulas import places, put
from tests.certificates.derivations import certificate
from tests.unit.certify.claims import NO_LEMMAS, RING, line, objection
from tests.unit.proving.elaborated import refused

SAID = re.compile(r"both free and bound|bound once more inside|bound where it is seen|a quantifier inside binds")
"""What rejections say for this reason."""

ALONE = re.compile(
    SAID.pattern + "|bound twice|may move|new variable|captured there|share a variable|differ in more than"
)
"""What checkers say that are asked without the door in front of them."""


def verdict(order: tuple[str, ...], start: str, answer: str, *steps: tuple[str, Place, str, str, Any]) -> Verdict:
    """Of a derivation whose steps have a rule, a place, the formulas before and after, and evidence."""
    ring = Ring.of(order)

    def over(text: str) -> Formula:
        return convert(read(text), ring)

    listed = [written(rule, at, over(b), over(a), (), evidence) for rule, at, b, a, evidence in steps]
    return verify(Certificate.derivation(order, over(start), listed, over(answer)))


# --- the two symptoms -------------------------------------------------------------------------------------
def test_a_leading_coefficient_is_not_0_below_a_quantifier_that_binds_its_name() -> None:
    """b = 0 for some x or b /= 0 for some b: with a = b = 0 taken inwards, that was the question without its leading
    term, and b = 0 and a = 1 and (ex x. b*x^2 + a = 0) true."""
    rule, before = "roots by signs", "ex x. b*x^2 + a = 0"
    after = "b /= 0 and a*b <= 0 or b = 0 and ((ex x. a = 0) or (ex b. b /= 0))"
    start, answer = (f"ex a, b. b = 0 and a = 1 and ({part})" for part in (before, after))
    found = verdict(("a", "b", "x"), start, answer, (rule, (0, 2), before, after, {}))
    assert (found.accepted, found.step) == (False, "payload.answer[1]") and SAID.search(found.reason)


def test_a_sphere_is_not_subtracted_below_a_quantifier_that_binds_its_radius() -> None:
    """x^2 + y^2 = a and (ex a. x^2 + y^2 = a + 1) has solutions; a = a + 1 has none."""
    rule, before = "sphere seen along a form", "ex x, y. x^2 + y^2 - a = 0 and (ex a. x^2 + y^2 - a - 1 = 0)"
    for order in (("a", "x", "y"), RING.names):
        part = convert(read("x^2 + y^2 - a = 0"), Ring.of(order))
        evidence: Any = {"sphere": formula_to_json(part), "variables": ["x", "y"], "form": "x"}
        found = verdict(order, f"ex a. ({before})", "false", (rule, (0,), before, "false", evidence))
        assert not found.accepted and found.step.startswith("payload.start") and SAID.search(found.reason)
    assert refused(rule, before, "false", evidence)


# --- each checker that substitutes, by itself --------------------------------------------------------------
def _solved(equation: str, sign: int | None) -> Any:
    return [["x", line(equation), sign]]


CAPTURED: list[tuple[str, str, str, Any]] = [
    (
        "linear equation solved",
        "ex x. x = a and (ex a. x + a = 3 and a > 5)",
        "ex a. 2*a = 3 and a > 5",
        {"solved": _solved("x - a", 1), "theory": NO_LEMMAS},
    ),
    (
        "linear equation solved under a guard",
        "ex x. b*x = a and (ex b. x = b and b > 2)",
        "b /= 0 and (ex b. a = b^2 and b > 2) or (ex x. b = 0 and a = 0 and (ex b. x = b and b > 2))",
        {"solved": _solved("b*x - a", None)},
    ),
    (
        "affine coordinates",
        "ex x, y. x + y = a and (ex y. x + y > 1 and y < a)",
        "ex x, y. x = a and (ex y. x > 1 and y < a)",
        {"values": [["x", [["x", "1"], ["y", "-1"]]]]},
    ),
    (
        "degree shift",
        "ex x. x^2 = a and (all x. x^2 > b)",
        "ex x. x >= 0 and x = a and (all x. x > b)",
        {"variable": "x", "exponent": 2, "theory": NO_LEMMAS},
    ),
    (
        "two variables exchanged",
        "ex x, y. x + y = 3 and (ex x. x + y > a)",
        "ex x, y. x^2 - 4*y >= 0 and x = 3 and (ex x. x > a)",
        {"variables": ["x", "y"]},
    ),
    (
        "mirror images of a convex set",
        "ex x. x > -1 and x < 1 and (all x. x > a or -x > a)",
        "all x. a < 0",
        {"mirror": [["x", "x", -1]]},
    ),
    (
        "translation of the origin",
        "ex x, y. x - y = a and (ex x. x - y > b)",
        "ex y. -y = a and (ex x. x - y > b)",
        {"variable": "x", "weights": [["x", "1"], ["y", "1"]]},
    ),
    (
        "homogeneous scaling",
        "ex x, y. x > y and (all x. x > y)",
        "(ex y. 1 > y) or (ex y. y < 0) or (ex y. -1 > y)",
        {"variable": "x", "weights": [["x", "1"], ["y", "1"]], "values": [1, 0, -1], "theory": NO_LEMMAS},
    ),
    (
        "rotation of the axes",
        "ex x, y. x^2 + y^2 = a and (ex y. x^2 + y^2 = b)",
        "ex x. x >= 0 and x^2 = a and x^2 = b",
        {"turns": [{"zero": "y", "half": "x", "plane": [["x", "y", "1"]]}]},
    ),
    (
        "constant along directions",
        "a > b and (all a. a > b)",
        "a > b",
        {"directions": [["a", [["a", "1"], ["b", "1"]]]], "steps": []},
    ),
    (
        "linear form named",
        "ex x, y. x + y = a and x*y > 1",
        "ex a. a > 1 and (ex x, y. a = x*y and x + y = a)",
        {"scales": ["1"]},
    ),
    (
        "nested blocks of one kind gathered",
        "ex x. x > a and (ex x. x < a)",
        "ex x. x > a and x < a",
        {},
    ),
    (
        "independent parts and miniscoping",
        "ex x, y. x > a and y > x",
        "(ex x. x > a) and (ex x, y. y > x)",
        {},
    ),
    (
        "renaming",
        "ex y. y > a",
        "ex a. a > a + 1",
        {},
    ),
]


@pytest.mark.parametrize(("rule", "before", "after", "evidence"), CAPTURED)
def test_a_checker_by_itself_captures_nothing(rule: str, before: str, after: str, evidence: Any) -> None:
    """The door that refuses clashing names is left out here."""
    assert rule in {*ELABORATORS, *RULES}
    if rule in ELABORATORS:
        assert refused(rule, before, after, evidence)
    if rule in RULES:
        assert ALONE.search(objection(rule, before, after, evidence))


# --- one substitution for all of them ----------------------------------------------------------------------
DOMAIN = (-1, 0, 2)
INNER = Ring.of(("x", "a", "y"))


def _value(formula: Formula, at: Mapping[str, Fraction | int]) -> bool:
    """The truth where quantifiers range over ``DOMAIN``: what substitution means does not depend on the domain."""
    match formula:
        case Constant(value):
            return value
        case Atom():
            return substituted(formula, {name: Fraction(at[name]) for name in formula.free}) == TRUE
        case Not(arg):
            return not _value(arg, at)
        case And(args):
            return all(_value(a, at) for a in args)
        case Or(args):
            return any(_value(a, at) for a in args)
    assert isinstance(formula, Quantified)
    name, rest = formula.variables[0], formula.variables[1:]
    body = type(formula)(rest, formula.body) if rest else formula.body
    values = (_value(body, {**at, name: d}) for d in DOMAIN)
    return any(values) if isinstance(formula, Exists) else all(values)


def _random(rng: random.Random, ring: Ring, depth: int) -> Formula:
    """A formula with quantifiers over few names, many of them bound again, or free elsewhere."""
    shape = rng.random() if depth else 1.0
    if shape < 0.4:
        names = rng.sample(ring.names, rng.choice((1, 1, 2)))
        return (exists if rng.random() < 0.5 else forall)(names, _random(rng, ring, depth - 1))
    if shape < 0.9:
        parts = [_random(rng, ring, depth - 1) for _ in range(2)]
        return (conj if rng.random() < 0.5 else disj)(parts)
    if shape < 0.95:
        return neg(_random(rng, ring, depth - 1))
    terms = (ring.gen(i) * rng.choice((-1, 0, 1, 2)) for i in range(ring.size))
    return atom(sum(terms, ring.constant(rng.choice((-1, 0, 1)))), rng.choice(tuple(Relation)))


@given(st.integers(0, 10**9))
def test_a_substitution_means_what_it_says_or_is_refused(seed: int) -> None:
    rng = random.Random(seed)
    formula = _random(rng, INNER, 3)
    term = INNER.var("a") * rng.choice((1, -1)) + INNER.var("y") * rng.choice((0, 0, 1)) + rng.choice((0, 1))
    claim = Claim("rule", TRUE, TRUE, INNER, Entry({}, "evidence"), "step")
    x = INNER.index["x"]
    try:
        image = mapped(formula, lambda a: atom(a.poly.compose({x: term}), a.relation), (INNER.gen(x), term), claim)
    except CertificateRejected as error:
        assert SAID.search(error.reason)
        return
    for place in ({"x": 5, "a": a, "y": y} for a in (-2, 0, 1) for y in (-1, 3)):
        value = term.evaluate([place[name] for name in INNER.names])
        assert _value(image, place) == _value(formula, {**place, "x": value})


# --- every rule, under quantifiers whose names clash ---------------------------------------------------------
def _clashes(formula: Formula, seen: set[str]) -> bool:
    """Whether a quantifier binds one of the names seen from where it stands."""
    if isinstance(formula, Quantified):
        return bool(seen & set(formula.variables)) or _clashes(formula.body, seen | set(formula.variables))
    return any(_clashes(child, seen) for child in children(formula))


NAMES = Ring.of(("a", "b", "x", "y"))


@pytest.mark.parametrize("rule", list(RULES))
def test_a_step_whose_names_clash_is_refused_whatever_its_rule(rule: str) -> None:
    """At the root or inside another formula; 20 with a clash each, and those without are not refused for one."""
    rng, offered = random.Random(rule), 0
    while offered < 20:
        whole, after = _random(rng, NAMES, 3), _random(rng, NAMES, 2)
        path, before = rng.choice(list(places(whole)))
        free = {*before.free, *after.free}
        changed = put(whole, path, after)
        clash = any(
            _clashes(f, seen)
            for f, seen in ((whole, set(whole.free)), (before, free), (after, free), (changed, set(changed.free)))
        )
        step = written(rule, path, before, after, (), {})
        found = verify(Certificate.derivation(NAMES.names, whole, [step], changed))
        assert not (clash and found.accepted), (whole, before, after)
        assert bool(SAID.search(found.reason)) is clash or not clash, found
        offered += clash


# --- what stays readable -----------------------------------------------------------------------------------
def test_blocks_beside_each_other_may_bind_one_name() -> None:
    made = certificate("(ex x. x = a) and (ex x. x = b)")
    assert verify(made).accepted


def test_parts_of_a_question_whose_names_clash_are_certified() -> None:
    text = "ex x. x > a and (ex x. x^2 = b and x < 2)"
    answer = qe.eliminate(text, anytime=True, check=True, timeout=20)
    assert answer.certificate is not None and qe.verify(answer.certificate).accepted
