"""Derivations with any field altered, any step dropped, swapped or repeated: refused, with the step named."""

from __future__ import annotations

import copy
import json
import pathlib
import re
from collections.abc import Callable, Collection, Iterator
from typing import Any

import pytest

import qe
from qe.api.input import read_formula
from qe.certify.registry import RULES
from qe.certify.verify import verify, verify_json
from qe.exact.ring import Ring
from qe.formula.syntax import TRUE
from qe.kernel.verdict import Verdict
from qe.proof.certificate import Certificate, digest
from qe.proof.entry import Entry, formula_from_json
from qe.proof.step import Nested, Step
from qe.proving.nested import names_within
from tests.certificates.derivations import CASES, certificate, data, rules
from tests.certificates.mutation import Path, at, leaves, lists, replaced, without
from tests.tables import each

QUICK = {
    "sign",
    "shift",
    "translated",
    "squares",
    "negations",
    "none",
    "point",
    "terms",
    "distributed",
    "taken far out",
    "redundant",
}
"""Cases for every day; the others are altered in the deep tests."""


Body = Callable[[dict[str, Any], int], None]


def at_every_step(first: int = 0, without: Collection[str] = ()) -> Callable[[Body], Callable[[str], None]]:
    """A body on a certificate and the number of a step becomes a test a case, over its steps from ``first`` on."""
    cases = [pytest.param(n, marks=() if n in QUICK else pytest.mark.deep) for n in CASES if n not in without]

    def made(body: Body) -> Callable[[str], None]:
        @pytest.mark.parametrize("name", cases)
        def test(name: str) -> None:
            whole = data(CASES[name])
            for k in range(first, len(whole["payload"]["steps"])):
                body(whole, k)

        test.__name__, test.__doc__ = body.__name__, body.__doc__
        return test

    return made


def evidence_altered(
    whole: dict[str, Any], k: int, every: int = 1, passed: Callable[[Path], bool] = lambda path: "samples" in path
) -> None:
    """Every entry of the evidence of a step, or some of them, with other values: refused there."""
    place: Path = ("payload", "steps", k, "evidence")
    listed = [entry for entry in leaves(whole["payload"]["steps"][k]["evidence"]) if not passed(entry[0])]
    for path, value in listed[::every]:
        for other in others(value):
            refused(verify_json(replaced(whole, (*place, *path), other)), k)


RELATIONS = ("=", "/=", "<", "<=", ">", ">=")
LARGE = {"guarded", "shorter", "constant", "basis", "nowhere", "chords"}
"""Cases with long cell tables, whose alterations the tests of tables make."""


def altered(whole: dict[str, Any], change: Callable[[dict[str, Any]], object]) -> Verdict:
    """The verdict on a changed certificate, signed with the digest of its new content."""
    other = copy.deepcopy(whole)
    change(other["payload"])
    other["digest"] = digest(other)
    return verify_json(json.dumps(other))


def refused(verdict: Verdict, k: int | None = None) -> None:
    """Not accepted; where the checker says what is wrong, it is a step (step k, or the place where steps meet)."""
    assert not verdict.accepted
    if verdict.decided:
        named = re.match(r"payload\.(steps\[(\d+)\]|answer|start)", verdict.step)
        assert named, verdict
        assert k is None or named[2] is None or int(named[2]) >= k, verdict


ELSEWHERE = {
    "critical values": "certificates/test_critical_values",
    "covering": "certificates/test_covering",
    "multipliers": "certificates/test_optimum",
    "instance": "certificates/test_witnesses_and_equations",
    "solutions": "certificates/test_solutions",
    "classification": "certificates/test_solutions",
    "parts": "unit/kernel/test_parts",
}
"""Rules whose evidence is altered in a file of its own."""

OTHERWISE = {"cells", "critical values", "shorter", "steps", "virtual substitution"}
"""Rules whose evidence has tests of its own."""


def test_every_rule_is_in_a_case_that_is_altered() -> None:
    assert {rule for text in CASES.values() for rule in rules(text)} | set(ELSEWHERE) == set(RULES)
    for name in ELSEWHERE.values():
        assert (pathlib.Path(__file__).parents[1] / f"{name}.py").exists()


def test_as_it_stands_it_is_accepted() -> None:
    for text in CASES.values():
        assert verify(certificate(text)).accepted
        assert verify(Certificate.from_json(certificate(text).to_json())).accepted


@at_every_step()
def test_dropped_and_repeated_steps(whole: dict[str, Any], k: int) -> None:
    refused(altered(whole, lambda p: p["steps"].pop(k)), k)
    step = whole["payload"]["steps"][k]
    verdict = altered(whole, lambda p: p["steps"].insert(k, p["steps"][k]))
    if in_order(step["before"]) == in_order(step["after"]):  # what only orders a part may do so once more
        return
    refused(verdict)


def in_order(formula: Any) -> str:
    """The formula with the arguments of its conjunction or disjunction in one order, as text."""
    joined = isinstance(formula, list) and formula[0] in ("and", "or")
    return json.dumps([formula[0], *sorted(formula[1:], key=json.dumps)] if joined else formula)


@at_every_step(first=1)
def test_swapped_steps(whole: dict[str, Any], k: int) -> None:
    """Steps at places of their own may be taken in another order: then they are the ones that were given."""
    verdict = altered(whole, lambda p: p["steps"].insert(k - 1, p["steps"].pop(k)))
    if verdict.accepted:
        first, second = whole["payload"]["steps"][k - 1]["at"], whole["payload"]["steps"][k]["at"]
        assert first[: len(second)] != second
        assert second[: len(first)] != first
    else:
        refused(verdict, k - 1)


@at_every_step()
def test_every_field_of_a_step(whole: dict[str, Any], k: int) -> None:
    step = whole["payload"]["steps"][k]
    for field in step:
        refused(altered(whole, lambda p, field=field: p["steps"][k].pop(field)), k)  # type: ignore[misc]
        for other in (None, "other", 7, ["other"], {"other": 1}):
            refused(altered(whole, lambda p, field=field, other=other: p["steps"][k].update({field: other})), k)  # type: ignore[misc]
    refused(altered(whole, lambda p: p["steps"][k].update(at=[*step["at"], 0])), k)
    refused(altered(whole, lambda p: p["steps"][k].update(at=[9, *step["at"]])), k)
    refused(altered(whole, lambda p: p["steps"][k].update(context=[["atom", f"{p['order'][0]}^2 + 7", "/="]])), k)


@at_every_step()
def test_another_formula_before_or_after(whole: dict[str, Any], k: int) -> None:
    for field in ("before", "after"):
        for path in atoms(whole["payload"]["steps"][k][field]):
            for relation in RELATIONS:
                changed = at(whole["payload"]["steps"][k][field], path)
                if changed[2] != relation:
                    text = replaced(whole, ("payload", "steps", k, field, *path, 2), relation)
                    verdict = verify_json(text)
                    if verdict.accepted:  # a part that does not matter, as one disjunct is true
                        assert is_right(json.loads(text)["payload"], k), (field, path, relation)
                    else:
                        refused(verdict, k)


def is_right(payload: dict[str, Any], k: int) -> bool:
    """Whether the engine, too, finds the two sides of a step equivalent."""
    ring = Ring.of(payload["order"])
    step = payload["steps"][k]
    left, right = (formula_from_json(Entry(step[f], f), ring, quantified=True) for f in ("before", "after"))
    return qe.equivalent(left, right)


@pytest.mark.parametrize("name", sorted(QUICK))
def test_another_start_or_answer(name: str) -> None:
    whole = data(CASES[name])
    for field in ("start", "answer"):
        for other in (True, False, ["atom", whole["payload"]["order"][0], ">"]):
            if whole["payload"][field] != other:
                refused(altered(whole, lambda p, f=field, o=other: p.update({f: o})))  # type: ignore[misc]


@at_every_step(without=LARGE)
def test_every_entry_of_the_evidence(whole: dict[str, Any], k: int) -> None:
    """Numbers, names and lemmas: none may be changed, and none is there for nothing."""
    step = whole["payload"]["steps"][k]
    if step["rule"] in OTHERWISE:
        return  # evidence with tests of its own
    evidence_altered(
        whole,
        k,
        # other samples between the same roots are as good, and weights with other signs
        passed=lambda path: "samples" in path or (path[0] == "weights" and len(step["evidence"]["weights"]) == 1),
    )
    for path, value in lists(step["evidence"], ("payload", "steps", k, "evidence")):
        for index in range(len(value)):
            if path[-1] not in ("samples", "line") and path[-3] != "cases":  # a shorter list, a stronger clause may do
                refused(verify_json(without(whole, path, index)), k)


@pytest.mark.parametrize("text", ["all x. x^2 > 1", "all x, y, z, u. x^2 + y^2 + z^2 + u^2 <= 1 -> x + y + z + u <= 2"])
def test_universal_sentences_by_a_point_or_multipliers(text: str) -> None:
    made = qe.eliminate(text, check=True).certificate
    assert made is not None
    whole = json.loads(made.to_json())
    (step,) = whole["payload"]["steps"]
    assert step["rule"] in ("instance", "multipliers")
    evidence_altered(whole, 0, passed=lambda path: False)


@each(72, pytest.param(4, marks=pytest.mark.deep))
def test_steps_inside_the_evidence(step: int) -> None:
    """Steps from infinity, and from what remains, may not be altered either."""
    made = data(CASES["infinity"])
    k = next(k for k, step in enumerate(made["payload"]["steps"]) if step["rule"] == "steps")
    evidence_altered(made, k, every=step)


def test_names_inside_the_evidence() -> None:
    """Variables that occur in nested derivations alone belong to the ring too."""
    given = read_formula("ex x. a*x^3 + b*x + c < 0")
    inner = Nested(given, (Step("renaming", given, read_formula("ex t. a*t^3 + b*t + c < 0")),), TRUE)
    assert set(names_within({"proof": [inner]})) == {"a", "b", "c", "x", "t"}


def test_an_empty_bundle_proves_nothing() -> None:
    verdict = verify(Certificate.bundle([]))
    assert not verdict.accepted
    assert "proves nothing" in verdict.reason


def test_a_rule_without_a_checker_proves_nothing() -> None:
    verdict = altered(data(CASES["lines"]), lambda p: p["steps"][0].update(rule="witchcraft"))
    assert not verdict.accepted
    assert not verdict.decided
    assert "witchcraft" in verdict.reason


def atoms(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The places of atoms in a formula."""
    if isinstance(node, list):
        if node and node[0] == "atom":
            yield path
        for k, part in enumerate(node):
            yield from atoms(part, (*path, k))


def others(value: Any) -> Iterator[Any]:
    """Other entries of the same kind, and of another."""
    yield from (None, [], {}) if value is not None else ([], 3)
    if isinstance(value, int):
        yield from (value + 1, -value - 1)
    elif isinstance(value, str):
        yield from (f"{value} + 1", f"-{value}", "", "1/0")
