"""The engine against z3 alone, on as many random problems as asked: ``python -m tests.differential.against_z3 100000``.

A second number is where to start, a third argument the family (``FAMILIES``): formulas, alternations of quantifiers, or
scripts, which both are given as they are. A formula with free variables is compared at one random point, which z3 is
given and the engine's answer, too. Blocks of problems run in processes of their own, since a call of z3 may not end at
its limit.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Callable
from multiprocessing import get_context
from multiprocessing.connection import Connection

from experiments import z3_oracle
from qe.engine.run import solve
from qe.errors import Unable
from qe.formula.evaluate import holds_at
from qe.formula.syntax import TRUE, Constant, Formula
from qe.options import Budget, Options
from tests.differential import scripts
from tests.differential.generate import (
    LARGE,
    NESTED,
    SMALL,
    at_point,
    random_alternation,
    random_formula,
    random_point,
)

ENGINE_SECONDS, Z3_SECONDS, BLOCK, BLOCK_SECONDS = 2.0, 0.25, 100, 120.0


def verdict(seed: str) -> str:
    """What came of the random problem of this seed, ``FAMILY NUMBER``: agree, wrong, or who has no answer."""
    return FAMILIES[seed.split()[0]](random.Random(seed))


def _formula(rng: random.Random) -> str:
    return _at_a_point(rng, random_formula(rng, rng.choice((*SMALL, *NESTED, *LARGE))))


def _alternation(rng: random.Random) -> str:
    return _at_a_point(rng, random_alternation(rng))


def _script(make: Callable[[random.Random], str]) -> Callable[[random.Random], str]:
    return lambda rng: scripts.verdict(make(rng), seconds=ENGINE_SECONDS, z3_seconds=Z3_SECONDS)


FAMILIES: dict[str, Callable[[random.Random], str]] = {
    "z3": _formula,
    "alternations": _alternation,
    "linear": _script(scripts.linear_script),
    "local": _script(scripts.local_script),
    "terms": _script(scripts.term_script),
    "levels": _script(scripts.level_script),
    "sharing": _script(scripts.sharing_script),
}


def _at_a_point(rng: random.Random, formula: Formula) -> str:
    point = random_point(rng, formula)
    try:
        answer = solve(formula, Options(), Budget(ENGINE_SECONDS)).formula
    except Unable:
        return "engine unable"
    ours = answer == TRUE if isinstance(answer, Constant) else holds_at(answer, point)
    sentence = at_point(formula, point)
    theirs = sentence.value if isinstance(sentence, Constant) else z3_oracle.decide(sentence, seconds=Z3_SECONDS)
    if theirs is None:
        return "z3 unknown"
    return "agree" if ours == theirs else "wrong"


def _block(seeds: list[str], out: Connection) -> None:
    for seed in seeds:
        out.send((seed, verdict(seed)))
    out.close()


def block(seeds: list[str]) -> tuple[Counter[str], list[str]]:
    """How often each verdict came, and the seeds of wrong answers and of an error of the engine."""
    receive, send = get_context("fork").Pipe(duplex=False)
    child = get_context("fork").Process(target=_block, args=(seeds, send))
    child.start()
    send.close()
    counts: Counter[str] = Counter()
    wrong = []
    try:
        while receive.poll(BLOCK_SECONDS):
            seed, found = receive.recv()
            counts[found] += 1
            wrong += [seed] if found == "wrong" else []
    except EOFError:
        child.join(60)
        if child.exitcode == 1:  # an error of the engine; a signal would be one of z3
            wrong.append(seeds[counts.total()])
    child.kill()
    child.join(60)
    counts["not reached"] = len(seeds) - counts.total()
    return counts, wrong


def main(count: int, start: int = 0, family: str = "z3") -> int:
    total: Counter[str] = Counter()
    wrong: list[str] = []
    for first in range(start, start + count, BLOCK):
        counts, bad = block([f"{family} {i}" for i in range(first, min(first + BLOCK, start + count))])
        total += counts
        wrong += bad
        print(first + BLOCK - start, dict(total), *wrong, flush=True)
    return len(wrong)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int((sys.argv[2:3] or ["0"])[0]), (sys.argv[3:4] or ["z3"])[0]))
