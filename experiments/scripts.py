"""Scripts of SMT-LIB through ``qe smt``, whole: ``experiments scripts FOLDER``.

What is known of a script is its ``:status``, else what ``index.jsonl`` beside it says (``status`` or ``z3``).
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

VERDICTS = ("sat", "unsat", "unknown")
GRACE = 10.0
"""Seconds beyond the limit until a run is ended from outside."""


@dataclass(frozen=True, slots=True)
class Ran:
    """One script: what was answered to its last check (the last line where nothing was), what is known, seconds."""

    name: str
    answer: str
    known: str | None
    seconds: float

    @property
    def decided(self) -> bool:
        """Whether there is a verdict."""
        return self.answer in ("sat", "unsat")

    @property
    def wrong(self) -> bool:
        """Whether it contradicts what is known."""
        return self.decided and self.known is not None and self.known != self.answer

    def __str__(self) -> str:
        word = "WRONG" if self.wrong else ""
        return f"{self.answer[:40]:8} {self.seconds:7.2f} s  {self.name}  {word}".rstrip()


def known_answers(folder: Path) -> dict[str, str]:
    """What is known of each script of a folder: sat or unsat."""
    found = {}
    index = folder / "index.jsonl"
    lines = index.read_text().splitlines() if index.is_file() else []
    listed = {row["file"]: row for row in map(json.loads, filter(str.strip, lines))}
    for path in sorted(folder.glob("*.smt2")):
        row = listed.get(path.name, {})
        words = [*re.findall(r":status\s+(\w+)", path.read_text())[-1:], row.get("status"), row.get("z3")]
        known = next((word for word in words if word in ("sat", "unsat")), None)
        if known is not None:
            found[path.name] = known
    return found


def runs(folder: Path, limit: float, memory: int, only: str = "") -> Iterator[Ran]:
    """Every script, one after the other."""
    known = known_answers(folder)
    for path in sorted(folder.glob("*.smt2")):
        if only in path.name:
            start = time.perf_counter()
            answer = _answer(path, limit, memory)
            yield Ran(path.name, answer, known.get(path.name), time.perf_counter() - start)


def _answer(path: Path, limit: float, memory: int) -> str:
    command = [sys.executable, "-m", "qe", "smt", str(path), "--timeout", str(limit), "--memory", str(memory)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit + GRACE, check=False)
    except subprocess.TimeoutExpired:
        return "unknown"
    lines = done.stdout.split("\n")
    return next(
        (line for line in reversed(lines) if line in VERDICTS), (done.stderr or done.stdout).strip() or "nothing"
    )


def lines(ran: list[Ran], limit: float) -> Iterator[str]:
    """The count."""
    words = Counter("wrong" if r.wrong else "decided" if r.decided else "open" for r in ran)
    others = f"{words['wrong']} wrong, {words['open']} open"
    yield f"{words['decided']} of {len(ran)} scripts decided in {limit:g} s, {others}"
