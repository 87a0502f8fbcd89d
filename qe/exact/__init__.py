"""Exact layer: integer polynomials, real algebraic numbers and sample points, on FLINT."""
