"""``bezier check``: verify a folder that ``bezier plan`` wrote, from the exact numbers in its files.

Beyond ``qe check`` on the certificates, this links the files: the certificates speak about this problem, the
point in ``path.json`` is the certified one, and the path is proved again from its control points.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import qe
from bezier import quadratic
from bezier.curve import Bezier, Smoothness
from bezier.numbers import NotANumber, parse
from bezier.path import Path, assemble
from bezier.problem import PlanMethod, Problem
from bezier.scalar import Vector, same, sign
from bezier.terms import Terms, condition_terms, fixed_values, multiple_of, objective_terms, reduced, terms_of
from bezier.workspace import Workspace, WorkspaceKind
from qe.certify.verify import verify
from qe.errors import CertificateRejected, InputError
from qe.evidence.cells_json import CellEvidence
from qe.evidence.certificate import Certificate, Kind
from qe.worker import Channel

MAX_BYTES = 200_000_000
TOLERANCE = 1e-9
"""Relative difference allowed between a decimal for people and the exact number beside it."""


def recheck(channel: Channel, folder: FilePath) -> list[str]:
    """Lines saying what was checked. Raises ``CertificateRejected`` naming the first entry that is wrong."""
    certificate = Certificate.from_json(_text(folder / "certificate.json"))
    verdict = verify(certificate)
    if not verdict.accepted:
        raise CertificateRejected(f"certificate.json: {verdict.step}", verdict.reason)
    lines = ["certificate.json: accepted"]
    table = _member(certificate, "region", Kind.CELLS)
    optimum: Any = _member(certificate, "optimum", Kind.OPTIMUM)
    stored = _json(folder / ("path.json" if optimum["status"] == "optimal" else "summary.json"))
    problem = _problem(_entry(stored, "problem", dict))
    _check_region(problem, table)
    lines.append("the region belongs to formula (8) of this problem")
    _check_optimum(problem, optimum)
    if optimum["status"] != "optimal":
        return [*lines, "no control point exists: the conditions contradict each other"]
    lines.append("the optimum belongs to this problem")
    points = _points(stored)
    _check_points(problem, points, _numbers(optimum["point"], optimum["field"], "optimum.point"))
    path = assemble(_curves(stored, points), points, problem.workspace)
    _check_path(path, stored)
    lines.append(f"path.json: {path.smoothness.name} at every join, every curve proved to lie in the workspace")
    return lines


def _member(certificate: Certificate, label: str, kind: Kind) -> object:
    """The payload of the member with this label and kind."""
    if isinstance(certificate.payload, tuple):
        for member in certificate.payload:
            if member.label == label and member.certificate.kind is kind:
                return member.certificate.payload
    raise CertificateRejected("certificate.json", f"no certificate about the {label}")


def _text(path: FilePath) -> str:
    try:
        if path.stat().st_size > MAX_BYTES:
            raise InputError(f"{path}: expected at most {MAX_BYTES} bytes")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: expected UTF-8 text") from None


def _json(path: FilePath) -> dict[str, Any]:
    try:
        found = json.loads(_text(path), parse_float=str)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: expected JSON, found: {error}") from None
    if not isinstance(found, dict):
        raise InputError(f"{path}: expected an object")
    return found


def _entry(table: Mapping[str, Any], key: str, kind: type) -> Any:
    value = table.get(key)
    if not isinstance(value, kind):
        raise CertificateRejected(key, f"expected {kind.__name__}")
    return value


def _rational(raw: object, place: str) -> Fraction:
    try:
        return parse(raw if isinstance(raw, str) else "")
    except NotANumber as error:
        raise CertificateRejected(place, f"expected an exact number, found {error}") from None


def _rationals(raw: object, place: str, count: int = 3) -> Vector:
    if not isinstance(raw, list) or len(raw) != count:
        raise CertificateRejected(place, f"expected {count} numbers")
    return tuple(_rational(entry, f"{place}[{i}]") for i, entry in enumerate(raw))


def _problem(table: Mapping[str, Any]) -> Problem:
    try:
        kind, method = WorkspaceKind(table.get("workspace")), PlanMethod(table.get("method"))
    except ValueError as error:
        raise CertificateRejected("problem", str(error)) from None
    via = _entry(table, "via", list)
    if len(via) != 2:
        raise CertificateRejected("problem.via", "expected two points")
    squared = _rational(table.get("radius_squared"), "problem.radius_squared")
    return Problem(
        method=method,
        workspace=Workspace(kind, squared),
        start=_rationals(table.get("start"), "problem.start"),
        via=(_rationals(via[0], "problem.via[0]"), _rationals(via[1], "problem.via[1]")),
        goal=_rationals(table.get("goal"), "problem.goal"),
        radius_is_auto=False,
    )


def _check_region(problem: Problem, payload: object) -> None:
    """The region's certificate is about the answer to this problem's formula."""
    if not isinstance(payload, CellEvidence):
        raise CertificateRejected("region", "expected a cell table")
    answer = qe.eliminate(quadratic.formula(problem)).formula
    matrix = payload.table.matrix
    if str(answer) != str(matrix) and not qe.equivalent(answer, matrix):
        raise CertificateRejected("region", "the cell table is about another formula")


def _check_optimum(problem: Problem, payload: Mapping[str, Any]) -> None:
    """The optimum's certificate minimises the objective, under conditions of this problem only."""
    stated = payload["problem"]
    if tuple(stated["variables"]) != quadratic.FREE:
        raise CertificateRejected("optimum.problem.variables", f"expected {', '.join(quadratic.FREE)}")
    if terms_of(stated["minimise"]) != objective_terms(problem):
        raise CertificateRejected("optimum.problem.minimise", "not the objective of this problem")
    allowed = [condition_terms(item.condition) for item in quadratic.as_conditions_on_q1(problem)]
    fixed = fixed_values(stated["constraints"])

    def known(terms: Terms, fixed: Mapping[int, Fraction]) -> bool:
        return any(multiple_of(reduced(terms, fixed), reduced(other, fixed)) is not None for other in allowed)

    for i, constraint in enumerate(stated["constraints"]):
        terms = terms_of(constraint["terms"])
        opposite = {exponents: -coefficient for exponents, coefficient in terms.items()}
        needed = {"<=": (terms,), "=": (terms, opposite)}.get(constraint["relation"], ())
        # an equation needs both of its halves among the conditions; the others may use it
        usable = fixed if constraint["relation"] == "<=" else {}
        if not needed or not all(known(half, usable) for half in needed):
            raise CertificateRejected(f"optimum.problem.constraints[{i}]", "not a condition of this problem")


def _numbers(rows: Sequence[Any], field: Mapping[str, Any] | None, place: str) -> Vector:
    """Exact numbers from their coefficients in a number field."""
    if field is None:
        return tuple(_rationals(row, place, 1)[0] for row in rows)
    from qe.exact.field import NumberField

    try:
        low, high = (_rational(end, f"{place}.field.interval") for end in field["interval"])
        base = NumberField.from_root([int(c) for c in field["minimal_polynomial"]], low, high)
    except (KeyError, TypeError, ValueError, InputError) as error:
        raise CertificateRejected(f"{place}.field", f"not a number field: {error}") from None
    values = (base.element([_rational(c, place) for c in row]) for row in rows)
    return tuple(v.as_fraction() if v.is_rational else v for v in values)


def _points(stored: Mapping[str, Any]) -> dict[str, Vector]:
    """The control points, each coordinate with its decimal compared to the exact number."""
    found = {}
    for name, listed in _entry(stored, "points", dict).items():
        coordinates = []
        for i, entry in enumerate(listed):
            place = f"points.{name}[{i}]"
            if "in_field" in entry:
                value = _numbers([entry["in_field"]], _entry(stored, "field", dict), place)[0]
                if str(value) != entry.get("exact"):
                    raise CertificateRejected(place, "exact text and coefficients differ")
            else:
                value = _rational(entry.get("exact"), place)
            difference = float(value) - float(_rational(entry.get("decimal"), place))
            if abs(difference) > TOLERANCE * max(1.0, abs(float(value))):
                raise CertificateRejected(place, "decimal and exact number differ")
            coordinates.append(value)
        found[name] = tuple(coordinates)
    return found


def _curves(stored: Mapping[str, Any], points: Mapping[str, Vector]) -> dict[str, Bezier]:
    try:
        listed = _entry(stored, "curves", dict).items()
        return {name: Bezier.of([points[p] for p in row]) for name, row in listed}
    except (KeyError, TypeError) as error:
        raise CertificateRejected("curves", f"unknown control point {error}") from None


def _check_points(problem: Problem, points: Mapping[str, Vector], optimal: Vector) -> None:
    """The control points are those that follow from the certified Q1."""
    if "Q1" not in points or not same(points["Q1"], optimal):
        raise CertificateRejected("points.Q1", "not the point of the certificate")
    expected = quadratic.control_points(problem, points["Q1"])
    for name, point in expected.items():
        if name not in points or not same(points[name], point):
            raise CertificateRejected(f"points.{name}", "does not follow from the problem and Q1")
    for item in quadratic.point_conditions(problem.workspace):
        if sign(item.condition.margin(points[item.point])) < 0:
            raise CertificateRejected(f"points.{item.point}", "outside the workspace")


def _check_path(path: Path, stored: Mapping[str, Any]) -> None:
    if list(path.curves) != ["P", "Q", "R"]:
        raise CertificateRejected("curves", "expected the curves P, Q, R")
    for proof in path.violations:
        raise CertificateRejected(f"curves.{proof.curve}", f"leaves the {proof.condition.name}")
    claimed = [entry.get("smoothness") for entry in _entry(stored, "joins", list)]
    if claimed != [item.join.smoothness.name for item in path.joins] or path.smoothness < Smoothness.C1:
        raise CertificateRejected("joins", "not as smooth as stated")
