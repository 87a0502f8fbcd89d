"""What the certificates of a folder claim: each has to be about the conditions of one system of control points.

Everything raises ``CertificateRejected`` naming the entry that is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from bezier.curves.scalar import Vector, exactly
from bezier.input.stored import DIMENSION, numbers
from bezier.methods.control.system import System
from bezier.methods.control.terms import (
    Terms,
    condition_terms,
    fixed_by,
    multiple_of,
    objective_terms,
    reduced,
    terms_of,
)
from qe.convex.near_optimum import GAP
from qe.errors import CertificateRejected
from qe.proof.certificate import Certificate, Kind


def member(certificate: Certificate, label: str, kind: Kind) -> Any:
    """The payload of the member with this label and kind."""
    if isinstance(certificate.payload, tuple):
        for item in certificate.payload:
            if item.label == label and item.certificate.kind == kind:
                return item.certificate.payload
    raise CertificateRejected("certificate.json", f"no certificate of kind {kind.value} with the label {label!r}")


def optimal_points(system: System, payload: Mapping[str, Any]) -> dict[str, Vector] | None:
    """The control points that the certificate of an optimum fixes, None when it shows that there are none.

    Raises ``CertificateRejected`` when they do not satisfy all conditions.
    """
    if payload["status"] != "optimal":
        return None
    if tuple(payload["problem"]["variables"]) != system.shape.variables:
        raise CertificateRejected("optimum: problem.variables", f"expected {', '.join(system.shape.variables)}")
    flat = numbers(payload["point"], payload["field"], "optimum.point")
    points = system.points([flat[i : i + DIMENSION] for i in range(0, len(flat), DIMENSION)])
    for label in system.violated(points):
        raise CertificateRejected("optimum.point", f"violates the condition {label}")
    return points


def has_member(certificate: Certificate, label: str) -> bool:
    """Whether a bundle has a member with this label."""
    return isinstance(certificate.payload, tuple) and any(item.label == label for item in certificate.payload)


def near_points(
    system: System, payload: Mapping[str, Any], reached: Mapping[str, Any]
) -> tuple[dict[str, Vector], Fraction]:
    """The control points of a witness, and the bound on the objective that a contradiction proves (``check_bound_of``).

    Raises ``CertificateRejected`` when they violate a condition, or are not as near to each other as they have to be.
    """
    bound = objective_terms(system).get(_origin(system), Fraction(0)) - _last(system, payload).get(
        _origin(system), Fraction(0)
    )
    if tuple(reached["order"]) != system.shape.variables:
        raise CertificateRejected("optimum: point: order", f"expected {', '.join(system.shape.variables)}")
    flat = numbers(reached["values"], None, "optimum: point: values")
    points = system.points([flat[i : i + DIMENSION] for i in range(0, len(flat), DIMENSION)])
    for label in system.violated(points):
        raise CertificateRejected("optimum: point", f"violates the condition {label}")
    value = exactly(system.objective_at(points))
    if value - bound > GAP * abs(value):
        raise CertificateRejected("optimum: bound", "not as near to the objective as it has to be")
    return points, bound


def check_bound_of(system: System, payload: Mapping[str, Any], label: str) -> None:
    """The certificate shows that the objective of the system has no value below some number under its conditions."""
    *conditions, last = payload["problem"]["constraints"]
    terms, goal = _last(system, payload), objective_terms(system)
    slopes = [{e: c for e, c in found.items() if any(e)} for found in (terms, goal)]
    if payload["status"] != "infeasible" or last["relation"] != "<" or slopes[0] != slopes[1]:
        raise CertificateRejected(f"{label}: problem.constraints", "the last one is no bound of the objective")
    weaker = {**payload, "problem": {**payload["problem"], "constraints": conditions}}
    check_optimum_of(system, weaker, label)


def _last(system: System, payload: Mapping[str, Any]) -> Terms:
    """The last condition of a certificate."""
    stated = payload["problem"]
    if not stated["constraints"] or sorted(stated["variables"]) != sorted(system.shape.variables):
        raise CertificateRejected("optimum: bound: problem", "not about the control points of this problem")
    order = [stated["variables"].index(name) for name in system.shape.variables]
    return _ordered(stated["constraints"][-1]["terms"], order)


def _origin(system: System) -> tuple[int, ...]:
    return (0,) * len(system.shape.variables)


def check_optimum_of(system: System, payload: Mapping[str, Any], label: str, minimise: Terms | None = None) -> None:
    """The certificate minimises this objective (None: the system's) under conditions of this system only.

    So a point that satisfies all conditions is the optimum of the system, a lower bound is one of the system, and a
    contradiction is one of the system.
    """
    stated = payload["problem"]
    if payload["status"] not in ("optimal", "infeasible"):
        raise CertificateRejected(f"{label}: status", "expected an optimum or a contradiction")
    variables = system.shape.variables
    if sorted(stated["variables"]) != sorted(variables):
        raise CertificateRejected(f"{label}: problem.variables", f"expected {', '.join(variables)}")
    order = [stated["variables"].index(name) for name in variables]
    if _ordered(stated["minimise"], order) != (objective_terms(system) if minimise is None else minimise):
        raise CertificateRejected(f"{label}: problem.minimise", "not the objective of this problem")
    constraints = [(_ordered(item["terms"], order), item["relation"]) for item in stated["constraints"]]
    wrong = foreign(system, constraints, fixed_by(constraints))
    if wrong is not None:
        raise CertificateRejected(f"{label}: problem.constraints[{wrong}]", "not a condition of this problem")


def _ordered(listed: Sequence[Any], order: Sequence[int]) -> Terms:
    """A polynomial of a certificate with its variables in this order."""
    return {tuple(exponents[i] for i in order): c for exponents, c in terms_of(listed).items()}


def foreign(system: System, constraints: Sequence[tuple[Terms, str]], fixed: Mapping[int, Fraction]) -> int | None:
    """The first of these constraints (``<=`` or ``=``) that is none of the system's conditions, None if all are.

    ``fixed``: the variables that equations among the constraints fix; the other constraints may use that.
    """
    allowed = [condition_terms(system, item) for item in system.conditions]

    def known(terms: Terms, fixed: Mapping[int, Fraction]) -> bool:
        return any(multiple_of(reduced(terms, fixed), reduced(other, fixed)) is not None for other in allowed)

    for i, (terms, relation) in enumerate(constraints):
        opposite = {exponents: -coefficient for exponents, coefficient in terms.items()}
        needed = {"<=": (terms,), "=": (terms, opposite)}.get(relation, ())
        # an equation needs both of its halves among the conditions; the others may use it
        usable = fixed if relation == "<=" else {}
        if not needed or not all(known(half, usable) for half in needed):
            return i
    return None
