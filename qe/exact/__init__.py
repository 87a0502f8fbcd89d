"""Exact layer: integer polynomials, real algebraic numbers and sample points, on FLINT. Nothing here knows a formula,
and only here FLINT is called.
"""
