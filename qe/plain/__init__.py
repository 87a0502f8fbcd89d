"""The plain reader: the checkers of the kernel with arithmetic of plain Python in the place of FLINT. A rule is never
checked otherwise than in ``qe.kernel``, whose files run here as they are.
"""
