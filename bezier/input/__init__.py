"""Exact numbers and tables as people write them."""
