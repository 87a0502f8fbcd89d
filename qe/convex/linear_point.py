"""A point of a set given by linear conditions, or why there is none, by the general simplex method: no best point."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.exact_basis import Refutation, decided
from qe.convex.highs import Proposer, highs
from qe.convex.linear_rows import LinearRows, linear_atoms
from qe.exact.linear_bounds import LinearBounds, TooMuch
from qe.exact.ring import Poly
from qe.exact.sparse_solve import whole_multiples
from qe.exact.sparse_text import digits
from qe.formula.syntax import Formula
from qe.options import Budget
from qe.proof.entry import Json, poly_to_text

LARGE, WORK = 1000, 20_000
"""So many coefficients are for HiGHS at once; with fewer, what takes the simplex method more new entries (20 ms)."""


@dataclass(frozen=True, slots=True)
class LinearContradiction:
    """sum weights_i polys_i is the number ``total``, where conditions on the polynomials exclude that (Farkas 1902)."""

    terms: tuple[tuple[int, Poly], ...]
    total: int

    def evidence(self) -> dict[str, Json]:
        """The evidence for the primitive "signs": the identity sum weights_i polys_i - total = 0."""
        sums: dict[Poly, int] = {}
        for weight, poly in self.terms:
            content, primitive = poly.normal()
            sums[primitive] = sums.get(primitive, 0) + weight * int(content)
        kept = {p: c for p, c in sums.items() if c and not p.is_constant}
        identity: list[Json] = [[digits(c), [[k, 1]]] for k, c in enumerate(kept.values())]
        if self.total:
            identity.append([digits(-self.total), []])
        listed: list[Json] = [poly_to_text(p) for p in kept]
        lemmas: list[Json] = [{"identity": identity}] if kept else []
        return {"theory": {"polynomials": listed, "lemmas": lemmas, "cases": []}}


def linear_point(
    conditions: Formula, *, budget: Budget, propose: Proposer = highs
) -> dict[str, Fraction] | LinearContradiction | None:
    """Values of the variables that meet all conditions, or how these contradict each other; None where they are no
    conjunction of linear atoms without /=.

    Small systems by the simplex method alone; of others ``propose`` says what to look at, and the simplex method takes
    those where that does not help.
    """
    if not (atoms := linear_atoms(conditions)):
        return None
    system = LinearRows.of(atoms)
    outcome = solved(system, budget, propose)
    if isinstance(outcome, Refutation):
        terms = tuple((system.rows[i].sign * w, atoms[i].poly) for i, w in outcome.weights.items())
        return LinearContradiction(terms, sum(w * system.rows[i].constant for i, w in outcome.weights.items()))
    return dict(zip(system.names, outcome, strict=True))


def solved(system: LinearRows, budget: Budget, propose: Proposer = highs) -> tuple[Fraction, ...] | Refutation:
    """A point of all rows or their contradiction."""

    def seconds() -> float | None:
        budget.check("linear conditions")
        return budget.remaining()

    large = sum(len(row.terms) for row in system.rows) >= LARGE
    outcome = None if large else _pivoted(system, budget, WORK)
    if outcome is None:
        outcome = decided(system, seconds, propose) or _pivoted(system, budget)
    assert outcome is not None
    return outcome


def _pivoted(system: LinearRows, budget: Budget, work: int | None = None) -> tuple[Fraction, ...] | Refutation | None:
    """What the simplex method says; None where it takes more than so much ``work``."""
    bounds = LinearBounds(work)
    columns = [bounds.variable() for _ in system.names]
    factors: list[Fraction] = []

    def refutation(parts: Iterable[tuple[Hashable, Fraction]]) -> Refutation:
        weights = whole_multiples({k: c / factors[k] for k, c in parts if isinstance(k, int)})
        return Refutation(weights if system.refuted_by(weights) else {k: -w for k, w in weights.items()})

    for number, row in enumerate(system.rows):
        terms = {columns[j]: Fraction(c) for j, c in row.terms.items()}
        factor = next(iter(terms.values())) if len(terms) == 1 else Fraction(1)
        factors.append(factor)
        x, bound = next(iter(terms)) if len(terms) == 1 else bounds.form(terms), -row.constant / factor
        conflict = None
        if row.is_equation or factor < 0:
            conflict = bounds.at_least(x, bound, strict=row.is_strict, reason=number)
        if (row.is_equation or factor > 0) and conflict is None:
            conflict = bounds.at_most(x, bound, strict=row.is_strict, reason=number)
        if conflict is not None:
            return refutation(bounds.contradiction())
    try:
        if bounds.conflict(lambda: budget.check("linear conditions")) is not None:
            return refutation(bounds.contradiction())
    except TooMuch:
        return None
    values = bounds.point()
    return tuple(values[x] for x in columns)
