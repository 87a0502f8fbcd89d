"""The work behind the operators and questions of regions (``qe.regions.operators`` says what they mean)."""

from __future__ import annotations

import random
import time
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import prod
from typing import Any, TypeVar

from qe import arguments
from qe.api.limits import performed, posed
from qe.convex.optimum import exact, minimize
from qe.decomposition.interval import Coordinate, Interval, Number, number_of
from qe.engine.run import solve as eliminated
from qe.errors import BudgetExceeded, InputError, InternalError, Unable
from qe.exact.algebraic import RealAlgebraic
from qe.exact.number import simplest, square_root
from qe.exact.ring import Poly, Ring
from qe.formula.build import JOINS, conj, convert, exists, forall, iff, implies, neg
from qe.formula.evaluate import substituted
from qe.formula.normal import nnf
from qe.formula.syntax import Constant, Formula
from qe.io.expressions import graph_of
from qe.io.substitution import over_one_ring
from qe.options import Budget, Options
from qe.processes.execution import Work
from qe.processes.limits import Limits
from qe.proof.multipliers import OptimumStatus
from qe.regions import planar, spatial, topology
from qe.regions.build import described
from qe.regions.convex_region import ConvexRegion
from qe.regions.region import Region
from qe.regions.walk import MOST_POINTS, different_points, walked

T = TypeVar("T")


# --- what the operators of regions do --------------------------------------------------------------------------
def joined(left: Region, way: str, right: object) -> Region:
    """The set that an operator makes of two."""
    f, g = _operands(left, right, left.limits.begun(time.monotonic()))
    made = conj((f, neg(g))) if way == "minus" else JOINS[way](f, g)
    return _region(left, made, left.order, None)


def compared(way: str, left: Region, right: object, timeout: float | None) -> bool:
    """Whether two sets stand in this relation."""
    limits = _limits(left, timeout).begun(time.monotonic())
    f, g = _operands(left, right, limits)
    claim = {
        "subset": lambda: implies(f, g),
        "superset": lambda: implies(g, f),
        "equal": lambda: iff(f, g),
        "disjoint": lambda: neg(conj((f, g))),
    }[way]()
    return performed(partial(_truth, forall(left.order, claim)), claim, limits)


def complement(region: Region, timeout: float | None) -> Region:
    """All other points."""
    return _region(region, neg(region.condition), region.order, timeout)


_TOPOLOGICAL = {
    "closure": (planar.Cells.closure, topology.closure),
    "interior": (planar.Cells.interior, topology.interior),
    "boundary": (planar.Cells.boundary, topology.boundary),
}


def topological(region: Region, way: str, timeout: float | None) -> Region:
    """Its closure, interior or boundary: of chosen cells where there are few variables, else what a formula says."""
    return _under(region, region.formula, timeout, partial(_made, region, *_TOPOLOGICAL[way]))


def components(region: Region, timeout: float | None) -> list[Region]:
    """The connected components."""
    if isinstance(region, ConvexRegion):  # a convex set is connected
        return [] if region.is_empty else [region]
    if (size := len(region.order)) > spatial.DIMENSIONS:
        raise Unable(f"connected components are found in up to {spatial.DIMENSIONS} variables, not in {size}")
    return _under(region, region.formula, timeout, partial(_components, region))


def bounding_box(region: Region, timeout: float | None) -> dict[str, Interval]:
    """The bounds of every variable."""
    start = time.monotonic()
    limit = arguments.seconds(timeout)
    box = {}
    for variable in region.order:
        left = None if limit is None else max(limit - (time.monotonic() - start), limit * 1e-3)
        box[variable] = region.bounds(variable, timeout=left)
    return box


def project(region: Region, variables: Any, timeout: float | None) -> Region:
    """The shadow in the space of some variables."""
    names = arguments.names(variables, "variables") or ()
    if not names or len(set(names)) < len(names) or not set(names) <= set(region.order):
        raise InputError(f"variables: some of {', '.join(region.order)}, each once, expected")
    hidden = [v for v in region.order if v not in names]
    return _region(region, exists(hidden, region.condition), names, timeout)


def section(region: Region, values: Mapping[Any, Coordinate], timeout: float | None) -> Region:
    """The part where some variables have these values, in the space of the others."""
    given = _numbers(region, arguments.by_name(values, "values"), "values")
    rest = tuple(v for v in region.order if v not in given)
    if not rest:
        raise InputError("values: a variable without a value expected; ask contains whether a point is in the region")
    ring = Ring.of(
        dict.fromkeys((*region.order, *(() if region.condition.ring is None else region.condition.ring.names)))
    )
    condition = convert(region.condition, ring)
    condition = substituted(condition, {v: q for v, q in given.items() if isinstance(q, Fraction)})
    exact = {v: a for v, a in given.items() if isinstance(a, RealAlgebraic)}
    condition = conj(over_one_ring(condition, *(graph_of(v, a) for v, a in exact.items())))
    return _region(region, exists(exact, condition), rest, timeout)


def distance(region: Region, point: object, timeout: float | None) -> Number:
    """The infimum of the distances of a point from the points of a region."""
    given = _numbers(region, arguments.point(point, region.order), "point")
    if missing := [v for v in region.order if v not in given]:
        raise InputError(f"point: a value for {missing[0]} expected")
    irrational = {v: a for v, a in given.items() if isinstance(a, RealAlgebraic)}
    ring = Ring.of([*region.order, *(f"at {v}" for v in irrational)])
    square, scale = ring.constant(0), prod(q.denominator for q in given.values() if isinstance(q, Fraction))
    for v, q in given.items():
        x = ring.var(v)
        apart = x - ring.var(f"at {v}") if isinstance(q, RealAlgebraic) else x * q.denominator - q.numerator
        part = scale if isinstance(q, RealAlgebraic) else scale // q.denominator
        square = square + apart * apart * (part * part)
    conditions = conj(over_one_ring(region.condition, *(graph_of(f"at {v}", a) for v, a in irrational.items())))
    return _under(region, conditions, timeout, partial(_distance, square, Fraction(1, scale * scale), conditions))


def exact_volume(region: Region, timeout: float | None) -> Any:
    """The measure in closed form; see ``qe.api.measure``."""
    begun = time.monotonic()  # SymPy takes a part of the time where it is not loaded yet
    from qe.api.measure import measure

    return region._asked(partial(measure, region), arguments.seconds(timeout), at_once=True, start=begun)


def sample(region: Region, seed: int, timeout: float | None) -> dict[str, Number]:
    """A random point of a region."""
    start = arguments.integers([seed], "seed")[0]
    point = _under(region, region.condition, timeout, partial(walked, region, random.Random(start)))
    if point is None:
        raise InputError("an empty region has no points")
    return point


def instances(region: Region, n: int, seed: int, timeout: float | None) -> list[dict[str, Number]]:
    """Different points of a region."""
    count, start = arguments.whole(n, "n", MOST_POINTS), arguments.integers([seed], "seed")[0]
    return _under(region, region.condition, timeout, partial(different_points, region, count, start))


# --- what is done under limits ------------------------------------------------------------------------------------
def _truth(sentence: Formula, budget: Budget) -> bool:
    answer = eliminated(sentence, Options(), budget).formula
    if not isinstance(answer, Constant):
        raise InternalError("a sentence has no truth value")
    return answer.value


def _components(region: Region, budget: Budget) -> list[Region]:
    components = planar.components if len(region.order) <= planar.DIMENSIONS else spatial.components
    parts = components(nnf(region.formula), region.order, budget)
    if len(parts) == 1:
        return [region]
    return [Region.of(part, region.order, budget=budget, limits=region.limits) for part in parts]


def _made(region: Region, chosen: planar.Choice, formula: topology.Operation, budget: Budget) -> Region:
    f, order = nnf(region.formula), region.order
    if len(order) > planar.DIMENSIONS:
        return described(formula(f, order, budget), order, budget, region.limits)
    return Region.of(planar.formula_of(f, order, chosen, budget), order, budget=budget, limits=region.limits)


def _distance(square: Poly, factor: Fraction, conditions: Formula, budget: Budget) -> Number:
    """The root of the infimum of a polynomial times a factor."""
    from qe.optimization.global_optimum import best
    from qe.optimization.values import Goal, Objective, new_name

    try:
        convex = minimize(square, conditions, scale=factor, budget=budget)
        status, value = convex.status, None if convex.value is None else exact(convex.value)
    except Unable as error:
        if isinstance(error, BudgetExceeded):
            raise
        goal = Goal.of(Objective.of(square, factor, new_name(square.ring.names)), conditions)
        optimum = best(1, goal, budget=budget)
        status, value = optimum.status, optimum.value
    if status is OptimumStatus.INFEASIBLE:
        raise InputError("an empty region has no distance from a point")
    if value is None:
        raise InternalError("a sum of squares has no infimum")
    return square_root(simplest(value))


# --- parts -------------------------------------------------------------------------------------------------------
def _under(region: Region, formula: Formula, timeout: float | None, work: Work[T]) -> T:
    """Work under the limits of a region, or the time that goes before them."""
    return performed(work, formula, _limits(region, timeout).begun(time.monotonic()))


def _limits(region: Region, timeout: float | None) -> Limits:
    """The limits of a region with this time, if there is one."""
    return region.limits if timeout is None else replace(region.limits, timeout=arguments.seconds(timeout))


def _region(region: Region, formula: Formula, order: tuple[str, ...], timeout: float | None) -> Region:
    """The region of a formula that was made of one's."""
    return _under(region, formula, timeout, partial(described, formula, order, limits=region.limits))


def _operands(left: Region, right: object, limits: Limits) -> tuple[Formula, Formula]:
    """The formulas of both, over one ring. Raises ``InputError`` for sets in other variables."""
    if isinstance(right, Region):
        if set(left.order) != set(right.order):
            raise InputError(
                f"regions in the same variables expected, those in {', '.join(left.order)} and in "
                f"{', '.join(right.order)} found (qe.region(formula, order=…) names the variables of the space)"
            )
        given = right.condition
    else:
        given = posed(right, {}, limits).restricted
        if strange := [v for v in given.free if v not in left.order]:
            raise InputError(f"a condition on {', '.join(left.order)} expected, {strange[0]} found")
    f, g = over_one_ring(left.condition, given)
    return f, g


def _numbers(region: Region, given: Mapping[str, Coordinate], what: str) -> dict[str, Number]:
    if strange := [v for v in given if v not in region.order]:
        raise InputError(f"{what}: values for some of {', '.join(region.order)} expected, {strange[0]} found")
    return {v: simplest(number_of(q, what, f"an exact number for {v}")) for v, q in given.items()}
