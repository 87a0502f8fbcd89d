"""The standard simplifier, on one theory of ranges."""
