"""The authors' published data on the EV3 arm, where they lie beside the project; nothing of them is part of it.

Sources: github.com/teamsnactsukuba/ev3-cgs-qe-ik (arXiv 2111.00384) and ev3-cgs-qe-ik-2 (arXiv 2305.12451), licence
BSD-2-Clause.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parents[2] / "shared" / "corpora" / "ev3"


def rows(name: str, folder: Path = FOLDER) -> list[dict[str, Any]]:
    """The records of ``name.jsonl``; none where the file is absent."""
    file = folder / f"{name}.jsonl"
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.is_file() else []


def segments(name: str, folder: Path = FOLDER) -> list[dict[str, Any]]:
    """A published comprehensive Gröbner system: where all of "Z" and not all of "N" vanish; none if it is absent."""
    file = folder / f"{name}.json"
    found: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))["segments"] if file.is_file() else []
    return found
