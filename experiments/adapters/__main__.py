"""``python -m experiments.adapters NAME``: solve one problem from standard input.

The task is ``{"formula": text, "limit": seconds, "memory": MiB}``. A first line ``{"ready": true}`` is printed when
the solver is imported, warmed up by a trivial problem, and the formula is read: the time limit counts from there.
The last line is ``{"status": ..., "answer": text, "message": text, "seconds": s, "cpu": s}``; ``cpu`` is
processor time, with that of ended child processes. The runner starts this program under hard limits.
"""

from __future__ import annotations

import json
import resource
import sys
import time
from collections.abc import Callable

from experiments.adapters import qepcad, smt, sympy_peers
from experiments.adapters.answer import Answer, Limits, NotSupported, OtherForm
from experiments.adapters.ours import ours
from experiments.solvers import ENGINES
from qe.errors import Unable
from qe.formula.syntax import Formula
from qe.io.text import CONSTANTS, read

WARM_UP = "ex x. x^2 = 2 and x > 1"

PEERS: dict[str, Callable[[Formula, Limits], Answer]] = {
    "qepcad": qepcad.qepcad,
    "sympy-extras": sympy_peers.sympy_extras,
    "semialg": sympy_peers.semialg,
    "z3": smt.z3,
    "cvc5": smt.cvc5,
    "yices": smt.yices,
}


def main(name: str) -> None:
    """Solve the problem with the solver of this name."""
    task = json.load(sys.stdin)
    solve = ours(name) if name in ENGINES else PEERS[name]
    limits = Limits(task["limit"], task["memory"])
    formula = read(task["formula"], known=CONSTANTS)
    start, begun = time.perf_counter(), processor_time()
    try:
        solve(read(WARM_UP), limits)
        print(json.dumps({"ready": True}), flush=True)
        start, begun = time.perf_counter(), processor_time()
        answer = solve(formula, limits)
        report = {"status": "solved", "answer": answer.text, "seconds": answer.seconds}
    except (Unable, MemoryError, ImportError) as error:
        kinds = {
            NotSupported: "unsupported",
            ImportError: "unsupported",
            OtherForm: "uncompared",
            MemoryError: "memory",
        }
        status = next((word for kind, word in kinds.items() if isinstance(error, kind)), "unable")
        message = f"{type(error).__name__}: {error}"[:300]
        report = {"status": status, "message": message, "seconds": time.perf_counter() - start}
    print(json.dumps({**report, "cpu": processor_time() - begun}))


def processor_time() -> float:
    """Seconds of processor time of this process and its ended children."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


if __name__ == "__main__":
    main(sys.argv[1])
