"""The commands, as the distribution installs them: Ctrl-C is one line also while Python is loading what they need."""

from __future__ import annotations

import gc
import sys
from importlib import import_module


def qe() -> int:
    """The command ``qe``; returns the exit status. A script alone needs no library that reads options."""
    is_script = len(sys.argv) == 3 and sys.argv[1] == "smt" and not sys.argv[2].startswith("-")
    return _run("qe", "qe.cli.smt" if is_script else "qe.cli.app")


def bezier() -> int:
    """The command ``bezier``; returns the exit status."""
    return _run("bezier", "bezier.cli")


def _run(name: str, module: str) -> int:
    gc.disable()  # what is loaded stays: looking for garbage in it would be a fifteenth of a short command
    try:
        main = import_module(module).main
    except KeyboardInterrupt:
        print(f"{name}: interrupted", file=sys.stderr)
        return 130
    finally:
        gc.set_threshold(20_000, 20, 50)  # there are few circles: looking for them took a third of a long script
        gc.enable()
    return int(main())
