"""Certificates to test with, made by the engine's own decomposition."""

from __future__ import annotations

from functools import lru_cache

from qe.decomposition.decompose import decompose
from qe.decomposition.operators.table import OPERATORS
from qe.io.text import read
from qe.options import Budget, Projection
from qe.proof.cells import CellTable
from qe.proof.cells_json import cells_from_json
from qe.proof.certificate import Certificate
from qe.proof.entry import Entry


@lru_cache(maxsize=64)
def cell_table(
    text: str, order: str, quantifiers: str = "", projection: Projection = Projection.BROWN_MCCALLUM
) -> Certificate:
    """The certificate of a quantifier-free matrix; ``quantifiers`` has one of ``.EA`` per variable in ``order``."""
    names = tuple(order.split())
    prefix = tuple(q.replace(".", "") for q in (quantifiers or "." * len(names)))
    found = decompose(read(text), names, prefix, budget=Budget(60), operator=OPERATORS[projection])
    return Certificate.cells(found.table)


TABLE = ("payload", "steps", 0, "evidence", "cells")
"""Where the table is in the text of such a certificate."""


def table_in(certificate: Certificate) -> CellTable:
    """The table by which the one step of a certificate is proved."""
    return cells_from_json(Entry(certificate.evidence_for("cells")["cells"], "cells"))
