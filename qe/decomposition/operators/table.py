"""All projection operators by name."""

from __future__ import annotations

from collections.abc import Mapping

from qe.decomposition.operators.brown_mccallum import BROWN_MCCALLUM
from qe.decomposition.operators.lazard import LAZARD
from qe.decomposition.operators.mccallum import MCCALLUM
from qe.decomposition.operators.operator import Operator
from qe.options import Projection

OPERATORS: Mapping[Projection, Operator] = {
    Projection.BROWN_MCCALLUM: BROWN_MCCALLUM,
    Projection.LAZARD: LAZARD,
    Projection.MCCALLUM: MCCALLUM,
}
