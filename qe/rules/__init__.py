"""Equivalence-preserving rules on quantifier blocks, with the way back for witnesses. A rule looks at one block and
knows no method; methods end a block, rules make it easier.
"""
