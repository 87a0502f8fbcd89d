"""Cylindrical algebraic coverings: existential sentences decided by intervals that overlap, one sample at a time."""
