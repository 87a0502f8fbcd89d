"""Global optima of any polynomial over any semialgebraic set, by elimination; with parameters as functions of them.
Convex quadratic problems are in ``qe.convex``.
"""
