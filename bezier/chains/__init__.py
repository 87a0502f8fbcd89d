"""Chains of Bézier curves through many via points: the convex problem, its optimum between two rational numbers, or why
there is none. Formulas (7) and (8) are not here (``bezier.methods``), nor are paths around obstacles."""
