"""Every claim's check bears out the verdict that is stated for it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import pytest

from paper_repro import tex
from paper_repro.claim import Claim, Evidence, Fact, Picture, Verdict, claim, examine, examine_all
from paper_repro.claims import CLAIMS
from tests.tables import each

KEYS = [c.key for c in CLAIMS]


@each(*(pytest.param(given, id=given.key) for given in CLAIMS), daily=3)
def test_the_check_bears_out_the_verdict(given: Claim) -> None:
    entry = examine(given)
    assert not entry.failures
    assert entry.verdict is given.verdict
    assert entry.evidence or given.rests_on or given.verdict is Verdict.NOT_TESTABLE
    for item in entry.evidence:
        if isinstance(item, Picture):
            root = ElementTree.fromstring(item.svg)
            assert root.tag.endswith("svg")
            assert "nan" not in item.svg
            assert len(list(root.iter())) > 30, "a picture shows something"


@pytest.mark.parametrize("given", CLAIMS, ids=KEYS)
def test_what_a_claim_says(given: Claim) -> None:
    for text in (given.title, given.says, given.finding, given.test):
        assert text.strip()
        assert text.count("$") % 2 == 0
        tex.inline(text)
    assert set(given.rests_on) <= set(KEYS)
    assert given.verdict is not Verdict.FAILED
    assert given.code.startswith("def ")
    assert '"""' not in given.code.splitlines()[1]


def test_keys_are_unique_and_fit_file_names() -> None:
    assert len(set(KEYS)) == len(KEYS)
    assert all(re.fullmatch(r"[a-z0-9-]+", key) for key in KEYS)


@pytest.mark.parametrize(
    "place",
    [
        *("Definition 1", "Figure 1", "Figure 2", "Figure 3", "Figure 4", "(1)", "(2)", "(3)", "(4)", "(5)", "(6)"),
        *("(7)", "(8)", "Section 1", "Section 2", "Section 3", "Section 4.1", "Section 4.2", "Section 5", "Abstract"),
    ],
)
def test_everything_numbered_in_the_paper_has_an_entry(place: str) -> None:
    assert any(place in c.place for c in CLAIMS)


def test_every_verdict_occurs() -> None:
    assert {c.verdict for c in CLAIMS} == set(Verdict) - {Verdict.FAILED}


def stated(key: str, holds: bool, rests_on: tuple[str, ...] = ()) -> Claim:
    @claim(
        key=key,
        place="Section 1",
        title="t",
        says="s",
        verdict=Verdict.REPRODUCED,
        finding="f",
        rests_on=rests_on,
    )
    def check() -> Iterator[Evidence]:
        """How."""
        yield Fact("one is one", True)
        yield Fact("the statement", holds)

    return check


def test_a_claim_that_is_not_borne_out_fails() -> None:
    assert examine(stated("good", True)).verdict is Verdict.REPRODUCED
    entry = examine(stated("bad", False))
    assert entry.verdict is Verdict.FAILED
    assert entry.failures == ("the statement",)


def test_a_claim_fails_with_what_it_rests_on() -> None:
    entries = examine_all([stated("bad", False), stated("other", True), stated("last", True, ("bad", "other"))])
    assert [e.verdict for e in entries] == [Verdict.FAILED, Verdict.REPRODUCED, Verdict.FAILED]
    assert "bad" in entries[2].failures[0]


def test_a_claim_fails_with_one_that_comes_later() -> None:
    told: list[str] = []
    entries = examine_all(
        [stated("first", True, ("bad",)), stated("bad", False), stated("last", True, ("first",))],
        lambda entry: told.append(entry.claim.key),
    )
    assert [(e.claim.key, e.verdict) for e in entries] == [(k, Verdict.FAILED) for k in ("first", "bad", "last")]
    assert told == ["bad", "first", "last"]
