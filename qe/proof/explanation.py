"""A run in words: numbered steps with their formulas, and between them what was chosen, done and given up."""

from __future__ import annotations

from collections.abc import Iterator

from qe.formula.syntax import TRUE, Formula
from qe.proof.run_log import Choice, Entry, RunLog, Switch, Work
from qe.proof.step import Step

WORDS = {
    "vs": "substitution",
    "cad": "decomposition",
    "critical": "critical values",
}
"""What methods are called in figures."""

LONGEST = 240
"""Characters of a formula that are shown; the derivation has it whole."""


def explained(log: RunLog) -> str:
    """The log as lines of text."""
    lines: list[str] = []
    number = 0
    for entry in log.entries:
        number += isinstance(entry, Step)
        lines += _lines(entry, number)
    if log.seconds is not None:
        lines.append(f"took {log.seconds} s")
    return "\n".join(lines)


def _lines(entry: Entry, number: int) -> Iterator[str]:
    match entry:
        case Choice():
            yield f"planned {entry}"
        case Switch():
            yield f"gave up {entry}"
        case Work(method, figures):
            listed = "; ".join(f"{name} {_plain(value)}" for name, value in figures.items())
            yield f"{WORDS.get(method, method)} {listed}"
        case Step(rule, before, after, context, evidence):
            detail = f" ({evidence['detail']})" if evidence.get("detail") else ""
            yield f"{number}. {rule}{detail}: {_short(before)}"
            where = "" if context == TRUE else f"   (where {_short(context)})"
            yield f"   <==> {_short(after)}{where}"


def _short(formula: Formula) -> str:
    text = str(formula)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def _plain(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value)) or "none"
    return {True: "yes", False: "no"}.get(value, str(value)) if isinstance(value, bool) else str(value)
