"""Method 2 with three quadratic curves: formula (8)."""
