"""What the plain reader and the kernel on FLINT say about the same certificates."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from qe.certify.verify import verify_json
from qe.options import Budget

SECONDS, TOGETHER = 60, 1000


def plain_verdicts(reader: Path, texts: Sequence[str], folder: Path) -> list[dict[str, Any]]:
    """What the reader alone says, in interpreters that see the standard library only."""
    names = [folder / f"{k}.json" for k in range(len(texts))]
    for name, text in zip(names, texts, strict=True):
        name.write_text(text, encoding="utf-8")
    command = [sys.executable, "-I", "-S", str(reader), "--json", "--timeout", str(SECONDS)]
    lines: list[str] = []
    for start in range(0, len(names), TOGETHER):
        given = [*command, *map(str, names[start : start + TOGETHER])]
        lines += subprocess.run(given, stdout=subprocess.PIPE, encoding="utf-8", check=False).stdout.splitlines()
    return list(map(json.loads, lines))


def compared(reader: Path, texts: Sequence[str], folder: Path) -> list[str]:
    """The verdicts that both give; fails where they differ, in the entry or the reason too."""
    found = []
    for text, plainly in zip(texts, plain_verdicts(reader, texts, folder), strict=True):
        verdict = asdict(verify_json(text, Budget(SECONDS), core=True))
        assert verdict == plainly, text[:2000]
        found.append("accepted" if verdict["accepted"] else "rejected" if verdict["decided"] else "undecided")
    return found
