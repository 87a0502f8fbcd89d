"""The arithmetic of the second ring: ideals, algebraic numbers, signatures of forms."""
