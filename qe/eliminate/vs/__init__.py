"""Virtual substitution: elimination of existential blocks of degree at most 2 (after factoring), with answers."""

from qe.eliminate.vs.block import eliminate_block
from qe.eliminate.vs.result import Answer, BlockResult, Choice
from qe.eliminate.vs.witness import witness

__all__ = ["Answer", "BlockResult", "Choice", "eliminate_block", "witness"]
