"""Derivations of the eliminations that a plan rests on: each step with evidence, checked, in the plan's certificate.

The steps are those that led to the engine's answers when the plan was made; nothing is eliminated a second time. In
``certificate.json`` each is a member of its own, of the kind ``derivation``, beside the certificates of the plan.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from bezier.obstacles.obstacle import Obstacle
from bezier.planner import radius_rule
from bezier.planner.table import method_for
from bezier.plans import Clock, Derived, Plan
from qe.api.verify import with_derivation
from qe.certify.claims import is_about
from qe.errors import CertificateRejected
from qe.formula.syntax import Formula
from qe.proof.certificate import Certificate, Kind

CHECKED = "Every step was checked: the evidence is in {0}, and qe check {0} checks it again."
CERTIFICATE = "certificate.json"
PREFIX = "derivation of "
"""How the labels of the members of a bundle begin."""


def with_derivations(plan: Plan, clock: Clock) -> Plan:
    """The plan with the derivations of all its eliminations, in its certificate too, as far as each step is checked."""
    of_radius = {} if plan.radius_rule is None else plan.radius_rule.answers
    result, unproved = proved({**plan.eliminations, **of_radius, **of_obstacles(plan.problem.obstacles)}, clock)
    return replace(_with(plan, result), unproved=unproved)


def proved(answers: Mapping[str, Any], clock: Clock) -> tuple[dict[str, Derived], dict[str, str]]:
    """The derivations of answers by their names, checked; for the others why they are not."""
    result, unproved = {}, {}
    for name, answer in answers.items():
        checked = with_derivation(answer, clock.remaining("derivations"))
        if checked.certificate is None:
            unproved[name] = checked.why_unchecked
        else:
            result[name] = Derived(checked.certificate, answer)
    return result, unproved


def pages(plan: Plan) -> dict[str, str]:
    """The derivations as pages, by the names of their files."""
    files = plan.derivation_pages
    return {files[name]: page(name, item) for name, item in plan.derivations.items() if item.answer is not None}


def page(name: str, item: Derived, file: str = CERTIFICATE, title: str = "") -> str:
    """A derivation as a page; ``file``: where its evidence is; ``title``: of the elimination of what the name says,
    where it has none."""
    heading = title or f"The elimination of {name}"
    result: str = item.answer.derivation.to_html(title=heading, note=CHECKED.format(file))
    return result


def members(derivations: Mapping[str, Derived]) -> list[tuple[str, Certificate]]:
    """The derivations as members of a bundle."""
    return [(PREFIX + name, item.certificate) for name, item in derivations.items()]


def of_obstacles(obstacles: Iterable[Obstacle]) -> dict[str, Any]:
    """The answers that obstacles given by formulas with quantifiers rest on."""
    return {f"the obstacle {o.name}": o.elimination for o in obstacles if o.elimination is not None}


def _with(plan: Plan, derived: Mapping[str, Derived]) -> Plan:
    """The plan with these derivations, in its certificate too."""
    whole = Certificate.bundle([*listed(plan.certificate), *members(derived)])
    return replace(plan, derivations=derived, certificate=whole)


def listed(certificate: Certificate) -> list[tuple[str, Certificate]]:
    """The members of a bundle with their labels; another certificate is the only one."""
    payload = certificate.payload
    return [(m.label, m.certificate) for m in payload] if isinstance(payload, tuple) else [("plan", certificate)]


# --- found again from a folder -------------------------------------------------------------------------------------


def with_stated(plan: Plan, certificate: Certificate) -> Plan:
    """The plan with the derivations that the certificate of its folder has, which are about what this plan asks.

    The derivations themselves are accepted with the certificate. Raises ``CertificateRejected`` for one about another
    question.
    """
    known, result = questions(plan), {}
    for member in certificate.payload if isinstance(certificate.payload, tuple) else ():
        if member.label.startswith(PREFIX):
            name = member.label.removeprefix(PREFIX)
            question, given = known.get(name), member.certificate
            if question is None:
                raise CertificateRejected(member.label, "this problem has no question of this name")
            if given.kind != Kind.DERIVATION or is_about(given, question) is None:
                expected = "expected a derivation that begins with the question of this problem"
                raise CertificateRejected(member.label, expected)
            result[name] = Derived(member.certificate)
    return _with(plan, {name: result[name] for name in known if name in result})  # in the order of planning


def questions(plan: Plan) -> dict[str, Formula]:
    """Everything that may be eliminated for a plan, by name."""
    radius = {name: statement.formula for name, statement in radius_rule.questions(plan.problem).items()}
    obstacles = {name: answer.question for name, answer in of_obstacles(plan.problem.obstacles).items()}
    return {**method_for(plan.problem).questions(plan.problem), **radius, **obstacles}
