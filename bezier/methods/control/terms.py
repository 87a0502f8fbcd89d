"""The conditions of a system as polynomials: how the entries of a certificate are matched with those of the problem.

What the certificates of a folder claim: each has to be about the conditions of one system of control points.

Everything raises ``CertificateRejected`` naming the entry that is wrong.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import partial, reduce
from typing import Any

from bezier.curves.containment import margin_terms
from bezier.curves.scalar import Terms, Vector, exactly, sign, terms_product, terms_scaled, terms_sum
from bezier.input.stored import DIMENSION, numbers
from bezier.methods.control.statements import Term
from bezier.methods.control.system import OnPoint, System
from qe.convex.near_optimum import GAP
from qe.errors import CertificateRejected
from qe.proof.certificate import Certificate


def terms_of(listed: Sequence[Any]) -> Terms:
    """A polynomial from the list [coefficient, exponents] of its terms."""
    return {tuple(exponents): Fraction(coefficient) for coefficient, exponents in listed}


def objective_terms(system: System) -> Terms:
    """The objective: the sum of |b - a|^2 along the route."""
    return _meant(system, system.objective())


def condition_terms(system: System, item: OnPoint) -> Terms:
    """The polynomial p with p <= 0 exactly on the condition."""
    point = [coordinate_terms(system, item.point, i) for i in range(3)]
    parts = (
        (c, [p for p, e in zip(point, key, strict=True) for _ in range(e)])
        for key, c in margin_terms(item.condition).items()
    )
    return terms_sum(*(reduce(terms_product, factors, {_origin(system): -c}) for c, factors in parts))


def coordinate_terms(system: System, point: str, i: int) -> Terms:
    """Coordinate i of a control point as a polynomial in the free coordinates, in the order of ``Shape.variables``."""
    return _meant(system, system.coordinate(point, i))


def _meant(system: System, term: Term) -> Terms:
    poly, factor = term.polynomial
    order = {name: k for k, name in enumerate(poly.ring.names)}
    places = [order.get(name) for name in system.shape.variables]
    return {tuple(0 if k is None else e[k] for k in places): factor * c for e, c in poly.terms()}


def multiple_of(a: Terms, b: Terms) -> Fraction | None:
    """The positive rational c with a = c * b, or None."""
    if a.keys() != b.keys() or not a:
        return None
    key = next(iter(a))
    ratio = a[key] / b[key]
    return ratio if ratio > 0 and all(a[e] == ratio * b[e] for e in a) else None


def fixed_by(constraints: Iterable[tuple[Terms, str]]) -> dict[int, Fraction]:
    """The variables that an equation c x + d = 0 among the constraints fixes, with their values."""
    result = {}
    for terms, relation in constraints:
        if relation == "=" and all(sum(exponents) <= 1 for exponents in terms):
            used = [exponents for exponents in terms if any(exponents)]
            if len(used) == 1:
                constant = terms.get((0,) * len(used[0]), Fraction(0))
                result[used[0].index(1)] = -constant / terms[used[0]]
    return result


def replaced(terms: Terms, fixed: Mapping[int, Fraction]) -> Terms:
    """The polynomial with fixed variables replaced by their values."""
    parts = []
    for exponents, coefficient in terms.items():
        kept = tuple(0 if i in fixed else k for i, k in enumerate(exponents))
        for i, value in fixed.items():
            coefficient = coefficient * value ** exponents[i]
        parts.append({kept: coefficient})
    return terms_sum(*parts)


def proof_of(certificate: Certificate) -> Any:
    """What an optimum, or a bound near one, holds of multipliers."""
    return certificate.parts[0].evidence_for("multipliers")


def named_multipliers(system: System, optimum: Any) -> list[tuple[str, Any]]:
    """(label, multiplier) for each condition with a non-zero multiplier.

    The multiplier belongs to the condition in the form |P1|^2 - r^2 <= 0 (or -z <= 0 for the table), whatever
    positive multiple of it the engine worked with.
    """
    known = [(item.label, condition_terms(system, item)) for item in system.conditions]
    stated = proof_of(optimum.certificate)["problem"]["constraints"][: len(optimum.multipliers)]
    fixed = fixed_by((terms_of(constraint["terms"]), constraint["relation"]) for constraint in stated)
    result = []
    for constraint, value in zip(stated, optimum.multipliers, strict=True):
        if sign(value):
            terms, at = terms_of(constraint["terms"]), {} if constraint["relation"] == "=" else fixed
            matches = ((label, multiple_of(replaced(terms, at), replaced(other, at))) for label, other in known)
            label, ratio = next(((name, c) for name, c in matches if c is not None), ("another condition", Fraction(1)))
            result.append((label, ratio * value))
    return result


def member(certificate: Certificate, label: str, rule: str) -> Certificate:
    """The member with this label, which has to be a derivation by one step of this rule."""
    if isinstance(certificate.payload, tuple):
        for item in certificate.payload:
            if item.label == label and item.certificate.evidence_for(rule) is not None:
                return item.certificate
    raise CertificateRejected("certificate.json", f"no derivation by {rule} with the label {label!r}")


def optimal_points(system: System, payload: Mapping[str, Any]) -> dict[str, Vector] | None:
    """The control points that the certificate of an optimum fixes, None when it shows that there are none.

    Raises ``CertificateRejected`` when they do not satisfy all conditions.
    """
    if payload["status"] != "optimal":
        return None
    stated = payload["problem"]["variables"], payload["point"], payload["field"]
    return _allowed(system, stated, ("optimum: problem.variables", "optimum.point", "optimum.point"))


def _allowed(system: System, stated: tuple[Any, Any, Any], places: tuple[str, str, str]) -> dict[str, Vector]:
    """The control points by names, values and the field of these, whose ``places`` and that of the point are told."""
    names, values, field = stated
    if tuple(names) != system.shape.variables:
        raise CertificateRejected(places[0], f"expected {', '.join(system.shape.variables)}")
    coordinates = numbers(values, field, places[1])
    points = system.points([coordinates[i : i + DIMENSION] for i in range(0, len(coordinates), DIMENSION)])
    for label in system.violated(points):
        raise CertificateRejected(places[2], f"violates the condition {label}")
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
    aim, last = (p.get(_origin(system), Fraction(0)) for p in (objective_terms(system), _last(system, payload)))
    bound = aim - last
    places = "optimum: point: order", "optimum: point: values", "optimum: point"
    points = _allowed(system, (reached["order"], reached["values"], None), places)
    value = exactly(system.objective_at(points))
    if value - bound > GAP * abs(value):
        raise CertificateRejected("optimum: bound", "not as near to the objective as it has to be")
    return points, bound


def check_bound_of(system: System, payload: Mapping[str, Any], label: str) -> None:
    """The certificate shows that the objective of the system has no value below some number under its conditions."""
    *conditions, last = payload["problem"]["constraints"]
    terms, goal = _last(system, payload), objective_terms(system)
    slopes = [{e: c for e, c in result.items() if any(e)} for result in (terms, goal)]
    if payload["status"] != "infeasible" or last["relation"] != "<" or slopes[0] != slopes[1]:
        raise CertificateRejected(f"{label}: problem.constraints", "the last one is no bound of the objective")
    weaker = {**payload, "problem": {**payload["problem"], "constraints": conditions}}
    check_optimum_of(system, weaker, label)


def _last(system: System, payload: Mapping[str, Any]) -> Terms:
    """The last condition of a certificate."""
    stated = payload["problem"]
    if not stated["constraints"] or sorted(stated["variables"]) != sorted(system.shape.variables):
        raise CertificateRejected("optimum: bound: problem", "not about the control points of this problem")
    return _ordered(system, stated["variables"], stated["constraints"][-1]["terms"])


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
    ordered = partial(_ordered, system, stated["variables"])
    if ordered(stated["minimise"]) != (objective_terms(system) if minimise is None else minimise):
        raise CertificateRejected(f"{label}: problem.minimise", "not the objective of this problem")
    constraints = [(ordered(item["terms"]), item["relation"]) for item in stated["constraints"]]
    wrong = foreign(system, constraints, fixed_by(constraints))
    if wrong is not None:
        raise CertificateRejected(f"{label}: problem.constraints[{wrong}]", "not a condition of this problem")


def _ordered(system: System, variables: Sequence[str], listed: Sequence[Any]) -> Terms:
    """A polynomial of a certificate in these variables, by those of the system in their order."""
    order = [variables.index(name) for name in system.shape.variables]
    return {tuple(exponents[i] for i in order): c for exponents, c in terms_of(listed).items()}


def foreign(system: System, constraints: Sequence[tuple[Terms, str]], fixed: Mapping[int, Fraction]) -> int | None:
    """The first of these constraints (``<=`` or ``=``) that is none of the system's conditions, None if all are.

    ``fixed``: the variables that equations among the constraints fix; the other constraints may use that.
    """
    allowed = [condition_terms(system, item) for item in system.conditions]

    def known(terms: Terms, fixed: Mapping[int, Fraction]) -> bool:
        return any(multiple_of(replaced(terms, fixed), replaced(other, fixed)) is not None for other in allowed)

    for i, (terms, relation) in enumerate(constraints):
        # an equation needs both of its halves among the conditions; the others may use it
        needed = {"<=": (terms,), "=": (terms, terms_scaled(-1, terms))}.get(relation, ())
        if not needed or not all(known(half, fixed if relation == "<=" else {}) for half in needed):
            return i
    return None
