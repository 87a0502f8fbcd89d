"""SMT-LIB 2 scripts of the logics QF_NRA and NRA (``docs/formats.md``): what they assert, and formulas as scripts.

Commands that only ask for output are passed over; what would change the assertions later is refused. A Boolean constant
p becomes a real variable p with the atom ``p > 0``, which is equisatisfiable, also under quantifiers, because both
cases of p have a real value. Formulas of z3 and pySMT are read as what their own printers write.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import takewhile
from typing import Any, cast

from qe.errors import InputError, ParseError
from qe.formula.notation import Monomial, digits, oriented
from qe.formula.syntax import TRUE, And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import children
from qe.io.names import renaming
from qe.io.smtlib_parser import SYMBOL, Expression, parse
from qe.io.smtlib_script import Script
from qe.io.surface import MAX_DEPTH
from qe.io.text_errors import Failing
from qe.io.tokens import without_collections

_RESERVED = re.compile(
    r"and|or|not|xor|true|false|ite|distinct|let|exists|forall|match|par|as|assert|declare-.*|define-.*|check-sat.*|"
    r"exit|echo|push|pop|reset.*|get-.*|set-.*|Real|Int|Bool|Array|String|RegLan|BINARY|DECIMAL|HEXADECIMAL|NUMERAL|"
    r"STRING|abs|mod|div|rem|is|is_int|to_int|to_real|pi|e|exp|sin|cos|tan|sec|csc|cot|a?sin|a?cos|a?tan|arc.*|sqrt|"
    r"sinh|cosh|tanh|asinh|acosh|atanh|if|implies|iff|int|real|bool|select|store|const|[.@].*|_|!|[-+*/^=<>]|[<>]=|=>"
)
_UNWRITABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f|\\]")
"""What a quoted symbol cannot hold (SMT-LIB 2.6, section 3.1): control characters, bars, backslashes."""

_OPERATORS = {Relation.EQ: "=", Relation.LT: "<", Relation.LE: "<=", Relation.GT: ">", Relation.GE: ">="}


_ANSWERED = re.compile(
    r"set-(logic|info|option)|get-(info|option|model|value|assertions|assignment|proof|unsat-core|unsat-assumptions)|echo"
)


def read(text: str, *, source: str = "<text>") -> Formula:
    """The conjunction of the assertions of a script. Raises ``ParseError`` with line and column."""
    fail = Failing(text, source)
    try:
        with without_collections(text):
            try:
                formula = _asserted(parse(text, fail, placed=False), fail)
            except ParseError:  # once more, to see where it is
                formula = _asserted(parse(text, fail), fail)
        depth = _depth(formula)
    except RecursionError:
        raise fail("the script is nested too deeply", -1) from None
    if depth > MAX_DEPTH:
        raise fail(f"the formula is nested more than {MAX_DEPTH} levels deep", -1)
    return formula


def _asserted(commands: list[Expression], fail: Failing) -> Formula:
    script = Script(fail)
    heads = list(takewhile("exit".__ne__, map(script.head, commands)))
    for head, command in zip(heads, commands):
        if head in ("declare-const", "declare-fun"):
            script.reserve(cast(list[Expression], command))
    checked = False
    for head, command in zip(heads, commands):
        if checked and head == "assert":
            script.error("an assert after check-sat: one question per script (qe smt runs it)", command)
        if script.change(cast(list[Expression], command)) or _ANSWERED.fullmatch(head):
            continue
        if head in ("check-sat", "check-sat-using"):
            checked = True
        elif head in ("push", "pop", "reset", "reset-assertions", "check-sat-assuming"):
            script.error(f"{head} is not supported: one question per script (qe smt runs it)", head)
        else:
            script.error(f"the command {head} is not supported", head)
    return script.whole()


def _depth(formula: Formula) -> int:
    return 1 + max((_depth(child) for child in children(formula)), default=0)


def write(formula: Formula) -> str:
    """A script that asserts ``formula``. Names that SMT-LIB keeps for itself or cannot write get ``v_`` in front.
    Raises ``InputError`` for a root atom, which SMT-LIB cannot express."""
    names = _allowed_names(formula)
    lines = [f"(set-logic {'QF_NRA' if formula.is_quantifier_free else 'NRA'})"]
    lines += [f"(declare-const {symbol(names[name])} Real)" for name in formula.free]
    lines.append(f"(assert {_term(formula, names)})")
    return "\n".join(lines) + "\n"


def _allowed_names(formula: Formula) -> dict[str, str]:
    return renaming(
        formula,
        keeps=lambda name: not _RESERVED.fullmatch(name) and not _UNWRITABLE.search(name),
        spell=lambda name: f"v_{_UNWRITABLE.sub('_', name)}",
    )


def symbol(name: str) -> str:
    """A name as a symbol of SMT-LIB."""
    return name if SYMBOL.fullmatch(name) else f"|{name}|"


def term(formula: Formula, symbols: Mapping[str, str]) -> str:
    """The formula as a term; ``symbols`` gives the symbols of its free names."""
    return _term(formula, {name: symbols.get(name) or new for name, new in _allowed_names(formula).items()})


def _term(formula: Formula, names: Mapping[str, str]) -> str:
    match formula:
        case Constant(value):
            return "true" if value else "false"
        case Atom():
            parts, relation = oriented(formula.poly, formula.relation)
            if relation is Relation.NE:
                return f"(not (= {_polynomial(parts, names)} 0))"
            return f"({_OPERATORS[relation]} {_polynomial(parts, names)} 0)"
        case And(args) | Or(args):
            return f"({'and' if isinstance(formula, And) else 'or'} {' '.join(_term(arg, names) for arg in args)})"
        case Not(arg):
            return f"(not {_term(arg, names)})"
        case Exists(variables, body) | ForAll(variables, body):
            bound = " ".join(f"({symbol(names[name])} Real)" for name in variables)
            return f"({'exists' if isinstance(formula, Exists) else 'forall'} ({bound}) {_term(body, names)})"
    raise InputError("root(…) cannot be written in SMT-LIB")


def _polynomial(parts: list[Monomial], names: Mapping[str, str]) -> str:
    texts = [_monomial(coefficient, powers, names) for coefficient, powers in parts]
    return texts[0] if len(texts) == 1 else f"(+ {' '.join(texts)})"


def _monomial(coefficient: int, powers: tuple[tuple[str, int], ...], names: Mapping[str, str]) -> str:
    factors = [written for name, k in powers for written in [symbol(names[name])] * k]
    if coefficient != 1 or not factors:
        factors.insert(0, digits(coefficient) if coefficient >= 0 else f"(- {digits(-coefficient)})")
    return factors[0] if len(factors) == 1 else f"(* {' '.join(factors)})"


def from_solver(given: Any) -> Formula | None:
    """The formula of an object of z3 or pySMT; None for any other."""
    doors = {"z3": from_z3, "pysmt": _from_pysmt}
    door = doors.get(type(given).__module__.partition(".")[0])
    return None if door is None else door(given)


def graph_of(name: str, given: Any) -> Formula | None:
    """Where a variable of this name has the value of a term of z3; None for any other."""
    if type(given).__module__.partition(".")[0] != "z3":
        return None
    import z3

    return from_z3(z3.Real(name, given.ctx) == given)


def from_z3(given: Any) -> Formula:
    """The formula of a z3 expression of sort Bool, of a list of them (their conjunction), or of what a solver holds.

    Raises ``InputError`` for what is not about real numbers.
    """
    if hasattr(given, "assertions"):
        if hasattr(given, "to_smt2"):
            return read(given.to_smt2(), source="<z3>")
        given = list(given.assertions())  # an optimiser
        if not given:
            return TRUE
    parts = list(given) if isinstance(given, list | tuple) else [given]
    if not parts or not all(hasattr(part, "sexpr") and hasattr(part, "ctx") for part in parts):
        raise InputError("from_z3: a Boolean expression of z3, a list of them, or a solver expected")
    import z3

    solver = z3.Solver(ctx=parts[0].ctx)
    try:
        solver.add(*parts)
    except z3.Z3Exception as error:
        raise InputError(f"from_z3: Boolean expressions expected: {str(error).splitlines()[0]}") from None
    return read(solver.to_smt2(), source="<z3>")


def _from_pysmt(given: Any) -> Formula:
    from pysmt.smtlib.printers import to_smtlib
    from pysmt.utils import quote

    if not hasattr(given, "get_free_variables") or not given.get_type().is_bool_type():
        raise InputError("a pySMT formula expected, a term found")
    lines = []
    for symbol in sorted(given.get_free_variables(), key=lambda symbol: str(symbol.symbol_name())):
        lines.append(f"(declare-const {quote(symbol.symbol_name())} {symbol.symbol_type()})")
    return read("\n".join([*lines, f"(assert {to_smtlib(given)})"]), source="<pysmt>")
