"""The primitive "terms": changes of variables, and what is no change of variables."""

from __future__ import annotations

import pytest

from qe.errors import CertificateRejected
from qe.formula.traverse import conjuncts
from qe.kernel.step import Claim
from qe.kernel.terms import terms_goals
from qe.proof.entry import Entry
from qe.proving.lemmas import refuting
from tests.unit.certify.claims import NO_LEMMAS, RING, formula, limits, objection

Terms = dict[str, str | tuple[str, str]]


def rows(terms: Terms) -> list[list[str]]:
    return [[name, *(t if isinstance(t, tuple) else (t, "1"))] for name, t in terms.items()]


def refused(before: str, after: str, there: Terms, back: Terms) -> str:
    """Why the step is rejected, with all lemmas that the prover finds for what it has to show; nothing if it is not."""
    evidence = {"there": rows(there), "back": rows(back), "theory": NO_LEMMAS}
    claim = Claim("terms", formula(before), formula(after), RING, Entry(evidence, "evidence"), "step")
    try:
        goals = terms_goals(claim, ())
    except CertificateRejected as error:
        return str(error)
    return objection("terms", before, after, {**evidence, "theory": refuting(goals, RING, limits()) or NO_LEMMAS})


ACCEPTED: dict[str, tuple[str, str, Terms, Terms]] = {
    "translation": ("ex x, y. x - y > 1", "ex y. -y > 1", {"x": "0"}, {"y": "-x + y"}),
    "shear": ("ex x, y. x + y > a and x > 0", "ex x, y. x > a and x - y > 0", {"x": "x - y"}, {"x": "x + y"}),
    "stretched": ("ex x. a*x > 1 and a /= 0", "ex x. x > 1 and a /= 0", {"x": ("x", "a")}, {"x": "a*x"}),
    "other names": ("ex x. x^2 = a", "ex y. y^2 = a", {"x": "y"}, {"y": "x"}),
    "a number": ("ex x. x^2 = 4", "true", {"x": "2"}, {}),
    "for all": ("all x, y. x - y <= 1", "all y. -y <= 1", {"x": "0"}, {"y": "-x + y"}),
}

REJECTED: dict[str, tuple[str, str, Terms, Terms]] = {
    "not invariant": ("ex x, y. x - y > 1 and x > 3", "ex y. -y > 1", {"x": "0"}, {"y": "-x + y"}),
    "denominator may vanish": ("ex x. a*x > 1 or b = 0", "ex x. x > 1 or b = 0", {"x": ("x", "a")}, {"x": "a*x"}),
    "sign of the denominator": ("ex x. x > b and a /= 0", "ex x. x > a*b and a /= 0", {"x": ("x", "a")}, {"x": "a*x"}),
    "sign of a quotient": ("ex x. x > 0 and a*x = b and b > 0", "b > 0 and a /= 0", {"x": ("b", "a")}, {}),
    "not onto": ("ex x. x = a", "ex x. x^2 = a", {"x": "x^2"}, {"x": "x"}),
    "the variable is free outside": ("ex x. x = y", "ex y. y = y + 1 - 1", {"x": "y"}, {"y": "x"}),
    "bound on one side, free on the other": ("ex x. x = y", "x = y", {"x": "y"}, {}),
    "denominator 0": ("ex x. x = 5 and x^3 = 3", "true", {"x": ("1", "0")}, {}),
    "captured inside": ("ex x. (ex y. x^2 - y = 1)", "ex z. (ex y. z^2 - y = 1)", {"x": "y"}, {"z": "x"}),
    "a variable without a term": ("ex x, y. x > y", "ex z. z > 0", {"x": "z"}, {"z": "x - y"}),
}


@pytest.mark.parametrize("name", ACCEPTED)
def test_a_change_of_variables_is_accepted(name: str) -> None:
    assert not refused(*ACCEPTED[name])


@pytest.mark.parametrize("name", REJECTED)
def test_what_is_no_change_of_variables_is_rejected(name: str) -> None:
    assert refused(*REJECTED[name])


def under(before: str, after: str, there: Terms, back: Terms, given: str) -> str:
    """As ``refused``, where something is known."""
    evidence = {"there": rows(there), "back": rows(back), "theory": NO_LEMMAS}
    claim = Claim("terms", formula(before), formula(after), RING, Entry(evidence, "evidence"), "step")
    goals = terms_goals(claim, tuple(conjuncts(formula(given))))
    found = {**evidence, "theory": refuting(goals, RING, limits()) or NO_LEMMAS}
    return objection("terms", before, after, found, given=given)


NESTED = "ex x. x > b and (ex z. x - z > 0 and z > c)", "ex y. a*y > b and (ex z. a*y - z > 0 and z > c)"
ALONG: tuple[Terms, Terms] = {"x": "a*y"}, {"y": ("x", "a")}


def test_squares_of_denominators_go_below_quantifiers_too() -> None:
    """What a quantifier binds inside is compared as it stands: a^2*x - a^2*z was not x - z."""
    assert not under(*NESTED, *ALONG, "a > 0") and not under(*NESTED, *ALONG, "a /= 0")
    assert under(*NESTED, *ALONG, "a >= 0")


@pytest.mark.parametrize("given", ["a /= 0", "a < 0"])
def test_of_an_odd_power_its_sign_stays(given: str) -> None:
    """For a < 0 and b > 0 the left side holds and the right one does not."""
    assert under("ex x. x = b and x > 0", "ex y. a*y = b and y > 0", *ALONG, given)


@pytest.mark.parametrize("given", ["a >= 0", "a <= 0", "b > 0"])
def test_what_may_be_zero_is_not_divided_out(given: str) -> None:
    """At a = 0 the left side holds for b > 0, the right one never."""
    assert under("ex x. x = b and x > 0", "ex y. y = b and a^2*y > 0", {"x": "y"}, {"y": "x"}, given)
    assert not under("ex x. x = b and x > 0", "ex y. y = b and a^2*y > 0", {"x": "y"}, {"y": "x"}, "a > 0")
