"""One adapter per solver: takes a formula of this project, gives back an answer in the text syntax.

``python -m experiments.adapters NAME`` reads ``{"formula": text, "limit": seconds}`` as JSON from standard input and
prints ``{"status": ..., "answer": text, "seconds": s}``. ``seconds`` leaves out starting the interpreter, imports and
reading, except for QEPCAD, which is a whole process anyway. The runner starts this program under hard limits.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from qe.errors import Unable
from qe.formula.normal import prenex, rename_apart
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import free_variables
from qe.io.text import read, write

QEPCAD_HOME = "/usr/lib/qepcad"
QEPCAD_CELLS = 10_000_000
MEMORY = 1800  # MB, a little below the limit of the runner, so that ours ends by itself


@dataclass(frozen=True, slots=True)
class Answer:
    """``text`` in the text syntax; ``seconds`` of solving."""

    text: str
    seconds: float


class NotSupported(Unable):
    """The solver does not take, or does not answer, this kind of problem."""


def ours(formula: Formula, limit: float) -> Answer:
    """This project, with its default options."""
    import qe

    start = time.perf_counter()
    answer = qe.eliminate(formula, timeout=limit, memory=MEMORY)
    seconds = time.perf_counter() - start
    if answer.formula is None or answer.status is not qe.Status.SOLVED:
        raise Unable(str(getattr(answer, "reason", None) or answer.stats))
    return Answer(write(answer.formula), seconds)


def z3_decides(formula: Formula, limit: float) -> Answer:
    """z3 on sentences; it gives no quantifier-free formula for nonlinear reals."""
    from experiments.z3_oracle import decide

    if free_variables(formula):
        raise NotSupported("z3 decides sentences only")
    start = time.perf_counter()
    verdict = decide(formula, seconds=limit)
    if verdict is None:
        raise Unable("unknown")
    return Answer(str(verdict).lower(), time.perf_counter() - start)


# --- QEPCAD ----------------------------------------------------------------------------------------------
def qepcad(formula: Formula, limit: float) -> Answer:
    """QEPCAD B, whole process. Quantifiers are pulled to the front for it; names are replaced."""
    if shutil.which("qepcad") is None:
        raise NotSupported("qepcad is not installed")
    prefix, matrix = prenex(formula)
    bound = [(kind.value, name) for kind, names in prefix for name in names]
    free = list(free_variables(formula))
    names = {name: f"v{i}" for i, name in enumerate([*free, *(name for _, name in bound)])}
    if not names or isinstance(matrix, Constant):
        raise NotSupported("nothing left for qepcad to do")
    quantifiers = "".join(f"({kind} {names[name]})" for kind, name in bound)
    lines = [
        "[problem]",
        f"({','.join(names.values())})",
        str(len(free)),
        f"{quantifiers}[{_qepcad_text(matrix, names)}].",
        "finish",
        "",
    ]
    environment = {**os.environ, "qe": QEPCAD_HOME}
    start = time.perf_counter()
    process = subprocess.run(
        ["qepcad", f"+N{QEPCAD_CELLS}"],
        input="\n".join(lines),
        capture_output=True,
        text=True,
        env=environment,
        timeout=limit + 5,
        check=False,
    )
    seconds = time.perf_counter() - start
    if "Error!" in process.stdout:  # printed when a polynomial vanishes over a cell; the answer below it may be wrong
        raise Unable(process.stdout[process.stdout.index("Error!") :].splitlines()[0])
    found = re.search(r"An equivalent quantifier-free formula:\s*(.*?)\s*=====", process.stdout, re.DOTALL)
    if not found:
        raise Unable(" ".join(process.stdout.split())[-300:])
    return Answer(_from_qepcad(found.group(1), {short: name for name, short in names.items()}), seconds)


def _qepcad_text(formula: Formula, names: dict[str, str]) -> str:
    match formula:
        case Atom(poly, relation):
            terms = []
            for exponents, coefficient in poly.terms():
                powers = [f"{names[n]}^{k}" for n, k in zip(poly.ring.names, exponents, strict=True) if k]
                terms.append(" ".join([f"({int(coefficient)})", *powers]))
            return f"{' + '.join(terms)} {relation.value} 0"
        case And(args):
            return "[" + " /\\ ".join(_qepcad_text(a, names) for a in args) + "]"
        case Or(args):
            return "[" + " \\/ ".join(_qepcad_text(a, names) for a in args) + "]"
        case Not(arg):
            return f"[~ {_qepcad_text(arg, names)}]"
    raise NotSupported(f"{type(formula).__name__} in a matrix")


def _from_qepcad(text: str, names: dict[str, str]) -> str:
    """QEPCAD's answer with explicit products, round brackets and the original names."""
    if "_root_" in text:
        raise NotSupported("answer with indexed roots")
    tokens = re.findall(r"v\d+|\d+|/\\|\\/|/=|<=|>=|==>|<==>|TRUE|FALSE|.", " ".join(text.split()))
    result: list[str] = []
    for token in (t for t in tokens if t != " "):
        operand = re.fullmatch(r"v\d+|\d+|\(", token)
        if result and operand and re.fullmatch(r"v\d+|\|.*\||\d+|\)|\w+'*", result[-1]):
            result.append("*")
        token = {"[": "(", "]": ")", "TRUE": "true", "FALSE": "false"}.get(token, token)
        result.append(_quoted(names[token]) if token in names else token)
    return " ".join(result)


def _quoted(name: str) -> str:
    from qe.io.text import quoted

    return quoted(name)


# --- SymPy based peers -----------------------------------------------------------------------------------
def sympy_extras(formula: Formula, limit: float) -> Answer:
    """sympy-extras: McCallum/Hong CAD and virtual substitution."""
    from sympy_extras.polys.cad import quantifier_elimination

    prefix, matrix = prenex(formula)
    symbols = _Symbols()
    body = symbols.boolean(matrix)
    quantifiers = [
        ("exists" if kind.value == "E" else "forall", symbols[name]) for kind, names in prefix for name in names
    ]
    start = time.perf_counter()
    result = quantifier_elimination(body, quantifiers)
    return Answer(symbols.text(result), time.perf_counter() - start)


def semialg(formula: Formula, limit: float) -> Answer:
    """semialg: complete quantifier elimination on its symbolic quantifiers."""
    from semialg.solve import reduce_complete_expr

    symbols = _Symbols()
    expression = symbols.quantified(rename_apart(formula))
    free = [symbols[name] for name in free_variables(formula)]
    start = time.perf_counter()
    result = reduce_complete_expr(expression, free_variables=free) if free else reduce_complete_expr(expression)
    return Answer(symbols.text(result), time.perf_counter() - start)


class _Symbols:
    """Formulas to SymPy and back, through real symbols v0, v1, ... so that names cannot clash."""

    def __init__(self) -> None:
        import sympy

        self.sympy = sympy
        self.symbols: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        return self.symbols.setdefault(name, self.sympy.Symbol(f"v{len(self.symbols)}", real=True))

    def boolean(self, formula: Formula) -> Any:
        match formula:
            case Constant(value):
                return self.sympy.true if value else self.sympy.false
            case Atom(poly, relation):
                return self._relation(
                    sum(
                        int(c)
                        * self.sympy.Mul(*(self[n] ** k for n, k in zip(poly.ring.names, exponents, strict=True)))
                        for exponents, c in poly.terms()
                    ),
                    relation,
                )
            case And(args):
                return self.sympy.And(*(self.boolean(a) for a in args))
            case Or(args):
                return self.sympy.Or(*(self.boolean(a) for a in args))
            case Not(arg):
                return self.sympy.Not(self.boolean(arg))
        raise NotSupported(f"{type(formula).__name__} in a matrix")

    def _relation(self, expression: Any, relation: Relation) -> Any:
        s = self.sympy
        kind = {
            Relation.EQ: s.Eq,
            Relation.NE: s.Ne,
            Relation.LT: s.Lt,
            Relation.LE: s.Le,
            Relation.GT: s.Gt,
            Relation.GE: s.Ge,
        }
        return kind[relation](expression, 0)

    def quantified(self, formula: Formula) -> Any:
        from semialg import Exists as SemialgExists
        from semialg import ForAll as SemialgForAll

        match formula:
            case Exists(names, body) | ForAll(names, body):
                result = self.quantified(body)
                kind = SemialgExists if isinstance(formula, Exists) else SemialgForAll
                for name in reversed(names):
                    result = kind(self[name], result)
                return result
            case And(args):
                return self.sympy.And(*(self.quantified(a) for a in args))
            case Or(args):
                return self.sympy.Or(*(self.quantified(a) for a in args))
            case Not(arg):
                return self.sympy.Not(self.quantified(arg))
        return self.boolean(formula)

    def text(self, result: Any) -> str:
        """The text syntax of a Boolean of relations between polynomials with rational coefficients."""
        s = self.sympy
        if result in (True, s.true):
            return "true"
        if result in (False, s.false):
            return "false"
        if isinstance(result, s.And | s.Or):
            return (
                "(" + (" and " if isinstance(result, s.And) else " or ").join(self.text(a) for a in result.args) + ")"
            )
        if isinstance(result, s.Not):
            return f"not ({self.text(result.args[0])})"
        if isinstance(result, s.core.relational.Relational):
            relation = {"==": "=", "!=": "/="}.get(result.rel_op, result.rel_op)
            top, bottom = s.fraction(s.together(result.lhs - result.rhs))
            if bottom.free_symbols:  # p/q rel 0 iff p*q rel 0, where q is not zero
                return f"({self._polynomial(top * bottom)} {relation} 0 and {self._polynomial(bottom)} /= 0)"
            return f"{self._polynomial(top / bottom)} {relation} 0"
        raise NotSupported(f"answer with {type(result).__name__}: {str(result)[:100]}")

    def _polynomial(self, expression: Any) -> str:
        used = [name for name, symbol in self.symbols.items() if expression.has(symbol)]
        if not used:
            if not expression.is_rational:
                raise NotSupported(f"answer with {str(expression)[:100]}")
            return f"({expression})"
        try:
            poly = self.sympy.Poly(expression, *(self.symbols[n] for n in used), domain="QQ")
        except self.sympy.PolynomialError as error:
            raise NotSupported(f"answer with {str(expression)[:100]}") from error
        return " + ".join(
            "*".join([f"({c})", *(f"{_quoted(n)}^{k}" for n, k in zip(used, exponents, strict=True) if k)])
            for exponents, c in poly.terms()
        )


ADAPTERS: dict[str, Callable[[Formula, float], Answer]] = {
    "ours": ours,
    "qepcad": qepcad,
    "sympy-extras": sympy_extras,
    "semialg": semialg,
    "z3": z3_decides,
}


def main() -> None:
    """Solve one problem from standard input with the solver named on the command line."""
    task = json.load(sys.stdin)
    start = time.perf_counter()
    try:
        answer = ADAPTERS[sys.argv[1]](read(task["formula"]), task["limit"])
        report = {"status": "solved", "answer": answer.text, "seconds": answer.seconds}
    except (Unable, subprocess.TimeoutExpired, MemoryError) as error:
        report = {
            "status": "unable",
            "message": f"{type(error).__name__}: {error}"[:300],
            "seconds": time.perf_counter() - start,
        }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
