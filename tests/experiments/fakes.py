"""Fake solvers: programs that answer, loop, take all memory, crash, or leave a process behind."""

from __future__ import annotations

import sys

from experiments.solvers import Solver

READY = "import sys, json, time, os, subprocess\ntask = json.load(sys.stdin)\nprint('{\"ready\": true}', flush=True)\n"


def fake(name: str, body: str) -> Solver:
    """A solver that reads its task, says that it is ready, and then runs ``body``."""
    return Solver(name, (sys.executable, "-c", READY + body))


def answering(name: str, text: str, seconds: float = 0.01) -> Solver:
    """A solver with one answer to everything."""
    report = {"status": "solved", "answer": text, "seconds": seconds}
    return fake(name, f"print(json.dumps({report!r}))")


def refusing(name: str, status: str, message: str) -> Solver:
    """A solver that reports a status other than solved."""
    return fake(name, f"print(json.dumps({{'status': {status!r}, 'message': {message!r}, 'seconds': 0.1}}))")


BUSY = fake("busy", "while True: pass")
HOG = fake("hog", "held = []\nwhile True: held.append(bytearray(os.urandom(1)) * (8 << 20))")
CRASHING = fake("crashing", "print('no idea', file=sys.stderr)\nsys.exit(3)")
OUT_OF_MEMORY = fake("out-of-memory", "raise MemoryError")
SILENT = fake("silent", "")
