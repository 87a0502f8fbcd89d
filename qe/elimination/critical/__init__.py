"""Critical-value elimination: one block over bounded fibres. What has no compact fibres belongs to other methods."""

from qe.elimination.critical.block import ConvexBody, Disjunct, Tabulated, eliminate_block
from qe.elimination.critical.open_cells import OpenCell
from qe.elimination.critical.universal import eliminate_universal, necessary_conditions

__all__ = [
    "ConvexBody",
    "Disjunct",
    "OpenCell",
    "Tabulated",
    "eliminate_block",
    "eliminate_universal",
    "necessary_conditions",
]
