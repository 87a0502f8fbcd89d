"""What can be asked, said once: a Python function, a command, a word at the prompt and a row of docs/doors.md each.

All four have the name of the row, take the same keywords (``settings``) with the same defaults, and say the same of
themselves. ``words``: older names at the prompt; ``also``: older names in Python.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from qe.api.settings import (
    Decision,
    Elimination,
    Limited,
    Optimisation,
    ProvedBlock,
    ProvedQuestion,
    Search,
)


@dataclass(frozen=True, slots=True)
class Door:
    """``says``: what is answered; ``line``: what follows the word at the prompt; ``examples``: command lines."""

    name: str
    settings: type
    says: str
    line: str
    examples: tuple[str, ...]
    words: tuple[str, ...] = ()
    also: tuple[str, ...] = ()


DOORS: Mapping[str, Door] = {
    door.name: door
    for door in (
        Door(
            "eliminate",
            Elimination,
            "A quantifier-free formula equivalent to FORMULA.",
            "FORMULA",
            (
                'qe eliminate "ex x. x^2 + b*x + c = 0"',
                'qe eliminate "ex x. a*x^2 + b*x + c < 0" --assuming "a > 0"',
                'qe eliminate "all x. x^2 >= a*x" --explain',
            ),
        ),
        Door(
            "decide",
            Decision,
            "Whether a sentence is true, a script satisfiable.",
            "FORMULA",
            ('qe decide "all x. ex y. y^3 = x"', 'qe decide "a^2 > 0" --assuming "a > 0"'),
        ),
        Door(
            "find",
            ProvedQuestion,
            "Exact points that satisfy FORMULA, one or more.",
            "[N:] FORMULA",
            ('qe find "x^2 = 2 and x > 0"', 'qe find "x^2 + y^2 < 1" -n 3'),
            ("instance",),
            ("find_instance", "find_instances"),
        ),
        Door(
            "solve",
            ProvedQuestion,
            "All solutions of FORMULA, case by case.",
            "[x, y:] FORMULA",
            ('qe solve "x^2 + y^2 = 1 and x >= y" --variables x,y',),
            also=("reduce",),
        ),
        Door(
            "region",
            ProvedQuestion,
            "The set of points that satisfy FORMULA.",
            "FORMULA",
            ('qe region "x^2 + y^2 <= 4 and y >= x" --plot region.png',),
        ),
        Door(
            "simplify",
            ProvedQuestion,
            "A formula as short as it gets.",
            "FORMULA",
            ('qe simplify "a*b > 0 or a < -1" --assuming "a > 0"',),
        ),
        Door(
            "equivalent",
            Search,
            "Whether two formulas say the same.",
            "FORMULA ; FORMULA",
            ('qe equivalent "a*b > 0" "b > 0" --assuming "a > 0"',),
        ),
        Door(
            "witnesses",
            ProvedBlock,
            "Solutions as terms in the parameters.",
            "FORMULA",
            ('qe witnesses "ex x. a*x = b"',),
            also=("parametric_witnesses",),
        ),
        Door(
            "minimize",
            Optimisation,
            "The exact least value under CONSTRAINTS.",
            "TERM [: FORMULA]",
            ('qe minimize "x + y" "x^2 + y^2 <= 1"',),
            ("min",),
        ),
        Door(
            "maximize",
            Optimisation,
            "The exact greatest value under CONSTRAINTS.",
            "TERM [: FORMULA]",
            ('qe maximize "x + y" "x^2 + y^2 <= 1"',),
            ("max",),
        ),
        Door(
            "optimum",
            Optimisation,
            "The least and the greatest value under CONSTRAINTS.",
            "TERM [: FORMULA]",
            ('qe optimum "x*y" "x^2 + y^2 <= 1"',),
        ),
        Door(
            "verify",
            Limited,
            "Verify a certificate.",
            "FILE",
            ('qe eliminate "ex x. x^2 = a" --certificate c.json', "qe verify c.json"),
        ),
    )
}


def table_of_doors() -> str:
    """All doors as a table in Markdown."""
    rows = [
        f"| {d.says.replace('FORMULA', 'a formula').replace('CONSTRAINTS', 'constraints')} "
        f"| `qe.{d.name}`{''.join(f', `qe.{name}`' for name in d.also)} | `qe {d.name}` "
        f"| `:{d.name} {d.line}` |"
        for d in DOORS.values()
    ]
    return "\n".join(["| what | Python | command | at the prompt |", "|---|---|---|---|", *rows])
