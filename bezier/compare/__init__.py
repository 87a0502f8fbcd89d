"""Quadratic and cubic side by side, in space and in the plane of the via points."""
