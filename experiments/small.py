"""Small eliminations, many in one process: what a question costs beyond its mathematics. ``experiments small``.

Five families of one quantified variable and two or three parameters, seeded: two linear conditions, a quadratic with
two conditions at most, two quadratics, a cubic, and a Boolean combination. Seconds are of processor time and hold
reading the text, the elimination and nothing of the start. All work is done in this process: what a long question costs
a worker would not be counted.
"""

from __future__ import annotations

import gc
import random
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import qe

SEED = 11
RELATIONS = ("<", "<=", "=", "/=", ">", ">=")
LETTERS = ("a", "b", "c")


@dataclass(frozen=True, slots=True)
class Family:
    """The questions of one family: seconds of all, characters of all answers, the slowest question with its seconds."""

    name: str
    count: int
    seconds: float
    characters: int
    slowest: tuple[float, str]

    def __str__(self) -> str:
        each = 1000 * self.seconds / self.count
        seconds, text = self.slowest
        return f"{self.name:15} {self.seconds:6.2f} s  {each:6.2f} ms each  {self.characters:7d} characters  " + (
            f"slowest {1000 * seconds:.0f} ms: {text}"
        )


def measured(count: int, names: list[str] | None = None) -> Iterator[Family]:
    """Each family, with so many questions."""
    qe.eliminate("ex x. x^2 + a*x + 1 = 0 and x < a", process=False)  # loads what is loaded with the first question
    for name in names or FAMILIES:
        texts = questions(name, count)
        gc.collect()
        times, characters = [], 0
        for text in texts:
            start = time.process_time()
            answer = qe.eliminate(text, process=False)
            times.append(time.process_time() - start)
            characters += len(str(answer.formula))
        yield Family(name, count, sum(times), characters, max(zip(times, texts, strict=True)))


def questions(name: str, count: int) -> list[str]:
    """The first questions of a family; the same at every call."""
    rng = random.Random(f"{SEED} {name}")
    return [f"ex x. {FAMILIES[name](rng)}" for _ in range(count)]


def _number(rng: random.Random) -> int:
    return rng.choice((-3, -2, -1, 1, 2, 3))


def _coefficient(rng: random.Random) -> str:
    """A number, a letter, or a letter with numbers."""
    kind = rng.randrange(3)
    if kind == 0:
        return f"({_number(rng)})"
    letter = rng.choice(LETTERS[:2])
    return letter if kind == 1 else f"({_number(rng)}*{letter} + {_number(rng)})"


def _polynomial(rng: random.Random, degree: int) -> str:
    """A polynomial in x of that degree whose leading coefficient is a number or a letter."""
    leading = rng.choice((*LETTERS[:2], "1", "2"))
    lower = [f"{_coefficient(rng)}*x^{k}" for k in range(degree - 1, 0, -1) if rng.random() < 0.7]
    return " + ".join([f"{leading}*x^{degree}", *lower, rng.choice((*LETTERS, _coefficient(rng)))])


def _atom(rng: random.Random, degree: int) -> str:
    return f"{_polynomial(rng, degree)} {rng.choice(RELATIONS)} 0"


def _linear(rng: random.Random) -> str:
    return f"{_atom(rng, 1)} and {_atom(rng, 1)}"


def _quadratic(rng: random.Random) -> str:
    bounds = ["x > 0", "x < 1", f"x >= {rng.choice(LETTERS)}"]
    return " and ".join([_atom(rng, 2), *rng.sample(bounds, rng.randrange(3))])


def _two_quadratics(rng: random.Random) -> str:
    return f"{_atom(rng, 2)} and {_atom(rng, 2)}"


def _cubic(rng: random.Random) -> str:
    lower = [f"{_number(rng)}*x^2", f"{rng.choice(LETTERS)}*x", rng.choice(LETTERS)]
    cubic = " + ".join(["x^3", *rng.sample(lower, 2)])
    return f"{cubic} {rng.choice(RELATIONS)} 0" + rng.choice(("", " and x > 0", " and x < 1"))


def _boolean(rng: random.Random) -> str:
    return f"({_atom(rng, 1)} or {_atom(rng, 2)}) and ({_atom(rng, 1)} or {_atom(rng, 1)})"


FAMILIES: dict[str, Callable[[random.Random], str]] = {
    "linear": _linear,
    "quadratic": _quadratic,
    "two quadratics": _two_quadratics,
    "cubic": _cubic,
    "Boolean": _boolean,
}
