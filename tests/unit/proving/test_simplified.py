"""Simplifications whose proof in one step is out of reach are proved piece by piece; every step is checked."""

import pytest
from hypothesis import given, settings

import qe
from qe.certify.registry import RULES
from qe.exact.ring import Ring
from qe.formula.syntax import FALSE, TRUE, Formula
from qe.io.text import read
from qe.kernel.derivation import check_derivation
from qe.kernel.step import Context
from qe.options import Budget, Options
from qe.proof.certificate import Certificate
from qe.proof.derivation import moved, put_together
from qe.proof.entry import Json, formula_to_json
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.prover import Prover, proved
from qe.proving.remembering import remembering
from qe.proving.simplified import Simplified
from qe.simplifier.simplify import simplify
from tests.strategies import formulas
from tests.tables import each

WIDE = " and ".join(f"(a{k} > 0 or b{k} > 0 and c{k} = 0 or a{k} < 0 and b{k} < 0)" for k in range(6))
CASES = {
    "a quantifier of a variable that does not occur": ("ex x. x > a and (all k. x > 0 and a > 0 or a = x)", None),
    "parts under what stands beside them": (
        f"a > 0 and ({WIDE} and (b >= 0 or a <= 0 or c > 1)) and (b > 0 or c = 1 and (a > 0 or c < 0) or a < -1)",
        None,
    ),
    "a long sum of positive terms": (
        "ex x, y, z. x > 0 and y > 0 and z > 0 and (x + 2*y + 3*z + 1)^5 < 0",
        "false",
    ),
}

RING = Ring.of(("k", "x", "y", "z"))


def over(text: str) -> Formula:
    return moved(read(text), RING)


def certificate(before: Formula, after: Formula) -> Certificate | None:
    log = RunLog()
    log.step("simplification", before, after)
    proof = proved(put_together(before, log.steps(), after), after, Options(certify=True), Budget())
    assert proof.checked is (proof.certificate is not None)
    return proof.certificate


@pytest.mark.parametrize("name", CASES)
def test_a_simplification_beyond_one_step_is_proved_in_several(name):
    text, simple = CASES[name]
    before = read(text)
    found = certificate(before, simplify(before) if simple is None else read(simple))
    assert found is not None and qe.verify(found, formula=before).accepted


@each(2, 5)
def test_what_is_simplified_outside_helps_deep_inside_with_one_search_more_a_quantifier(depth: int) -> None:
    """Each block is simpler only under what the one around it becomes: x0 = 0 is known when x1 is looked at."""
    text = f"x{depth - 1}*y + x0 > 0 and w^2 + y^2 + x{depth - 1} >= y"
    for k in reversed(range(depth)):
        outer = f"x{k - 1}" if k else "a"
        mine = f"x{k}^2 + {outer}*x{k} <= 0 and ({outer}*w + x{k}*y >= 0 or x{k}*w < 0)"
        text = f"(ex x{k}. {mine} and {text})"
    before = read(f"a^2 <= 0 and {text}")
    assert before.ring is not None
    prover, searches = Prover(before.ring, Options(), Budget()), list[bool]()

    def evidence(one: Formula, other: Formula, used: Context) -> tuple[str, Json] | None:
        made = prover.own(Step("simplification", one, other), used)
        searches.append(made is not None)
        return made

    simplified = Simplified(evidence, (), prover.steps)
    assert simplified.inside((), before, simplify(before), before) == simplify(before)
    assert searches.count(False) <= depth and searches.count(True) <= 2 * depth
    certificate = Certificate.derivation(before.ring.names, before, prover.steps, simplify(before))
    assert qe.verify(certificate, formula=before).accepted


@settings(max_examples=60, deadline=None)
@given(formulas(), formulas())
def test_what_is_proved_of_a_simplification_is_accepted_from_scratch(first, second):
    before = first & second
    found = certificate(before, simplify(before))
    assert found is None or qe.verify(found).accepted


@each(
    ("x > 0 and (y > 0 or z > 0)", "x > 0 and y > 0"),
    ("x > 0 or y > 0 and z > 0", "x > 0 or y > 0"),
    ("x > 0 and (all k. y > 0)", "x > 0"),
    ("x > 0 or y > 0", "y > 0"),
    ("x > 0 and y > 0", "x > 0"),
    ("x > 0 and y > 0", "true"),
    ("x > 0 or y > 0", "false"),
)
def test_what_both_sides_share_hides_no_difference(before, after):
    for left, right in ((before, after), (after, before)):
        assert certificate(over(left), over(right)) is None


def test_a_step_that_was_accepted_is_known_by_all_that_it_depends_on():
    start, wrong = over("x > 0 and x > -1"), over("x > -1")
    good = certificate(start, over("x > 0"))
    assert good is not None and isinstance(good.payload, dict)
    known: set[tuple[object, ...]] = set()
    check_derivation(good.payload, Budget(), remembering(RULES, known))
    assert len(known) == 1
    step = good.payload["steps"][0]  # type: ignore[call-overload, index]
    for entry, value in (("after", wrong), ("after", TRUE), ("after", FALSE)):
        changed = {**step, entry: formula_to_json(value)}
        payload = {**good.payload, "steps": [changed], "answer": changed["after"]}
        with pytest.raises(qe.CertificateRejected):
            check_derivation(payload, Budget(), remembering(RULES, known))
