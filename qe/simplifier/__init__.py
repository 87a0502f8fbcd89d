"""The standard simplifier, on one theory of ranges. Rules that need the structure of a block are in ``qe.rules``."""
