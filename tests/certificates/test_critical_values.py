"""Critical values: blocks over bounded fibres are proved on open cells; altered evidence and false claims are not."""

from __future__ import annotations

import copy
import dataclasses
import functools
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from qe.api.input import read_formula
from qe.certify.registry import RULES
from qe.elimination.cad import certificate_for
from qe.elimination.critical.method import by_critical_values
from qe.elimination.protocol import Context
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Ring
from qe.expert.critical_values import check_critical_values
from qe.expert.regular_set import check_regular
from qe.formula.build import conj, convert, disj
from qe.formula.syntax import Exists, Formula
from qe.io.names import names_in
from qe.kernel.derivation import limits_of
from qe.kernel.step import Claim
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.entry import Entry, Json
from qe.proof.run_log import RunLog
from qe.proving import critical as critical_proof
from tests.certificates.mutation import at
from tests.certificates.producing import table_in

DISC = "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + y^2 <= 4"
ELLIPSE = "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + 4*y^2 <= 1"
LENS = "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + y^2 <= 4 and (x - 3)^2 + y^2 <= 4"
LINE = "ex x. (x - a)^2 <= 1 and x^2 <= 3 and a <= 2"
LIMITS = limits_of(Budget(), RULES)


def block(text: str) -> Exists:
    """The formula, a block."""
    found = read_formula(text)
    assert isinstance(found, Exists)
    return found


def made(before: Exists, after: Formula, order: tuple[str, ...]) -> Json:
    """Evidence for an equivalence that is claimed."""
    return critical_proof.critical_evidence(claim(before, after, None), order, Options(certify=True), Budget(60))


def claim(before: Exists, after: Formula, evidence: Json) -> Claim:
    """The claim over one ring."""
    ring = Ring.of(dict.fromkeys((*names_in(before), *names_in(after))))
    given = Entry(evidence, "evidence")
    return Claim("critical values", moved(before, ring), moved(after, ring), ring, given, "step")


def check(before: Exists, after: Formula, evidence: Json) -> None:
    """As the checker: silently, or ``CertificateRejected``."""
    check_critical_values(claim(before, after, evidence), (), LIMITS)


@functools.cache
def example(text: str) -> tuple[Exists, Formula, dict[str, Any]]:
    """A block, its formula by critical values, and the evidence."""
    before = block(text)
    found = by_critical_values(before.variables, before.body, Context(Options(), Budget(60), RunLog()))
    assert found.order is not None
    evidence = made(before, found.formula, found.order)
    assert isinstance(evidence, dict)
    return before, found.formula, evidence


@pytest.mark.parametrize("text", [DISC, ELLIPSE, LENS, LINE])
def test_it_is_accepted(text: str) -> None:
    check(*example(text))


def test_convex_answers_in_three_parameters() -> None:
    before = block("ex x. (x - a)^2 <= 1 and x^2 <= 4 and b^2 + c^2 <= 1")
    after = read_formula("a <= 3 and a >= -3 and b^2 + c^2 <= 1")
    check(before, after, made(before, after, ("a", "b", "c")))


@settings(max_examples=6, deadline=None, derandomize=True)
@given(st.integers(1, 3), st.integers(1, 4), st.integers(-3, 3), st.integers(1, 9))
def test_random_ellipses(p: int, q: int, shift: int, size: int) -> None:
    before = block(f"ex x. {p}*(x - a)^2 <= {q} and x^2 + {shift}*x <= {size}")
    found = by_critical_values(before.variables, before.body, Context(Options(), Budget(60), RunLog()))
    check(before, found.formula, made(before, found.formula, found.order or ("a",)))


# --- false claims ---------------------------------------------------------------------------------
WRONG: dict[str, Callable[[Formula], Formula]] = {
    "open": lambda f: read_formula("a^2 + b^2 < 9"),
    "smaller": lambda f: read_formula("a^2 + b^2 <= 8"),
    "larger": lambda f: read_formula("a^2 + b^2 <= 10"),
    "a point outside": lambda f: disj((f, convert(read_formula("a = 4 and b = 0"), f.ring))),  # type: ignore[arg-type]
    "a line outside": lambda f: disj((f, convert(read_formula("b = 0 and a <= 5 and a >= 0"), f.ring))),  # type: ignore[arg-type]
    "a vertical line": lambda f: disj((f, convert(read_formula("a = 0 and b <= 5"), f.ring))),  # type: ignore[arg-type]
    "a point missing": lambda f: conj((f, convert(read_formula("a /= 3 or b /= 0"), f.ring))),  # type: ignore[arg-type]
    "a line missing": lambda f: conj((f, convert(read_formula("a /= 0 or b /= 0 and b < 5"), f.ring))),  # type: ignore[arg-type]
    "nothing": lambda f: read_formula("a^2 + b^2 + 1 <= 0"),
}


@pytest.mark.parametrize("order", [("a", "b"), ("b", "a")])
@pytest.mark.parametrize("name", WRONG)
def test_false_claims(name: str, order: tuple[str, ...]) -> None:
    """Evidence as the engine makes it, or of the true claim with what the false one needs, is rejected."""
    before, after, evidence = example(DISC)
    wrong = WRONG[name](after)
    with pytest.raises((CertificateRejected, Unable)):
        check(before, wrong, made(before, wrong, order))
    table = certificate_for(wrong, wrong, Options(), Budget(60))
    assert table is not None
    with pytest.raises(CertificateRejected):
        check(before, wrong, {**evidence, "regular": table.to_data()})


def test_conditions_that_the_theorem_does_not_cover() -> None:
    _, after, evidence = example(DISC)
    for text in (
        "ex x, y. (x - a)^2 + (y - b)^2 < 1 and x^2 + y^2 <= 4",
        "ex x, y. (x - a)^2 + (y - b)^2 >= 1 and x^2 + y^2 <= 4",
        "ex x, y. (x - a)^2 + (y - b)^2 = 1 and x^2 + y^2 <= 4",
        "ex x, y. (x - a)^2 + (y - b)^2 <= 1 and x^2 + y^4 <= 4",
        "ex x, y. (x - a)^2 <= 1 and x^2 + y^2 <= 4 and (y <= 1 or x = 0)",
    ):
        with pytest.raises(CertificateRejected, match=r"all weak or all strict|degree at most 2|not convex"):
            check(block(text), after, evidence)


# --- altered evidence -----------------------------------------------------------------------------
def altered(evidence: dict[str, Any], change: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
    """A changed copy."""
    other = copy.deepcopy(evidence)
    change(other)
    return other


def refused(text: str, change: Callable[[dict[str, Any]], object], reason: str | None = None) -> None:
    """The change leads to a rejection at an entry of the evidence, or of the step."""
    before, after, evidence = example(text)
    with pytest.raises(CertificateRejected, match=reason) as caught:
        check(before, after, altered(evidence, change))
    assert caught.value.step.startswith(("evidence", "step"))


@pytest.mark.parametrize("text", [DISC, ELLIPSE])
def test_every_member_of_the_evidence(text: str) -> None:
    for name in example(text)[2]:
        refused(text, lambda e, name=name: e.pop(name))  # type: ignore[misc]
        for other in ("other", 7, {"other": 1}, []):
            refused(text, lambda e, name=name, other=other: e.update({name: other}))  # type: ignore[misc]


def test_unbounded_fibres() -> None:
    for weights in (["0", "0"], ["-1", "2"], ["1", "-1"]):
        refused(DISC, lambda e, weights=weights: e.update(bound=weights), "bound|negative")  # type: ignore[misc]
    before = block("ex x, y. x - a <= 0 and y^2 + b^2 <= 1")
    after = read_formula("b^2 <= 1")
    with pytest.raises(CertificateRejected, match="bound"):
        check(before, after, {**example(DISC)[2], "bound": ["1", "1"]})


def count_refused(text: str, changes: list[Callable[[dict[str, Any]], object]]) -> int:
    """How many of some changes are rejected."""
    before, after, evidence = example(text)
    rejected = 0
    for change in changes:
        try:
            check(before, after, altered(evidence, change))
        except CertificateRejected:
            rejected += 1
    return rejected


@pytest.mark.parametrize("text", [DISC, ELLIPSE, pytest.param(LENS, marks=pytest.mark.deep)])
def test_chains(text: str) -> None:
    """No set of active conditions may be left out, nor the end of a chain that leads to what no other row does.

    Another coefficient makes another polynomial, which is true of the critical points too, but seldom of use.
    """
    chains = example(text)[2]["chains"]
    others: list[Callable[[dict[str, Any]], object]] = []
    for k, rows in enumerate(chains):
        refused(text, lambda e, k=k: e["chains"].pop(k))  # type: ignore[misc]
        if rows:
            refused(text, lambda e, k=k: e["chains"].__setitem__(k, []), "no polynomial in the parameters")  # type: ignore[misc]
        for r in range(len(rows)):
            refused(text, lambda e, k=k, r=r: e["chains"][k][r][0].__setitem__(0, 99), "before it")  # type: ignore[misc]
            refused(text, lambda e, k=k, r=r: e["chains"][k].__setitem__(r, []), "is 0")  # type: ignore[misc]
            others.append(lambda e, k=k, r=r: e["chains"][k][r][0].__setitem__(1, "a*b + 7"))  # type: ignore[misc]
    assert count_refused(text, others) > len(others) // 2


LONG = [pytest.param(text, marks=pytest.mark.deep) for text in (ELLIPSE, LENS)]


@pytest.mark.parametrize("text", [DISC, LINE, *LONG])
def test_factors_and_samples(text: str) -> None:
    evidence = example(text)[2]
    dropped: list[Callable[[dict[str, Any]], object]] = []
    for k, level in enumerate(evidence["factors"]):
        dropped += [lambda e, k=k, j=j: e["factors"][k].pop(j) for j in range(len(level))]  # type: ignore[misc]
    assert count_refused(text, dropped) >= len(dropped) - 1  # one may come from an elimination that found too much
    stacks = [("stacks",), *(("stacks", j, 1) for j, (_, inner) in enumerate(evidence["stacks"]))]
    for path in stacks:
        stack = at(evidence, path)
        for j in range(len(stack) if isinstance(stack, list) else 0):
            beside = stack[j + 1 if j + 1 < len(stack) else 0][0]
            if len(stack) > 1:
                refused(text, lambda e, p=path, j=j: at(e, p).pop(j))  # type: ignore[misc]
                refused(text, lambda e, p=path, j=j, b=beside: at(e, p)[j].__setitem__(0, b), "ascend")  # type: ignore[misc]
            refused(text, lambda e, p=path, j=j: at(e, p).insert(j, at(e, p)[j]), "ascend")  # type: ignore[misc]


@pytest.mark.parametrize("text", [DISC, *LONG])
def test_what_is_said_of_cells(text: str) -> None:
    """A point for a cell outside, weights for one inside, and numbers of none."""
    evidence = example(text)[2]
    for j, (_, inner) in enumerate(evidence["stacks"]):
        for i, (_, said) in enumerate(inner):
            for other in (-1 - said, 99, -99, None):
                refused(text, lambda e, j=j, i=i, o=other: e["stacks"][j][1][i].__setitem__(1, o))  # type: ignore[misc]
    for k in range(len(evidence["points"])):
        refused(text, lambda e, k=k: e["points"].__setitem__(k, ["50", "0"]), "a point")  # type: ignore[misc]
    for k, (_, *rest) in enumerate(evidence["weights"]):
        refused(text, lambda e, k=k, n=len(rest): e["weights"].__setitem__(k, ["0"] * (n + 1)), "weights")  # type: ignore[misc]
        refused(text, lambda e, k=k, r=rest: e["weights"].__setitem__(k, ["-1", *r]), "negative")  # type: ignore[misc]
        refused(text, lambda e, k=k, r=rest: e["weights"].__setitem__(k, r), "numbers")  # type: ignore[misc]


def test_a_table_of_something_else() -> None:
    other = example(LENS)[2]["regular"]
    assert other is not None
    refused(ELLIPSE, lambda e: e.update(regular=other), "another formula")


def test_a_table_with_a_cell_undecided() -> None:
    holds = read_formula("a^2 <= 2")
    made = certificate_for(holds, holds, Options(), Budget(60))
    assert made is not None
    table = table_in(made)
    stack = table.root.stack
    assert stack is not None
    check_regular(table, LIMITS, "regular")
    for k, cell in enumerate(stack.cells):
        for truth in (None, not cell.truth):
            cells = (*stack.cells[:k], dataclasses.replace(cell, truth=truth), *stack.cells[k + 1 :])
            root = dataclasses.replace(table.root, stack=dataclasses.replace(stack, cells=cells))
            if truth is None or k % 2:
                with pytest.raises(CertificateRejected):
                    check_regular(dataclasses.replace(table, root=root), LIMITS, "regular")


# --- broken producers -----------------------------------------------------------------------------
def nothing_eliminated(m: pytest.MonkeyPatch) -> None:
    """Chains that stop at once."""
    m.setattr(critical_proof, "chain", lambda start, free, enough, budget: [])


def fewer_sets(m: pytest.MonkeyPatch) -> None:
    """Sets of two active conditions are forgotten."""
    whole = critical_proof.active_sets
    m.setattr(critical_proof, "active_sets", lambda *args: list(whole(*args))[:-1])


def no_projection(m: pytest.MonkeyPatch) -> None:
    """Factor lists that are not closed."""
    whole = critical_proof.factor_lists
    m.setattr(critical_proof, "factor_lists", lambda *args: ((), *whole(*args)[1:]))


def any_weights(m: pytest.MonkeyPatch) -> None:
    """Weights are believed without a look at them."""
    m.setattr(critical_proof, "is_positive", lambda matrix: True)


def any_points(m: pytest.MonkeyPatch) -> None:
    """The first point is believed to do for all cells."""
    shows = critical_proof._Cells.shows
    m.setattr(critical_proof._Cells, "shows", lambda self, k, v, inside: inside or shows(self, k, v, inside))


@pytest.mark.parametrize("patch", [nothing_eliminated, fewer_sets, no_projection, any_weights, any_points])
def test_side_conditions_switched_off(patch: Callable[[pytest.MonkeyPatch], None], monkeypatch: Any) -> None:
    before, after, evidence = example(LENS)
    order = tuple(str(name) for name in evidence["order"])
    assert set(order) == set(after.free)
    patch(monkeypatch)
    with pytest.raises(CertificateRejected):
        check(before, after, made(before, after, order))
