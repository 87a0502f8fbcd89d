"""The prompt that ``qe`` opens on a terminal: one question after the other, ``%`` is the last answer.

A line whose brackets are open, or that ends where more has to come, goes on in the next one.
"""

from __future__ import annotations

import atexit
import os
import re
import shlex
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import qe
from qe import arguments
from qe.api.doors import DOORS
from qe.api.settings import Elimination, settings_in
from qe.cli.options import ELSEWHERE, checked
from qe.errors import InputError, QEError, Unable
from qe.exact.number import point_text
from qe.extras import lacking
from qe.spelling import quoted

Ask = Callable[[str], str]

DOORS_LISTED = "\n".join(
    f"  :{f'{door.name} {door.line}':<29}{door.says[0].lower()}{door.says[1:-1]}"
    for door in DOORS.values()
    if door.name != "eliminate"
)
HELP = """A formula is answered by one without quantifiers, a sentence by true or false; % is the last answer.
  ex x. x^2 + b*x + c = 0       what b and c have to fulfil
{doors}
  :plot FILE                    a picture of the last answer (.png, .svg, .pdf; .html in three variables)
  :why                          how the last answer was reached
  :NAME VALUE                   sets an option of qe eliminate for all questions that take it, as in :assuming a > 0,
                                :check on, :method cad or :timeout 5 (off: as without it); now {settings}
  :help   :quit (or Ctrl-D)     Ctrl-C ends a question that takes too long"""

_MORE = re.compile(r"(?:[-+*/^=<>,.:&|]|\\|\b(?:and|or|not|implies|iff|then|else|if|AND|OR|NOT))\s*$")
_COUNT = re.compile(r"(?s)\s*(?:([0-9]{1,6})\s*:)?(.*)")
_NUMBER = re.compile(r"-?[0-9]{1,9}(?:\.[0-9]{1,9})?")
_LAST = re.compile(r"(`(?:[^`\\]|\\.)*`)|%")
OLDER = {word: door.name for door in DOORS.values() for word in (*door.words, *door.also)}
COMMANDS = (*DOORS, *OLDER, "help", "plot", "why")
SETTINGS = {
    name: setting for name, (_, setting) in settings_in(Elimination).items() if name not in ELSEWHERE - {"check"}
}


@dataclass(slots=True)
class Session:
    """What a prompt remembers: the last answer, its text for ``%``, and what has been set."""

    settings: dict[str, Any] = field(default_factory=lambda: {"timeout": 60.0})
    last: Any = None
    text: str = ""

    def reply(self, line: str) -> str:
        """What is printed for a line: an answer, or one line that says what is wrong."""
        try:
            return self._answer(line.strip())
        except Unable as error:
            return f"unable: {error}"
        except QEError as error:
            return f"error: {error}"
        except ImportError as error:
            absent = lacking(error)
            if absent is None:
                raise
            return f"unable: {absent}"

    def _answer(self, line: str) -> str:
        if not line or line.startswith("#"):
            return ""
        if not line.startswith(":"):
            return self._eliminate(self._meant(line))
        name, _, rest = line[1:].partition(" ")
        if (setting := name.replace("-", "_")) in SETTINGS:
            return self._set(setting, rest.strip())
        if name not in COMMANDS:
            near = get_close_matches(name, (*COMMANDS, "quit", *SETTINGS), 1)
            raise InputError(
                f"no such command: :{name}; " + (f"did you mean :{near[0]}?" if near else ":help lists them")
            )
        command: Ask = getattr(self, f"_{OLDER.get(name, name)}")
        return command(self._meant(rest.strip()))

    def _meant(self, text: str) -> str:
        """The text with the last answer in the place of ``%``."""

        def put(match: re.Match[str]) -> str:
            if match[1]:
                return match[1]
            if not self.text:
                raise InputError("% is the last answer, and there is none yet")
            return f"({self.text})"

        return _LAST.sub(put, text)

    def _keep(self, value: Any, text: str) -> str:
        self.last, self.text = value, " ".join(text.split())
        return text

    def _eliminate(self, line: str) -> str:
        return self._answered(qe.eliminate(line, **self.settings))

    def _simplify(self, rest: str) -> str:
        return self._answered(self._asked("simplify", rest))

    def _answered(self, answer: qe.Answer) -> str:
        if answer.formula is None:
            raise Unable(answer.reason)
        lines = [self._keep(answer, str(answer))]
        if answer.generic:
            lines.append(f"assuming {' and '.join(map(str, answer.generic))}")
        if self.settings.get("check"):
            lines.append(answer.why_unchecked or "checked")
        if answer.witness:
            kind = "counterexample" if answer.truth is False else "witness"
            lines.append(f"{kind}: {point_text(answer.witness)}")
        return "\n".join(lines)

    def _decide(self, rest: str) -> str:
        return self._keep(None, str(self._asked("decide", rest)).lower())

    def _solve(self, rest: str) -> str:
        names, colon, formula = rest.partition(":")
        named = bool(colon) and not re.search(r"[=<>.()]|\b(ex|all|exists|forall)\b", names)
        solutions = self._asked("solve", formula if named else rest, names if named else None)
        return self._keep(solutions, str(solutions))

    def _find(self, rest: str) -> str:
        count, formula = _COUNT.fullmatch(rest).groups()  # type: ignore[union-attr]
        if not (points := self._asked("find", formula, int(count or 1))):
            return "there is none"
        return self._keep(None, " or\n".join(point_text(point, " and ") or "true" for point in points))

    def _equivalent(self, rest: str) -> str:
        one, sign, two = rest.partition(";")
        if not sign:
            raise InputError("two formulas with ; between them expected, as in :equivalent x > 0 ; x^3 > 0")
        return self._keep(None, str(self._asked("equivalent", one, two)).lower())

    def _witnesses(self, rest: str) -> str:
        return "\n".join(map(str, self._asked("witnesses", rest))) or "there are none"

    def _verify(self, rest: str) -> str:
        return str(qe.verify(qe.Certificate.from_json(arguments.content(Path(rest), "certificate")[0])))

    def _region(self, rest: str) -> str:
        region = self._asked("region", rest, self.settings.get("order"))
        if region.is_empty:
            return self._keep(region, "false")
        lines = [f"dimension {region.dimension} in {', '.join(map(quoted, region.order))}"]
        lines += [f"{quoted(name)}: {region.bounds(name)!r}".replace("Interval", "") for name in region.order]
        lines += [f"cell: {cell.brief()}" for cell in region.cells]
        self._keep(region, str(region.formula))
        return "\n".join(lines)

    def _maximize(self, rest: str) -> str:
        return self._minimize(rest, "maximize")

    def _optimum(self, rest: str) -> str:
        return f"least: {self._minimize(rest)}\ngreatest: {self._maximize(rest)}"

    def _minimize(self, rest: str, door: str = "minimize") -> str:
        term, _, conditions = rest.partition(":")
        best = self._asked(door, term, conditions.strip() or "true")
        if best.value is None:
            return str(best.status.name.lower())
        at = "not attained" if best.attained is False else point_text(best.point)
        self._keep(None, str(best.value))
        near = "" if best.is_optimal or best.attained is False else f"{best.status.value}: "
        return f"{near}{best.value}  ({at})"

    def _plot(self, rest: str) -> str:
        if self.last is None:
            raise InputError("there is no answer to draw yet")
        words = shlex.split(rest)
        if len(words) != 1:
            raise InputError("the name of a file expected, as in :plot region.png")
        getattr(self.last, "region", self.last).plot(words[0], timeout=self.settings.get("timeout"))
        return f"written: {words[0]}"

    def _why(self, rest: str) -> str:
        if not isinstance(self.last, qe.Answer):
            raise InputError("there is no elimination to explain yet")
        return self.last.explanation

    def _set(self, name: str, rest: str) -> str:
        """Set what all further questions are asked with, or no longer."""
        default = SETTINGS[name].default
        if rest in ("off", "none"):
            self.settings.pop(name, None)
        elif isinstance(default, bool):
            self.settings[name] = True
        else:
            value = float(rest) if _NUMBER.fullmatch(rest) else rest
            whole = isinstance(value, float) and value.is_integer()
            self.settings |= checked({name: int(value) if whole else value}, ":")
        return f"set: {self._all_settings()}"

    def _asked(self, door: str, *given: Any) -> Any:
        """What the function of a door says, with what has been set and it takes."""
        takes = settings_in(DOORS[door].settings)
        return getattr(qe, door)(*given, **{name: value for name, value in self.settings.items() if name in takes})

    def _all_settings(self) -> str:
        return ", ".join(f"{name} {_written(value)}" for name, value in sorted(self.settings.items())) or "nothing"

    def _help(self, rest: str) -> str:
        return HELP.format(doors=DOORS_LISTED, settings=self._all_settings())


def _written(value: object) -> str:
    if isinstance(value, frozenset | tuple):
        return ",".join(sorted(map(_written, value)) if isinstance(value, frozenset) else value)
    return f"{value:g}" if isinstance(value, float) else str(getattr(value, "value", value))


def is_open(text: str) -> bool:
    """Whether more has to come before the text can mean something."""
    bare = re.sub(r"`(?:[^`\\]|\\.)*`|#.*", "", text)
    is_command, opened = bare.lstrip().startswith(":"), any(bare.count(a) > bare.count(b) for a, b in ("()", "[]"))
    return opened or (not is_command and bool(_MORE.search(bare)))


def run(ask: Ask | None = None, put: Callable[[str], None] = print) -> int:
    """Ask and answer until the input ends; exit status 0."""
    session = Session()
    read = ask or _reader()
    if ask is None:
        put(f"qe {qe.__version__}: a formula is answered, :help lists what else there is, Ctrl-D leaves")
    while True:
        try:
            text = read("qe> ")
            while is_open(text):
                text = f"{text.rstrip().removesuffix(chr(92))}\n{read('... ')}"
            if text.strip() in (":quit", ":q", ":exit", "quit", "exit"):
                return 0
            if reply := session.reply(text):
                put(reply)
        except EOFError:
            return 0
        except KeyboardInterrupt:
            put("interrupted")


def _reader() -> Ask:
    """Python's own way to ask, with lines that can be edited and are kept over sessions where the system knows how."""
    with suppress(ImportError, OSError):
        import readline

        place = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state") / "bezier-qe" / "history"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.touch(mode=0o600)
        atexit.register(readline.write_history_file, place)
        if place.stat().st_size:
            readline.read_history_file(place)
    return input
