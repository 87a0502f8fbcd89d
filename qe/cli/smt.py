"""``qe smt``: an SMT-LIB solver for the reals, one answer per command (SMT-LIB 2.6, chapter 4).

Every command is answered before the next one is read, so that programs can drive it through pipes. An error is answered
``(error "...")`` and the next command is read; after an assertion that was not understood the answer is never ``sat``.
"""

from __future__ import annotations

import io
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any, TextIO, cast

import qe
from qe.arguments import MOST_BYTES
from qe.cli.smt_check import Checks, Result
from qe.cli.source import no_file, read_source
from qe.errors import InputError, ParseError, Unable
from qe.io import surface as s
from qe.io.formats import Format
from qe.io.smtlib_parser import Ends, Expression, parse, plain, show
from qe.io.smtlib_script import Script
from qe.io.smtlib_words import is_real
from qe.io.text_errors import Failing

if TYPE_CHECKING:
    from qe.cli.smt_values import Evaluation, Number

MOST_LEVELS = 10_000
PIECE = 1 << 20
"""Characters that are read at once."""
_READ = re.compile(r"(?:\s+|;[^\n]*)*\(\s*(assert|declare-[a-z]+|define-[a-z-]+)\b")
_INFO = {
    ":name": '"bezier-qe"',
    ":version": f'"{qe.__version__}"',
    ":authors": '"the bezier-qe authors"',
    ":error-behavior": "continued-execution",
}


class Solver(Checks):
    """The state of a solver. ``put`` takes the answers, ``warn`` what is only for people; ``timeout``: seconds for the
    whole run, or (``each``) for every check."""

    def __init__(
        self,
        put: Callable[[str], None],
        warn: Callable[[str], None],
        *,
        timeout: float | None = None,
        memory: int | None = None,
        each: bool = False,
    ) -> None:
        super().__init__(timeout, memory, each)
        self.put, self.warn = put, warn
        self.failed, self.done = False, False
        self.options: dict[str, str] = {}
        self.restart()

    def restart(self) -> None:
        """Forget everything but the options."""
        self.script = Script(Failing("", "<smt>"), self.tick)
        self.result: Result | None = None
        self.status = ""  # what the script says that the next check will answer

    # --- input -----------------------------------------------------------------------------------------------
    def run(self, pieces: Iterable[str], source: str) -> None:
        """Answer the commands of a text as it comes in."""
        text, line, column, ends = "", 0, 0, Ends()
        for piece in pieces:
            text += piece if text or line or column else piece.removeprefix("\ufeff")
            start = 0
            for end in ends.found(text):
                self.execute(text[start:end], source, line, column)
                lines = text.count("\n", start, end)
                line, column = line + lines, end - text.rfind("\n", 0, end) - 1 if lines else column + end - start
                start = end
                if self.done:
                    return
            if start:
                text = text[start:]
                ends.cut(start)
            if len(text) > (PIECE if self.late else MOST_BYTES):
                self.script.lost = self.failed = self.done = True
                self.put('(error "unable: a command has no end within the limits, nothing behind it is read")')
                return
        if len(text) > PIECE and ends.depth:
            self.error(Failing(text, source)("unbalanced brackets: a '(' is never closed", 0))
        elif text.strip():
            self.execute(text, source, line, column)

    def execute(self, text: str, source: str, line: int = 0, column: int = 0) -> None:
        """Answer the command that is a text, which starts at this line and column (from 0) of ``source``."""
        fail = Failing(text, source, line, column)
        self.script.fail = fail
        self.begin()
        read = _READ.match(text)
        asserts = read is not None and read[1] == "assert"
        if self.late and read:  # what is asserted is not known any more
            self.script.lost |= asserts
            if self.options.get(":print-success") == "true":
                self.error(InputError("unable: time limit reached"))
            return
        try:
            if read and self.changed(text, fail):
                return
            commands = parse(text, fail)
        except InputError as error:
            self.script.lost |= asserts
            self.error(error)
            return
        for command in commands:
            self.answer(command, fail)
            if self.done:
                return

    def changed(self, text: str, fail: s.Fail) -> bool:
        """Whether what declares, defines or asserts is read without places, which takes half the time; where there is
        an error, it is read once more to see where."""
        try:
            (command,) = parse(text, fail, placed=False)
            if not self.script.change(cast(list[Expression], command)):
                return False
        except (InputError, Unable, RecursionError, ValueError):
            return False
        self.result = None
        if self.options.get(":print-success") == "true":
            self.put("success")
        return True

    def error(self, error: Exception) -> None:
        self.failed = True
        place = f"line {error.line} column {error.column}: " if isinstance(error, ParseError) and error.line else ""
        message = error.message if isinstance(error, ParseError) else str(error)
        self.put(f'(error "{place}{message}")'.replace("\n", " "))

    def answer(self, command: Expression, fail: s.Fail) -> None:
        """Carry out one command and print its answer."""
        try:
            self.script.fail = fail
            head = self.script.head(command)
            reply = self.reply(head, cast(list[Expression], command))
        except InputError as error:
            kept = self.script.keep(cast(list[Expression], command)) if command_name(command) else True
            self.script.lost |= not kept
            self.error(error)
        except (Unable, RecursionError) as error:
            self.script.lost |= command_name(command) == "assert"
            said = f"unable: {error}" if isinstance(error, Unable) else "the command is nested too deeply"
            self.error(InputError(said))
        else:
            if reply is not None:
                self.put(reply)
            elif self.options.get(":print-success") == "true":
                self.put("success")

    # --- commands --------------------------------------------------------------------------------------------
    def reply(self, head: str, command: list[Expression]) -> str | None:
        rest = command[1:]
        match head:
            case "check-sat":  # z3 takes assumptions behind it, too
                return self.assuming([*command[:1], rest]) if rest else self.check()
            case "check-sat-assuming":
                return self.assuming(command)
            case "check-sat-using":
                self.warn("check-sat-using: tactics are not used, the answer is that of check-sat")
                return self.check()
            case "push" | "pop":
                self.move(head, command)
            case "reset":
                self.options.clear()
                self.restart()
            case "reset-assertions":
                self.reset_assertions()
            case "set-logic" | "set-info":
                if [show(item) for item in rest[:1]] == [":status"]:
                    self.status = show(rest[1]) if len(rest) > 1 else ""
            case "set-option":
                self.options[_word(rest, 0)] = show(rest[1]) if len(rest) > 1 else "true"
            case "get-option":
                return self.options.get(_word(rest, 0), "unsupported")
            case "get-info":
                return self.info(_word(rest, 0))
            case "echo":
                return show(rest[0]) if rest else '""'
            case "exit":
                self.done = True
            case _:
                return self.question(head, command)
        return None

    def question(self, head: str, command: list[Expression]) -> str | None:
        match head:
            case "get-model":
                return self.model()
            case "get-value":
                return self.values(command)
            case "eval":
                self.script.arity(command, 1)
                return self.value(command[1], self.evaluation())
            case "get-assertions":
                return f"({' '.join(show(a.written) for a in self.script.assertions)})"
            case "get-unsat-core":
                return self.core()
            case "get-unsat-assumptions":
                return f"({' '.join(map(show, self.refuted(self.last('unsat').asked)))})"
            case "get-qe":
                return self.eliminated(command)
            case "get-objectives":
                return "\n".join(["(objectives", *(f" {line}" for line in self.last("sat").best), ")"])
            case "get-proof" | "get-assignment" | "get-qe-disjunct" | "simplify" | "apply":
                return "unsupported"
        if self.script.change(command):
            self.result = None
            return None
        return self.script.error(f"the command {head} is not supported", command)

    def move(self, head: str, command: list[Expression]) -> None:
        """``push`` and ``pop``."""
        number = command[1] if len(command) > 1 else "1"
        if not isinstance(number, str) or not number.isdigit() or int(number[:9]) > MOST_LEVELS:
            self.script.error("a number of levels expected", number)
        count = int(number)
        self.result = None
        if head == "push":
            self.script.push(count)
        else:
            self.script.pop(count, command)

    def reset_assertions(self) -> None:
        """Drop all levels and assertions; declarations stay only where they are global."""
        kept = self.script
        self.restart()
        if self.options.get(":global-declarations") == "true":
            kept.levels.clear()
            kept.assertions.clear()
            kept.lost = False
            self.script = kept

    def info(self, key: str) -> str:
        if key == ":reason-unknown":
            return f"(:reason-unknown {self.result.reason if self.result and self.result.reason else 'incomplete'})"
        if key == ":assertion-stack-levels":
            return f"(:assertion-stack-levels {len(self.script.levels)})"
        return f"({key} {_INFO[key]})" if key in _INFO else "unsupported"

    # --- checks ----------------------------------------------------------------------------------------------
    def check(self, extra: Sequence[s.Node] = (), asked: tuple[Expression, ...] = ()) -> str:
        nodes = [assertion.node for assertion in self.script.assertions]
        result = self.solved([*nodes, *extra])
        if result.answer == "sat" and self.script.lost:
            result = Result("unknown", "(an assertion was not understood)")
        if result.answer == "sat" and self.script.objectives:
            from qe.cli.smt_objectives import optimised  # and what optimises

            box = self.options.get(":opt.priority") == "box"
            result = optimised(self.script, result, [*nodes, *extra], self.left(), self.memory, box=box)
        self.result = result._replace(asked=asked)
        if {self.status, result.answer} == {"sat", "unsat"}:
            self.warn(f"the script says :status {self.status}, but the answer is {result.answer}")
        self.status = ""
        return result.answer

    def assuming(self, command: list[Expression]) -> str:
        self.script.arity(command, 1)
        literals = self.script.items(command[1], "a list of assumptions expected")
        nodes = [self.script.formula(item, self.script.globals) for item in literals]
        return self.check(nodes, tuple(literals))

    def last(self, answer: str) -> Result:
        """The last check, which must have had this answer."""
        if self.result is None or self.result.answer != answer:
            raise InputError("no model is at hand" if answer == "sat" else "no refutation is at hand")
        return self.result

    def core(self) -> str:
        """Named assertions that cannot hold together with the others and what was assumed; none can be left out."""
        assumed = [self.script.formula(item, self.script.globals) for item in self.last("unsat").asked]
        named = [(a.name, a.node) for a in self.script.assertions if a.name is not None]
        others = [*assumed, *(a.node for a in self.script.assertions if a.name is None)]
        return f"({' '.join(map(str, self.needed(named, others)))})"

    def refuted(self, asked: Sequence[Expression]) -> list[Expression]:
        """Assumptions that cannot hold together with the assertions; none of them can be left out."""
        assumed = [(item, self.script.formula(item, self.script.globals)) for item in asked]
        return self.needed(assumed, [a.node for a in self.script.assertions])

    def needed(self, parts: Sequence[tuple[Any, s.Node]], others: Sequence[s.Node]) -> list[Any]:
        """What names those of the parts, none of which can be left out, that contradict the others."""
        from qe.api.solver import needed

        kept = needed(parts, lambda some: self.solved([*others, *(node for _, node in some)]).answer == "unsat")
        return [name for name, _ in kept]

    # --- models ----------------------------------------------------------------------------------------------
    def evaluation(self) -> Evaluation:
        """Terms at the point of the last check."""
        from qe.cli.smt_values import Evaluation
        from qe.io.total import Fill, Total

        result = self.last("sat")
        if result.point is None:
            raise InputError("the formula is satisfiable, but no model was found")
        point = {**{name: Fraction(0) for _, name in self.script.constants.values()}, **result.point}
        total = result.total or Total()
        outside = total.at(point)

        def value(function: str, argument: Number) -> Number:
            if total.fill is Fill.ARGUMENT:
                return argument
            if total.fill is Fill.CONSTANT:
                return next((point[name] for name, (f, _) in total.values.items() if f == function), 0)
            return next((v for f, a, v in outside if f == function and a == argument), 0)

        return Evaluation(point, value)

    def model(self) -> str:
        from qe.cli.smt_values import written

        values = self.evaluation()
        lines = []
        for symbol, (sort, name) in self.script.constants.items():
            number = values.point.get(name, 0)
            shown = written(number) if sort == "Real" else ("true" if number > 0 else "false")
            lines.append(f"  (define-fun {symbol} () {sort} {shown})")
        return "\n".join(["(", *lines, ")"])

    def values(self, command: list[Expression]) -> str:
        self.script.arity(command, 1)
        terms, values = command[1], self.evaluation()
        if isinstance(terms, str) or not terms:
            self.script.error("a list of terms expected", terms)
        return f"({' '.join(f'({show(item)} {self.value(item, values)})' for item in terms)})"

    def value(self, item: Expression, values: Evaluation) -> str:
        """What a term, or a formula, is worth."""
        from qe.cli.smt_values import written

        meaning = self.script.meaning(item, self.script.globals)
        if is_real(meaning):
            return written(values.term(cast(s.Term, meaning)))
        return "true" if values.truth(cast(s.Node, meaning)) else "false"

    def eliminated(self, command: list[Expression]) -> str:
        """``get-qe``: an equivalent formula without quantifiers."""
        from qe.io.smtlib import term
        from qe.io.total import Total

        self.script.arity(command, 1)
        self.tick()
        asked = self.script.formula(command[1], self.script.globals)
        formula, total = self.formula([asked], Total(), self.left())
        answer = qe.eliminate(total.checked(formula), timeout=self.left(), memory=self.memory)
        if answer.formula is None:
            raise Unable(answer.reason or "no answer")
        symbols = {name: plain(symbol) for symbol, (_, name) in self.script.constants.items()}
        return term(answer.formula, symbols)


def command_name(command: Expression) -> str:
    """The first word of a command."""
    return command[0] if not isinstance(command, str) and command and isinstance(command[0], str) else ""


def _word(items: Sequence[Expression], k: int) -> str:
    if len(items) <= k or not isinstance(word := items[k], str):
        raise InputError("a keyword expected")
    return word


def run(script: str, *, timeout: float | None = None, memory: int | None = None, interactive: bool = False) -> int:
    """``qe smt``: the commands of a file, then (of ``-`` alone, or ``interactive``) of standard input; the status."""
    source = None if script == "-" else read_source(script, Format.SMTLIB)
    if source is not None and source.name == "<argument>":
        raise no_file(script)
    solver = Solver(
        lambda reply: print(reply, flush=True),
        lambda note: print(f"qe: {note}", file=sys.stderr, flush=True),
        timeout=timeout,
        memory=memory,
        each=interactive,
    )
    if source is not None:
        solver.run(_pieces(io.StringIO(source.text)), source.name)
    if (source is None or interactive) and not solver.done:
        solver.run(_pieces(sys.stdin), "<stdin>")
    return 2 if solver.failed else 0


def main() -> int:
    """``qe smt FILE``; returns the exit status."""
    from qe.cli.shell import guarded

    return guarded(partial(run, sys.argv[2]), sys.argv, name="qe")


def _pieces(stream: TextIO) -> Iterator[str]:
    """The lines, longer ones in pieces."""
    return iter(partial(stream.readline, PIECE), "")
