"""A path of several curves with what is proved about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

from bezier.curves.containment import Inside, Leaves, Outcome, containment, examine_all
from bezier.curves.curve import Bezier, Join, Smoothness, join
from bezier.curves.enclosure import Enclosure, maximum, root_enclosure
from bezier.curves.nonnegative import UNIT, Interval, events_of
from bezier.curves.scalar import Vector, is_zero, scale
from bezier.curves.workspace import Condition, Workspace
from qe.proof.certificate import Certificate


@dataclass(frozen=True, slots=True)
class ProvedJoin:
    """Where two named curves of the path meet."""

    first: str
    second: str
    join: Join


@dataclass(frozen=True, slots=True)
class Proof:
    """What was found out about one curve and one condition of the workspace."""

    curve: str
    outcome: Outcome

    @property
    def condition(self) -> Condition:
        """The condition examined."""
        return self.outcome.condition


@dataclass(frozen=True, slots=True)
class Path:
    """The curves in order, the control points by name, the joins, and the containment proofs."""

    curves: Mapping[str, Bezier]
    points: Mapping[str, Vector]
    joins: tuple[ProvedJoin, ...]
    proofs: tuple[Proof, ...]
    durations: Mapping[str, Fraction] = field(default_factory=dict)
    """The time that a curve takes, where it is not 1."""

    def __repr__(self) -> str:
        curves = ", ".join(f"{name} of degree {curve.degree}" for name, curve in self.curves.items())
        return f"Path({curves}; {'inside' if self.is_inside else 'not proved inside'})"

    def duration(self, curve: str) -> Fraction:
        """The time that a curve takes."""
        return self.durations.get(curve, Fraction(1))

    @property
    def is_inside(self) -> bool:
        """Whether every whole curve is proved to lie in the workspace."""
        return all(isinstance(proof.outcome, Inside) for proof in self.proofs)

    @property
    def violations(self) -> tuple[Proof, ...]:
        """The proofs that failed, each with a parameter outside."""
        return tuple(proof for proof in self.proofs if isinstance(proof.outcome, Leaves))

    @property
    def smoothness(self) -> Smoothness:
        """The smoothness that every join has with respect to time."""
        return min((j.join.smoothness for j in self.joins), default=Smoothness.C2)


def assemble(
    curves: Mapping[str, Bezier],
    points: Mapping[str, Vector],
    workspace: Workspace,
    *,
    durations: Mapping[str, Fraction] | None = None,
) -> Path:
    """Examine joins and containment of the curves, exactly."""
    path = Path(dict(curves), dict(points), (), prove(curves, workspace.conditions), durations or {})
    joins = [
        ProvedJoin(a, b, join(curves[a], curves[b], (path.duration(a), path.duration(b)))) for a, b in pairwise(curves)
    ]
    return replace(path, joins=tuple(joins))


def prove(curves: Mapping[str, Bezier], conditions: tuple[Condition, ...]) -> tuple[Proof, ...]:
    """The containment of each curve in each condition."""
    return tuple(Proof(name, outcome) for name, curve in curves.items() for outcome in examine_all(curve, conditions))


def speed_at_joins(path: Path) -> dict[str, Vector]:
    """The common velocity at each join that is at least C1, by the name of the join."""
    data: dict[str, Any] = {}
    for item in path.joins:
        if item.join.smoothness >= Smoothness.C1:
            slope = path.curves[item.second].derivative(1, Fraction(0))
            data[f"{item.first}-{item.second}"] = scale(1 / path.duration(item.second), slope)
    return data


def path_certificates(path: Path) -> list[tuple[str, Certificate]]:
    """A labelled certificate for each containment proof that has this form."""
    result = []
    for proof in path.proofs:
        if isinstance(proof.outcome, Inside):
            certificate = containment(path.curves[proof.curve], proof.outcome)
            if certificate is not None:
                result.append((f"{proof.curve} in {proof.condition.name}", certificate))
    return result


REL = Fraction(1, 10**6)
"""Relative width of the enclosure of the squared speed."""


@dataclass(frozen=True, slots=True)
class Slowest:
    """The least speed of a curve in mm per unit of time."""

    least: Enclosure
    """It lies in this enclosure, which is 0 when the curve stops."""
    stops: tuple[Interval, ...]
    """Where, as intervals of the parameter with one zero of the speed each (equal ends: exactly there)."""


def slowest(curve: Bezier, duration: Fraction = Fraction(1)) -> Slowest:
    """The least of |P'(t)| / duration over [0, 1]."""
    squared = curve.hodograph().norm_squared()
    zero = Enclosure(Fraction(0), Fraction(0))
    if all(map(is_zero, squared)):
        return Slowest(zero, (UNIT,))
    if stops := [event.t for event in events_of((squared,)) if event.signs == (0,)]:
        return Slowest(zero, tuple(stops))
    # the least of p > 0 is one over the largest of 1/p
    low, high = maximum((Fraction(1),), squared, REL).finite
    return Slowest(root_enclosure(1 / high, 1 / low).scaled(1 / duration), ())


def slowest_of(path: Path) -> Mapping[str, Slowest]:
    """``slowest`` for each curve of a path, with respect to time."""
    return {name: slowest(curve, path.duration(name)) for name, curve in path.curves.items()}
