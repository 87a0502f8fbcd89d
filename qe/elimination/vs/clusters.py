"""Roots of a cubic that are tried as one point, because a formula asks one thing of them at a time.

THEOREM. Let no conjunction in F have two members that depend on x at the roots x1, x2, x3 (an atom does not if its
polynomial is a constant modulo the cubic). Then F(x1) or F(x2) or F(x3) is F with every atom replaced by "it holds at
some xk": "some" distributes over "or", and over "and" with what does not depend on x. (Kosta 2016 calls points
that are tried together a cluster.)
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from qe.elimination.vs.candidates import Candidate
from qe.elimination.vs.cubic import remainder
from qe.elimination.vs.points import SOME, CubicRoot
from qe.formula.syntax import And, Atom, Formula, Or


def clustered(candidates: Iterable[Candidate], x: int) -> tuple[Candidate, ...]:
    """The candidates, with one for the three roots of a cubic where the theorem allows it."""
    distinct = tuple(dict.fromkeys(candidates))
    out: list[Candidate] = []
    for candidate in distinct:
        e = candidate.point
        if isinstance(e, CubicRoot) and e.index and not e.epsilon:
            three = [replace(candidate, point=replace(e, index=k)) for k in (1, 2, 3)]
            if all(c in distinct for c in three) and asks_one(candidate.formula, x, e):
                out += [replace(candidate, point=replace(e, index=SOME))] if e.index == 1 else []
                continue
        out.append(candidate)
    return tuple(out)


def asks_one(formula: Formula, x: int, e: CubicRoot) -> bool:
    """Whether no conjunction of a positive formula has two members that depend on x at the roots."""
    match formula:
        case And(args):
            return all(asks_one(a, x, e) for a in args) and sum(_depends(a, x, e) for a in args) <= 1
        case Or(args):
            return all(asks_one(a, x, e) for a in args)
    return True


def _depends(formula: Formula, x: int, e: CubicRoot) -> bool:
    match formula:
        case And(args) | Or(args):
            return any(_depends(a, x, e) for a in args)
        case Atom(poly, _):
            return bool(poly.degree(x)) and any(remainder(poly, x, e.coefficients)[0][1:])
    return False
