"""Polynomials written as products of listed factors, and the sign of such a product on a cell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from qe.errors import CertificateRejected
from qe.exact.ring import Poly, Ring
from qe.kernel.arithmetic.sturm import divide_out, value_at_integers

Signs = list[list["int | None"]]

_ODD_NUMBERS = (1009, -757, 613, -1223, 881, -1471, 547, -1093, 1301, -673, 1429, -919)


@dataclass(frozen=True, slots=True)
class Product:
    """``unit`` (a sign) times the listed factors (level, index) to the exponents given, up to a positive constant."""

    unit: int
    powers: tuple[tuple[int, int, int], ...]


_SIGNS = {
    (s, odd, even): frozenset(s * t for t in ((-1, 0, 1) if odd else (0, 1) if even else (1,)))
    for s in (-1, 0, 1)
    for odd in (False, True)
    for even in (False, True)
}


def possible_signs(product: Product, signs: Signs) -> frozenset[int]:
    """The signs that the product can have where the factors have these signs; an unknown one can have any."""
    known, odd, even = product.unit, False, False
    for level, index, exponent in product.powers:
        s = signs[level][index] if level < len(signs) else None
        if s == 0:
            known = 0
        elif exponent & 1:
            odd, known = odd or s is None, known * (s or 1)
        else:
            even = even or s is None
    return _SIGNS[known, odd, even]


def sign(product: Product, signs: Signs) -> int | None:
    """The sign of the product where the factors have these signs; None when an unknown one matters."""
    possible = possible_signs(product, signs)
    return next(iter(possible)) if len(possible) == 1 else None


class FactorLists:
    """The factor lists of a table, ready for trial division. Values are not changed after construction."""

    def __init__(self, ring: Ring, lists: Sequence[Sequence[Poly]]) -> None:
        self.ring, self.lists = ring, tuple(tuple(level) for level in lists)
        self.point = tuple(_ODD_NUMBERS[i % 12] + 2 * (i // 12) for i in range(ring.size))
        self._values = [[value_at_integers(f, self.point) for f in level] for level in self.lists]
        self._known: dict[Poly, Product | None] = {}

    def decompose(self, p: Poly) -> Product | None:
        """p as a product of listed factors and a nonzero constant; None if something else is left over.

        By trial division, not by factoring: sign-invariance of the listed factors is all that is needed.
        """
        if not p:
            return Product(0, ())
        if p not in self._known:
            self._known[p] = self._divide(p)
        return self._known[p]

    def _divide(self, p: Poly) -> Product | None:
        powers, rest = [], p
        for level in range(p.level, -1, -1):
            if rest.is_constant:
                break
            value = value_at_integers(rest, self.point)
            for index, f in enumerate(self.lists[level]):
                here = self._values[level][index]
                if here and value % here:
                    continue  # a divisor divides every value at an integer point
                if any(a < b for a, b in zip(rest.degrees, f.degrees, strict=True)):
                    continue
                rest, exponent = divide_out(rest, f)
                if exponent:
                    powers.append((level, index, exponent))
                    value = value_at_integers(rest, self.point)
        if not rest.is_constant:
            return None
        constant = rest.constant_value()
        return Product((constant > 0) - (constant < 0), tuple(powers))


def check_lists(ring: Ring, lists: Sequence[Sequence[Poly]]) -> None:
    """Every factor stands on its own level, is primitive, and is listed once."""
    if len(lists) != ring.size:
        raise CertificateRejected("payload.factors", f"expected {ring.size} lists, one per variable")
    for k, level in enumerate(lists):
        seen: set[Poly] = set()
        for i, f in enumerate(level):
            step = f"payload.factors[{k}][{i}]"
            if f.ring is not ring:
                raise CertificateRejected(step, "the polynomial belongs to another ring")
            if f.level != k:
                raise CertificateRejected(step, f"its main variable is not {ring.names[k]}")
            if f.normal()[0] != 1:
                raise CertificateRejected(step, "not primitive with positive leading coefficient")
            if f in seen:
                raise CertificateRejected(step, "listed twice")
            seen.add(f)
