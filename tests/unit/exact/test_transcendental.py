from __future__ import annotations

import mpmath

from qe.exact.transcendental import floor_of
from qe.spelling import NUMBERS


def test_the_numbers_are_those_of_their_names() -> None:
    for bits in (1, 64, 1000):
        with mpmath.workprec(bits + 80):
            for name, value in zip(NUMBERS, (mpmath.pi, mpmath.e, mpmath.euler, mpmath.catalan), strict=True):
                assert floor_of(name, bits) == int(mpmath.floor(value * 2**bits))
