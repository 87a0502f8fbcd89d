"""The plain reader as a command: the verdict of the kernel's checkers, in a process without FLINT.

All that it needs is imported here, so that the modules loaded are those that its one file holds.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
import zipfile
from collections.abc import Iterator
from dataclasses import asdict
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, NoReturn

import qe.formula.comparison
import qe.kernel.derivation  # noqa: F401
from qe.certify.claims import claim_of
from qe.certify.trusts import trusts
from qe.certify.verify import verify_json
from qe.errors import BudgetExceeded, Unable
from qe.kernel.verdict import Verdict
from qe.options import VERIFY_SECONDS, Budget
from qe.proof.certificate import Certificate

OK, BAD_INPUT, UNABLE, REJECTED = 0, 2, 3, 4
MOST_SECONDS = 10_000_000.0
"""What a timer of the system takes."""


def main() -> NoReturn:
    """Run the command line. Exit status 0: accepted, 2: wrong arguments or files, 3: not decided, 4: rejected."""
    parser = argparse.ArgumentParser(prog="reader", description="Check certificates, in plain Python.")
    parser.add_argument("certificate", nargs="*", metavar="CERTIFICATE", help="a file, or - for standard input")
    parser.add_argument("--timeout", type=_seconds, default=VERIFY_SECONDS, help="seconds for each")
    parser.add_argument("--json", action="store_true", help="one JSON object a line")
    parser.add_argument("--write-reader", type=Path, metavar="FILE", help="write this reader as one file")
    given = parser.parse_args()
    sys.set_int_max_str_digits(0)
    sys.setrecursionlimit(10_000)
    if not given.certificate and not given.write_reader:
        parser.error("a certificate expected")
    if given.write_reader:
        try:
            write_reader(given.write_reader)
        except OSError as error:
            parser.error(f"--write-reader: {error}")
    sys.exit(max((_checked(name, given.timeout, given.json) for name in given.certificate), default=OK))


def _seconds(text: str) -> float:
    seconds = float(text)
    if not 0 < seconds <= MOST_SECONDS:
        raise argparse.ArgumentTypeError(f"a positive number of seconds expected, {text} found")
    return seconds


def _checked(name: str, seconds: float, as_json: bool) -> int:
    """Print the verdict on a file; the exit status."""
    if hasattr(signal, "alarm"):  # for steps between which the budget is not looked at
        signal.signal(signal.SIGALRM, _out_of_time)
        signal.setitimer(signal.ITIMER_REAL, seconds)
    lines: tuple[str, ...] = ()
    try:
        text = sys.stdin.read() if name == "-" else Path(name).read_text("utf-8")
        verdict = verify_json(text, Budget(seconds), core=True)
        if verdict.accepted:
            certificate = Certificate.from_json(text)
            lines = (*claim_of(certificate).words, *(f"rests on: {name}" for name in trusts(certificate)))
    except Unable as error:
        verdict = Verdict(False, "", str(error), decided=False)
    except (OSError, UnicodeDecodeError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return BAD_INPUT
    print(json.dumps(asdict(verdict)) if as_json else "\n".join((str(verdict), *lines)))
    return OK if verdict.accepted else REJECTED if verdict.decided else UNABLE


def _out_of_time(*_: object) -> None:
    raise BudgetExceeded("time limit reached", limit="time")


def write_reader(file: Path) -> None:
    """The modules that are loaded, and the theorems, as one file that Python runs."""
    loaded = {name: module for name, module in sys.modules.items() if name.split(".")[0] in ("qe", "__main__")}
    sources = {}
    for name, module in sorted(loaded.items()):
        spec: Any = module.__spec__
        path = name.replace(".", "/") + ("/__init__.py" if spec.submodule_search_locations else ".py")
        sources[path] = spec.loader.get_source(spec.name)
    sources |= dict(_texts(files("qe.theorems"), "qe/theorems"))
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, text in sources.items():
            archive.writestr(zipfile.ZipInfo(path), text, zipfile.ZIP_DEFLATED)


def _texts(folder: Traversable, path: str) -> Iterator[tuple[str, str]]:
    for entry in sorted(folder.iterdir(), key=lambda e: e.name):
        if entry.name.endswith((".toml", ".json", ".py")):
            yield f"{path}/{entry.name}", entry.read_text("utf-8")
        elif entry.is_dir() and not entry.name.startswith("__"):
            yield from _texts(entry, f"{path}/{entry.name}")
