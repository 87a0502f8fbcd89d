"""The border between commands and the shell: exit status, one-line errors, progress, files.

Exit status: 0 answered, 2 bad input, 3 unable within the limits, 4 certificate rejected, 1 a bug; 130 interrupted by
Ctrl-C, 143 by SIGTERM, both after what was half written has been taken away.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from copy import copy
from difflib import get_close_matches
from functools import partial
from itertools import takewhile
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, TextIO, TypeVar

from qe.cli.source import in_json
from qe.cli.values import take_leading_minus, take_plain_values
from qe.errors import CertificateRejected, DoubtfulInput, InputError, QEError, Unable, restored
from qe.extras import lacking
from qe.progress import Event

if TYPE_CHECKING:
    import typer

    from qe.processes.channel import Channel

T = TypeVar("T")

OK, BUG, BAD_INPUT, UNABLE, REJECTED, INTERRUPTED, TERMINATED = 0, 1, 2, 3, 4, 130, 143

_PREFIX = {
    "unable": "unable: ",
    "rejected": "certificate rejected: ",
    "internal_error": "internal error, please report: ",
}
"""What an error's line begins with, by its status."""

DISPLAY_AFTER = 0.4
"""Seconds before a progress display appears: quick answers stay quiet."""
NOTE = "note"
"""The fact under which a worker tells what may have been meant otherwise."""
LINES_APART = 2.0
"""Seconds between two lines of progress where there is no terminal."""


def enter(app: typer.Typer, argv: Sequence[str] | None, *, name: str) -> int:
    """Run a command line; the exit status, as ``guarded`` has it."""
    from typer import Abort, TyperException
    from typer.main import get_command

    words = sys.argv[1:] if argv is None else argv

    def main() -> int:
        command = _asked(app, words)
        take_plain_values(command)
        take_leading_minus(command)
        if misspelt := _misspelt(command, words) and _misspelt(get_command(app), words):
            raise InputError(f"{misspelt} (see {name} --help)")
        try:
            code = command.main(args=None if argv is None else list(argv), prog_name=name, standalone_mode=False)
        except TyperException as error:
            message = error.format_message().replace("Value error, ", "").rstrip(".")
            raise InputError(f"{message} (see {name} --help)") from None
        except Abort:
            raise KeyboardInterrupt from None
        if code == INTERRUPTED:  # typer has taken the interrupt for itself
            raise KeyboardInterrupt
        return int(code or OK)

    return guarded(main, words, name=name)


def guarded(main: Callable[[], int], words: Sequence[str], *, name: str) -> int:
    """The exit status of a command that was called with these words. Errors become exactly one line on stderr, with
    ``--json`` one object on stdout, too."""
    sys.excepthook = _one_line_hook(name)
    sys.set_int_max_str_digits(0)  # the limits on input hold long numbers off, and answers may have them
    _open_streams()

    def reported(status: str, message: str, code: int) -> int:
        if "--json" in words:
            try:
                print(in_json({"status": status, "message": " ".join(message.split()), "exit": code}), flush=True)
            except OSError as error:
                return _unheard(name, error)
        return fail(name, _PREFIX.get(status, "") + message, code)

    before = _raising_at_termination()
    try:
        with _doubts_noted(name, wanted="--plain" not in words):
            code = main()
        sys.stdout.flush()
        return code
    except QEError as error:
        return reported(*_failure(error))
    except KeyboardInterrupt:
        return reported("interrupted", "interrupted", INTERRUPTED)
    except _Terminated:
        return reported("interrupted", "ended by a signal", TERMINATED)
    except ImportError as error:
        absent = lacking(error)
        if absent is None:
            raise
        return reported("unable", str(absent), UNABLE)
    except OSError as error:
        if error.filename is not None:
            raise
        return _unheard(name, error)
    except SystemExit as stop:  # what the command line library makes of a broken pipe
        if not isinstance(stop.__context__, OSError):
            raise
        return _unheard(name, stop.__context__)
    finally:
        if before is not None:
            signal.signal(signal.SIGTERM, before)


def _asked(app: typer.Typer, words: Sequence[str]) -> Any:
    """The commands of an app, or the one alone that the first word names: to build all takes long."""
    from typer.main import get_command, get_command_name

    names = (one.name or get_command_name(one.callback.__name__) for one in app.registered_commands if one.callback)
    named = [one for one, name in zip(app.registered_commands, names) if [name] == [*words[:1]]]
    if named and app.registered_callback:  # without one, typer makes a single command of it
        app = copy(app)
        app.registered_commands = named
    return get_command(app)


def _failure(error: QEError) -> tuple[str, str, int]:
    """What is said of an error: its status, the message and the exit status."""
    from qe.processes.channel import WorkerDied, WorkerStopped

    match error:
        case InputError():
            return "input_error", str(error), BAD_INPUT
        case WorkerStopped(known=known) | WorkerDied(known=known):
            return "unable", f"{error}; known {known}", UNABLE
        case Unable():
            return "unable", str(error), UNABLE
        case CertificateRejected():
            return "rejected", str(error), REJECTED
    return "internal_error", str(error), BUG


class _Terminated(BaseException):
    """SIGTERM has come: as at Ctrl-C, what is half done is undone on the way out."""


def _raising_at_termination() -> signal.Handlers | None:
    """Have SIGTERM raise ``_Terminated``, where it would end the process; what it did before, None where that stays."""
    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGTERM) != signal.SIG_DFL:
        return None

    def end(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # once is enough
        raise _Terminated

    signal.signal(signal.SIGTERM, end)
    return signal.SIG_DFL


def examples(*lines: str) -> str:
    """What stands below the help of a command, line by line as it can be typed."""
    return "\n".join(("\b", "Examples:", *(f"  {line}" for line in lines)))


@contextmanager
def _doubts_noted(name: str, *, wanted: bool) -> Iterator[None]:
    """Within, what may have been meant otherwise is noted on stderr, each time in a line of its own."""
    shown = warnings.showwarning

    def note(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
        if issubclass(category, DoubtfulInput):
            fail(name, f"note: {message}", OK)
        else:
            shown(message, category, *place, **more)

    with warnings.catch_warnings():
        warnings.showwarning = note
        warnings.simplefilter("always" if wanted else "ignore", DoubtfulInput)
        yield


def _misspelt(command: Any, words: Sequence[str]) -> str:
    """The first word that looks like an option and is none, with the nearest one that there is; "" without one."""
    known = {"--help", *_options(command)}
    for word in takewhile(lambda word: word != "--", words):
        option = word.split("=")[0]
        if option.startswith("--") and option not in known and " " not in option:
            near = get_close_matches(option, sorted(known), 1)
            return f"no such option: {option}" + (f"; did you mean {near[0]}?" if near else "")
    return ""


def _options(command: Any) -> set[str]:
    """The options of a command and of those inside it."""
    inner = (_options(one) for one in getattr(command, "commands", {}).values())
    return {name for one in command.params for name in (*one.opts, *one.secondary_opts)}.union(*inner)


def _open_streams() -> None:
    """Make the standard streams usable even where the caller closed them: no file opened later can get their numbers.
    Letters that the terminal's encoding lacks are written by their numbers."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDONLY)  # the lowest free number: this one
    sys.stdin = sys.stdin or open(0)  # noqa: SIM115
    sys.stdout = sys.stdout or open(1, "w")  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w")  # noqa: SIM115
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")


def _unheard(name: str, error: OSError) -> int:
    """Output cannot be written. A reader that left early, as head does, has what it wanted; else the answer is lost."""
    _silence(sys.stdout)
    if isinstance(error, BrokenPipeError):
        return OK
    return fail(name, f"unable: the output cannot be written: {error.strerror or error}", UNABLE)


def fail(name: str, message: str, code: int) -> int:
    """Print one line on stderr; the exit status ``code``."""
    try:
        print(f"{name}: {' '.join(message.split())}", file=sys.stderr, flush=True)
    except OSError:
        _silence(sys.stderr)
    return code


def _silence(stream: TextIO) -> None:
    """Let what a stream still holds go nowhere, so that the interpreter does not complain about it at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _one_line_hook(name: str) -> Callable[[type[BaseException], BaseException, TracebackType | None], None]:
    """What the interpreter does with an exception nobody expected: one line with its place; exit status 1."""

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):  # while the command was being loaded; the signal ends the process
            fail(name, "interrupted", BUG)
            return
        while trace is not None and trace.tb_next is not None:
            trace = trace.tb_next
        place = "" if trace is None else f" at {Path(trace.tb_frame.f_code.co_filename).name}:{trace.tb_lineno}"
        fail(name, f"internal error, please report: {kind.__name__}{place}: {error}", BUG)

    return hook


def is_live(stream: TextIO) -> bool:
    """Whether a line may be drawn over and over: on a terminal that knows how, unless plain text is wanted (as
    ``NO_COLOR`` says)."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") not in ("dumb", "unknown")


class Display(AbstractContextManager["Display"]):
    """A progress line on stderr; where none can be drawn, with ``lines`` a line now and then, else nothing."""

    def __init__(self, *, wanted: bool = True, lines: bool = False) -> None:
        self._wanted = wanted and is_live(sys.stderr)
        self._lines = wanted and lines and not self._wanted
        self._said = -LINES_APART
        self._start = time.monotonic()
        self._status: Any = None

    def __exit__(self, *exc: object) -> None:
        if self._status is not None:
            self._status.stop()

    def __call__(self, event: Event) -> None:
        """A progress listener."""
        elapsed = time.monotonic() - self._start
        if self._lines and elapsed >= self._said + LINES_APART:
            self._said = elapsed
            print(f"{event.phase} ... ({elapsed:.1f} s)", file=sys.stderr, flush=True)
        if not self._wanted or elapsed < DISPLAY_AFTER:
            return
        if self._status is None:
            from rich.console import Console

            self._status = Console(stderr=True).status("")
            self._status.start()
        total = f"/{event.total}" if event.total is not None else ""
        count = f" {event.done}{total}" if event.done or event.total else ""
        self._status.update(f"{event.phase}{count} {event.note} [dim]{elapsed:.0f} s[/dim]")


def limited(
    work: Callable[[Channel], T],
    *,
    timeout: float | None,
    memory: int | None,
    plain: bool,
    lines: bool = False,
    text: str | None = None,
) -> T:
    """Do the work under hard limits, of which start-up has taken its part, with a progress display; ``lines``: also
    where there is no terminal. It begins in this process where nothing is limited and a ``text`` is read that is not
    long."""
    from qe.processes.channel import ANSWERED, Known
    from qe.processes.execution import grace_of, run
    from qe.processes.limits import Limits
    from qe.processes.portable import portable

    grace, known = 0.0 if timeout is None else remaining(timeout) - timeout + grace_of(timeout), Known()
    at_once = text is None or timeout is not None
    if text is not None and not at_once:
        from qe.formula.features import text_may_block  # with what work in this process needs

        at_once = text_may_block(text)
    with Display(wanted=not plain, lines=lines) as display:
        limits = Limits(timeout, memory, display)
        try:
            return run(partial(_with_doubts, work), limits, at_once=at_once, grace=grace, known=known)
        except Unable:
            if ANSWERED not in known.facts:
                raise
            return known.facts[ANSWERED]  # type: ignore[return-value]
        except (RecursionError, MemoryError, ValueError) as error:
            raise restored(*portable(error)) from error
        finally:
            if NOTE in known.facts:
                warnings.warn(str(known.facts[NOTE]), DoubtfulInput, stacklevel=2)


def _with_doubts(work: Callable[[Channel], T], channel: Channel) -> T:
    """The work, with the channel told of the doubts that it warns of: a worker has no stderr."""
    doubts: list[str] = []

    def tell(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
        if issubclass(category, DoubtfulInput):
            doubts.append(str(message))
            channel.fact(NOTE, "; ".join(doubts))

    with warnings.catch_warnings():
        warnings.showwarning = tell
        return work(channel)


def remaining(timeout: float) -> float:
    """Seconds left of a command's time limit, at least a quarter of it however slow the start was."""
    return max(timeout / 4, timeout - age())


def age() -> float:
    """Seconds since this process was started, where the system tells; else the processor time it has used."""
    try:
        with open("/proc/self/stat") as handle:
            ticks = int(handle.read().rpartition(")")[2].split()[19])
        return time.clock_gettime(time.CLOCK_BOOTTIME) - ticks / os.sysconf("SC_CLK_TCK")
    except (OSError, AttributeError, ValueError):
        return time.process_time()


def check_writable(*paths: Path | None) -> None:
    """Raise ``InputError`` early when a file could not be written later."""
    for path in paths:
        if path is None:
            continue
        if path.is_dir():
            raise InputError(f"{path}: a file name expected, a folder found")
        if _is_no_plain_file(path):
            continue
        if not path.parent.is_dir():
            raise InputError(f"{path}: the folder {path.parent} does not exist")
        if not os.access(path.parent, os.W_OK):
            raise InputError(f"{path}: the folder {path.parent} is not writable")


def _is_no_plain_file(path: Path) -> bool:
    """Whether something stands there that is neither a file nor a folder, or is the system's own name of one."""
    return path.exists() and (not path.is_file() or path.absolute().parts[1:2] in (("dev",), ("proc",)))


def write_file(path: Path, content: str | bytes) -> None:
    """Write a whole file or nothing: into a temporary file next to it, then renamed. What is no plain file (a device,
    a pipe, standard output) is written to; renaming would put a file in its place."""
    import tempfile

    data = content.encode() if isinstance(content, str) else content
    try:
        if _is_no_plain_file(path):
            path.write_bytes(data)
            return
        path = Path(os.path.realpath(path))  # of a link, the file that it leads to
        descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(descriptor, "wb") as handle:
            handle.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None
