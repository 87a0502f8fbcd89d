"""Reading back what ``bezier plan`` wrote: files, exact numbers, members of certificates, and whom they speak about.

Everything raises ``CertificateRejected`` naming the entry that is wrong, or ``InputError`` for unreadable files.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import qe
from bezier.control import System
from bezier.curves.scalar import Vector
from bezier.input.numbers import NotANumber, parse
from bezier.terms import Terms, condition_terms, fixed_values, multiple_of, objective_terms, reduced, terms_of
from qe.errors import CertificateRejected, InputError
from qe.formula.syntax import Formula
from qe.proof.certificate import Certificate, Kind

MAX_BYTES = 200_000_000
MAX_CHARACTERS = 4000
"""Of one number: algebraic numbers of high degree have long coefficients, and Python reads up to 4300 digits."""


def text(path: FilePath) -> str:
    """The text of a file of moderate size."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise InputError(f"{path}: expected at most {MAX_BYTES} bytes")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: expected UTF-8 text") from None


def table(path: FilePath) -> dict[str, Any]:
    """The JSON object in a file, decimals kept as text."""
    try:
        found = json.loads(text(path), parse_float=str)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: expected JSON, found: {error}") from None
    if not isinstance(found, dict):
        raise InputError(f"{path}: expected an object")
    return found


def entry(table: Mapping[str, Any], key: str, kind: type) -> Any:
    """A value of this type under a key."""
    value = table.get(key)
    if not isinstance(value, kind):
        raise CertificateRejected(key, f"expected {kind.__name__}")
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
    values = (base.element([rational(c, place) for c in row]) for row in rows)
    return tuple(v.as_fraction() if v.is_rational else v for v in values)


def member(certificate: Certificate, label: str, kind: Kind) -> Any:
    """The payload of the member with this label and kind."""
    if isinstance(certificate.payload, tuple):
        for item in certificate.payload:
            if item.label == label and item.certificate.kind is kind:
                return item.certificate.payload
    raise CertificateRejected("certificate.json", f"no certificate about the {label}")


def certified_answer(system: System, certificate: Certificate) -> Formula:
    """The answer to this system's formula as printed; its certificate must be there if the engine makes one."""
    answer = qe.eliminate(system.formula())
    if answer.certificate is not None:
        payload = member(certificate, "elimination", answer.certificate.kind)
        if payload != answer.certificate.payload:
            raise CertificateRejected("elimination", "not about the formula of this problem")
    assert answer.formula is not None
    return answer.formula


def certified_points(system: System, certificate: Certificate) -> dict[str, Vector] | None:
    """The control points that the certificate of the optimum fixes, None when it shows that there are none.

    Checked here: it minimises the objective of this system under conditions of this system only, and its point
    satisfies all of them. Then the point is the optimum, and a contradiction is one of the system.
    """
    payload = member(certificate, "optimum", Kind.OPTIMUM)
    _check_problem(system, payload["problem"])
    if payload["status"] != "optimal":
        return None
    flat = numbers(payload["point"], payload["field"], "optimum.point")
    points = system.points([flat[i : i + 3] for i in range(0, len(flat), 3)])
    for label in system.violated(points):
        raise CertificateRejected("optimum.point", f"violates the condition {label}")
    return points


def _check_problem(system: System, stated: Mapping[str, Any]) -> None:
    if tuple(stated["variables"]) != system.shape.variables:
        raise CertificateRejected("optimum.problem.variables", f"expected {', '.join(system.shape.variables)}")
    if terms_of(stated["minimise"]) != objective_terms(system):
        raise CertificateRejected("optimum.problem.minimise", "not the objective of this problem")
    allowed = [condition_terms(system, item) for item in system.conditions]
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
