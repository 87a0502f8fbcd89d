"""Linear conditions decided by a proposed basis, made exact: a point that keeps them, or weights that refute them.

Applegate, Cook, Dash, Espinoza 2007 (QSopt_ex). First all inequalities get a common slack t: where it can be positive,
a rounded point will do; where it is negative, the multipliers contradict; where it is 0, only strict ones get a slack.
In sparse systems these come first, where there are none no slack: vertices cost little there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import frexp, isfinite

from qe.convex.highs import Proposal, Proposer, Slackened, highs
from qe.convex.linear_rows import LinearRows
from qe.exact.sparse_solve import solve_sparse, whole_multiples

_ROUNDED = (0, 3, 10, 20, 40)
"""Binary digits after the point that are tried for a point with room to spare."""

_CLOSEST = 1 << 100
"""How much larger differences from a vertex are asked for, at most."""

_TINY, _DIGITS = 1e-9, 30
"""What counts as zero: a slack; a multiple of a row, so many binary digits shorter than the longest."""

_PART, _WHOLE, _NEARLY, _NOISE = 5_000, 10_000_000, 1e-5, 1e-10
"""A number may be whole times a small part of the least, all times a larger one; how nearly, and in proportion."""


@dataclass(frozen=True, slots=True)
class Refutation:
    """Multipliers of rows by Farkas's lemma (``LinearRows.refuted_by``)."""

    weights: Mapping[int, int]


def decided(
    system: LinearRows, seconds: Callable[[], float | None], propose: Proposer = highs
) -> tuple[Fraction, ...] | Refutation | None:
    """A point of all rows or their contradiction, checked exactly; None where the proposals do not lead to either.

    ``seconds``: how many are left, asked between steps.
    """
    inequalities = [i for i, row in enumerate(system.rows) if not row.is_equation]
    strict = [i for i in inequalities if system.rows[i].is_strict]
    for slack in map(frozenset, (strict, inequalities) if system.is_sparse else (inequalities, strict)):
        scales = [max(map(abs, row.terms.values())) if i in slack else 0 for i, row in enumerate(system.rows)]
        problem = Slackened(system, scales)
        while True:
            try:
                proposal = propose(problem, seconds())
            except OverflowError:
                return None
            if proposal is None:
                break
            seconds()
            outcome = _rounded(problem, proposal) or _refutation(problem, proposal)
            if outcome is not None:
                return outcome
            vertex = _vertex(problem, proposal)
            if vertex is not None and system.holds(vertex[:-1]):
                return vertex[:-1]
            if vertex is None or problem.zoom >= _CLOSEST:
                break
            problem = replace(problem, centre=vertex, zoom=problem.zoom << 20)  # floats took that for a solution
            if problem.is_solved:
                break
    return None


def _rounded(problem: Slackened, proposal: Proposal) -> tuple[Fraction, ...] | None:
    """The point in few digits, where all rows have a slack."""
    if proposal.ray or not all(map(isfinite, proposal.point)):
        return None
    above = proposal.point[problem.size] / problem.zoom + (problem.centre[-1] if problem.centre else 0)
    if above <= 0 or any(row.is_equation for row in problem.system.rows):
        return None
    exact = [Fraction(v) / problem.zoom for v in proposal.point[: problem.size]]
    if problem.centre:
        exact = [c + v for c, v in zip(problem.centre, exact)]
    for digits in (*_ROUNDED, problem.zoom.bit_length() + 40):
        unit = 1 << digits
        point = tuple(Fraction(round(v * unit), unit) for v in exact)
        if problem.system.holds(point):
            return point
    return None


def _refutation(problem: Slackened, proposal: Proposal) -> Refutation | None:
    """The multipliers of the rows, from those that are not zero in floats."""
    rows = problem.system.rows
    given = {i: w for i, w in enumerate(proposal.multipliers) if w}
    sizes = {i: frexp(w)[1] + max(map(abs, rows[i].terms.values())).bit_length() for i, w in given.items()}
    longest = max(sizes.values(), default=0)
    support = [i for i, size in sizes.items() if size > longest - _DIGITS]
    weights = proportions({i: proposal.multipliers[i] for i in support})
    for kept in (weights, {i: -w for i, w in weights.items()}):  # the multipliers of a greatest t are negative
        if kept and problem.system.refuted_by(kept):
            return Refutation(kept)
    if not proposal.ray and proposal.point[problem.size] > _TINY and not problem.centre:
        return None
    equations: dict[int, dict[int, int]] = {}
    for k, i in enumerate(support):
        for j, c in (rows[i].terms if proposal.ray else problem.terms(i)).items():
            equations.setdefault(j, {})[k] = c
    if proposal.ray:
        equations[problem.size] = {k: rows[i].constant for k, i in enumerate(support) if rows[i].constant}
    if not equations.get(problem.size):
        return None
    solved = solve_sparse(equations.values(), [int(j == problem.size) for j in equations])
    if solved is None:
        return None
    weights = {support[k]: w for k, w in whole_multiples(solved).items() if w}
    return Refutation(weights) if problem.system.refuted_by(weights) else None


def proportions(numbers: Mapping[int, float]) -> dict[int, int]:
    """Integers in these proportions, as far as floats tell; none where they are not small parts of each other."""
    least, whole = min(map(abs, numbers.values()), default=0.0), 1
    if not least or not all(isfinite(w / least * _WHOLE * _PART) for w in numbers.values()):
        return {}
    for w in numbers.values():
        ratio = w / least * whole
        if abs(ratio - round(ratio)) > _NEARLY + _NOISE * abs(ratio):
            whole *= Fraction(ratio).limit_denominator(_PART).denominator
        if whole > _WHOLE:
            return {}
    return {i: round(w / least * whole) for i, w in numbers.items()}


def _vertex(problem: Slackened, proposal: Proposal) -> tuple[Fraction, ...] | None:
    """x and t at which the tight rows are equations."""
    if proposal.ray:
        return None
    basic, last = set(proposal.columns), problem.size
    fixed = 0 if last in basic else 1
    tight = [{j: c for j, c in problem.terms(i).items() if j in basic} for i in proposal.rows]
    right = [-problem.system.rows[i].constant - fixed * problem.scales[i] for i in proposal.rows]
    solved = solve_sparse(tight, right)
    if solved is None:
        return None
    return (*(solved.get(j, Fraction(0)) for j in range(last)), solved.get(last, Fraction(fixed)))
