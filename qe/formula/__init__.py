"""First-order formulas over the real numbers: syntax trees, builders, normal forms, evaluation. Nothing here changes
what a formula means but by its definition; simplification is in ``qe.simplifier``.
"""
