"""Formula (8) and formula (7) on one problem: what each gives, proved, and how long it takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce

import qe
from bezier.compare import whole_curve
from bezier.compare.planar import Plane, plane_coordinates, region_of
from bezier.cubic import formula as cubic
from bezier.cubic.existence import Existence, existence
from bezier.curves.area import convex_area
from bezier.curves.enclosure import Enclosure
from bezier.curves.quality import curvature_enclosure, length_enclosure
from bezier.methods import method_of
from bezier.obstacles import avoid
from bezier.plan import Clock, Plan
from bezier.problem import PlanMethod, Problem
from bezier.quadratic import formula as quadratic
from bezier.quadratic.plan import QuadraticPlan
from qe.errors import InputError, Unable

METHODS = (PlanMethod.QUADRATIC, PlanMethod.CUBIC)
PAPER = {PlanMethod.QUADRATIC: "about 15.4 s", PlanMethod.CUBIC: "has not yet been successful"}
"""What the paper reports of quantifier elimination for formula (8), section 4.2.1, and (7), section 4.2."""

REGION_SECONDS = 30.0
"""No region is worked on longer than this; the comparison then says so."""
AREA_REL, VOLUME_REL = Fraction(1, 1000), 0.05
"""Relative width of areas and volumes."""


@dataclass(frozen=True, slots=True)
class Side:
    """One method: its plan, and for every curve of the path its length and its largest curvature."""

    plan: Plan
    lengths: Mapping[str, Enclosure]
    curvatures: Mapping[str, Enclosure]

    @property
    def length(self) -> Enclosure | None:
        """Of the whole path."""
        return reduce(Enclosure.__add__, self.lengths.values()) if self.lengths else None

    @property
    def curvature(self) -> Enclosure | None:
        """The largest one on the whole path."""
        found = list(self.curvatures.values())
        if not found:
            return None
        tops = [c.high for c in found if c.high is not None]
        return Enclosure(max(c.low for c in found), max(tops) if len(tops) == len(found) else None)


@dataclass(frozen=True, slots=True)
class PlanarRegion:
    """The possible places of Q1 in the plane of the via points. ``formula``: as asked; its free variables are q1u, q1v.

    ``region`` and ``area`` (None: not reached, see ``reason``; the area in the square of the unit of the points).
    """

    formula: str
    region: qe.Region | None = None
    area: Enclosure | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Planar:
    """The planar regions of formula (8), of (8*) for whole curves, and of (7) with Q2 quantified.

    ``contained``: whether the engine proved that the first lies in the second (None: not decided).
    """

    plane: Plane
    polygon: PlanarRegion
    whole: PlanarRegion
    cubic: PlanarRegion
    contained: bool | None

    @property
    def named(self) -> dict[str, PlanarRegion]:
        """By the formula's number in the paper."""
        return {"(8)": self.polygon, "(8*)": self.whole, "(7)": self.cubic}


@dataclass(frozen=True, slots=True)
class Comparison:
    """``sides`` by method; ``volume``: of the region of formula (8) in space; ``seconds``: of the common steps."""

    problem: Problem
    sides: Mapping[PlanMethod, Side]
    planar: Planar
    volume: Enclosure | None
    existence: Existence
    seconds: Mapping[str, float]


def compare(problem: Problem, clock: Clock | None = None) -> Comparison:
    """Plan with both methods and measure what they leave free. Raises ``InputError`` for other methods."""
    if problem.method not in METHODS:
        raise InputError(f'method: expected "quadratic" or "cubic" to compare them, found "{problem.method.value}"')
    watch = clock or Clock()
    sides = {}
    for method in METHODS:
        with watch.step(method.value):
            sides[method] = _side(problem, method, watch)
        watch.learn(method.value, sides[method].plan.outcome.value)
    planar = _planar(problem, watch)
    with watch.step("volume of the region of (8)"):
        volume = _volume(sides[PlanMethod.QUADRATIC].plan)
    with watch.step("existence theorem of (7)"):
        theorem = existence(timeout=_limit(watch))
    return Comparison(problem, sides, planar, volume, theorem, dict(watch.seconds))


def for_method(problem: Problem, method: PlanMethod) -> Problem:
    """The same problem for another method; a ratio and a join speed, which only the cubic one knows, are left out."""
    if method is problem.method:
        return problem
    plain = replace(problem, ratio=Fraction(1), join_speed=Fraction(0))
    found = avoid.changed(plain, method, Fraction(0))
    if found is None:
        raise InputError(f'{problem.source}: expected a problem that method "{method.value}" can take')
    return found


def _side(problem: Problem, method: PlanMethod, clock: Clock) -> Side:
    own = Clock(limit=clock.remaining(), listener=clock.listener, note=clock.note)
    made: Plan = method_of(method).make(for_method(problem, method), own)
    plan = avoid.examined(made)
    curves = plan.path.curves if plan.path else {}
    with own.step("length and curvature"):
        lengths = {name: length_enclosure(c) for name, c in curves.items()}
        curvatures = {name: curvature_enclosure(c) for name, c in curves.items()}
    return Side(replace(plan, seconds=dict(own.seconds)), lengths, curvatures)


def _limit(clock: Clock) -> float:
    left = clock.remaining()
    return REGION_SECONDS if left is None else min(REGION_SECONDS, left)


def _planar(problem: Problem, clock: Clock) -> Planar:
    plane = Plane.through(problem)
    formulas = planar_formulas(problem, plane)
    regions = {}
    for name, formula in formulas.items():
        with clock.step(f"planar region of {name}"):
            regions[name] = _region(formula, plane, _limit(clock))
    contained: bool | None = None
    with clock.step("(8) lies in (8*)"):
        try:
            contained = whole_curve.polygon_implies_curve(for_method(problem, METHODS[0]), plane, timeout=_limit(clock))
        except Unable as error:
            clock.learn("(8) lies in (8*)", f"not decided: {error}")
    return Planar(plane, regions["(8)"], regions["(8*)"], regions["(7)"], contained)


def planar_formulas(problem: Problem, plane: Plane) -> dict[str, str]:
    """The conditions on Q1 in the plane, for the engine: free variables q1u, q1v."""
    first, second = (for_method(problem, method) for method in METHODS)
    cubic_conditions = cubic.system(second).conditions_text()
    u, v = plane_coordinates("Q2")
    return {
        "(8)": plane.section(quadratic.system(first).conditions_text(), ("Q1",)),
        "(8*)": whole_curve.formula(first, plane),
        "(7)": f"ex {u}, {v}. {plane.section(cubic_conditions, ('Q1', 'Q2'))}",
    }


def _region(formula: str, plane: Plane, seconds: float) -> PlanarRegion:
    """The region, which is convex: its conditions are convex in Q1 and Q2, for every t."""
    try:
        region = region_of(formula, timeout=seconds)
        area, unit = convex_area(region, AREA_REL), plane.unit_area
    except Unable as error:
        return PlanarRegion(formula, reason=str(error))
    assert area.high is not None and unit.high is not None
    return PlanarRegion(formula, region, Enclosure(area.low * unit.low, area.high * unit.high))


def _volume(plan: Plan) -> Enclosure | None:
    """Of the region of Q1 in space; None when it is not reached."""
    assert isinstance(plan, QuadraticPlan)
    try:
        return Enclosure(*plan.region.volume(VOLUME_REL))
    except Unable:
        return None
