"""Equivalence-preserving rules on quantifier blocks, with the way back for witnesses."""
