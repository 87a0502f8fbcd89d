"""A claim of the paper as data, with the check beside it, and what the check brings to light."""

from __future__ import annotations

import ast
import inspect
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from textwrap import dedent

from qe import Certificate


class Verdict(Enum):
    """What became of a claim. SOLVED: the paper says that it did not get there, and the evidence does. FAILED is never
    stated: it is what a claim gets when its check does not bear it out.
    """

    REPRODUCED = "reproduced"
    CORRECTED = "reproduced with a correction"
    SOLVED = "solved here"
    DIFFERS = "differs"
    NOT_TESTABLE = "not testable"
    FAILED = "the check failed"


@dataclass(frozen=True, slots=True)
class Fact:
    """A statement that was checked exactly. Texts may hold LaTeX between dollar signs."""

    text: str
    holds: bool


@dataclass(frozen=True, slots=True)
class Asked:
    """A question put to the engine. ``answer``: LaTeX; ``holds``: the answer is the expected one and its certificate,
    if there is one, was accepted by the separate checker; ``expected``: the formula to which it was found equivalent;
    ``seconds``: elapsed time.
    """

    text: str
    question: str
    answer: str
    holds: bool
    seconds: float
    certificate: Certificate | None = None
    expected: str = ""

    @property
    def is_short(self) -> bool:
        """Whether the answer is a word or a few, such as "true"."""
        return self.answer.startswith(r"\text")


@dataclass(frozen=True, slots=True)
class Table:
    """Computed numbers."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclass(frozen=True, slots=True)
class Picture:
    """A drawing from computed data, as one SVG element."""

    caption: str
    svg: str


Evidence = Fact | Asked | Table | Picture
Check = Callable[[], Iterator[Evidence]]


@dataclass(frozen=True, slots=True)
class Claim:
    """``place``: section and number in the paper; ``says``: the paper's statement in our words; ``finding``: what came
    out; ``verdict``: what the evidence of ``check`` must bear out. The docstring of ``check`` says how it was tested.
    ``rests_on``: keys of claims whose evidence is used too.
    """

    key: str
    place: str
    title: str
    says: str
    verdict: Verdict
    finding: str
    check: Check
    rests_on: tuple[str, ...] = ()

    @property
    def test(self) -> str:
        """How the claim was tested."""
        return inspect.getdoc(self.check) or ""

    @property
    def code(self) -> str:
        """The source of the check, without the data above it and the docstring."""
        lines = dedent(inspect.getsource(self.check)).splitlines()
        function = ast.parse("\n".join(lines)).body[0]
        assert isinstance(function, ast.FunctionDef)
        described = function.body[0]
        return "\n".join((*lines[function.lineno - 1 : described.lineno - 1], *lines[described.end_lineno :]))


def claim(
    *,
    key: str,
    place: str,
    title: str,
    says: str,
    verdict: Verdict,
    finding: str,
    rests_on: tuple[str, ...] = (),
) -> Callable[[Check], Claim]:
    """Make a claim of the check that follows."""
    return lambda check: Claim(key, place, title, says, verdict, finding, check, rests_on)


@dataclass(frozen=True, slots=True)
class Entry:
    """A claim with its evidence."""

    claim: Claim
    evidence: tuple[Evidence, ...]
    seconds: float

    @property
    def failures(self) -> tuple[str, ...]:
        """The statements that were not borne out."""
        return tuple(item.text for item in self.evidence if isinstance(item, Fact | Asked) and not item.holds)

    @property
    def verdict(self) -> Verdict:
        """The stated verdict if everything was borne out, FAILED otherwise."""
        return Verdict.FAILED if self.failures else self.claim.verdict


def examine(given: Claim) -> Entry:
    """Run the check of one claim."""
    start = time.perf_counter()
    evidence = tuple(given.check())
    return Entry(given, evidence, time.perf_counter() - start)


def examine_all(claims: Iterable[Claim], tell: Callable[[Entry], None] = lambda entry: None) -> tuple[Entry, ...]:
    """Run all checks in order, but what a claim rests on, and fails with, before it; each entry is told as it comes."""
    known, done = {given.key: given for given in claims}, dict[str, Entry]()

    def run(given: Claim) -> None:
        for key in given.rests_on:
            if key in known and key not in done:
                run(known[key])
        entry = examine(given)
        broken = [key for key in given.rests_on if key in done and done[key].verdict is Verdict.FAILED]
        facts = tuple(Fact(f"rests on {key}, whose check failed", False) for key in broken)
        done[given.key] = replace(entry, evidence=entry.evidence + facts)
        tell(done[given.key])

    for given in known.values():
        if given.key not in done:
            run(given)
    return tuple(done[key] for key in known)
