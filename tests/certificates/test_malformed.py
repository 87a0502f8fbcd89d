"""Whatever stands in an entry of a certificate, the checkers end with a verdict that names an entry.

True certificates of every kind, and steps by every rule, get other values in their entries: of other types, formulas
with quantifiers and root atoms, empty lists, parts left out, repeated or taken from elsewhere, huge numbers.
"""

from __future__ import annotations

import functools
import json
import random
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from importlib.metadata import entry_points
from typing import Any

import pytest

import qe
from qe.certify import registry
from qe.certify.registry import GROUP, RULES
from qe.certify.verify import CRASHED, verify, verify_json
from qe.options import Budget
from qe.proof.certificate import FORMAT, Certificate, Kind
from tests.attacks.rules import RULES as QUESTIONS
from tests.certificates import (
    false_claims,
    false_claims_of_arms,
)
from tests.certificates.altered_derivations import steps
from tests.certificates.derivations import CASES, data
from tests.certificates.false_claims import Data, text_of
from tests.certificates.mutation import Path, at, paths
from tests.unit.certify.claims import step
from tests.unit.kernel import test_parts

NEEDED = (
    *("squares known", "turned inside", "taken apart", "inequations", "nowhere", "translated", "sphere"),
    *("counterexample", "discs", "terms", "half-plane", "signs of forms", "redundant", "boundary", "distributed"),
    *("factors", "roots", "exchanged", "zeros", "gathered", "infinity", "alternatives", "named", "quadric", "chords"),
    "multipliers",
)
"""Questions of ``derivations`` that have all rules which these have."""

OTHERS = [
    ("ex x. x^2 + a*x + b < 0 and x > 1", "coverings"),
    ("ex x. x^2 + a*x + b = 0 and x > 0", "cgs"),
    ("ex x. (x - a)^2 <= 1 and x^2 <= 3 and a <= 2", "critical"),
    ("all x. -1 <= x and x <= 1 -> -m <= a + b*x + x^2 and a + b*x + x^2 <= m", "critical"),
    ("ex x, y. x^2 + y^2 <= a and x^2 > b", "auto"),
    ("all x. x >= 0 and x <= 1 -> a*x^3 + b*x^2 + x + c > 0", "auto"),
    ("all x, y, z, u. x^2 + y^2 + z^2 + u^2 > 1", "auto"),
    (str(QUESTIONS["Boolean search"].question(random.Random(5))), "auto"),
    ("ex y, z. y^2 + z^2 <= 0 and y*z - x = 0", "auto"),
]
"""Questions for rules that those of ``derivations`` do not need, with the method."""


# --- certificates ------------------------------------------------------------------------------------------
def first(make: Any) -> Data:
    """The first certificate that is found."""
    return next(json.loads(c.to_json()) for c in (make(random.Random(seed)) for seed in range(40)) if c is not None)


BROUGHT = [point.name for point in entry_points(group=GROUP)]


def of_kinds() -> Iterator[Data]:
    """One of the kind that is no derivation."""
    yield json.loads(Certificate.bundle([("one", false_claims.witness(random.Random(0)))]).to_json())


def of_one_step() -> Iterator[Data]:
    """Derivations by rules that say what their evidence shows."""
    makers = (false_claims.cells, false_claims.substitution, false_claims.witness, false_claims.optimum)
    of_curves = (false_claims.containment, false_claims.clearance)
    yield from map(first, (*makers, *of_curves, false_claims_of_arms.classification))
    of_arms = (false_claims_of_arms.solutions, false_claims_of_arms.branch, false_claims_of_arms.inverse)
    yield from map(first, (*of_arms, false_claims_of_arms.motions))
    yield from test_parts.data("all x. x^4 + a*x + 1 > 0", 25)["certificates"]


@functools.cache
def by_rule() -> dict[str, list[tuple[list[str], Data]]]:
    """Steps of each rule, also those inside evidence, with the order of the variables."""
    found: dict[str, list[tuple[list[str], Data]]] = {rule: [] for rule in (*RULES, *BROUGHT)}
    whole = [*(data(CASES[name]) for name in NEEDED), *of_one_step()]
    for text, method in OTHERS:
        certificate = qe.eliminate(text, method=method, check=True, process=False).certificate
        assert certificate is not None, text
        whole.append(json.loads(certificate.to_json()))
    listed: list[tuple[list[str], Data]] = []
    listed += [(one["payload"]["order"], made) for one in whole for made in steps(one["payload"])]
    for order, made in listed:
        if len(json.dumps(made)) < 12_000:
            found[made["rule"]].append((order, made))
    return found


def alone(order: list[str], made: Data) -> Data:
    """A derivation of this step alone, without the facts of its place: they are conjuncts of the start here."""
    before, after, context = made["before"], made["after"], made["context"]
    if not context:
        at, start, answer = [], before, after
    else:
        at, start, answer = [0], ["and", before, *context], True
    return {
        "kind": "derivation",
        "payload": {"order": order, "start": start, "steps": [{**made, "at": at}], "answer": answer},
    }


# --- other entries -----------------------------------------------------------------------------------------
def value(rng: random.Random, names: list[str]) -> Any:
    """Something that an entry may be, but seldom should."""
    v, w = rng.choice(names), rng.choice(names)
    atom = ["atom", w, rng.choice(("=", "/=", "<", ">="))]
    root = ["root", v, "<", f"{v}^2 - 2", rng.choice((1, -1, -5))]
    plain: list[Any] = [None, True, False, 0, 1, -1, 7, 10**30, -(10**30), "", "0", "1", "x", v, "1/2", "-7/3", "1/0"]
    texts = ["9" * 5000, "1" + "0" * 4000, f"{v}^2 + 1", f"{v}^10000", f"{v}^4", f"{v} - 1"]
    shapes = [[], [[]], [[], []], {}, {"a": 1}, [0], ["0"], [True], [v], [v, w], [v, v], ["exists", [], True]]
    formulas = [
        *(atom, root, ["not", atom], ["and", True, False], ["not", True], ["exists", [v], ["atom", v, ">"]]),
        *(["forall", [v], ["atom", f"{v}^2 + 1", "<"]], ["and", atom, ["exists", [v], ["atom", v, ">"]]]),
        *(["exists", [v], root], ["exists", [v], ["or", ["atom", v, ">"], root]]),
    ]
    return deepcopy(rng.choice(rng.choice((plain, texts, shapes, formulas))))


def quantified(rng: random.Random, names: list[str], formula: Any) -> Any:
    """The formula with a quantifier, a root atom or a constant somewhere in it; sometimes what is below its own."""
    v = rng.choice(names)
    if isinstance(formula, list) and formula and formula[0] in ("exists", "forall") and rng.random() < 0.7:
        kind, block, body = formula
        inner = rng.choice((body, quantified(rng, names, body), True, ["not", body]))
        return rng.choice(([kind, block, inner], [kind, block[:1], inner], [kind, [*block, v], inner], inner))
    other = rng.choice((["exists", [v], ["atom", v, ">"]], ["root", v, "<", f"{v}^2 - 2", 1], True, formula))
    return rng.choice((["exists", [v], formula], ["not", formula], [rng.choice(("and", "or")), formula, other]))


def altered(rng: random.Random, given: Data, root: Path) -> Data:
    """The data with one entry below ``root`` changed."""
    made = deepcopy(given)
    top = at(made, root)
    listed = list(paths(top))
    if not listed:
        return made
    path, names = rng.choice(listed), made["payload"].get("order") if isinstance(made.get("payload"), dict) else None
    known = names if isinstance(names, list) and names and all(isinstance(n, str) for n in names) else ["x", "y"]
    node = at(top, path[:-1])
    old, shape = node[path[-1]], rng.random()
    if shape < 0.15:
        del node[path[-1]]
    elif shape < 0.3 and isinstance(old, list) and old:
        node[path[-1]] = rng.choice((old[:1], old * 2, old[::-1], [], old[1:]))
    elif shape < 0.4:
        node[path[-1]] = deepcopy(at(top, rng.choice(listed)))
    else:
        node[path[-1]] = value(rng, known)
    return made


def of_step(rng: random.Random, order: list[str], made: Data) -> Data:
    """A derivation of the step with one or two of its formulas or an entry of its evidence changed."""
    made = deepcopy(made)
    shape = rng.randrange(6)
    if shape == 0:
        made["after"] = deepcopy(made["before"])
    for side in [("before",), ("after",), ("before", "after"), (), ()][shape - 1] if shape else ():
        made[side] = quantified(rng, order, made[side])
    whole = alone(order, made)
    if shape in (4, 5) or rng.random() < 0.2:
        return altered(rng, whole, ("payload", "steps", 0, "evidence") if made["evidence"] else ("payload",))
    return whole


def verdict_on(made: Data) -> str:
    """accepted, rejected or not decided; fails where a checker crashes, or a rejection names no entry."""
    text = text_of({"format": FORMAT, "version": 3, **made, "digest": ""})
    found = verify_json(text, Budget(2))
    assert CRASHED not in found.reason, (found, json.dumps(made))
    assert found.step or found.accepted or not found.decided, (found, json.dumps(made))
    return "accepted" if found.accepted else "rejected" if found.decided else "not decided"


def sweep(seed: int, each: int) -> tuple[Counter[str], Counter[str]]:
    """So many alterations for every rule and kind; what was said, and how many there were of each."""
    rng, said, offered = random.Random(seed), Counter[str](), Counter[str]()
    for rule, listed in by_rule().items():
        for _ in range(each if listed else 0):
            said[verdict_on(of_step(rng, *rng.choice(listed)))] += 1
            offered[rule] += 1
    for whole in of_kinds():
        content = {key: part for key, part in whole.items() if key not in ("format", "digest")}
        root = "certificates" if "certificates" in content else "payload"
        for _ in range(each):
            made = altered(rng, content, () if rng.random() < 0.1 else (root,))
            said[verdict_on(made)] += 1
            offered[whole["kind"]] += 1
    return said, offered


def test_every_entry_may_be_anything() -> None:
    said, offered = sweep(1, 5)
    assert set(offered) == {*RULES, *BROUGHT, "bundle"}
    assert said["rejected"] > 120 and said["accepted"]


@pytest.mark.deep
@pytest.mark.parametrize("part", range(4))
def test_every_entry_may_be_anything_often(part: int) -> None:
    assert sweep(10 + part, 150)[0]["rejected"]


# --- symptoms ----------------------------------------------------------------------------------------------
def test_a_block_that_stands_after_is_no_answer_by_critical_values() -> None:
    """It was an internal error: ['x'] not in Ring(b)."""
    for text, method in OTHERS[2:4]:
        certificate = qe.eliminate(text, method=method, check=True, process=False).certificate
        assert certificate is not None
        for made in steps(json.loads(certificate.to_json())["payload"]):
            if made["rule"].startswith("critical values"):
                order = sorted({*made["evidence"]["order"], "x", "y"})
                whole = alone(order, {**made, "after": made["before"]})
                whole["payload"]["answer"] = made["before"]
                found = verify(Certificate(Kind.DERIVATION, whole["payload"]))
                assert found.step == "payload.steps[0]" and "without quantifiers" in found.reason


def test_a_checker_that_crashes_has_accepted_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The verdict names the step, and asks to report it."""

    def crash(*_: object) -> None:
        raise KeyError("x")

    monkeypatch.setattr(registry, "RULES", {**RULES, "renaming": crash})
    payload = alone(["a", "x"], step("renaming", "ex x. x = a", "ex x. x = a"))["payload"]
    found = verify(Certificate(Kind.DERIVATION, payload), Budget(5))
    assert (found.accepted, found.decided, found.step) == (False, True, "payload.steps[0]")
    assert found.reason == f"{CRASHED} (KeyError: 'x')"
