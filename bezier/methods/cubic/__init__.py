"""Method 2 with three cubic curves: formula (7)."""
