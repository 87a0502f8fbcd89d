"""What certificates claim, which theorems there are, and what is trusted."""

from fractions import Fraction

import pytest

import qe
from qe.certify.claims import claim_of, is_about
from qe.certify.registry import RULES
from qe.certify.theorems import theorem_of
from qe.certify.trusts import expert_parts
from qe.exact.ring import Ring
from qe.expert.rules import EXPERT
from qe.formula.build import convert
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.groebner.evidence import solutions_certificate
from qe.io.text import read
from qe.kernel.parts import true_where
from qe.kernel.renaming import is_same
from qe.proof.certificate import Certificate
from tests.certificates.producing import cell_table
from tests.tables import each

# What certificates claim, in words, and whether that is about a question.


def witness(text: str, *values: str) -> Certificate:
    names = ("x", "y")
    return Certificate.witness(convert(read(text), Ring.of(names)), names, [Fraction(v) for v in values])


def substitution() -> Certificate:
    ring = Ring.of(("a", "x"))
    body, answer = (convert(read(t), ring) for t in ("x = a and x > 1", "a > 1"))
    return Certificate.substitution(body, ring.names, [("x", ring.gen(1) - ring.gen(0))], answer)


def test_a_witness_claims_a_true_sentence() -> None:
    given = witness("x > 0 and y = x", "1", "1")
    assert claim_of(given).words == ("the sentence  ex x, y. x > 0 and x = y", "is true", "by instance")
    assert is_about(given, read("ex x, y. x > 0 and y = x")) == TRUE
    assert is_about(given, read("ex u, v. v = u and u > 0")) == TRUE  # other names, another order
    assert is_about(given, read("all x, y. x <= 0 or y /= x")) == FALSE  # the negation
    assert is_about(given, read("ex x, y. x >= 0 and y = x")) is None


def test_a_substitution_claims_an_equivalence() -> None:
    assert claim_of(substitution()).words == (
        "the formula  ex x. a = x and x > 1",
        "is equivalent to  a > 1, for all real values of a",
        "by linear equation solved",
    )
    about = is_about(substitution(), read("ex x. x = a and x > 1"))
    assert isinstance(about, Formula) and str(about) == "a > 1"


def test_tables() -> None:
    plain = cell_table("x^2 + y^2 < 1", "x y")
    said = ("the formula  x^2 + y^2 < 1", "has one truth value on each cell of a decomposition", "by cells")
    assert claim_of(plain).words == said
    closed = cell_table("x^2 + y^2 < 1", "x y", "EE")
    assert claim_of(closed).words == ("the sentence  ex x, y. x^2 + y^2 < 1", "is true", "by cells")
    assert is_about(closed, read("ex x, y. x^2 + y^2 < 1")) == TRUE
    assert is_about(closed, read("ex x, y. x^2 + y^2 < 2")) is None


def test_bundles() -> None:
    one, other = witness("x > 0 and y = x", "1", "1"), substitution()
    bundle = Certificate.bundle([("first", one), ("second", other)])
    assert claim_of(bundle).words[0] == "2 claims" and claim_of(bundle).words[1].startswith("first: the sentence")
    assert is_about(bundle, read("ex x. x = a and x > 1")) is not None
    assert is_about(bundle, read("ex x. x = a")) is None


def test_solutions() -> None:
    ring = Ring.of(("x", "y"))
    x, y = ring.gen(0), ring.gen(1)
    found = claim_of(solutions_certificate([x**2 - 4, y - x], [(x, Relation.GT)]))
    assert found.words[0] == "the formula  x^2 = 4 and y = x and x > 0"
    assert found.equivalence is not None and is_same(found.equivalence[1], read("x = 2 and y = 2"))
    assert claim_of(solutions_certificate([x**2 + 1])).equivalence == (read("x^2 + 1 = 0"), FALSE)


def decided(where: str, question: str, truth: bool) -> tuple[Formula, Formula]:
    """What a derivation says that proves the truth of a question where something holds."""
    condition = read(where)
    return read(f"({where}) and ({question})"), condition if truth else FALSE


QUESTION = "ex x. x^2 < a and b*x > 1"


@each(
    ((read(QUESTION), read("a > 0 and b /= 0")), "a > 0 and b /= 0"),
    ((read("all x. x^2 >= a or b*x <= 1"), read("a > 0")), "a <= 0"),
    (decided("a > 1", QUESTION, True), "a > 1"),
    (decided("a > 1 and b > 1", QUESTION, True), "a > 1 and b > 1"),
    (decided("a > 1 or b > 1", "ex y. 1 < b*y and a > y^2", True), "a > 1 or b > 1"),
    (decided("a < 0", "all x. x^2 >= a or b*x <= 1", False), "a < 0"),
    (decided("a > 1", QUESTION, False), None),  # about the negation
    (decided("a > 1", "all x. x^2 >= a or b*x <= 1", True), None),
    ((decided("a > 1", QUESTION, True)[0], read("a > 0")), None),
    (decided("a > 1", "ex x. x^2 <= a and b*x > 1", True), None),
)
def test_what_an_equivalence_says_to_imply_a_formula(
    equivalence: tuple[Formula, Formula], expected: str | None
) -> None:
    found = true_where(equivalence, read(QUESTION))
    assert (None if found is None else str(found)) == (None if expected is None else str(read(expected)))


# Theorems of rules: what the modules of their checkers say.


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_with_a_checker_has_its_theorem(rule: str) -> None:
    assert theorem_of(rule), f'the docstring of the module of the checker of "{rule}" says THEOREM'


def test_a_rule_has_the_theorem_of_its_checker_and_no_other() -> None:
    assert "intermediate values" in theorem_of("root")[0]
    assert len(theorem_of("solutions")) == 1
    assert theorem_of("no such rule") == ()


# What a certificate rests on, and that the core alone refuses what needs more.

CORE = [
    "ex x. x^2 + b*x + c = 0",
    "ex x, y. x*y = a and x + y = b and x^3 + y^3 > 1",
    "ex x. x >= 0 and x <= 1 and a*x^3 + b*x^2 + c*x + d < 0",
    "all x. ex y. y^3 = x",
    "ex x. x > 0 and x^4 + a*x^3 + b*x + c = 0",
]
NEEDS = {"ex x. (x - a)^2 <= 1 and x^2 <= 4": "critical values"}


@pytest.mark.parametrize("question", CORE)
def test_the_core_suffices(question: str) -> None:
    certificate = qe.eliminate(question, check=True).certificate
    assert certificate is not None and qe.verify(certificate, core=True).accepted
    assert not expert_parts(certificate)


@pytest.mark.parametrize("question", NEEDS)
def test_the_core_refuses_what_needs_the_expert_ring(question: str) -> None:
    certificate = qe.eliminate(question, method="critical", check=True).certificate
    assert certificate is not None and qe.verify(certificate).accepted
    verdict = qe.verify(certificate, core=True)
    assert not verdict.accepted and verdict.step == "core" and NEEDS[question] in verdict.reason
    assert NEEDS[question] in certificate.trusts
    bundle = Certificate.bundle((("one", certificate),))
    assert qe.verify(bundle).accepted and not qe.verify(bundle, core=True).accepted


def test_every_expert_rule_has_a_checker() -> None:
    assert set(RULES) >= set(EXPERT)
