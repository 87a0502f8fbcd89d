"""Rational proofs about chains: a point that keeps all conditions, multipliers that exclude one, and both sides of the
optimum.

THEOREM (weak duality; Boyd, Vandenberghe: Convex Optimization, 5.2.2). With weights w_i >= 0 and convex forms, the
least value of f + sum w_i g_i is at most f wherever all g_i <= 0; if the least value of sum w_i g_i is positive,
nowhere are all g_i <= 0. The least values here are exact: one linear system over Q. Certificates are sentences that
the rule "multipliers" proves, and witnesses; a sentence about some of the conditions is one about all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from math import lcm

from bezier.chains import proposals
from bezier.chains.chain import Chain, objective_form
from bezier.chains.form import AXES, Form, Point, Requirement, Solved, weighted_sum
from qe.convex.evidence import optimum_certificate
from qe.convex.minimise import evidence_about, solve
from qe.convex.near_optimum import GAP
from qe.convex.system import ConvexSystem, constant
from qe.errors import Unable
from qe.exact.quadratic_form import Quadratic
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj
from qe.formula.syntax import TRUE, Relation
from qe.options import Budget
from qe.proof.certificate import Certificate
from qe.proof.multipliers import FormRelation, OptimumStatus

_ZERO, _ONE = Fraction(0), Fraction(1)
GAPS = (GAP, 1000 * GAP, 1_000_000 * GAP)
"""Shares of the value, tried in this order: digits cancel where it is small, and conditions may leave hardly room."""
MOST_EXACT = 12
"""Variables up to which an exact method is tried where rounded multipliers prove nothing."""
EXACT_SECONDS = 1.0
LEAST, MOST = "least value at least ", "least value at most "
"""Labels of the two sides."""
_PLACES = (20, 30, 40, 50)  # binary, of a point, in proportion to the size of the problem
_DROPPED = (1e-6, 1e-9, 0.0)  # shares of the largest weight below which weights are left out
_ADDED = (1e-12, 1e-10, 1e-8)
_SMALLER = tuple(Fraction(1, 10**k) for k in (13, 12, 11, 10))  # shares of the room of a condition


@dataclass(frozen=True)
class Contradiction:
    """The conditions ``support`` exclude each other. The certificate is made where it is wanted: on the way to a
    smallest conflict most are not."""

    support: tuple[Requirement, ...]
    made: Callable[[], Certificate]

    @cached_property
    def certificate(self) -> Certificate:
        """What proves it."""
        return self.made()


@dataclass(frozen=True, slots=True)
class Best:
    """A point that keeps all conditions, and a number below which the objective cannot be."""

    free: tuple[Point, ...]
    value: Fraction
    bound: Fraction
    weights: Mapping[str, Fraction]
    """The multipliers of the bound, of the conditions that have one."""
    certificate: Certificate


def decided(chain: Chain, solved: Solved, rows: Sequence[Requirement]) -> tuple[Point, ...] | Contradiction:
    """Free points that keep these conditions, or why there are none. Raises ``Unable`` where they touch so that neither
    can be proved."""
    size, d = solved.size, chain.dimension
    known = {row.label for row in rows}
    if solved.joins and all(row.label in known for _, row in solved.joins):
        return contradiction(chain, size, {r.label: w for w, r in solved.joins}, [r for _, r in solved.joins])
    for row in rows:
        if row.form.is_constant and row.form.constant > 0:
            return contradiction(chain, size, {row.label: _ONE}, (row,))
    varying = [row for row in rows if not row.form.is_constant]
    if not varying:
        return ((_ZERO,) * d,) * size
    proposal = proposals.best(chain, size, varying)
    if proposal is not None:
        for places in _PLACES if proposal.excess < 0 else ():
            free = rounded_point(chain, proposal.point, places)
            if all(row.form.value(free) <= 0 for row in varying):
                return free
        for weights in rational_weights(proposal.weights):
            support = [(w, row) for w, row in zip(weights, varying, strict=True) if w]
            lowest = weighted_sum((w, row.form) for w, row in support).minimum(size, d) if support else None
            if lowest is not None and lowest[1] > 0:
                return contradiction(chain, size, {r.label: w for w, r in support}, [r for _, r in support])
    if size * d <= MOST_EXACT:
        return _exactly(chain, size, varying)
    raise Unable("the conditions touch: neither a path nor a contradiction could be proved")


def contradiction(
    chain: Chain, size: int, weights: Mapping[str, Fraction], rows: Sequence[Requirement]
) -> Contradiction:
    """What multipliers prove, checked. Raises ``Unable`` where they prove nothing."""
    d = chain.dimension
    lowest = weighted_sum((weights[row.label], row.form) for row in rows).minimum(size, d)
    if lowest is None or lowest[1] <= 0 or any(weights[row.label] < 0 for row in rows):
        raise Unable("these multipliers contradict nothing")
    forms, listed = [row.form for row in rows], [weights[row.label] for row in rows]
    return Contradiction(tuple(rows), partial(refuted, chain, size, forms, listed, lowest[0]))


def refuted(
    chain: Chain, size: int, forms: Sequence[Form], weights: Sequence[Fraction], at: Sequence[Point], *, strict: int = 0
) -> Certificate:
    """That the forms, with these weights least at ``at``, are not all <= 0 (the last ``strict`` ones: < 0) anywhere."""
    relations = (FormRelation.LE,) * (len(forms) - strict) + (FormRelation.LT,) * strict
    system = ConvexSystem(names_of(chain, size), *_objective_and(chain, size, forms), relations)
    flat = tuple(c for p in at for c in p)
    evidence = evidence_about(system, status=OptimumStatus.INFEASIBLE, point=flat, multipliers=tuple(weights))
    return optimum_certificate(evidence)


def _objective_and(chain: Chain, size: int, forms: Sequence[Form]) -> tuple[Quadratic, tuple[Quadratic, ...]]:
    quadratics = tuple(form.quadratic(size, chain.dimension) for form in forms)
    return constant(size * chain.dimension, 0), quadratics


def _exactly(chain: Chain, size: int, rows: Sequence[Requirement]) -> tuple[Point, ...] | Contradiction:
    """The same by the engine's exact method, which also knows conditions that touch."""
    relations = (FormRelation.LE,) * len(rows)
    names = names_of(chain, size)
    system = ConvexSystem(names, *_objective_and(chain, size, [row.form for row in rows]), relations)
    evidence = solve(system, budget=Budget(EXACT_SECONDS))
    if evidence.status is OptimumStatus.INFEASIBLE:
        return Contradiction(tuple(rows), partial(optimum_certificate, evidence))
    values = [Fraction(c) if isinstance(c, Fraction) else None for c in evidence.point]
    exact = [c for c in values if c is not None]
    if len(exact) < len(values):
        raise Unable("the conditions touch in an irrational point")
    d = chain.dimension
    return tuple(tuple(exact[i : i + d]) for i in range(0, len(exact), d))


def best(
    chain: Chain,
    solved: Solved,
    rows: Sequence[Requirement],
    inside: Sequence[Point],
    gaps: Sequence[Fraction] = GAPS,
) -> Best:
    """Both sides of the optimum under these conditions, a billionth of it apart, or the first of ``gaps`` that can be
    proved. ``inside``: free points that keep the conditions. Raises ``Unable`` where none can."""
    size, d, objective = solved.size, chain.dimension, objective_form(chain, solved)
    lowest = objective.minimum(size, d)
    if lowest is not None and all(row.form.value(lowest[0]) <= 0 for row in rows):
        return bounded(chain, solved, rows, lowest[0], {})
    varying = [row for row in rows if not row.form.is_constant]
    proposal = proposals.best(chain, size, varying, objective)
    if proposal is None:
        raise Unable("no optimum was proposed")
    points = list(near_optimum(chain, proposal, inside, varying, objective))
    for near in (inside, *points) if lowest is not None else ():  # least at many places, some of which may be inside
        lowered = objective.minimum(size, d, near)
        if lowered is not None and all(row.form.value(lowered[0]) <= 0 for row in rows):
            return bounded(chain, solved, rows, lowered[0], {})
    if not points:
        raise Unable("no point near the optimum keeps all conditions")
    free = min(points, key=objective.value)
    multipliers, value = rational_weights(proposal.weights), objective.value(free)
    bound, _, weights = lower_bound(chain, size, objective, varying, multipliers, value - gaps[0] * abs(value))
    named = {row.label: w for w, row in zip(weights, varying, strict=True) if w}
    gap = next((gap for gap in gaps if value - bound <= gap * abs(value)), gaps[-1])
    return bounded(chain, solved, rows, free, named, gap)


def lower_bound(
    chain: Chain,
    size: int,
    objective: Form,
    rows: Sequence[Requirement],
    multipliers: Iterable[Sequence[Fraction]],
    enough: Fraction | None = None,
) -> tuple[Fraction, tuple[Point, ...], Sequence[Fraction]]:
    """The best bound that one of these multipliers proves, or the first that is ``enough``; where the sum with them is
    least; and they. Raises ``Unable`` where none proves one."""
    highest = None
    for weights in multipliers:
        if min(weights, default=_ZERO) < 0:  # these prove nothing
            continue
        held = [(w, row.form) for w, row in zip(weights, rows, strict=True) if w]
        lowest = weighted_sum([(_ONE, objective), *held]).minimum(size, chain.dimension)
        if lowest is not None and (highest is None or lowest[1] > highest[0]):
            highest = lowest[1], lowest[0], weights
            if enough is not None and highest[0] >= enough:
                break
    if highest is None:
        raise Unable("it is unbounded, or no bound was proved")
    return highest


def bounded(
    chain: Chain,
    solved: Solved,
    rows: Sequence[Requirement],
    free: Sequence[Point],
    weights: Mapping[str, Fraction],
    gap: Fraction = GAP,
) -> Best:
    """What a point and multipliers prove together. Raises ``Unable`` where the point breaks a condition, a weight is
    negative or of no condition, or the two sides are more than ``gap`` of the value apart."""
    size, objective = solved.size, objective_form(chain, solved)
    broken = [row.label for row in rows if row.form.value(free) > 0]
    if broken:
        raise Unable(f"the point breaks a condition: {broken[0]}")
    if weights.keys() - {row.label for row in rows} or any(w < 0 for w in weights.values()):
        raise Unable("a multiplier is negative, or of no condition")
    chosen = [row for row in rows if weights.get(row.label)]
    lagrangian = weighted_sum([(_ONE, objective), *((weights[row.label], row.form) for row in chosen)])
    lowest, value = lagrangian.minimum(size, chain.dimension), objective.value(free)
    if lowest is None or value - lowest[1] > gap * abs(value):
        raise Unable("the two sides of the optimum are too far from each other")
    forms = [*(row.form for row in chosen), objective.shifted(-lowest[1])]
    below = refuted(chain, size, forms, [*(weights[row.label] for row in chosen), _ONE], lowest[0], strict=1)
    detail = next((row.detail for row in chosen if row.detail), "")
    reached = [*(row.form for row in rows if not row.detail), objective.shifted(-value)]
    proofs = [(f"{LEAST}{lowest[1]}{detail}", below), (f"{MOST}{value}", witness(chain, size, reached, free))]
    used = {row.label: weights[row.label] for row in chosen}
    return Best(tuple(free), value, lowest[1], used, Certificate.bundle(proofs))


def feasible(chain: Chain, solved: Solved, rows: Sequence[Requirement], free: Sequence[Point]) -> Certificate:
    """That the free points keep these conditions."""
    return witness(chain, solved.size, [row.form for row in rows], free)


def witness(chain: Chain, size: int, forms: Sequence[Form], free: Sequence[Point]) -> Certificate:
    """That the forms are all <= 0 at the free points."""
    names = names_of(chain, size)
    ring = Ring.of(names)
    matrix = conj(tuple(atom(polynomial(form, ring, size, chain.dimension), Relation.LE) for form in forms))
    if matrix == TRUE:  # nothing is free
        return Certificate.derivation(names, TRUE, (), TRUE)
    return Certificate.witness(matrix, names, [c for p in free for c in p])


def polynomial(form: Form, ring: Ring, size: int, dimension: int) -> Poly:
    """A positive multiple with whole coefficients."""
    terms: dict[tuple[int, ...], Fraction] = {}
    width = size * dimension

    def add(places: Sequence[int], value: Fraction) -> None:
        if value:
            terms[tuple(places.count(v) for v in range(width))] = value

    add((), form.constant)
    for i, g in form.gradient.items():
        for k, value in enumerate(g):
            add((i * dimension + k,), value)
    for (i, j), m in form.matrix.items():
        for k in range(dimension if i <= j else 0):
            add((i * dimension + k, j * dimension + k), m if i == j else 2 * m)
    scale = lcm(*(value.denominator for value in terms.values()))
    return ring.from_terms({powers: int(value * scale) for powers, value in terms.items()})


def names_of(chain: Chain, size: int) -> tuple[str, ...]:
    """The variables of the sentences: the coordinates of the free points, numbered from 1."""
    return tuple(f"{AXES[k]}{i + 1}" for i in range(size) for k in range(chain.dimension))


def rounded_point(chain: Chain, point: Sequence[Sequence[float]], places: int) -> tuple[Point, ...]:
    """With so many binary places, in proportion to the largest coordinate that is given."""
    unit = Fraction(2) ** (places - int(max(abs(c) for p in chain.points for c in p)).bit_length())
    return tuple(tuple(Fraction(round(Fraction(c) * unit)) / unit for c in p) for p in point)


def rational_weights(weights: Sequence[float]) -> Iterator[tuple[Fraction, ...]]:
    """Rational multipliers near these: without those below a share of the largest one, then with a small one for each
    condition, which holds points that the large ones leave nearly free."""
    largest = max(weights, default=0.0)
    if not largest > 0:
        return
    unit = Fraction(2) ** (50 - Fraction(largest).numerator.bit_length() + Fraction(largest).denominator.bit_length())
    for share in _DROPPED:
        yield tuple(Fraction(round(Fraction(w) * unit)) / unit if w > share * largest else _ZERO for w in weights)
    for share in _ADDED:
        least = Fraction(round(Fraction(largest * share) * unit)) / unit
        yield tuple(Fraction(round(Fraction(max(w, 0.0)) * unit)) / unit + least for w in weights)


def near_optimum(
    chain: Chain, proposal: proposals.Proposal, inside: Sequence[Point], rows: Sequence[Requirement], objective: Form
) -> Iterator[tuple[Point, ...]]:
    """Points near the proposal that keep all conditions: the best ones of slightly narrower conditions, and the first
    one on the way from the proposal to the inside."""
    size = len(inside)
    for share in _SMALLER:
        near = proposals.best(chain, size, [narrower(row, share) for row in rows], objective)
        free = rounded_point(chain, near.point, 50) if near is not None else ()
        if free and all(row.form.value(free) <= 0 for row in rows):
            yield free
            break
    start = rounded_point(chain, proposal.point, 50)
    for places in range(46, -1, -2):
        share = Fraction(1, 2**places)
        pairs = zip(start, inside, strict=True)
        free = tuple(tuple(a + share * (b - a) for a, b in zip(p, q, strict=True)) for p, q in pairs)
        if all(row.form.value(free) <= 0 for row in rows):
            yield free
            break


def narrower(row: Requirement, share: Fraction) -> Requirement:
    """The condition with this share less room."""
    return replace(row, form=row.form.shifted(share * row.right if row.squares else share * abs(row.form.constant)))
