"""Cell tables as JSON and back.

A stack is written with the sample of every sector, and for every section the factors that vanish on it, each
with its root number (1 for the smallest root of that factor over the cell). The section's isolating interval is
the one between the two neighbouring sector samples. The root numbers repeat what the order of the sections says
already; the reader checks them.
"""

from __future__ import annotations

from qe.exact.ring import Ring
from qe.options import Projection
from qe.proof.cells import Cell, CellTable, Stack
from qe.proof.entry import Entry, Json, formula_from_json, formula_to_json, poly_to_text


def cells_to_json(table: CellTable) -> Json:
    """The table as JSON data; ``cells_from_json`` reads it back."""
    return {
        "order": list(table.order),
        "quantifiers": list(table.quantifiers),
        "matrix": formula_to_json(table.matrix),
        "projection": table.projection.value,
        "factors": [[poly_to_text(f) for f in level] for level in table.factors],
        "constraints": [list(level) for level in table.constraints],
        "root": _cell_to_json(table.root),
    }


def _cell_to_json(cell: Cell) -> Json:
    out: dict[str, Json] = {"signs": cell.signs, "truth": cell.truth}
    if cell.reach is not None:
        out |= {"reach": list(cell.reach), "own": None if cell.own is None else list(cell.own)}
    stack = cell.stack
    if stack is not None:
        met: dict[int, int] = {}
        sections: list[Json] = []
        for section in stack.sections:
            numbered: list[Json] = []
            for i in section:
                met[i] = met.get(i, 0) + 1
                numbered.append([i, met[i]])
            sections.append(numbered)
        out["stack"] = {
            "used": list(stack.used),
            "sectors": [str(s) for s in stack.sectors],
            "sections": sections,
            "cells": [_cell_to_json(c) for c in stack.cells],
        }
    return out


def cells_from_json(entry: Entry) -> CellTable:
    """The table; ``CertificateRejected`` names the first malformed entry."""
    order, quantifiers, matrix, projection, factors, constraints, root = entry.fields(
        "order", "quantifiers", "matrix", "projection", "factors", "constraints", "root"
    )
    names = order.names()
    ring = Ring.of(names)
    levels = list(factors.items())
    try:
        operator = Projection(projection.text())
    except ValueError:
        raise projection.fail("unknown projection operator") from None
    return CellTable(
        order=names,
        quantifiers=tuple(e.text() for e in quantifiers.items()),
        matrix=formula_from_json(matrix, ring),
        projection=operator,
        factors=tuple(tuple(f.polynomial(ring) for f in level.items()) for level in levels),
        root=_cell_from_json(root, len(names)),
        constraints=tuple(tuple(e.integer() for e in level.items()) for level in constraints.items()),
    )


def _cell_from_json(entry: Entry, depth: int) -> Cell:
    signs, truth, stack, reach, own = entry.fields("signs", "truth", optional=("stack", "reach", "own"))
    interval: tuple[tuple[int, int, int] | None, tuple[int, ...] | None] = (None, None)
    if reach.value is not None:
        first, last, at = (e.integer() for e in reach.row("first", "last", "at"))
        interval = (first, last, at), None if own.value is None else tuple(e.integer() for e in own.items())
    elif own.value is not None:
        raise own.fail("an interval expected")
    if stack.value is None:
        return Cell(signs.text(), truth.truth(), None, *interval)
    if depth == 0:
        raise stack.fail("a stack above the last variable")
    used, sectors, sections, cells = stack.fields("used", "sectors", "sections", "cells")
    met: dict[int, int] = {}
    above = Stack(
        used=tuple(e.integer() for e in used.items()),
        sectors=tuple(e.rational() for e in sectors.items()),
        sections=tuple(_section(e, met) for e in sections.items()),
        cells=tuple(_cell_from_json(e, depth - 1) for e in cells.items()),
    )
    return Cell(signs.text(), truth.truth(), above, *interval)


def _section(entry: Entry, met: dict[int, int]) -> tuple[int, ...]:
    listed = []
    for pair in entry.items():
        parts = list(pair.items())
        if len(parts) != 2:
            raise pair.fail("expected a factor and its root number")
        i, number = parts[0].integer(), parts[1].integer()
        met[i] = met.get(i, 0) + 1
        if number != met[i]:
            raise parts[1].fail(f"this is root number {met[i]} of the factor, not {number}")
        listed.append(i)
    return tuple(listed)
