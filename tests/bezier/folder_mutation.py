"""Altering the files that ``bezier plan`` writes, one entry at a time, and asking ``bezier check`` about each.

Every leaf of every JSON file and every cell of every table of numbers is altered once, every element of a list and
every entry of an object is dropped once. Numbers change in their last digit, the hardest change to notice.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from bezier.check import recheck
from bezier.input import stored
from bezier.planner import command
from bezier.problem import load_problem, to_json
from qe.errors import CertificateRejected, InputError
from tests.certificates.mutation import leaves

EXAMPLES = (
    "cubic_hemisphere",
    "cubic_joins",
    "hemisphere_gap",
    "no_control_point",
    "obstacle_box",
    "obstacle_motion",
    "single",
    "single_dip",
    "single_leaves",
    "three_balls",
    "tight_radius",
)
_NUMBER = re.compile(r"-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?(/[0-9]+)?")
READ_BY_RESTORE = ("problem", "cuts", "closed", "piecewise", "attempts")


class Quiet:
    """A channel that nobody listens to."""

    def event(self, event: object) -> None:
        """Ignored."""

    def fact(self, name: str, value: object) -> None:
        """Ignored."""


def planned(problem: Path, folder: Path) -> Path:
    """The folder with all files of a plan, without pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    command.plan(Quiet(), load_problem(problem), folder, folder, plots=False)
    return folder


def rejection(folder: Path) -> str | None:
    """The one line that refuses the folder, None when it is accepted. No other error may come."""
    try:
        recheck.recheck(Quiet(), folder)
    except (CertificateRejected, InputError) as error:
        return str(error)
    return None


# --- alterations ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Alteration:
    """``place``: of the entry in ``file``; ``write``: the whole altered file; ``names``: one that a refusal says."""

    file: str
    place: str
    write: Callable[[], str]
    names: tuple[str, ...]

    def is_named_in(self, message: str) -> bool:
        """Whether a refusal tells the file and the entry, or the one around it."""
        return self.file in message and any(name in message for name in self.names)


def other(value: Any) -> Any:
    """Another value, as close as it gets."""
    match value:
        case None:
            return "0"
        case bool():
            return not value
        case int() | float():
            return value + 1
        case "":
            return "0"
    if _NUMBER.fullmatch(value):
        digits = value[:-1] + str((int(value[-1]) + 1) % 10)
        return digits if not digits.endswith("/0") else value[:-1] + "7"
    return value[:-1] + ("x" if value[-1] != "x" else "y")


def alterations(file: Path) -> Iterator[Alteration]:
    """Every entry of the file altered once, every element dropped once."""
    text = file.read_text(encoding="utf-8")
    return _of_json(file.name, json.loads(text)) if file.suffix == ".json" else _of_rows(file.name, text)


def _of_json(name: str, whole: Any) -> Iterator[Alteration]:
    for path, value in leaves(whole):
        yield _changed(name, whole, path, other(value), drop=False)
    for path in _elements(whole):
        yield _changed(name, whole, path, None, drop=True)


def _elements(node: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    for key, value in node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ():
        yield (*path, key)
        yield from _elements(value, (*path, key))


def _changed(name: str, whole: Any, path: tuple[str | int, ...], value: Any, *, drop: bool) -> Alteration:
    place = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).removeprefix(".")
    names = ("certificate.json",) if name == "certificate.json" else tuple(str(k) for k in path if isinstance(k, str))
    return Alteration(
        name, ("without " if drop else "") + place, lambda: _written(whole, path, value, drop=drop), names
    )


def _written(whole: Any, path: tuple[str | int, ...], value: Any, *, drop: bool) -> str:
    """The text with one entry altered or dropped; ``whole`` is as before afterwards."""
    node = whole
    for key in path[:-1]:
        node = node[key]
    kept = dict(node) if isinstance(node, dict) else list(node)
    if drop:
        del node[path[-1]]
    else:
        node[path[-1]] = value
    text = json.dumps(whole, ensure_ascii=False)
    node.clear()
    node.update(kept) if isinstance(node, dict) else node.extend(kept)
    return text


def _of_rows(name: str, text: str) -> Iterator[Alteration]:
    lines = text.split("\n")
    for i, line in enumerate(lines[:-1]):
        yield Alteration(name, f"without line {i + 1}", partial(_joined, lines, i, []), ("line",))
        cells = line.split(",")
        for k, cell in enumerate(cells):
            changed = ",".join([*cells[:k], other(cell), *cells[k + 1 :]])
            yield Alteration(name, f"line {i + 1}, {k}", partial(_joined, lines, i, [changed]), ("line",))


def _joined(lines: list[str], i: int, instead: list[str]) -> str:
    return "\n".join([*lines[:i], *instead, *lines[i + 1 :]])


# --- asking --------------------------------------------------------------------------------------------------------


@dataclass
class Memory:
    """What was computed once about files that did not change: the verdict of a certificate, and the restored plan."""

    verdicts: dict[str, Any] = field(default_factory=dict)
    certificates: dict[str, Any] = field(default_factory=dict)
    plans: dict[str, Any] = field(default_factory=dict)
    texts: dict[int, Any] = field(default_factory=dict)

    def use(self, monkeypatch: Any, *, plans: bool) -> None:
        """Answer from memory what was asked before; ``plans``: also where entries of the summary changed that no
        method reads."""
        read, verify, restore, data = recheck._certificate, recheck.verify, recheck.restored, recheck.data_texts

        def certificate(folder: Path) -> Any:
            text = stored.text(folder / recheck.CERTIFICATE)
            if text not in self.certificates:
                self.certificates = {text: read(folder), **dict(list(self.certificates.items())[:1])}
            return self.certificates[text]

        def verdict(found: Any) -> Any:
            key = str(found.digests)
            if key not in self.verdicts:
                self.verdicts[key] = verify(found)
            return self.verdicts[key]

        def restored(problem: Any, found: Any, stated: Any) -> Any:
            summary = {k: stated.summary.get(k) for k in READ_BY_RESTORE} if plans else stated.summary
            path = stated.path if problem.single is not None or not plans else None  # the other methods read none
            key = json.dumps([found.digests, to_json(problem), summary, path])
            if key not in self.plans:
                self.plans = {key: restore(problem, found, stated), **dict(list(self.plans.items())[:1])}
            return self.plans[key]

        def texts(plan: Any) -> Any:
            if id(plan.certificate) not in self.texts:
                self.texts[id(plan.certificate)] = plan.certificate, data(plan)
            return self.texts[id(plan.certificate)][1]

        monkeypatch.setattr(recheck, "_certificate", certificate)
        monkeypatch.setattr(recheck, "verify", verdict)
        monkeypatch.setattr(recheck, "restored", restored)
        if plans:
            monkeypatch.setattr(recheck, "data_texts", texts)


def refused(folder: Path, alteration: Alteration) -> str | None:
    """The refusal of the folder with this alteration, None when it is accepted; the folder is as before afterwards."""
    file = folder / alteration.file
    before = file.read_bytes()
    file.write_text(alteration.write(), encoding="utf-8")
    try:
        return rejection(folder)
    finally:
        file.write_bytes(before)


def not_certified(folder: Path, alteration: Alteration) -> bool:
    """Whether the altered entry is one that the summary calls not certified."""
    if alteration.file != "summary.json":
        return False
    named = json.loads((folder / "summary.json").read_text())["not_certified"]
    place = alteration.place.removeprefix("without ")
    return any(place == name or place.startswith((f"{name}.", f"{name}[")) for name in named)
