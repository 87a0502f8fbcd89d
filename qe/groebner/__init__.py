"""Parametric ideals: comprehensive Gröbner systems and the real solutions that they count. Gröbner bases over the
rationals are in ``qe.exact``.
"""
