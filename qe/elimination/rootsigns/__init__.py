"""Blocks about the roots of one polynomial, by the signs of the minors of Hermite's forms. Systems of several
polynomials in several variables are in ``qe.groebner``.
"""
