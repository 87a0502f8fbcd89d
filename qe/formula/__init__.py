"""First-order formulas over the real numbers: syntax trees, builders, normal forms, evaluation."""
