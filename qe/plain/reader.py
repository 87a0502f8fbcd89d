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
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NoReturn

import qe.certify.parts
import qe.kernel.cells
import qe.kernel.derivation
import qe.kernel.gauss
import qe.kernel.witness  # noqa: F401
from qe.certify.claims import claim_of
from qe.certify.trusts import trusts
from qe.certify.verify import verify
from qe.errors import BudgetExceeded, CertificateRejected, InputError, Unable
from qe.kernel.verdict import Verdict
from qe.options import VERIFY_SECONDS, Budget
from qe.proof.certificate import Certificate

OK, BAD_INPUT, UNABLE, REJECTED = 0, 2, 3, 4


def main() -> NoReturn:
    """Run the command line. Exit status 0: accepted, 2: no certificate, 3: not decided, 4: rejected."""
    parser = argparse.ArgumentParser(prog="reader", description="Check certificates, in plain Python.")
    parser.add_argument("certificate", nargs="*", metavar="CERTIFICATE", help="a file, or - for standard input")
    parser.add_argument("--timeout", type=float, default=VERIFY_SECONDS, help="seconds for each")
    parser.add_argument("--json", action="store_true", help="one JSON object a line")
    parser.add_argument("--write-reader", type=Path, metavar="FILE", help="write this reader as one file")
    given = parser.parse_args()
    sys.set_int_max_str_digits(0)
    sys.setrecursionlimit(10_000)
    if given.write_reader:
        write_reader(given.write_reader)
    sys.exit(max((_checked(name, given.timeout, given.json) for name in given.certificate), default=OK))


def _checked(name: str, seconds: float, as_json: bool) -> int:
    """Print the verdict on a file; the exit status."""
    if hasattr(signal, "alarm"):  # for steps between which the budget is not looked at
        signal.signal(signal.SIGALRM, _out_of_time)
        signal.setitimer(signal.ITIMER_REAL, seconds)
    lines: tuple[str, ...] = ()
    try:
        certificate = Certificate.from_json(sys.stdin.read() if name == "-" else Path(name).read_text("utf-8"))
        verdict = verify(certificate, Budget(seconds), core=True)
        lines = (*claim_of(certificate).words, *_axioms(certificate)) if verdict.accepted else ()
    except CertificateRejected as error:
        verdict = Verdict(False, error.step, error.reason)
    except Unable as error:
        verdict = Verdict(False, "", str(error), decided=False)
    except (InputError, OSError, UnicodeDecodeError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        return BAD_INPUT
    print(json.dumps(asdict(verdict)) if as_json else "\n".join((str(verdict), *lines)))
    return OK if verdict.accepted else REJECTED if verdict.decided else UNABLE


def _out_of_time(*_: object) -> None:
    raise BudgetExceeded("time limit reached", limit="time")


def _axioms(certificate: Certificate) -> Iterator[str]:
    return (f"rests on: {name}, which is believed" for name in trusts(certificate))


def write_reader(file: Path) -> None:
    """The modules that are loaded, and the theorems, as one file that Python runs."""
    sources = {"__main__.py": "from qe.plain.__main__ import main\n\nmain()\n"}
    for name in sorted({"qe.plain.__main__", *(name for name in sys.modules if name.split(".")[0] == "qe")}):
        spec: Any = find_spec(name)
        path = name.replace(".", "/") + ("/__init__.py" if spec.submodule_search_locations else ".py")
        sources[path] = spec.loader.get_source(name)
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
