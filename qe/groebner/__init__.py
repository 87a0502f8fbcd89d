"""Parametric ideals: comprehensive Gröbner systems and the real solutions that they count."""
