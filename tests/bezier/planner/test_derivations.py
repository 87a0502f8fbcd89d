"""Derivations of what a plan rests on: those of its own answers, every step checked, about the right questions."""

from __future__ import annotations

from dataclasses import replace

import pytest

import bezier
import qe
from bezier.planner import derivations
from bezier.planner.planning import make_plan
from bezier.plans import Clock, Outcome
from bezier.problem import load_problem
from qe.api.verify import with_derivation
from qe.errors import CertificateRejected
from qe.formula.syntax import FALSE
from qe.proof.certificate import Certificate, Kind

NEAR = {"start": (-4, 1, 1), "via": [(-1, 3, 3), (1, 3, 3)], "goal": ("9/2", 1, 1)}


@pytest.fixture(scope="module")
def plain(root):
    return make_plan(load_problem(root / "examples" / "three_balls.toml"))


@pytest.fixture(scope="module")
def plan(plain):
    return derivations.with_derivations(plain, Clock())


def members(plan):
    return {m.label: m.certificate for m in plan.certificate.payload}


def test_only_who_asks_gets_them(plain):
    assert not plain.derivations and not any(label.startswith(derivations.PREFIX) for label in members(plain))
    assert set(plain.eliminations) == {"formula (8)", "the question of the table"}


def test_each_is_accepted_and_about_its_question(plain, plan):
    assert set(plan.derivations) == set(plain.eliminations) and not plan.unproved
    for name, question in derivations.questions(plan).items():
        if name in plan.derivations:
            certificate = members(plan)[derivations.label(name)]
            assert certificate.kind == Kind.DERIVATION
            assert qe.verify(certificate, formula=question).accepted
    assert members(plain).items() <= members(plan).items()
    assert qe.verify(plan.certificate).accepted


def test_nothing_is_eliminated_a_second_time(plain, plan, monkeypatch):
    def refuse(*_, **__):
        raise AssertionError("eliminated again")

    monkeypatch.setattr("qe.engine.run.answered", refuse)
    monkeypatch.setattr(qe, "eliminate", refuse)
    again = derivations.with_derivations(plain, Clock())
    assert again.certificate.to_json() == plan.certificate.to_json()


def test_another_answer_gets_none(plain):
    answer = plain.eliminations["formula (8)"]
    found = with_derivation(replace(answer, formula=FALSE, certificate=None))
    assert found.certificate is None and found.why_unchecked and found.guarantee is qe.Guarantee.DERIVED
    wrong = replace(plain, eliminations={"formula (8)": replace(answer, formula=FALSE, certificate=None)})
    made = derivations.with_derivations(wrong, Clock())
    assert not made.derivations and set(made.unproved) == {"formula (8)"}


def test_the_pages_have_the_steps_with_their_theorems(plan):
    pages = derivations.pages(plan)
    assert list(pages) == ["derivation_1.html", "derivation_2.html"] == list(plan.derivation_pages.values())
    for name, page in zip(plan.derivations, pages.values(), strict=True):
        assert f"<h1>The elimination of {name}</h1>" in page and "Every step was checked" in page
        assert page.count("<summary>theorem</summary>") >= len(plan.derivations[name].rules)


def test_what_a_folder_states_is_about_this_problem(plain, plan):
    found = derivations.with_stated(plain, plan.certificate)
    assert found.certificate == plan.certificate
    assert {n: d.rules for n, d in found.derivations.items()} == {n: d.rules for n, d in plan.derivations.items()}
    table = members(plan)["derivation of the question of the table"]
    for label, certificate in (
        ("derivation of formula (8)", table),
        ("derivation of formula (9)", table),
        ("derivation of the question of the table", members(plan)["optimum"]),
    ):
        with pytest.raises(CertificateRejected) as caught:
            derivations.with_stated(plain, Certificate.bundle([(label, certificate)]))
        assert caught.value.step == label


def test_what_the_radius_forces_and_obstacles_with_quantifiers():
    wall = {"kind": "formula", "name": "hill", "formula": "ex w. x^2 + y^2 + z^2 + w^2 < 1/4"}
    given = {**NEAR, "via": [(-3, 4, 0), (3, 4, 0)], "start": (-4, 0, 0), "goal": (4, 0, 0)}
    made = bezier.plan(**given, method="cubic", obstacles=[wall], proofs=True)
    names = ["formula (7)", "what the radius forces at Q0", "what the radius forces at R0", "the obstacle hill"]
    assert sorted(made.derivations) == sorted(names) and made.found.outcome is Outcome.SOLVED
    assert made.certified and qe.verify(made.certificate).accepted


def test_flags_only():
    with pytest.raises(qe.InputError, match="proofs"):
        bezier.plan(**NEAR, proofs="yes please")
