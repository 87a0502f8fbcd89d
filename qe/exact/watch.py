"""Looking at a clock inside exact arithmetic, which has none of its own.

One FLINT call cannot be interrupted. What takes long is a sequence of calls, or a product that can be taken apart;
between the calls a ``Watch`` is asked. It raises (``BudgetExceeded``) where the work is to end.
"""

from __future__ import annotations

from collections.abc import Callable

from qe.exact.ring import Poly

PIECE = 1_000_000
"""Pairs of terms that are multiplied in one call: less than a tenth of a second, unless the numbers are very long."""


PAIRS = 20_000
"""Of so many, times the words of their coefficients, the products take one unit of work."""


def _go_on(units: int = 0) -> None:
    """No clock: the work goes on."""


class Watch:
    """Something to be asked between steps, and told of long ones. A copy in another process does neither until it is
    given ``ask`` and ``spend`` there."""

    __slots__ = ("ask", "spend")

    def __init__(self, ask: Callable[[], object] = _go_on, spend: Callable[[int], object] = _go_on) -> None:
        self.ask, self.spend = ask, spend

    def __call__(self) -> None:
        self.ask()

    def __reduce__(self) -> tuple[type[Watch], tuple[()]]:
        return Watch, ()


IDLE = Watch()
"""The watch of work without limits."""


def watched_product(a: Poly, b: Poly, watch: Watch) -> Poly:
    """a*b, where both have many terms in pieces of a, with a look at the watch before each."""
    watch()
    pairs = a.term_count() * b.term_count()
    if pairs > PAIRS // 20:
        watch.spend(pairs * (a.height_bits() + b.height_bits()) // (64 * PAIRS))
    if pairs <= PIECE:
        return a * b
    terms, step = a.terms(), max(1, PIECE // b.term_count())
    total = a.ring.constant(0)
    for start in range(0, len(terms), step):
        watch()
        total = total + a.ring.from_terms(dict(terms[start : start + step])) * b
    return total
