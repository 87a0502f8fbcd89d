"""Critical-value elimination: one block over bounded fibres."""

from qe.eliminate.critical.block import ConvexBody, Disjunct, Tabulated, eliminate_block
from qe.eliminate.critical.helpers import Helpers, Proposal
from qe.eliminate.critical.open_cells import OpenCell
from qe.eliminate.critical.universal import eliminate_universal

__all__ = [
    "ConvexBody",
    "Disjunct",
    "Helpers",
    "OpenCell",
    "Proposal",
    "Tabulated",
    "eliminate_block",
    "eliminate_universal",
]
