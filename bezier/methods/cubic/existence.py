"""The existence theorem of formula (7), asked of the engine, and what its witness means.

THEOREM (found by the engine): for all Q0, R0 and r with |Q0| <= r and |R0| <= r, formula (7) has a solution (Q1, Q2).
Its witness is Q1 = Q0, Q2 = R0, whose path stops and turns round at both joins (``cubic.formula.trivial_choice``): so
a plan needs the objective or a least speed, and existence alone says nothing about a usable path.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import qe
from bezier.methods.control import statements as st
from bezier.methods.control.system import coordinates
from bezier.methods.cubic import formula as cubic

GIVEN = ("Q0", "R0")


@dataclass(frozen=True, slots=True)
class Existence:
    """The sentence, the engine's verdict (None: not reached), and the witness it found: terms in the parameters."""

    sentence: str
    truth: bool | None
    witness: str
    answer: Any = field(default=None, compare=False, repr=False)
    """The engine's, None where it was not asked."""


def question() -> st.Statement:
    """For all Q0, R0, r with |Q0|, |R0| <= r there are Q1, Q2 that satisfy formula (7) as printed."""
    shape, radius = cubic.shape(), st.name("r")
    parameters = [name for point in GIVEN for name in coordinates(point)]
    inside = [st.at_most(st.squares(st.names(coordinates(point))), st.power(radius, 2)) for point in GIVEN]
    given = st.every(*inside, st.at_least(radius, st.number(0)))
    return st.for_all([*parameters, "r"], st.implies(given, st.exists(shape.variables, shape.symbolic())))


def sentence() -> str:
    """The same as text."""
    return str(question())


def trivial_witness() -> dict[str, str]:
    """Q1 = Q0 and Q2 = R0, by variables: what ``qe.check_witness`` accepts for ``sentence``."""
    pairs = zip(cubic.shape().free, GIVEN, strict=True)
    return {v: w for free, given in pairs for v, w in zip(coordinates(free), coordinates(given), strict=True)}


def existence(*, timeout: float | None = None) -> Existence:
    """Ask the engine."""
    statement = question()
    answer = qe.eliminate(statement.formula, timeout=timeout)
    witness = next((line for line in answer.stats.get("plan", ()) if line.startswith(WITNESS)), "")
    return Existence(str(statement), answer.truth, witness.removeprefix(WITNESS), answer)


WITNESS = "witness in the parameters: "
"""How the engine's story begins the line with a witness."""
