"""Variable names across formats: which are possible at all, and injective renaming where a format keeps some."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from qe.arguments import names, wrong
from qe.errors import InputError
from qe.formula.syntax import Atom, Formula
from qe.formula.traverse import atoms, bound_variables
from qe.spelling import NUMBERS, quoted

_FORBIDDEN = re.compile(r"[|\\\ud800-\udfff]")


def check_name(name: object) -> str:
    """The name, if every format can carry it: not empty, no bar, no backslash, no half of a surrogate pair. Raises
    ``InputError`` for anything else."""
    if not isinstance(name, str):
        raise wrong("name", "the name of a variable", name)
    if not name or _FORBIDDEN.search(name):
        reason = "it holds a bar, a backslash or half a character" if name else "it is empty"
        raise InputError(f"{name!r} cannot be the name of a variable: {reason}")
    if name in NUMBERS:
        raise InputError(f"{name} cannot be the name of a variable: it is a number")
    return name


def refuse_numbers(names: Iterable[str]) -> None:
    """Raises ``InputError`` where one of the names stands for a number that is not algebraic."""
    if found := [quoted(name) for name in names if name in NUMBERS]:
        hint = 'put a variable in its place, with bounds for it in assuming: "3.14159 < p < 3.1416"'
        taking = "eliminate, decide, equivalent, simplify, solve and the optima take it"
        raise InputError(f"{found[0]} is not algebraic: {taking}; elsewhere {hint}")


def bound_names(variables: object) -> tuple[str, ...]:
    """The names that a quantifier binds. Raises ``InputError`` for what gives none."""
    bound = names(variables, "variables")
    if not bound:
        raise InputError("variables: a quantifier needs at least one variable")
    return tuple(map(check_name, bound))


def renaming(
    formula: Formula, *, keeps: Callable[[str], bool], spell: Callable[[str], str], filler: str = "_"
) -> dict[str, str]:
    """An injective map from the names of a formula to names that a format allows: those that it ``keeps``, and others
    as ``spell`` writes them, with as many ``filler`` letters as it takes to be allowed and new."""
    names = names_in(formula)
    new_names = {name: name for name in names if keeps(name)}
    used = set(new_names)
    for name in names:
        if name not in new_names:
            new = spell(name)
            while not keeps(new) or new in used:
                new += filler
            new_names[name] = new
            used.add(new)
    return new_names


def names_in(formula: Formula) -> list[str]:
    """Every name of a formula: those of its ring, and those that only quantifiers and root atoms mention."""
    ring = formula.ring
    names = dict.fromkeys(ring.names if ring is not None else ())
    names.update(dict.fromkeys(a.variable for a in atoms(formula) if not isinstance(a, Atom)))
    names.update(dict.fromkeys(bound_variables(formula)))
    return list(names)
