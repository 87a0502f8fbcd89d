"""Polynomials that are nowhere negative, everywhere or where some variables are not, with identities that prove it.
Which method asks for them, and when, is not decided here.
"""
