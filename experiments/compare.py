"""Are two answers equivalent? Decided by z3 where it can, probed at rational points where it cannot.

``python -m experiments.compare`` reads one JSON object with ``answer``, ``expected`` and optionally ``assume`` (all in
the text syntax) from standard input and prints the verdict. It is a program of its own so that a caller can
kill it: z3's time limit is not always kept.
"""

from __future__ import annotations

import json
import random
import sys
from enum import Enum
from fractions import Fraction

from experiments.z3_oracle import to_z3
from qe.formula.build import conj, implies, neg
from qe.formula.evaluate import holds_at
from qe.formula.syntax import Constant, Formula
from qe.io.text import CONSTANTS, read

POINTS = 400


class Verdict(Enum):
    """Outcome of a comparison; PROBED: no difference at many rational points, but no proof either."""

    EQUIVALENT = "equivalent"
    PROBED = "probed"
    DIFFERENT = "different"


def compare(answer: str, expected: str, assume: str | None = None, *, seconds: float = 10.0) -> Verdict:
    """Whether the answer is equivalent to the expected one, under the assumption if there is one."""
    # One text, so that both formulas come out over one polynomial ring.
    pieces = [f"({text})" for text in (answer, expected, assume or "true")]
    left, right, given = (read(piece, known=CONSTANTS) for piece in pieces)
    left, right = _in_one_ring(left, right, given)
    if isinstance(left, Constant) and isinstance(right, Constant):
        return Verdict.EQUIVALENT if left == right else Verdict.DIFFERENT
    proved = all(_implication(f, g, seconds) for f, g in ((left, right), (right, left)))
    if proved:
        return Verdict.EQUIVALENT
    return Verdict.DIFFERENT if differing_point(left, right, seconds=seconds) is not None else Verdict.PROBED


def _in_one_ring(left: Formula, right: Formula, given: Formula) -> tuple[Formula, Formula]:
    from qe.exact.ring import Ring
    from qe.formula.build import convert

    names = tuple(dict.fromkeys(name for f in (left, right, given) for name in f.free))
    ring = Ring.of(names)
    left, right, given = (convert(f, ring) for f in (left, right, given))
    return implies(given, left), implies(given, right)


def _implication(left: Formula, right: Formula, seconds: float) -> bool:
    """Whether z3 proves the implication."""
    import z3

    solver = z3.Tactic("qfnra-nlsat").solver()
    solver.set("timeout", int(1000 * seconds))
    try:
        solver.add(to_z3(left), z3.Not(to_z3(right)))
        return bool(solver.check() == z3.unsat)
    except z3.Z3Exception:
        return False


def differing_point(
    left: Formula, right: Formula, *, seed: int = 1, seconds: float = 10.0
) -> dict[str, Fraction] | None:
    """A rational point where exactly one of two quantifier-free formulas holds, if one is found.

    z3's model is tried first (a candidate, confirmed by exact evaluation), then random points.
    """
    if not (left.is_quantifier_free and right.is_quantifier_free):
        return None
    names = tuple(dict.fromkeys((*left.free, *right.free)))
    rng = random.Random(seed)
    candidates = [point for f, g in ((left, right), (right, left)) for point in _models(f, g, names, seconds)]
    scales = (1, 3, 10, 40)
    candidates += [
        {n: Fraction(rng.randint(-6 * s, 6 * s), s) for n in names} for s in scales for _ in range(POINTS // 4)
    ]
    for point in candidates:
        if holds_at(left, point) != holds_at(right, point):
            return point
    return None


def _models(left: Formula, right: Formula, names: tuple[str, ...], seconds: float) -> list[dict[str, Fraction]]:
    import z3

    solver = z3.Tactic("qfnra-nlsat").solver()
    solver.set("timeout", int(1000 * seconds))
    try:
        solver.add(to_z3(conj((left, neg(right)))))
        if solver.check() != z3.sat:
            return []
        model = solver.model()
    except z3.Z3Exception:
        return []
    point = {}
    for name in names:
        value = model.eval(z3.Real(name), model_completion=True)
        if z3.is_algebraic_value(value):
            value = value.approx(20)
        if not z3.is_rational_value(value):
            return []
        point[name] = Fraction(value.numerator_as_long(), value.denominator_as_long())
    return [point]


def main() -> None:
    """Read a comparison from standard input, print the verdict."""
    task = json.load(sys.stdin)
    print(compare(task["answer"], task["expected"], task.get("assume")).value)


if __name__ == "__main__":
    main()
