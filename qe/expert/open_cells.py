"""The open cells of a decomposition, each with a rational sample.

THEOREM (Collins 1975; for open cells alone Strzebonski 2000). Let the factor lists be closed under leading
coefficients, discriminants and pairwise resultants. Over a connected open set where no factor of a lower level
vanishes, the real roots of the factors of a level are continuous functions, distinct and always as many. So if a stack
over its sample has as many gaps between neighbouring samples as the factors have real roots, with one sign change in
each gap, then the samples meet each sector over the whole set once. The cells so found are connected, open, and all
that there are; no factor vanishes on them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from qe.exact.ring import Poly
from qe.kernel.arithmetic.sturm import count_real_roots, exact, sign_of
from qe.kernel.limits import check_value
from qe.kernel.step import Limits
from qe.proof.entry import Entry

Values = tuple[Fraction, ...]


def open_cells(
    levels: Sequence[Sequence[Poly]], stack: Entry, limits: Limits, values: Values = ()
) -> Iterator[tuple[Values, Entry]]:
    """The sample of each open cell with what the certificate says of it; the stacks are checked on the way.

    ``stack``: for each sector its sample and the stack over it, or what is said of a cell of the last level.
    """
    limits.tick()
    sectors = [tuple(sector.items()) for sector in stack.items()]
    if not sectors or any(len(sector) != 2 for sector in sectors):
        raise stack.fail("expected [sample, what is over it] for each sector")
    k = len(values)
    samples = [sample.rational() for sample, _ in sectors]
    _check_samples(levels[0], k, samples, stack)
    for value, (_, inside) in zip(samples, sectors, strict=True):
        if len(levels) == 1:
            yield (*values, value), inside
            continue
        for f in (f for level in levels[1:] for f in level):
            check_value(f, k, value)
        above = [[f.at_rational(k, value) for f in level] for level in levels[1:]]
        yield from open_cells(above, inside, limits, (*values, value))


def _check_samples(factors: Sequence[Poly], k: int, samples: Sequence[Fraction], stack: Entry) -> None:
    """Ascending samples, no roots, with one change of one sign in each gap and as many gaps as real roots."""
    if any(a >= b for a, b in pairwise(samples)):
        raise stack.fail("the samples do not ascend")
    changes, roots = [0] * (len(samples) - 1), 0
    for f in factors:
        p = f.to_univariate(k)
        signs = [sign_of(p(exact(value))) for value in samples]
        if 0 in signs:
            raise stack.fail("a sample is a root")
        roots += count_real_roots(p)
        for gap, (a, b) in enumerate(pairwise(signs)):
            changes[gap] += a != b
    if any(found != 1 for found in changes) or roots != len(changes):
        raise stack.fail("the samples do not separate the real roots one by one")
