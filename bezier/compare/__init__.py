"""Quadratic and cubic side by side, in space and in the plane of the via points. Each method plans in a folder of its
own, ``bezier.methods``, which knows no other.
"""
