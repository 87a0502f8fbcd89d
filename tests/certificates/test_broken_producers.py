"""Each side condition of a rule, switched off in its producer, leads to a step that is not accepted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest

import qe.rules.block as block
import qe.rules.cases as cases
import qe.rules.degree_shift as degree_shift
import qe.rules.generic as generic
import qe.rules.linear as linear
import qe.rules.preparation as preparation
import qe.rules.scaling as scaling
import qe.rules.structural as structural
import qe.rules.translation as translation
import qe.rules.zeros as zeros
import qe.simplify.factors as factors
from qe.api.input import read_formula
from qe.exact.ring import Ring
from qe.formula.normal import nnf, rename_apart
from qe.formula.syntax import FALSE, TRUE, Exists
from qe.formula.traverse import clashes, conjuncts
from qe.options import Budget, Options
from qe.proof.derivation import moved
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.proving.nested import names_within
from qe.proving.prover import Prover
from qe.rules import block_context
from qe.rules.step import StepKind
from qe.rules.tree import Any

Patch = Callable[[pytest.MonkeyPatch], None]


def unproved(text: str) -> set[str]:
    """The rules of the steps of a preparation that are not accepted."""
    log, given = RunLog(), read_formula(text)
    preparation.prepare(given, log=log)
    return {step.rule for step in log.steps() if not accepted(step)}


def accepted(step: Step) -> bool:
    """Whether evidence is found for a step, decompositions apart."""
    given = step.before.ring or step.after.ring
    if given is None:  # between constants
        return step.before == step.after
    ring = Ring.of(dict.fromkeys((*given.names, *names_within(step))))
    before, after, context = (moved(f, ring) for f in (step.before, step.after, step.context))
    known = tuple(conjuncts(context)) if context != TRUE else ()
    prover = Prover(ring, Options(), Budget(20), tables=False, known=known)
    if clashes(before):  # certificates begin after other names for its bound variables
        return prover.evidence(replace(step, before=before, after=after), known) is not None
    led = prover.taken(replace(step, before=before, after=after, context=context, places=((),)), before)
    return led == after and not prover.unchecked


def known_sign(m: pytest.MonkeyPatch) -> None:
    """Every coefficient counts as positive."""
    m.setattr(linear, "_sign", lambda lead, position, facts: 1)


def no_guard(m: pytest.MonkeyPatch) -> None:
    """The guard of the regular case is left out."""
    m.setattr(structural, "_nonzero", lambda pivot: TRUE)


def no_sign(m: pytest.MonkeyPatch) -> None:
    """x >= 0 is left out after an even shift of degrees."""
    m.setattr(degree_shift, "values", lambda variable, k, strict=False: TRUE)


def any_exponent(m: pytest.MonkeyPatch) -> None:
    """Exponents are divided by 2 whatever they are, bare comparisons of x too."""
    once = iter([2])
    m.setattr(degree_shift, "common_exponent", lambda body, x, nonnegative=False: next(once, 1))
    m.setattr(block, "RULES", (block_context.rule(degree_shift.shift_degree, StepKind.DEGREE_SHIFT),))


def any_weights(m: pytest.MonkeyPatch) -> None:
    """Polynomials count as homogeneous for equal weights."""
    m.setattr(scaling, "homogeneous_weights", lambda body, names: dict.fromkeys(body.ring.names[:2], Fraction(1)))
    m.setattr(block, "RULES", (block_context.rule(scaling.fix_scale, StepKind.SCALING),))


def one_value(m: pytest.MonkeyPatch) -> None:
    """The values 0 and -1 are left out after scaling."""
    m.setattr(scaling, "sorted", lambda signs, reverse=False: [1], raising=False)
    m.setattr(block, "RULES", (block_context.rule(scaling.fix_scale, StepKind.SCALING),))


def any_direction(m: pytest.MonkeyPatch) -> None:
    """Polynomials count as constant along a direction."""
    m.setattr(translation, "constant_direction", lambda body, names: dict.fromkeys(sorted(names), Fraction(1)))
    m.setattr(block, "RULES", (block_context.rule(translation.fix_origin, StepKind.TRANSLATION),))


def all_open(m: pytest.MonkeyPatch) -> None:
    """Every condition counts as open."""
    m.setattr(generic, "is_open", lambda formula, indices: True)


def fewer_factors(m: pytest.MonkeyPatch) -> None:
    """One factor of a product is forgotten."""
    full = cases.eq.factor_choice

    def fewer(equations: object, limit: int) -> object:
        found = full(equations, limit)  # type: ignore[arg-type]
        return found and (found[0], found[1][:-1])

    m.setattr(cases.eq, "factor_choice", fewer)
    m.setattr(block, "RULES", (block_context.rule(cases.split_factors, StepKind.FACTOR_SPLIT),))


def other_equations(m: pytest.MonkeyPatch) -> None:
    """A basis loses an equation."""
    m.setattr(cases.eq, "better_equations", lambda found, basis, variables: tuple(basis.polys)[:1])
    m.setattr(block, "RULES", (block_context.rule(cases.groebner_equations, StepKind.GROEBNER),))


def all_apart(m: pytest.MonkeyPatch) -> None:
    """Conditions that share a variable are quantified apart."""
    m.setattr(structural, "connected", lambda parts, names: ((), [(frozenset("xy"), (p,)) for p in parts]))
    m.setattr(block, "RULES", (block_context.rule(structural.independent_parts, StepKind.MINISCOPE),))


def no_dual(m: pytest.MonkeyPatch) -> None:
    """The body of a universal block is not negated."""
    m.setattr(preparation, "nnf", lambda formula, negate=False: nnf(formula))


def wrong_factors(m: pytest.MonkeyPatch) -> None:
    """A factor of even exponent is dropped where it may be zero."""
    m.setattr(factors, "_assemble", lambda relation, odd, even, settled: settled(factors.atom(odd, relation)))


def one_case(m: pytest.MonkeyPatch) -> None:
    """The boundary itself is forgotten."""
    m.setattr(generic, "Any", lambda nodes: Any(nodes[:1]))
    m.setattr(block, "RULES", (block_context.rule(generic.drop_inequations, StepKind.GENERIC),))


def negated(m: pytest.MonkeyPatch) -> None:
    """A negation gets lost."""
    m.setattr(preparation, "nnf", lambda formula, negate=False: nnf(formula, negate=not negate))


def any_pattern(m: pytest.MonkeyPatch) -> None:
    """Whatever is zero, some other condition counts as false."""
    m.setattr(zeros, "truth_under", lambda formula, signs: False)


CASES: dict[str, tuple[Patch, str, str]] = {
    "boundary": (one_case, "ex x. x^2 >= a and b*x /= 1", "boundary apart"),
    "negation": (negated, "not (ex x. x^3 > a and x < b)", "negation normal form"),
    "zeros": (any_pattern, "ex x, y. (x /= 0 or y /= 0) and x*y + a = 0", "conditions on zeros that follow"),
    "sign": (known_sign, "ex x. a*x = b and x > c", "linear equation solved"),
    "guard": (no_guard, "ex x. a*x = b and x > c", "linear equation solved under a guard"),
    "no sign": (no_sign, "ex x. x^4 + a < 0 and x^2 + b > 0", "degree shift"),
    "bare": (any_exponent, "ex x. x^4 + a < 0 and x < 0", "degree shift"),
    "exponents": (any_exponent, "ex x. x^5 + a < 0 and x^3 > c", "degree shift"),
    "weights": (any_weights, "ex x, y. x^2 + y > 1 and x*y < 2", "homogeneous scaling"),
    "values": (one_value, "ex x, y. x^3 + y^3 < 0 and x < y", "homogeneous scaling"),
    "direction": (any_direction, "ex x, y. x^2 + y^2 < a and x + y > 1", "translation of the origin"),
    "closed": (all_open, "ex x, y. x + y <= a and x*y >= a^2 and x - y /= a", "inequations that remove no interior"),
    "factors": (fewer_factors, "ex x. (x - a)*(x + a) = 0 and x > 1", "case split on factors"),
    "equations": (other_equations, "ex x, y. x^2 + y = a and x*y = 1 and x > y", "Groebner basis of the equations"),
    "apart": (all_apart, "ex x, y. x*y > a and x + y < 1", "independent parts and miniscoping"),
    "dual": (no_dual, "all x. x^2 + a > 0", "duality"),
    "even": (wrong_factors, "ex x. a^2*(x^3 + b) < 0 and x^5 > c", "standard simplification"),
}


@pytest.mark.parametrize("name", CASES)
def test_the_step_is_not_accepted(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    patch, text, rule = CASES[name]
    patch(monkeypatch)
    assert rule in unproved(text)


def test_with_their_side_conditions_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, (_, text, rule) in CASES.items():
        if name != "equations":  # a basis is not always a combination that is found
            assert rule not in unproved(text), name


def test_a_coefficient_that_conjuncts_with_the_variable_keep_from_zero() -> None:
    """1 + a*x <= 0 implies a /= 0, but what the substitution makes of it does not."""
    before = read_formula("ex x. a*x + b = 0 and 1 + a*x <= 0")
    after = read_formula("a^2*(b - 1) >= 0")
    assert isinstance(before, Exists)
    equation = conjuncts(before.body)[0]
    evidence = {"proof": {"solved": [("x", equation.poly, 0)]}}  # type: ignore[attr-defined]
    ring = before.ring
    assert ring is not None

    assert not accepted(Step("linear equation solved", before, moved(after, ring), TRUE, evidence))


@pytest.mark.parametrize(
    ("rule", "before", "right", "wrong"),
    [
        (
            "vanishing sum of squares split",
            "ex x, y. x^2 + (x - y)^2 = 0 and x + y > a",
            "ex x, y. x = 0 and y = 0 and x + y > a",
            "ex x, y. x = 0 and x + y > a",
        ),
    ],
)
def test_steps_of_older_certificates(rule: str, before: str, right: str, wrong: str) -> None:
    """By rules that nothing makes any more."""
    given = read_formula(before)
    assert given.ring is not None
    assert accepted(Step(rule, given, moved(read_formula(right), given.ring)))
    assert not accepted(Step(rule, given, moved(read_formula(wrong), given.ring)))


def test_a_name_that_captures() -> None:
    given = read_formula("(ex x. x > a) and (ex x. x < b)")
    right = rename_apart(given)
    assert accepted(Step("renaming", given, right))
    wrong = read_formula("(ex a. a > a + 0*x) and (ex x. x < b)")
    assert not accepted(Step("renaming", given, wrong if wrong.ring else FALSE))
