"""Scripts of other systems as the one command that they end in, with definitions in the place of their names.

``eq = x^2 + y^2; Reduce[eq < 1, x]`` of Mathematica, ``x = Real('x')`` and ``s.add(x > 0)`` of Z3, ``x = symbols('x')``
of SymPy, ``f := x^2; solve(f > 1, x);`` of Maple, Giac and Redlog. No statement is passed over unread.
"""

from __future__ import annotations

import re

from qe.arguments import shown
from qe.errors import InputError
from qe.io.text_words import LONGEST, SIGNED, split
from qe.spelling import WORD

_BEGINS = re.compile(
    r"(?:\s|#[^\n]*\n)*(?:from\s+[\w.]+\s+import\b|import\s+\w|(?:\w+\s*,\s*)*\w+\s*=\s*(?:\w+\.)?(?:Real|Int|Bool|[sS]ymbol)s?\("
    r"|var\(|Clear(?:All)?\[|load_package\b|restart\b|with\(|\w+\s*:=(?=.*[;\n].|\s*\w[\w:-]*\()|\w+\s*=(?![=>])[^;]*;.*\b[A-Z][a-z]+[A-Za-z]*\[)",
    re.DOTALL,
)
_COMMENT = re.compile(r"#[^\n]*|\(\*.*?\*\)", re.DOTALL)
_IDLE = re.compile(
    r"from\s.*|import\s.*|Clear(?:All)?\[.*\]|init_printing\(.*\)|(?:load_package|rlset|on|off)\b.*|restart|with\(.*\)"
    r"|\w+\s*=\s*(?:\w+\.)?(?:Simple)?Solver\(\)|(?:print\s*\(?\s*)?\w+\.(?:check|model)\(\)\s*\)?"
)
"""Statements that say nothing about the question."""
_DECLARED = re.compile(r"(?:([\w\s,]+?)=\s*)?(?:\w+\.)?(Real|Int|Bool|[sS]ymbol|var)s?\(\s*(['\"])(.*?)\3\s*(.*)\)")
_SAID = re.compile(rf"(?:({WORD})\s*:?=(?![=>])\s*|(print)\s*(?=\())(.+)", re.DOTALL)
"""A definition, or what is printed."""
_ADDED = re.compile(r"\w+\.(?:add|append|insert)\((.*)\)", re.DOTALL)
_CALL = re.compile(r"[A-Za-z][\w.:\-]*[(\[]")
_ASSUMED = re.compile(r"(\w+)\s*=\s*(?:True|1)|domain\s*=\s*['\"](\w+)['\"]")


def last_command(text: str) -> str:
    """The command that a script ends in; another text as it is. Raises ``InputError`` for what has no meaning here."""
    typed = "\n".join(re.findall(r"^(?:>>>|\.\.\.) (.*)", text, re.MULTILINE)) or text
    if len(text) > LONGEST or not _BEGINS.match(typed):
        return typed
    values: dict[str, str] = {}
    idle = set[str]()
    known: list[str] = []
    conditions: list[str] = []
    question = ""

    def put(part: str) -> str:
        idle.difference_update(re.findall(WORD, part))
        return re.sub(WORD, lambda word: values.get(word[0], word[0]), part)

    statements = [statement.strip(" \t\r:") for statement in split(_COMMENT.sub("", typed), ";\n")]
    statements = [statement for statement in statements if statement and not _IDLE.fullmatch(statement)]
    for statement in statements:
        if question:
            raise InputError(f"{shown(question)}: one question at the end of a script expected")
        declared, added, said = (kind.fullmatch(statement) for kind in (_DECLARED, _ADDED, _SAID))
        if declared:
            names, signs = _variables(declared)
            values, known = values | names, known + signs
        elif added:
            conditions.append(put(added[1]))
        elif said and said[1] and not (statement == statements[-1] and _CALL.match(said[3])):
            value = put(said[3])
            values[said[1]] = value if value[0] in "[{" else f"({value})"
            idle.add(said[1])
        else:
            question = put(said[3][1:-1] if said and said[2] else said[3] if said else statement)
    if bool(question) is bool(conditions) or idle:
        unused = f", and a use of {', '.join(sorted(idle))}" if idle else ""
        raise InputError(f"one question at the end of a script expected{unused}")
    question = question or f"{{{', '.join(conditions)}}}"
    return f"Assuming[{' && '.join(known)}, {question}]" if known else question


def _variables(declared: re.Match[str]) -> tuple[dict[str, str], list[str]]:
    """The names of a declaration with their variables, and conditions on these."""
    left, kind, _, right, options = declared.groups()
    variables, names = re.findall(WORD, right), re.findall(WORD, left or right)
    refused, signs = [kind] if kind in ("Int", "Bool") else [], []
    for option in filter(None, map(str.strip, options.split(","))):
        assumed = _ASSUMED.fullmatch(option)
        sort = assumed[1] or assumed[2] if assumed else ""
        refused += [option] if sort not in ("real", "RR", *SIGNED) else []
        signs += [f"{name} {SIGNED[sort]} 0" for name in variables if sort in SIGNED]
    if refused:
        raise InputError(f"{', '.join(names)}: all variables are real, {refused[0]} cannot be asked for")
    if len(names) != len(variables) or re.sub(rf"{WORD}|[\s,]", "", right):
        raise InputError(f"{shown(declared[0])}: a name for each variable expected")
    return dict(zip(names, variables)), signs
