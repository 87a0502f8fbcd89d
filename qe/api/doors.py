"""What can be asked, said once: a Python function, a command, a word at the prompt and a row of docs/doors.md each,
with one name, the same keywords (``settings``) and defaults."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from qe.api.settings import Decision, Elimination, Limited, Optimisation, ProvedBlock, ProvedQuestion, Search

EXAMPLES = """
qe eliminate "ex x. x^2 + b*x + c = 0"
qe eliminate "ex x. a*x^2 + b*x + c < 0" --assuming "a > 0"
qe eliminate "all x. x^2 >= a*x" --explain
qe decide "all x. ex y. y^3 = x"
qe decide "a^2 > 0" --assuming "a > 0"
qe find "x^2 + y^2 < 1" -n 3
qe solve "x^2 + y^2 = 1 and x >= y" --variables x,y
qe region "x^2 + y^2 <= 4 and y >= x" --plot region.png
qe simplify "a*b > 0 or a < -1" --assuming "a > 0"
qe equivalent "a*b > 0" "b > 0" --assuming "a > 0"
qe witnesses "ex x. a*x = b"
qe minimize "x + y" "x^2 + y^2 <= 1"
qe maximize "x + y" "x^2 + y^2 <= 1"
qe optimum "x*y" "x^2 + y^2 <= 1"
qe verify c.json --formula "ex x. x^2 = a"
"""


@dataclass(frozen=True, slots=True)
class Door:
    """``says``: what is answered; ``line``: what follows the word at the prompt. ``words``: older names at the prompt;
    ``also``: older names in Python; ``certified``: whether an answer has a certificate of its own to be written."""

    name: str
    settings: type
    says: str
    line: str = "FORMULA"
    words: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    certified: bool = True

    @property
    def examples(self) -> tuple[str, ...]:
        """Command lines."""
        return tuple(line for line in EXAMPLES.splitlines() if line.startswith(f"qe {self.name} "))


POINTS, TERM = ("find_instance", "find_instances"), "TERM [: FORMULA]"
_LISTED = (
    Door("eliminate", Elimination, "A quantifier-free formula equivalent to FORMULA."),
    Door("decide", Decision, "Whether a sentence is true, a script satisfiable."),
    Door("find", ProvedQuestion, "Exact points that satisfy FORMULA.", "[N:] FORMULA", ("instance",), POINTS, False),
    Door("solve", ProvedQuestion, "All solutions of FORMULA, case by case.", "[x, y:] FORMULA", also=("reduce",)),
    Door("region", ProvedQuestion, "The set of points that satisfy FORMULA."),
    Door("simplify", ProvedQuestion, "A formula as short as it gets."),
    Door("equivalent", Search, "Whether two formulas are equivalent.", "FORMULA ; FORMULA"),
    Door("witnesses", ProvedBlock, "Solutions as terms in the parameters.", also=("parametric_witnesses",)),
    Door("minimize", Optimisation, "The exact least value under CONSTRAINTS.", TERM, ("min",)),
    Door("maximize", Optimisation, "The exact greatest value under CONSTRAINTS.", TERM, ("max",)),
    Door("optimum", Optimisation, "The least and the greatest value under CONSTRAINTS.", TERM, certified=False),
    Door("verify", Limited, "Verify a certificate.", "FILE"),
)
DOORS: Mapping[str, Door] = {door.name: door for door in _LISTED}
