"""Method 1: one curve of degree n, as printed and closed."""
