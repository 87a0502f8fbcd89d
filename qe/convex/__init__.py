"""Convex quadratic systems: read, minimise, prove, feasible, faces."""
