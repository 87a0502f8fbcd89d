"""The former place of ``bezier.methods.cubic.existence``."""

from bezier.methods.cubic.existence import existence, sentence, trivial_witness

__all__ = ["existence", "sentence", "trivial_witness"]
