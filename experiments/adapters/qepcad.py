"""QEPCAD B, whole process. The writer and the reader of its language are ``qe.io.qepcad``."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time

from experiments.adapters.answer import Answer, Limits, NotSupported, OtherForm
from qe.errors import Unable
from qe.formula.normal import close, prenex, rename
from qe.formula.syntax import Constant, Formula
from qe.io import formats
from qe.io import qepcad as language
from qe.io.names import names_in
from qe.io.text import write

HOME = "/usr/lib/qepcad"
CELLS = 10_000_000


def qepcad(formula: Formula, limits: Limits) -> Answer:
    """Quantifiers are pulled to the front; variables get the names v0, v1, ... in between."""
    if shutil.which("qepcad") is None:
        raise NotSupported("qepcad is not installed")
    prefix, matrix = prenex(formula)
    names = {name: f"v{i}" for i, name in enumerate(names_in(close(prefix, matrix)))}
    if not names or isinstance(matrix, Constant):
        raise NotSupported("nothing left for qepcad to do")
    blocks = [(kind, tuple(names[name] for name in block)) for kind, block in prefix]
    session = language.write(close(blocks, rename(matrix, names)))
    start = time.perf_counter()
    process = subprocess.run(
        ["qepcad", f"+N{CELLS}"],
        input=session,
        capture_output=True,
        text=True,
        env={"qe": HOME, **os.environ},  # the variable's own name is in small letters
        check=False,
    )
    seconds = time.perf_counter() - start
    if "Error!" in process.stdout:  # printed when a polynomial vanishes over a cell; the answer below it may be wrong
        raise Unable(process.stdout[process.stdout.index("Error!") :].splitlines()[0])
    found = re.search(r"An equivalent quantifier-free formula:\s*(.*?)\s*=====", process.stdout, re.DOTALL)
    if not found:
        raise Unable(" ".join(process.stdout.split())[-300:])
    if "_root_" in found[1]:
        raise OtherForm("answer with indexed roots")
    return Answer(
        write(rename(formats.read(found[1], "qepcad"), {short: name for name, short in names.items()})), seconds
    )
