"""Blocks about the roots of one polynomial, by the signs of the minors of Hermite's forms."""
