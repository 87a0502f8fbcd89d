"""Coverings are checked by separate code: each side condition of the theorem, each entry, and claims that are false."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator

import pytest

import qe
from qe.decomposition import cover
from qe.decomposition.line import Cover
from qe.errors import InternalError, NotWellOriented, Unable
from qe.exact.ring import Poly
from qe.formula.build import exists
from qe.formula.normal import nnf
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Formula, Or
from qe.io import formats
from tests.certificates.coverings import (
    BODIES,
    altered,
    forged,
    interval,
    judged,
    line,
    places,
    projected,
    proof,
    read,
    verdict,
)
from tests.unit.decomposition.test_cover import random_body


@pytest.mark.parametrize("text", BODIES)
def test_coverings_are_accepted(text: str) -> None:
    body = read(text)
    assert verdict(body, proof(body, body.free)) == ""
    assert verdict(body, proof(body, body.free[::-1])) == ""


@pytest.mark.parametrize("seed", range(80))
def test_coverings_of_random_bodies_are_accepted(seed: int) -> None:
    body = random_body(random.Random(seed))
    if body.ring is None or (body.is_quantifier_free and not body.free):
        return
    try:
        given = proof(body, body.free)
    except (NotWellOriented, AssertionError, Unable):
        return
    assert verdict(body, given) == ""


# --- the evidence altered -----------------------------------------------------------------------------
@pytest.mark.parametrize("text", BODIES[:4])
def test_altered_evidence_never_proves_more(text: str) -> None:
    """Rejected, or still a proof of this claim: the same evidence never serves for a body with solutions."""
    body, rng = read(text), random.Random(text)
    given = proof(body, body.free)
    listed = list(places(given))
    satisfiable = [f for f in relaxed(body) if qe.eliminate(exists(f.free, f), process=False).truth]
    rejected = 0
    for path in rng.sample(listed, min(len(listed), 60)):
        changed = altered(given, path, rng)
        rejected += bool(verdict(body, changed))
        for weaker in satisfiable[:3]:
            assert verdict(weaker, changed)
    assert rejected > 30


def relaxed(body: Formula) -> list[Formula]:
    """The body with one of its parts left out, or with one atom negated."""
    if not isinstance(body, And | Or):
        return []
    found: list[Formula] = []
    for k, arg in enumerate(body.args):
        rest = [*body.args[:k], *body.args[k + 1 :]]
        for other in (nnf(arg, negate=True), TRUE):
            parts = tuple(p for p in (*rest, other) if p != TRUE)
            found.append(parts[0] if len(parts) == 1 else type(body)(parts))
    return [f for f in found if isinstance(f, And | Or | Atom) and set(f.free) == set(body.free)]


@pytest.mark.parametrize("seed", range(40))
def test_evidence_for_one_body_proves_no_satisfiable_other(seed: int) -> None:
    body = random_body(random.Random(1000 + seed))
    try:
        given = proof(body, body.free)
    except (NotWellOriented, AssertionError, Unable):
        return
    for other in relaxed(body):
        if verdict(other, given) == "":
            assert qe.eliminate(exists(other.free, other), method="cad", process=False).truth is False


# --- producers that forget a side condition ----------------------------------------------------------
@pytest.mark.parametrize("left_out", ["leading coefficient", "discriminant", "resultant"])
def test_a_projection_without_a_part_is_rejected(left_out: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def project(polys: Iterable[Poly], level: int, operator: object) -> Iterator[Poly]:
        return (p for kind, p in projected(polys, level) if kind != left_out)

    monkeypatch.setattr(cover, "project", project)
    assert any_rejected()


def test_neighbours_without_their_resultant_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cover, "pairwise", lambda intervals: ())
    assert any_rejected()


def test_factors_of_lower_level_that_are_forgotten_are_rejected(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = cover.characterization

    def without(found: Cover) -> object:
        for known in found.intervals:
            object.__setattr__(known, "below", ())  # what the atoms say about the lines below
        return whole(found)

    monkeypatch.setattr(cover, "characterization", without)
    assert any_rejected()


def any_rejected() -> bool:
    """Whether the checker rejects what the producer makes of some of many bodies."""
    bodies = [read(text) for text in BODIES] + [random_body(random.Random(seed)) for seed in range(200, 260)]
    for body in (b for b in bodies if not isinstance(b, Constant)):
        try:
            given = proof(body, body.free)
        except (NotWellOriented, AssertionError, Unable, InternalError):
            continue
        if verdict(body, given):
            return True
    return False


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("ex x, y. x^2 + y^2 < 1 and x*y > 1", TRUE, "follows to be False"),
        ("ex x. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("all x, y. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("ex x. all y. x^2 + y^2 < 1 and x*y > 1", FALSE, "about another formula"),
        ("ex x, y. x^2 + y^2 <= 1 and x*y > 1", FALSE, "about another formula"),
    ],
)
def test_evidence_is_about_one_formula(before: str, after: Formula, message: str) -> None:
    body = read(BODIES[0])
    assert message in judged(formats.read(before, "text"), after, proof(body, body.free))


# --- evidence forged by hand for sentences that are true ----------------------------------------------
def test_an_interval_over_a_root_of_its_factor_is_rejected() -> None:
    body = read("x^2 < 1")
    whole = interval(0, 4, 4, [0, 1])
    assert "contains a root" in forged(body, [["x - 1", "x + 1"]], line([0, 1], ["-2", "0", "2"], [[1], [0]], whole))


@pytest.mark.parametrize(("own", "reason"), [([], "does not follow from the signs"), ([0], "contains a root")])
def test_a_factor_of_lower_level_that_changes_its_sign_says_nothing(own: list[int], reason: str) -> None:
    body = read("x > 0 and y > x")
    above = line([], ["0"], [], interval(0, 0, 0, []))
    first = line([0], ["-1", "1"], [[0]], interval(0, 2, 0, own, above))
    assert reason in forged(body, [["x"], ["-x + y"]], first)


def test_a_factor_that_is_zero_on_a_line_beside_the_sample_is_rejected() -> None:
    """x*z + y has no root over (0, 1), and is zero on the whole line over (0, 0)."""
    body = read("x = 0 and x*z + y = 0")
    top = line([0], ["0"], [], interval(0, 0, 0, [0]))
    middle = line([], ["1"], [], interval(0, 0, 0, [], top))
    parts = (
        interval(0, 0, 0, [0]),
        interval(1, 1, 1, [0], middle),
        interval(2, 2, 2, [0]),
    )
    assert "may vanish identically" in forged(body, [["x"], [], ["x*z + y"]], line([0], ["-1", "1"], [[0]], *parts))
