"""Exact Bézier curves: points, joins, signs, containment, length and curvature."""
