"""Exact Bézier curves: points, joins, signs, containment, length and curvature. What is a path of several of them is in
``bezier.paths``; obstacles and arms know curves, not the other way round.
"""
