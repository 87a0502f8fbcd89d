"""Scripts of other systems as the one command that they end in, with definitions in the place of their names.

``eq = x^2 + y^2; Reduce[eq < 1, x]`` of Mathematica, ``x = Real('x')`` and ``s.add(x > 0)`` of Z3, ``x = symbols('x')``
of SymPy, ``assume(x > 0)`` of Sage, ``f := x^2; solve(f > 1, x);`` of Maple, Giac and Redlog. No statement is passed
over unread.
"""

from __future__ import annotations

import re

from qe.arguments import shown
from qe.errors import InputError
from qe.io.text_words import LONGEST, SIGNED, split
from qe.spelling import WORD

_PROMPT = re.compile(r"^(?:>>>|\.\.\.|In \[\d+\]:|sage:) (.*)", re.MULTILINE)
_COMMENT = re.compile(r"#[^\n]*|\(\*.*?\*\)", re.DOTALL)
_SATISFIABLE = r"(?:print\s*\(?\s*)?\w+\.check\(\)\s*\)?"
_IDLE = re.compile(
    r"from\s+[\w.]+\s+import\b.*|import\s+\w.*|(?:Clear(?:All)?|Remove)\[.*\]|init_printing\(.*\)|restart|with\(\w*\)"
    rf"|(?:load_package|rlset|on|off)\s.*|\w+\s*=\s*(?:\w+\.)?(?:Simple)?Solver\(\)|{_SATISFIABLE}"
    r"|(?:print\s*\(?\s*)?\w+\.model\(\)\s*\)?|\w+\s*=\s*qepcad_formula"
)
"""Statements that say nothing about the question."""
_DECLARED = re.compile(r"(?:([\w\s,]+?)=\s*)?(?:\w+\.)?(Real|Int|Bool|[sS]ymbol|var)s?\(\s*(['\"])(.*?)\3\s*(.*)\)")
_SAID = re.compile(rf"(?:({WORD})\s*:?=(?![=>])\s*|(print)\s*(?=\())(.+)", re.DOTALL)
"""A definition, or what is printed."""
_FUNCTION = re.compile(r"(\w+)\[((?:\s*\w+_\s*,?)+)\]\s*:?=\s*(.+)", re.DOTALL)
_ADDED = re.compile(r"(?:\w+\.(?:add|append|insert)|(assume))\((.*)\)", re.DOTALL)
_CALL = re.compile(r"[A-Za-z][\w.:\-]*[(\[]")
_ASSUMED = re.compile(r"(\w+)\s*=\s*(?:True|1)|domain\s*=\s*['\"](\w+)['\"]")
_OF_QEPCAD = {"and_": "And", "or_": "Or", "not_": "Not", "exists": "Exists", "forall": "ForAll", "implies": "Implies"}


def asks_satisfiability(text: str) -> bool:
    """Whether a script asks if what it adds can hold, as ``s.check()`` of Z3 does."""
    return any(re.fullmatch(_SATISFIABLE, statement) for statement in _statements(text))


def last_command(text: str) -> str:
    """The command that a script ends in; another text as it is. Raises ``InputError`` for what has no meaning here."""
    typed = "\n".join(_PROMPT.findall(text)) or text
    statements = _statements(text)
    if not _is_script(statements):
        return typed
    values: dict[str, str] = {}
    functions: dict[str, tuple[list[str], str]] = {}
    idle = set[str]()
    known: list[str] = []
    conditions: list[str] = []
    question = ""

    def put(part: str) -> str:
        idle.difference_update(re.findall(WORD, part))
        part = re.sub(WORD, lambda word: values.get(word[0], word[0]), part)
        for name, (parameters, body) in functions.items():
            while call := re.search(rf"\b{name}(?=\[)", part):
                inside = next(split(part[call.end() :], "]"))
                given = dict(zip(parameters, split(inside[1:]), strict=False))
                if len(given) < len(parameters):
                    raise InputError(f"{shown(inside)}: a value for each of {', '.join(parameters)} expected")
                value = re.sub(WORD, lambda word: f"({given[word[0]]})" if word[0] in given else word[0], body)  # noqa: B023
                part = f"{part[: call.start()]}({value}){part[call.end() + len(inside) + 1 :]}"
        return part

    for statement in statements:
        if _IDLE.fullmatch(statement):
            continue
        if question:
            raise InputError(f"{shown(question)}: one question at the end of a script expected")
        declared, function, added, said = (kind.fullmatch(statement) for kind in (_DECLARED, _FUNCTION, _ADDED, _SAID))
        if declared:
            names, signs = _variables(declared)
            values, known = values | names, known + signs
        elif function:
            functions[function[1]] = re.findall(r"(\w+)_", function[2]), put(function[3])
        elif added:
            (known if added[1] else conditions).extend(map(put, split(added[2]) if added[1] else [added[2]]))
        elif said and said[1] and not (statement == statements[-1] and _CALL.match(said[3])):
            value = put(said[3])
            values[said[1]] = value if value[0] in "[{" else f"({value})"
            idle.add(said[1])
        else:
            question = put(said[3][1:-1] if said and said[2] else said[3] if said else statement)
            question = question[1:-1] if question[0] == "(" and question in values.values() else question
    if bool(question) is bool(conditions) or idle:
        unused = f", and a use of {', '.join(sorted(idle))}" if idle else ""
        raise InputError(f"one question at the end of a script expected{unused}")
    question = question or f"{{{', '.join(conditions)}}}"
    return f"Assuming[{' && '.join(known)}, {question}]" if known else question


def _statements(text: str) -> list[str]:
    """The statements of a text that may be a script, without comments; none of one that nobody typed."""
    if len(text) > LONGEST:
        return []
    typed = _COMMENT.sub("", "\n".join(_PROMPT.findall(text)) or text)
    typed = re.sub(r"\b\w+\.(and_|or_|not_|exists|forall|implies)(?=\()", lambda word: _OF_QEPCAD[word[1]], typed)
    return [part for statement in split(typed, ";\n") if (part := statement.strip(" \t\r:"))]


def _is_script(statements: list[str]) -> bool:
    if any(kind.fullmatch(part) for part in statements for kind in (_IDLE, _DECLARED, _ADDED, _FUNCTION)):
        return True
    *defined, last = statements or [""]
    command = _SAID.sub(r"\3", last)
    if any(re.match(r"\w+\s*:=", part) for part in statements):
        return bool(defined or _CALL.match(command))
    return any(_SAID.fullmatch(part) for part in defined) and re.match(r"[A-Z][A-Za-z]+\[", command) is not None


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
