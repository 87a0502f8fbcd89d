"""LALR(1) parsing: Lark works the tables out, this module runs them.

The tables of the readers' grammars are stored beside this file (``python -m qe.io.store_tables`` writes them), because
working them out takes longer than most problems. Stored tables are used only for the very grammar they were made of.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from hashlib import sha256
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

END = "$END"


class Token(str):
    """A token: its text, the terminal it is, and the offset where it starts."""

    __slots__ = ("start_pos", "type")
    type: str
    start_pos: int

    def __new__(cls, type: str, text: str, start_pos: int) -> Token:
        made = super().__new__(cls, text)
        made.type, made.start_pos = type, start_pos
        return made


Tokens = Callable[[str, Callable[..., Token]], Iterator[Token]]
"""The tokens of a text, made by the given constructor. One compiled pattern is faster than one per terminal."""


class UnexpectedToken(Exception):
    """A token that cannot stand where it does; ``accepts``: the terminals that can."""

    def __init__(self, token: Token, accepts: frozenset[str]) -> None:
        self.token, self.accepts = token, accepts
        super().__init__(f"unexpected {token.type}")


class Production(NamedTuple):
    """A rule ``origin: ...`` of ``size`` symbols; ``action``: the builder's method, "" to hand on the only symbol.

    ``spliced``: the positions of lists (of repetitions) whose items become children of this rule.
    """

    origin: str
    size: int
    action: str
    spliced: tuple[int, ...]


class Tables(NamedTuple):
    """``states``: for each state the next one by symbol, or ``-1 - r`` where production r is complete.

    Parsing begins in state 0 and is done in state ``end``.
    """

    states: tuple[dict[str, int], ...]
    end: int
    productions: tuple[Production, ...]


class Parser:
    """Reads texts by tables; the actions are the methods of ``builder``."""

    def __init__(self, tables: Tables, tokens: Tokens, builder: object) -> None:
        self._tables, self._tokens = tables, tokens
        self._actions = [_action(production, builder) for production in tables.productions]

    def parse(self, text: str) -> Any:
        """What the builder makes of the text. Raises ``UnexpectedToken``, and what the actions raise."""
        states, productions, actions = self._tables.states, self._tables.productions, self._actions
        stack: list[int] = [0]
        values: list[Any] = []
        for token in chain(self._tokens(text, Token), (Token(END, "", len(text)),)):
            while (step := states[stack[-1]].get(token.type)) is None or step < 0:
                if step is None:
                    raise UnexpectedToken(token, self._accepted(stack))
                made = productions[-1 - step]
                keep = len(values) - made.size
                value = actions[-1 - step](values[keep:])
                del values[keep:], stack[len(stack) - made.size :]
                values.append(value)
                stack.append(states[stack[-1]][made.origin])
                if stack[-1] == self._tables.end and token.type == END:
                    return values[-1]
            stack.append(step)
            values.append(token)
        raise AssertionError("the end was not reached")

    def _accepted(self, stack: list[int]) -> frozenset[str]:
        """The terminals that can follow, as far as to be read: not those that only complete productions."""
        return frozenset(
            name for name in self._tables.states[stack[-1]] if name.isupper() and self._is_read(name, stack)
        )

    def _is_read(self, name: str, stack: list[int]) -> bool:
        stack = list(stack)
        while (step := self._tables.states[stack[-1]].get(name)) is not None and step < 0:
            made = self._tables.productions[-1 - step]
            del stack[len(stack) - made.size :]
            stack.append(self._tables.states[stack[-1]][made.origin])
            if stack[-1] == self._tables.end and name == END:
                return True
        return step is not None


def _action(production: Production, builder: object) -> Callable[[list[Any]], Any]:
    if not production.action:
        return _only
    method: Callable[[list[Any]], Any] = list if production.action == "_" else getattr(builder, production.action)
    return partial(_with_splices, method, production.spliced) if production.spliced else method


def _only(children: list[Any]) -> Any:
    return children[0]


def _with_splices(method: Callable[[list[Any]], Any], spliced: tuple[int, ...], children: list[Any]) -> Any:
    joined: list[Any] = []
    for i, child in enumerate(children):
        if i not in spliced:
            joined.append(child)
        elif joined:
            joined += child
        else:
            joined = child  # nobody else has this list; long repetitions are not copied again and again
    return joined if method is list else method(joined)


# --- where tables come from ---------------------------------------------------------------------------------------


def tables(name: str, grammar: str, start: str) -> Tables:
    """The tables of a grammar: the stored ones, if they were made of this very grammar, else worked out."""
    return stored(name, grammar, start) or computed(grammar, start)


def stored(name: str, grammar: str, start: str) -> Tables | None:
    """The tables in the file of this name, or None where there is none or it belongs to another grammar."""
    path = file_of(name)
    if not path.exists():
        return None
    data = json.loads(path.read_text(encoding="utf-8"))
    if data["grammar"] != _digest(grammar, start):
        return None
    productions = (Production(p["origin"], p["size"], p["action"], tuple(p["spliced"])) for p in data["productions"])
    return Tables(tuple(data["states"]), data["end"], tuple(productions))


def store(name: str, grammar: str, start: str) -> None:
    """Work the tables out and write the file of this name."""
    made = computed(grammar, start)
    lines = [
        f'{{"grammar": "{_digest(grammar, start)}",',
        f'"end": {made.end},',
        _listing("productions", [p._asdict() for p in made.productions]) + ",",
        _listing("states", made.states) + "}",
    ]
    file_of(name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def _listing(key: str, rows: Iterable[object]) -> str:
    return f'"{key}": [\n' + ",\n".join(json.dumps(row) for row in rows) + "\n]"


def file_of(name: str) -> Path:
    """Where the tables of this name are stored."""
    return Path(__file__).with_name(f"tables_{name}.json")


def _digest(grammar: str, start: str) -> str:
    return sha256(f"{start}\n{grammar}".encode()).hexdigest()


def computed(grammar: str, start: str) -> Tables:
    """The tables of a grammar in Lark's notation whose terminals are all declared and named."""
    from lark import Lark
    from lark.lexer import Lexer

    class Unused(Lexer):
        def __init__(self, conf: Any) -> None:
            pass

        def lex(self, lexer_state: Any, parser_state: Any) -> Any:
            return iter(())

    table: Any = Lark(grammar, parser="lalr", start=start, lexer=Unused).parser.parser._parse_table
    number = {table.start_states[start]: 0}  # states in the order in which they are met from the start
    rules: dict[Any, int] = {}
    states: list[dict[str, int]] = []
    for state in (queue := list(number)):
        row: dict[str, int] = {}
        for symbol, (action, target) in sorted(table.states[state].items()):
            if action.name == "Shift":
                if target not in number:
                    number[target] = len(number)
                    queue.append(target)
                row[str(symbol)] = number[target]
            else:
                row[str(symbol)] = -1 - rules.setdefault(target, len(rules))
        states.append(row)
    return Tables(tuple(states), number[table.end_states[start]], tuple(_production(rule) for rule in rules))


def _production(rule: Any) -> Production:
    origin, symbols = str(rule.origin.name), rule.expansion
    spliced = tuple(i for i, symbol in enumerate(symbols) if not symbol.is_term and symbol.name.startswith("_"))
    hands_on = rule.options.expand1 and not rule.alias and len(symbols) == 1
    action = "" if hands_on else "_" if origin.startswith("_") else str(rule.alias or origin)
    return Production(origin, len(symbols), action, spliced)
