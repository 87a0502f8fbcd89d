"""What a command is asked, where its formula comes from (the argument itself, a file, or standard input), its reply."""

from __future__ import annotations

import json
import os
import re
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qe.arguments import MOST_BYTES, content
from qe.errors import InputError, Unable
from qe.io import formats
from qe.io.formats import BY_ENDING, Format

if TYPE_CHECKING:
    from qe.formula.syntax import Formula
    from qe.processes.channel import Channel

_FILE_LIKE = re.compile(rf"[^\s<>=]+({'|'.join(map(re.escape, BY_ENDING))})")


class ProofFormat(Enum):
    """Proof assistants for which certificates are written."""

    COQ = "coq"


@dataclass(frozen=True, slots=True)
class Source:
    """A text to read, its format, and the name to give in messages."""

    text: str
    format: Format
    name: str
    total_division: bool = False


@dataclass(frozen=True, slots=True)
class Reply:
    """``text`` for stdout, ``notes`` for stderr, the content of each asked-for file, the exit ``code``;
    ``verdict``: for stderr, what a check has shown."""

    text: str
    notes: tuple[str, ...] = ()
    files: Mapping[str, str | bytes] = field(default_factory=dict)
    code: int = 0
    verdict: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What the command line requests."""

    source: Source
    settings: Mapping[str, Any] = field(default_factory=dict)
    certificate: bool = False
    json: bool = False
    check: bool = False
    explain: bool = False
    start: float = field(default_factory=time.perf_counter)

    @property
    def seconds(self) -> float:
        """How long ago it was made."""
        return round(time.perf_counter() - self.start, 6)

    def data(self, **answer: Any) -> dict[str, Any]:
        """An answer for machines."""
        return {"status": "solved", **answer, "seconds": self.seconds}

    def read(self, channel: Channel, *terms: str, listed: Sequence[str] = (), solved: Sequence[str] = ()) -> Any:
        """The formula of the source, to be ``solved`` for these; the keywords for a call of the public functions about
        it, with what it assumes; and ``terms`` of the same problem, whose variables may be ``listed``."""
        from qe.api.input import of_one_problem, order_of

        source, given = self.source, dict(self.settings)
        if source.format is Format.TEXT:
            names, assuming = (*solved, *listed, *(given.get("order") or ())), given.get("assuming")
            text, assuming, *terms = of_one_problem(source.text, assuming, *terms, listed=names)  # type: ignore[assignment]
            source, given["assuming"] = replace(source, text=text), assuming
        formula, known = read_question(channel, source, solved=solved)
        if "order" in given:
            given["order"] = order_of(given["order"], source.text, formula)
        if known.free:
            given["assuming"] = [known] if given.get("assuming") is None else [known, given["assuming"]]
        return formula, {**given, "progress": channel.event, "check": self.certificate or self.check}, *terms

    def verdict(self, answer: Any) -> str:
        """What the check that was wanted has shown."""
        if not self.check:
            return ""
        reason = getattr(answer, "why_unchecked", getattr(answer, "reason", ""))
        return "checked" if answer.guarantee.value == "checked" else f"not checked: {reason}"

    def reply(
        self, answer: Any, text: str, data: Mapping[str, Any], *, notes: tuple[str, ...] = (), **files: str | bytes
    ) -> Reply:
        """An answer as text, or as JSON where that is wanted, with its certificate and what a check has shown."""
        if self.certificate:
            files["certificate"] = certificate_text(answer)
        shown = in_json(data) if self.json else text
        return Reply(shown, notes, files, verdict=self.verdict(answer))


def read_question(channel: Channel, source: Source, *, solved: Sequence[str] = ()) -> tuple[Formula, Formula]:
    """The formula of a source, to be ``solved`` for these, and what it assumes; the channel is told of its size."""
    from qe.api.input import note_doubts
    from qe.formula.traverse import atoms, bound_variables

    read = formats.read_posed
    formula, known = read(source.text, source.format.value, source=source.name, total_division=source.total_division)
    note_doubts(source.text, formula, source.format.value, solved)
    bound, polys = bound_variables(formula), [part.poly for part in atoms(formula)]
    channel.fact(
        "formula",
        f"{len(polys)} atoms of degree up to {max((p.total_degree for p in polys), default=0)} in "
        f"{len(formula.free) + len(bound)} variables, {len(bound)} of them quantified",
    )
    return formula, known


def called(module: str, function: str, channel: Channel, **given: Any) -> Any:
    """The work of a command, in a module that is loaded by the process which does it."""
    return getattr(import_module(module), function)(channel, **given)


def in_json(data: Mapping[str, Any]) -> str:
    """Data as commands print it."""
    return json.dumps(data, indent=2, ensure_ascii=False)


def certificate_text(answer: object) -> str:
    """The JSON of an answer's certificate; ``Unable`` where there is none."""
    certificate = getattr(answer, "certificate", None)
    if certificate is None:
        raise Unable("there is no certificate for this kind of answer")
    return str(certificate.to_json())


def read_source(argument: str, wanted: Format | None) -> Source:
    """The text behind a command-line argument: ``-`` is standard input, an existing file is read, else the text.
    Without a wanted format a file's ending decides. Raises ``InputError`` for a file that cannot be read."""
    if argument == "-":
        try:
            given = sys.stdin.read(MOST_BYTES + 1)
        except UnicodeDecodeError:
            raise InputError("<stdin>: UTF-8 text expected, other bytes found") from None
        if len(given) > MOST_BYTES:
            raise InputError(f"<stdin>: at most {MOST_BYTES:,} characters expected, more found")
        return Source(given.removeprefix("\ufeff"), wanted or Format.TEXT, "<stdin>")
    if is_file(path := Path(argument)):
        text, ending = content(path, "file")
        return Source(text, wanted or BY_ENDING.get(ending, Format.TEXT), argument)
    if _FILE_LIKE.fullmatch(argument.strip()):
        raise InputError(f"{argument}: no such file")
    return Source(argument, wanted or Format.TEXT, "<argument>")


def no_file(name: str) -> InputError:
    """The error for a name at which there is no file to read."""
    return InputError(f"{name}: {'a file expected, a folder found' if os.path.isdir(name) else 'no such file'}")


def is_file(path: Path) -> bool:
    """Whether the path names something to read; text that is no possible path is not one."""
    return os.path.exists(path) and not os.path.isdir(path)
