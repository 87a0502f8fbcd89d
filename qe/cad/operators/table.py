"""All projection operators by name."""

from __future__ import annotations

from collections.abc import Mapping

from qe.cad.operators.brown_mccallum import BROWN_MCCALLUM
from qe.cad.operators.lazard import LAZARD
from qe.cad.operators.mccallum import MCCALLUM
from qe.cad.operators.operator import Operator
from qe.options import Projection

OPERATORS: Mapping[Projection, Operator] = {o.name: o for o in (BROWN_MCCALLUM, LAZARD, MCCALLUM)}
