"""Comprehensive Groebner systems and partitions as data, as JSON texts, and back.

A text carries a format, a version and the SHA-256 digest of the rest, as certificates do. What follows from other
entries (leading monomials, dimensions, conditions as text) is worked out again and compared; the digest tells damage.
Neither proves that the segments are right: that is what certificates are for.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from itertools import zip_longest
from typing import TypeVar

from qe import arguments
from qe.errors import CertificateRejected, InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.block_order import BlockOrder
from qe.exact.groebner import MonomialOrder
from qe.exact.ring import Poly, Ring
from qe.groebner.segment import Segment, monomial_names
from qe.proof.certificate import digest
from qe.proof.entry import Entry, Json, poly_to_text, read_json

Result = TypeVar("Result")
Parts = tuple[tuple[Poly, ...], BlockOrder, dict[str, RealAlgebraic], tuple[Segment, ...]]
"""Generators, variables and parameters, constants, segments."""

VERSION = 1


def written(what: str, data: Mapping[str, Json], indent: int | None) -> str:
    """Data as a text that ``read`` reads."""
    if indent is not None:
        arguments.whole(indent, "indent", 80)
    whole: dict[str, Json] = {"format": f"bezier-qe {what}", "version": VERSION, **data}
    return json.dumps({**whole, "digest": digest(whole)}, indent=indent, ensure_ascii=False)


def read(text: str, what: str, build: Callable[[Entry], Result], data_of: Callable[[Result], Json]) -> Result:
    """What ``build`` makes of the entries of a text by ``written``; ``data_of`` must give the same entries again.

    Raises ``InputError`` with one line that names the entry that is wrong.
    """
    try:
        whole = read_json(arguments.text(text, what))
    except (ValueError, RecursionError) as error:
        raise InputError(f"{what}: JSON expected; {error}") from None
    if not isinstance(whole, dict) or whole.get("format") != f"bezier-qe {what}":
        raise InputError(f'{what}: an object with "format": "bezier-qe {what}" expected')
    if whole.get("version") is not VERSION:
        raise InputError(f"{what}: version {VERSION} expected, {arguments.shown(whole.get('version'))} found")
    content = {key: value for key, value in whole.items() if key not in ("format", "version", "digest")}
    try:
        found = build(Entry(content, ""))
        if whole.get("digest") != digest(whole):
            raise CertificateRejected("digest", "the rest was changed after it was written")
        _compare(Entry(content, ""), data_of(found))
    except CertificateRejected as error:
        raise InputError(f"{what}: {error}") from None
    except RecursionError:
        raise InputError(f"{what}: nested too deeply") from None
    return found


def _compare(entry: Entry, expected: Json) -> None:
    """The same values everywhere."""
    value = entry.value
    if isinstance(value, dict) and isinstance(expected, dict) and value.keys() == expected.keys():
        for part, key in zip(entry.fields(*expected), expected, strict=True):
            _compare(part, expected[key])
    elif isinstance(value, list) and isinstance(expected, list) and len(value) == len(expected):
        for part, other in zip_longest(entry.items(), expected):
            _compare(part, other)
    elif type(value) is not type(expected) or value != expected:
        raise entry.fail(f"expected {arguments.shown(expected)}, found {arguments.shown(value)}")


# --- systems ---------------------------------------------------------------------------------------------------------


def texts(polys: Sequence[Poly]) -> list[Json]:
    """Polynomials as text."""
    return [poly_to_text(p) for p in polys]


def system_data(
    polys: Sequence[Poly], block: BlockOrder, constants: Mapping[str, RealAlgebraic], segments: Sequence[Segment]
) -> dict[str, Json]:
    """A system as plain data: polynomials as text, constants as text and as [minimal polynomial, index of the root]."""
    names = polys[0].ring.names
    variables = [names[i] for i in block.variables]

    def entries(segment: Segment) -> Json:
        found: dict[str, Json] = {
            "equal": texts(segment.equal),
            "nonzero": texts(segment.nonzero),
            "some_nonzero": texts(segment.some),
            "basis": texts(segment.basis),
            "elements": texts(segment.elements),
            "leading": [monomial_names(e, variables) for e in segment.leads],
            "dimension": segment.dimension,
        }
        return found if segment.faithful is None else {**found, "faithful": texts(segment.faithful)}

    return {
        "polynomials": texts(polys),
        "variables": list[Json](variables),
        "parameters": [n for i in block.parameters if (n := names[i]) not in constants],
        "constants": {name: str(value) for name, value in constants.items()},
        "numbers": {n: [list[Json](v.minimal_polynomial), v.index] for n, v in constants.items()},
        "order": block.order.value,
        "segments": [entries(s) for s in segments],
    }


def system_parts(entry: Entry) -> Parts:
    """What ``system_data`` wrote. Raises ``CertificateRejected`` where an entry is malformed."""
    names = ("polynomials", "variables", "parameters", "constants", "numbers", "order", "segments")
    polys, variables, parameters, _, numbers, order, segments = entry.fields(*names)
    if not isinstance(numbers.value, dict):
        raise numbers.fail("expected an object")
    constants = {name: _number(Entry(value, f"{numbers.path}.{name}")) for name, value in numbers.value.items()}
    largest, others = variables.names(), parameters.names()
    if not largest or len({*largest, *others, *constants}) < len(largest) + len(others) + len(constants):
        raise variables.fail("expected different variables, at least one, and no parameter or constant among them")
    ring = Ring.of((*constants, *reversed(others), *reversed(largest)))
    try:
        chosen = MonomialOrder(order.text())
    except ValueError:
        raise order.fail(f"expected one of {', '.join(o.value for o in MonomialOrder)}") from None
    places = tuple(ring.index[n] for n in (*others, *reversed([*constants])))
    block = BlockOrder(tuple(ring.index[n] for n in largest), places, chosen)
    given = polynomials(polys, ring)
    if not given:
        raise polys.fail("expected at least one polynomial")
    return given, block, constants, tuple(_segment(e, block, ring) for e in segments.items())


def polynomials(entry: Entry, ring: Ring) -> tuple[Poly, ...]:
    """A list of them."""
    return tuple(e.polynomial(ring) for e in entry.items())


def _number(entry: Entry) -> RealAlgebraic:
    parts = list(entry.items())
    if len(parts) != 2:
        raise entry.fail("expected [coefficients of a minimal polynomial, index of a root]")
    coefficients, index = [e.value for e in parts[0].items()], parts[1].integer()
    try:
        return RealAlgebraic.by_index(arguments.integers(coefficients, "coefficients"), index)
    except InputError as error:
        raise entry.fail(str(error)) from None


def _segment(entry: Entry, block: BlockOrder, ring: Ring) -> Segment:
    names = ("equal", "nonzero", "some_nonzero", "basis", "elements", "leading", "dimension")
    *lists, _, _, faithful = entry.fields(*names, optional=("faithful",))
    equal, nonzero, some, basis, elements = (polynomials(e, ring) for e in lists)
    for part, group in zip(lists, (equal, nonzero, some), strict=False):
        if not all(block.is_free(p) for p in group):
            raise part.fail("expected polynomials in the parameters")
    for part, group in zip(lists, (equal, nonzero, some, basis, elements), strict=True):
        if not all(group):
            raise part.fail("expected polynomials other than 0")
    known = None if isinstance(entry.value, dict) and "faithful" not in entry.value else polynomials(faithful, ring)
    if known is not None and len(known) != len(elements):
        raise faithful.fail("expected as many polynomials as elements")
    return Segment(block, equal, nonzero, some, basis, elements, known)
