"""SMT-LIB 2 scripts of the logics QF_NRA and NRA (``docs/formats.md``): what they assert, and formulas as scripts.

Commands that only ask for output are passed over, ``exit`` ends the script, and what would change the assertions later
(``push``, ``pop``, an ``assert`` after ``check-sat``) is refused. A Boolean constant p becomes a real variable p with
the atom ``p > 0``, which is equisatisfiable, also under quantifiers, because both cases of p have a real value.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import takewhile
from typing import TypeAlias, cast

from qe.errors import InputError, ParseError
from qe.formula.notation import Monomial, digits, oriented
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import children
from qe.io.names import Renaming, names_in
from qe.io.smtlib_parser import Expression, parse
from qe.io.smtlib_script import Script
from qe.io.surface import MAX_DEPTH
from qe.io.text_errors import Failing
from qe.io.tokens import without_collections

_SIMPLE = re.compile(r"[A-Za-z~!@$%^&*_+=<>.?/-][A-Za-z0-9~!@$%^&*_+=<>.?/-]*")
_RESERVED = re.compile(
    r"and|or|not|xor|true|false|ite|distinct|let|exists|forall|match|par|as|assert|declare-.*|define-.*|check-sat.*|"
    r"exit|echo|push|pop|reset.*|get-.*|set-.*|Real|Int|Bool|Array|String|RegLan|BINARY|DECIMAL|HEXADECIMAL|NUMERAL|"
    r"STRING|abs|mod|div|rem|is|is_int|to_int|to_real|pi|e|exp|sin|cos|tan|sec|csc|cot|a?sin|a?cos|a?tan|arc.*|sqrt|"
    r"sinh|cosh|tanh|asinh|acosh|atanh|if|implies|iff|int|real|bool|select|store|const|[.@].*|_|!|[-+*/^=<>]|[<>]=|=>"
)
_UNWRITABLE = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f|\\]")
"""What a quoted symbol cannot hold (SMT-LIB 2.6, section 3.1): control characters, bars, backslashes."""

Names: TypeAlias = Renaming | Mapping[str, str]

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
    """A script that asserts ``formula``.

    Names that SMT-LIB keeps for itself or cannot write get ``v_`` in front; others are quoted where needed. Raises
    ``InputError`` for a root atom, which SMT-LIB cannot express.
    """
    names = Renaming(formula, keeps=_allowed, spell=lambda name: f"v_{_UNWRITABLE.sub('_', name)}")
    lines = [f"(set-logic {'QF_NRA' if formula.is_quantifier_free else 'NRA'})"]
    lines += [f"(declare-const {symbol(names[name])} Real)" for name in formula.free]
    lines.append(f"(assert {_term(formula, names)})")
    return "\n".join(lines) + "\n"


def _allowed(name: str) -> bool:
    return not _RESERVED.fullmatch(name) and not _UNWRITABLE.search(name)


def symbol(name: str) -> str:
    """A name as a symbol of SMT-LIB."""
    return name if _SIMPLE.fullmatch(name) else f"|{name}|"


def term(formula: Formula, symbols: Mapping[str, str]) -> str:
    """The formula as a term; ``symbols`` gives the symbols of its free names."""
    names = Renaming(formula, keeps=_allowed, spell=lambda name: f"v_{_UNWRITABLE.sub('_', name)}")
    return _term(formula, {name: symbols.get(name) or names[name] for name in names_in(formula)})


def _term(formula: Formula, names: Names) -> str:
    match formula:
        case Constant(value):
            return "true" if value else "false"
        case Atom():
            parts, relation = oriented(formula.poly, formula.relation)
            if relation is Relation.NE:
                return f"(not (= {_polynomial(parts, names)} 0))"
            return f"({_OPERATORS[relation]} {_polynomial(parts, names)} 0)"
        case And(args):
            return f"(and {' '.join(_term(arg, names) for arg in args)})"
        case Or(args):
            return f"(or {' '.join(_term(arg, names) for arg in args)})"
        case Not(arg):
            return f"(not {_term(arg, names)})"
        case Exists(variables, body) | ForAll(variables, body):
            bound = " ".join(f"({symbol(names[name])} Real)" for name in variables)
            return f"({'exists' if isinstance(formula, Exists) else 'forall'} ({bound}) {_term(body, names)})"
    raise InputError("root(…) cannot be written in SMT-LIB")


def _polynomial(parts: list[Monomial], names: Names) -> str:
    texts = [_monomial(coefficient, powers, names) for coefficient, powers in parts]
    return texts[0] if len(texts) == 1 else f"(+ {' '.join(texts)})"


def _monomial(coefficient: int, powers: tuple[tuple[str, int], ...], names: Names) -> str:
    factors = [written for name, k in powers for written in [symbol(names[name])] * k]
    if coefficient != 1 or not factors:
        factors.insert(0, digits(coefficient) if coefficient >= 0 else f"(- {digits(-coefficient)})")
    return factors[0] if len(factors) == 1 else f"(* {' '.join(factors)})"
