"""Control points that follow from free ones: the polynomials of formulas (7) and (8), each with its label. Which
formula is solved how belongs to each method.
"""
