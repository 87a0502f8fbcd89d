"""The former place of ``bezier.methods.single.formula``."""

from bezier.methods.single.formula import Symbol, eliminate

__all__ = ["Symbol", "eliminate"]
