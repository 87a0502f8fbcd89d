"""Exact numbers and tables as people write them. What the numbers mean is said where they are used."""
