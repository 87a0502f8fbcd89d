"""Virtual substitution: elimination of existential blocks of degree at most 2 (after factoring), with answers."""

from qe.elimination.vs.block import eliminate_block
from qe.elimination.vs.result import Answer, BlockResult, Choice
from qe.elimination.vs.witness import witness

__all__ = ["Answer", "BlockResult", "Choice", "eliminate_block", "witness"]
