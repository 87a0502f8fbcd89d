"""The rings there are, by their sizes, and their polynomials: all others take ``Ring`` and ``Poly`` from here."""

from qe.exact.poly import Poly, Ring, SparseTerm, format_poly
from qe.exact.wide import WIDE

__all__ = ["WIDE", "Poly", "Ring", "SparseTerm", "format_poly"]
