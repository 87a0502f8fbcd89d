"""Reading back what ``bezier plan`` wrote: files, exact numbers, members of certificates, and whom they speak about.

Everything raises ``CertificateRejected`` naming the entry that is wrong, or ``InputError`` for files that cannot be
opened.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from bezier.curves.curve import Bezier
from bezier.curves.scalar import Vector
from bezier.input.numbers import NotANumber, parse
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
from bezier.problem import Problem, from_json
from qe.errors import CertificateRejected, InputError
from qe.proof.certificate import Certificate, Kind

MAX_BYTES = 200_000_000
MAX_CHARACTERS = 4000
"""Of one number: algebraic numbers of high degree have long coefficients, and Python reads up to 4300 digits."""
DIMENSION = 3


@dataclass(frozen=True, slots=True)
class Stated:
    """What a folder says besides its certificates: ``summary.json``, and ``path.json`` where there is one."""

    summary: Mapping[str, Any]
    path: Mapping[str, Any] | None


def text(path: FilePath) -> str:
    """The text of a file of moderate size."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise InputError(f"{path}: expected at most {MAX_BYTES} bytes")
        return path.read_bytes().decode("utf-8")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise CertificateRejected(path.name, "expected UTF-8 text") from None


def table(path: FilePath) -> dict[str, Any]:
    """The JSON object in a file, decimals kept as text."""
    try:
        found = parsed(text(path))
    except (ValueError, RecursionError) as error:
        raise CertificateRejected(path.name, f"expected JSON, found: {error}") from None
    if not isinstance(found, dict):
        raise CertificateRejected(path.name, "expected a JSON object")
    return found


def parsed(raw: str) -> Any:
    """JSON with decimals kept as text. Raises ``ValueError`` for other text, NaN, infinity and repeated names."""
    return json.loads(raw, parse_float=str, parse_constant=_refused, object_pairs_hook=_no_repeats)


def _refused(name: str) -> Any:
    raise ValueError(f"{name}, which is no number")


def _no_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a name that occurs twice in one object")
    return found


def entry(table: Mapping[str, Any], key: str, kind: type, place: str = "") -> Any:
    """A value of this type under a key."""
    value = table.get(key)
    if not isinstance(value, kind):
        words = {dict: "an object", list: "a list", str: "a string"}
        raise CertificateRejected(f"{place}{key}", f"expected {words.get(kind, kind.__name__)}")
    return value


def rational(raw: object, place: str) -> Fraction:
    """An exact number given as text."""
    try:
        return parse(raw if isinstance(raw, str) else "", MAX_CHARACTERS)
    except NotANumber as error:
        raise CertificateRejected(place, f"expected an exact number, found {error}") from None


def numbers(rows: Sequence[Any], field: Mapping[str, Any] | None, place: str) -> Vector:
    """Exact numbers from their coefficients in a number field, which is Q for None."""
    if field is None:
        return tuple(rational(row, place) for row in rows)
    from qe.exact.field import NumberField

    try:
        low, high = (rational(end, f"{place}.field.interval") for end in field["interval"])
        base = NumberField.from_root([int(c) for c in field["minimal_polynomial"]], low, high)
    except (KeyError, TypeError, ValueError, InputError) as error:
        raise CertificateRejected(f"{place}.field", f"not a number field: {error}") from None
    if not all(isinstance(row, list) and row for row in rows):
        raise CertificateRejected(place, "expected the coefficients of each number")
    values = (base.element([rational(c, place) for c in row]) for row in rows)
    return tuple(v.as_fraction() if v.is_rational else v for v in values)


# --- the problem and the path --------------------------------------------------------------------------------------


def stated_problem(found: Mapping[str, Any], file: str) -> Problem:
    """The problem that a table read from a file states."""
    try:
        return from_json(found, "problem")
    except InputError as error:
        raise CertificateRejected(file, str(error)) from None


def control_points(found: Mapping[str, Any]) -> dict[str, Vector]:
    """The control points in the table of a ``path.json``."""
    points = {}
    for name, listed in entry(found, "points", dict, "path.json: ").items():
        place = f"path.json: points.{name}"
        if not isinstance(listed, list) or len(listed) != DIMENSION or not all(isinstance(c, dict) for c in listed):
            raise CertificateRejected(place, f"expected a point of {DIMENSION} coordinates")
        points[name] = tuple(_coordinate(c, found, f"{place}[{i}]") for i, c in enumerate(listed))
    return points


def _coordinate(stated: Mapping[str, Any], found: Mapping[str, Any], place: str) -> Any:
    if "in_field" not in stated:
        return rational(stated.get("exact"), place)
    return numbers([stated["in_field"]], entry(found, "field", dict, "path.json: "), place)[0]


def stored_path(found: Mapping[str, Any]) -> tuple[Problem, dict[str, Bezier]]:
    """The problem and the curves in the table of a ``path.json``."""
    points = control_points(found)
    curves = {}
    for name, row in entry(found, "curves", dict, "path.json: ").items():
        if not isinstance(row, list) or not row or not all(isinstance(p, str) and p in points for p in row):
            raise CertificateRejected(f"path.json: curves.{name}", "expected names of control points")
        curves[name] = Bezier.of([points[p] for p in row])
    return stated_problem(entry(found, "problem", dict, "path.json: "), "path.json"), curves


# --- certificates --------------------------------------------------------------------------------------------------


def member(certificate: Certificate, label: str, kind: Kind) -> Any:
    """The payload of the member with this label and kind."""
    if isinstance(certificate.payload, tuple):
        for item in certificate.payload:
            if item.label == label and item.certificate.kind is kind:
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
