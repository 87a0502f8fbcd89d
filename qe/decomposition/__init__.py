"""Decompositions of space on whose parts a formula has one truth value: cell tables and coverings, how they are found
(projection, constraints, order, lines over samples) and read (formulas, pieces, fibres).

What tries them on a problem, and with what else, is in ``qe.elimination``; what checks them is in ``qe.kernel``.
"""
