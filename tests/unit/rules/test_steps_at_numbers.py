"""Questions behind ``not`` and under ``all`` too: with numbers for the parameters, before and after a rule are equal.

Many numbers are zeros of what the rule has made, or huge, or tiny: there leading coefficients vanish, ellipses are
points, and the ends of intervals coincide.
"""

import random
from collections.abc import Sequence
from fractions import Fraction

import pytest

import qe
from qe.api.input import read_formula
from qe.formula.evaluate import substituted
from qe.formula.syntax import Constant, Formula
from qe.formula.traverse import polynomials
from qe.proof.run_log import RunLog
from qe.rules.preparation import prepare
from qe.rules.step import StepKind
from tests.certificates.test_steps_by_hand import accepted

FORMS = (
    "ex {v}. {p} and {q}",
    "all {v}. not ({p} and {q})",
    "not (ex {v}. {p} and {q})",
    "not (all {v}. {p} -> not {q})",
    "ex {v}. not (not {p} or not {q})",
)
QUESTIONS = {
    StepKind.SQUARE_ALONE: (
        ("x, y", "(2*x^2 + a*x + b*y + c {} 0)", ("=", "<", "<="), "(y^2 - a*y <= 1)"),
        ("x, y", "(-10^30*x^2 + a*x + y^2 - b*y + c {} 0)", ("=", ">", ">="), "(y - b*y^2 = 0)"),
    ),
    StepKind.CUBIC_INTERVAL: (
        ("x", "(a*x^3 + b*x^2 + c*x + d {} 0)", ("<", "<=", ">", ">="), "(x >= 0 and x <= 1)"),
        ("x", "(x^3 + a*x^2 + b*x + c {} 0)", ("<", ">"), "(3*x > -2)"),
    ),
    StepKind.QUADRICS: (
        ("x, y", "(a*x^2 + 2*y^2 + b*x*y + c*x - y - d {} 0)", (">",), "((x - a)^2 + y^2 <= b)"),
        ("x, y", "(x^2 + a*y^2 + b*x - c {} 0)", (">",), "(2*x^2 + (b^2 + 1)*(y - a)^2 = c)"),
    ),
}
NUMBERS = (0, 0, 1, -1, 2, -3, Fraction(1, 2), Fraction(-5, 4), Fraction(10) ** 30, -(Fraction(10) ** -30))


def zeros(formula: Formula, names: Sequence[str], rng: random.Random) -> dict[str, Fraction]:
    """Numbers, and where one of the polynomials is linear in a name, the number at which it vanishes."""
    found = {name: Fraction(rng.choice(NUMBERS)) for name in names}
    linear = [(p, n) for p in polynomials(formula) for n in names if p.degree(p.ring.index[n]) == 1]
    for poly, name in rng.sample(linear, min(len(linear), 1)):
        if {poly.ring.names[i] for i in poly.variables} <= set(names):
            at = [found.get(n, 0) for n in poly.ring.names]
            rest, slope = (c.evaluate(at) for c in poly.coefficients(poly.ring.index[name]))
            found[name] = -Fraction(rest) / Fraction(slope) if slope else found[name]
    return found


def truth(formula: Formula, values: dict[str, Fraction]) -> bool | None:
    left = substituted(formula, values)
    return left.value if isinstance(left, Constant) else qe.decide(left, method="cad", process=False)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("kind", QUESTIONS)
def test_at_numbers_nothing_changes(kind: StepKind, form: str) -> None:
    rng = random.Random(form)
    for variables, first, relations, second in QUESTIONS[kind]:
        question = read_formula(form.format(v=variables, p=first.format(rng.choice(relations)), q=second))
        log = RunLog()
        prepare(question, enabled={kind, StepKind.SIMPLIFY}, log=log)
        (step,) = (s for s in log.steps() if s.rule == kind.value)
        assert accepted(step)
        for _ in range(4):
            values = zeros(step.after, question.free, rng)
            assert truth(step.before, values) is truth(step.after, values), values
