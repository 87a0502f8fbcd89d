"""Convex quadratic systems: read, minimise, prove, feasible, faces. What is not convex, or not quadratic, goes to
``qe.optimization``.
"""
