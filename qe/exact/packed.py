"""Monomials as single integers for the degree reverse lexicographic order.

The fields of the integer are the partial sums e_1 + ... + e_n, e_1 + ... + e_(n-1), ..., e_1, the first of them on top.
So products are sums of integers and the order is that of integers: of two monomials of one degree the larger has
the smaller e_n, that is, the larger e_1 + ... + e_(n-1), and so on.
"""

from __future__ import annotations

from collections.abc import Sequence

from qe.errors import Unable

Exponents = tuple[int, ...]


class PackedMonomials:
    """Monomials in ``size`` variables with fields of so many ``bits``, one of which stays free for borrows."""

    def __init__(self, size: int, bits: int) -> None:
        self.size, self.bits = size, bits
        self._all = (1 << (bits * size)) - 1
        self.guard = sum(1 << (bits * k + bits - 1) for k in range(size))
        self._known: dict[int, Exponents] = {}

    def packed(self, exponents: Sequence[int]) -> int:
        """The integer of a monomial. Raises ``Unable`` where a degree does not fit."""
        total = packed = 0
        for k, e in enumerate(exponents):
            total += e
            packed |= total << (self.bits * k)
        if total >> (self.bits - 2):
            raise Unable("the degrees in a Gröbner basis grow past their limits")
        return packed

    def fields(self, monomial: int) -> int:
        """The exponents themselves, in fields: a divides b iff ``(fields(b) | guard) - fields(a)`` keeps ``guard``."""
        return monomial - ((monomial << self.bits) & self._all)

    def exponents(self, monomial: int) -> Exponents:
        """The exponents of a monomial."""
        known = self._known.get(monomial)
        if known is None:
            fields, mask = self.fields(monomial), (1 << self.bits) - 1
            known = self._known[monomial] = tuple(fields >> (self.bits * k) & mask for k in range(self.size))
        return known

    def degree(self, monomial: int) -> int:
        """The degree."""
        return monomial >> (self.bits * (self.size - 1))

    def divides(self, fields: int, others: int) -> bool:
        """Whether the monomial with the first fields divides the one with the others."""
        return ((others | self.guard) - fields) & self.guard == self.guard

    def lcm(self, a: int, b: int) -> int:
        """The least common multiple."""
        return self.packed([max(i, j) for i, j in zip(self.exponents(a), self.exponents(b), strict=True)])

    def are_coprime(self, a: int, b: int) -> bool:
        """Whether no variable occurs in both."""
        return not any(i and j for i, j in zip(self.exponents(a), self.exponents(b), strict=True))
