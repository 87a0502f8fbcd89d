"""The same entries as Markdown, for reading in a repository; pictures are files beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from paper_repro.claim import Asked, Claim, Entry, Evidence, Fact, Picture, Table
from paper_repro.page import PAPER, by_section, certificate_name, counted, picture_name


def render(entries: Sequence[Entry], made: str) -> str:
    """The whole text."""
    counts = ", ".join(f"{n} {verdict.value}" for verdict, n in counted(entries).items())
    lines = ["# The paper, claim by claim", "", PAPER, "", f"{len(entries)} entries: {counts}.", ""]
    lines += summary([e.claim for e in entries])
    for heading, members in by_section(entries).items():
        lines += ["", f"## {heading}"]
        for entry in members:
            lines += _entry(entry)
    return "\n".join([*lines, "", made, ""])


def summary(claims: Sequence[Claim]) -> list[str]:
    """The claims with their verdicts as the lines of a table."""
    rows = [f"| `{c.key}` | {c.place} | {c.title} | {c.verdict.value} |" for c in claims]
    return ["| key | where | claim | verdict |", "|---|---|---|---|", *rows]


def _entry(entry: Entry) -> list[str]:
    given = entry.claim
    lines = ["", f"### {given.title}", "", f"*{given.place}* · **{entry.verdict.value}**", ""]
    lines += [f"The paper: {given.says}", "", f"Tested: {' '.join(given.test.split())}", "", f"Found: {given.finding}"]
    if given.rests_on:
        lines += ["", f"Rests on: {', '.join(given.rests_on)}"]
    for item in entry.evidence:
        lines += ["", *_evidence(entry, item)]
    return [*lines, "", f"Run again: `python -m paper_repro --only {given.key}`"]


def _evidence(entry: Entry, item: Evidence) -> Iterator[str]:
    match item:
        case Fact(text, holds):
            yield f"- {_mark(holds)} {text}"
        case Asked():
            yield f"- {_mark(item.holds)} {item.text}:"
            yield from ("", "  ```", f"  {item.question}", "  ```", "", f"  $${' '.join(item.answer.split())}$$")
            if item.expected:
                yield f"  found equivalent to `{item.expected}`"
            if item.certificate is not None:
                yield f"  certificate: [{certificate_name(entry, item)}]({certificate_name(entry, item)})"
        case Table(head, rows):
            yield _row(head)
            yield _row(["---"] * len(head))
            yield from map(_row, rows)
        case Picture(caption, _):
            yield f"![{caption}]({picture_name(entry, item)})"


def _mark(holds: bool) -> str:
    return "✓" if holds else "✗"


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
