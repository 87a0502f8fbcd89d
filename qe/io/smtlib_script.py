"""The state of an SMT-LIB script: declarations, definitions and assertions, on the levels of ``push`` and ``pop``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from qe.errors import InputError, Unable
from qe.io import surface as s
from qe.io.smtlib_parser import Expression, place, plain
from qe.io.smtlib_terms import Terms
from qe.io.smtlib_words import Foreign, Macro, is_real

if TYPE_CHECKING:
    from qe.formula.syntax import Formula
    from qe.io.total import Total


class Assertion(NamedTuple):
    """What is asserted, as it was written, and its ``:named`` name."""

    node: s.Node
    written: Expression
    name: str | None


class Objective(NamedTuple):
    """A term of which the least value is wanted, or the greatest; as it was written."""

    least: bool
    term: s.Term
    written: Expression


_KEPT = ("globals", "constants", "names", "shared", "assertions", "objectives", "lost")
"""What there was when ``push`` was said comes back."""


class Script(Terms):
    """``constants``: sort and name in formulas of every declared symbol, in order. ``assertions``: what holds;
    ``lost``: whether something was asserted that is not among them."""

    def __init__(self, fail: s.Fail, tick: Callable[[], None] = lambda: None) -> None:
        super().__init__(fail, tick)
        self.constants: dict[str, tuple[str, str]] = {}
        self.assertions: list[Assertion] = []
        self.objectives: list[Objective] = []
        self.levels: list[dict[str, Any]] = []
        self.lost = False

    def head(self, command: Expression) -> str:
        """The name of a command."""
        if isinstance(command, str) or not command or not isinstance(command[0], str):
            self.error("a command in brackets expected", command)
        return command[0]

    def change(self, command: list[Expression]) -> bool:
        """Carry out a command that declares, defines or asserts; whether it is one."""
        head, *rest = command
        self.steps = self.pause = 0
        match head:
            case "assert":
                self.arity(command, 1)
                self.assertions.append(Assertion(self.formula(rest[0], self.globals), rest[0], _label(rest[0])))
            case "minimize" | "maximize":
                if not rest or not is_real(meaning := self.meaning(rest[0], self.globals)):
                    self.error(f"{head}: a term over the reals expected", command)
                self.objectives.append(Objective(head == "minimize", cast(s.Term, meaning), rest[0]))
            case "declare-const":
                self.arity(command, 2)
                self.declare(rest[0], rest[1])
            case "declare-fun":
                self.arity(command, 3)
                if rest[1] != []:
                    self.error("only functions without arguments can be declared", rest[1])
                self.declare(rest[0], rest[2])
            case "define-const":
                self.arity(command, 3)
                self.define(rest[0], [], rest[1], rest[2])
            case "define-fun":
                self.arity(command, 4)
                self.define(rest[0], self.parameters(rest[1]), rest[2], rest[3])
            case "define-fun-rec" | "define-funs-rec":
                self.error("recursive functions are not supported", head)
            case "define-sort" if len(rest) == 3 and rest[1] == []:
                self.sorts[self.symbol(rest[0])] = self.sort(rest[2])
            case "declare-sort" | "declare-datatype" | "declare-datatypes" | "define-sort":
                self.error("only the sorts Real and Bool are supported", head)
            case _:
                return False
        return True

    def keep(self, command: list[Expression]) -> bool:
        """What is left of a command that was not read (a declared symbol has some value, and so has a term that is not
        understood); whether all that it asserts is kept."""
        match command:
            case ["declare-const" | "declare-fun", str(symbol), *_, sort] if symbol not in self.globals:
                if sort in ("Real", "Int", "Bool"):
                    self.globals[symbol] = Foreign("Bool" if sort == "Bool" else "Real")
            case ["assert" | "define-fun" | "define-const", *_]:
                self.lenient = True
                try:
                    self.change(command)
                except InputError:
                    return False
                finally:
                    self.lenient = False
        return True

    def declare(self, name: Expression, sort: Expression) -> None:
        symbol, kind = self.symbol(name), self.sort(sort)
        self.fresh_global(symbol, name)
        self.reserved.discard(plain(symbol))
        inside = self.fresh(symbol)
        self.constants[symbol] = kind, inside
        self.globals[symbol] = self.variable(inside, kind, place(name))

    def reserve(self, command: list[Expression]) -> None:
        """Keep the name that a later declaration needs, so that no bound variable takes it."""
        if len(command) > 1 and isinstance(command[1], str):
            self.reserved.add(plain(command[1]))

    def define(self, name: Expression, parameters: list[tuple[str, str]], sort: Expression, body: Expression) -> None:
        symbol = self.symbol(name)
        self.fresh_global(symbol, name)
        wanted = self.sort(sort)
        if parameters:
            self.globals[symbol] = Macro(parameters, wanted, body, dict(self.globals))
        else:
            self.globals[symbol] = self.share(self.expect(self.meaning(body, self.globals), wanted, body))

    def fresh_global(self, symbol: str, at: Expression) -> None:
        if symbol in self.globals:
            self.error(f"{plain(symbol)} is declared twice", at)

    # --- levels ----------------------------------------------------------------------------------------------
    def push(self, count: int) -> None:
        """Remember the state, ``count`` times."""
        self.levels += [{name: copy(getattr(self, name)) for name in _KEPT}] * count

    def pop(self, count: int, at: Expression) -> None:
        """Go back to the state before the last ``count`` levels."""
        if count > len(self.levels):
            self.error(f"pop {count}, but there are only {len(self.levels)} levels", at)
        if count:
            vars(self).update({name: copy(value) for name, value in self.levels[-count].items()})
            del self.levels[-count:]
        self.taken = {*self.names}
        kept = set(map(id, self.shared))
        self.forms = {form: part for form, part in self.forms.items() if id(part) in kept}
        self.expanded.clear()
        self.fixed.intersection_update(self.names)
        self.varying.intersection_update(self.names)

    # --- questions -------------------------------------------------------------------------------------------
    def formula_of(self, nodes: Sequence[s.Node], total: Total) -> Formula:
        """The conjunction of the nodes, with names, which are quantified, for what would be written out many times;
        ``total`` is told about functions outside their domains. Raises ``Unable`` where it is much too long."""
        from qe.formula.build import exists
        from qe.io.sharing import named

        new = (name for k in count(1) if (name := f"part_{k}") not in self.taken)
        known = named(nodes, self.shared, self.bound, lambda: next(new))
        nodes = [*known.definitions, *known.nodes]
        return exists(known.names, self.lowered(nodes, total, [*self.names, *known.names], known.shared))

    def lowered(self, nodes: Sequence[s.Node], total: Total, names: Sequence[str], shared: Sequence[s.Part]) -> Formula:
        from qe.io.lowering import lower

        total.bound = frozenset(self.bound)
        return lower(s.Every(list(nodes)), self.fail, names=names, shared=shared, total=total)

    def used(self, nodes: Sequence[s.Node]) -> list[s.Part]:
        """The shared parts that the nodes contain, in their order."""
        from qe.io.sharing import ordered

        contained = set(map(id, ordered(nodes)))
        return [part for part in self.shared if id(part) in contained]

    def whole(self) -> Formula:
        """The conjunction of all assertions, with quantifiers in it only if there were some or it is too long without.
        Raises where a value outside a domain cannot be written down."""
        from qe.io.total import Fill, Total

        total, nodes = Total(fill=Fill.ANY), [a.node for a in self.assertions]
        try:
            formula = self.lowered(nodes, total, self.names, self.shared)
        except Unable:  # too long without names
            formula = self.formula_of(nodes, total)
        return total.checked(formula)


def _label(written: Expression) -> str | None:
    """The ``:named`` name of an assertion."""
    if not isinstance(written, str) and written[:1] == ["!"]:
        for key, value in zip(written[2::2], written[3::2]):
            if key == ":named" and isinstance(value, str):
                return str(value)
    return None
