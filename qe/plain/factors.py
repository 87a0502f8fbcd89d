"""Irreducible factors of polynomials over the integers: common divisors first, then images in one variable, lifted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from itertools import count as naturals
from math import comb
from random import Random

from qe.plain.irreducible import irreducible_factors
from qe.plain.modular import convolved, inverse_modulo, reduced, remainder, symmetric
from qe.plain.resultants import coefficients_in
from qe.plain.terms import MASK, WIDTH, Terms, at_fraction, common_divisor, content, divided, division, times

Parts = list[tuple[Terms, int]]
IMAGES = 5
"""So many images are looked at for one with few factors."""


def of_terms(a: Terms, places: Sequence[int]) -> tuple[int, Parts]:
    """(u, ((f, e), ...)) with a = u times the product of f^e, the f irreducible with positive leading coefficients."""
    if not a:
        return 0, []
    unit = content(a) if a[max(a)] > 0 else -content(a)
    return unit, list(_factors(divided(a, unit), places))


def _factors(a: Terms, places: Sequence[int]) -> Iterator[tuple[Terms, int]]:
    """The factors of a polynomial whose coefficients have no common divisor."""
    places = [p for p in places if any(k >> p & MASK for k in a)]
    if not places:
        return
    count = max(places) // WIDTH + 1
    main = min(places, key=lambda p: max(k >> p & MASK for k in a))
    inner = _content_in(a, main, places)
    yield from _factors(inner, places)
    a = division(a, inner, count)[0]
    if max(k >> main & MASK for k in a) == 1:
        yield a, 1
        return
    rest = common_divisor(a, _slope(a, main), places)  # every factor with one power less
    several = division(a, rest, count)[0]
    for exponent in naturals(1):
        if len(several) == 1 and 0 in several:
            return
        more = common_divisor(several, rest, places)
        once = division(several, more, count)[0]
        yield from ((f, exponent) for f in _irreducible(once, main, places) if len(f) > 1 or 0 not in f)
        several, rest = more, division(rest, more, count)[0]


def _slope(a: Terms, main: int) -> Terms:
    """The derivative."""
    return {k - (1 << main): c * (k >> main & MASK) for k, c in a.items() if k >> main & MASK}


def _content_in(a: Terms, main: int, places: Sequence[int]) -> Terms:
    """The greatest common divisor of the coefficients in one variable."""
    found: Terms = {}
    for c in sorted(coefficients_in(a, main), key=len):
        found = common_divisor(found, c, [p for p in places if p != main])
        if found == {0: 1}:
            break
    return found


def _irreducible(a: Terms, main: int, places: Sequence[int]) -> Iterator[Terms]:
    """The factors of a squarefree polynomial without a factor that is free of the main variable."""
    others = [p for p in places if p != main]
    degree = max(k >> main & MASK for k in a)
    if degree < 2:
        yield a
        return
    if not others:
        yield from (
            _positive({k << main: d for k, d in enumerate(f) if d}) for f in irreducible_factors(_list(a, main))
        )
        return
    point, images = _image(a, main, others)
    size = 1
    while 2 * size <= len(images):
        for chosen in combinations(images, size):
            outside = [f for f in images if f not in chosen]
            f = _lifted(a, main, others, point, chosen, outside)
            if f is not None:
                yield f
                a, images = division(a, f, max(places) // WIDTH + 1)[0], outside
                break
        else:
            size += 1
    yield _positive(a)


def _image(a: Terms, main: int, others: Sequence[int]) -> tuple[dict[int, int], list[list[int]]]:
    """Integers for the other variables where the polynomial keeps its degree and its roots are simple; its factors."""
    rng, found = Random(len(a)), list[tuple[int, dict[int, int], list[list[int]]]]()
    degree = max(k >> main & MASK for k in a)
    for attempt in naturals():
        point = {p: rng.randint(-attempt, attempt) for p in others}
        image = a
        for place, value in point.items():
            image = at_fraction(image, place, value)
        c = _list(image, main)
        if len(c) == degree + 1 and max(common_divisor(image, _slope(image, main), (main,))) == 0:
            parts = irreducible_factors(_list(divided(image, content(image)), main))
            found.append((len(parts), point, parts))
            if len(parts) == 1 or len(found) == IMAGES:
                return min(found, key=lambda one: one[0])[1:]
    raise AssertionError


def _lifted(
    a: Terms,
    main: int,
    others: Sequence[int],
    point: dict[int, int],
    chosen: Sequence[list[int]],
    outside: Sequence[list[int]],
) -> Terms | None:
    """The factor of the polynomial whose image at the point is the product of the chosen ones; None if there is none.

    Hensel's lemma by degrees in the other variables around the point, modulo a prime above what the coefficients can
    be: with l the leading coefficient, l*a = f*g is looked for with f and g of leading coefficient l. The trial
    division at the end shows that f is a factor.
    """
    lead = coefficients_in(a, main)[-1]
    count = max((main, *others)) // WIDTH + 1
    whole = times(a, lead, count)
    for place, value in point.items():
        lead, whole = _moved(lead, place, value), _moved(whole, place, value)
    degrees = (max(k >> p & MASK for k in whole) for p in others)
    prime = _prime(2 * max(c.bit_length() for c in whole.values()) + 2 * sum(degrees) + 60)
    first, second = (_product(parts, lead[0], prime) for parts in (chosen, outside))
    m, n = len(first) - 1, len(second) - 1
    to_first, to_second = inverse_modulo(second, first, prime), inverse_modulo(first, second, prime)
    pieces, leads = _by_degree(whole, main, others), _by_degree(lead, main, others)
    sides = [[{0: first}], [{0: second}]]
    for degree in range(1, len(pieces)):
        error = {y: c + [0] * (m + n + 1 - len(c)) for y, c in pieces[degree].items()}
        fresh: list[dict[int, list[int]]] = [{}, {}]
        for y, (top,) in leads[degree].items() if degree < len(leads) else ():
            fresh = [{**fresh[0], y: [0] * m + [top]}, {**fresh[1], y: [0] * n + [top]}]
        for f, g in zip([*sides[0], fresh[0]], [*sides[1], fresh[1]][::-1], strict=True):
            for y, b in f.items():
                for z, c in g.items():
                    row = error.setdefault(y + z, [0] * (m + n + 1))
                    for k, d in enumerate(convolved(b, c)):
                        row[k] -= d
        for y, e in error.items():
            for made, base, inverse in ((fresh[0], first, to_first), (fresh[1], second, to_second)):
                if part := remainder(convolved(reduced(e, prime), inverse), base, prime):
                    made[y] = part + made.get(y, [0] * len(base))[len(part) :]
        sides = [[*sides[0], fresh[0]], [*sides[1], fresh[1]]]
    terms = ((y + (k << main), b) for side in sides[0] for y, c in side.items() for k, b in enumerate(c))
    found = {k: d for k, b in terms if (d := symmetric(b, prime))}
    for place, value in point.items():
        found = _moved(found, place, -value)
    found = _positive(division(found, _content_in(found, main, (main, *others)), count)[0])
    return None if division(a, found, count)[1] else found


def _by_degree(a: Terms, main: int, others: Sequence[int]) -> list[dict[int, list[int]]]:
    """By total degree in the other variables: monomial there -> coefficients in the main variable."""
    found: list[dict[int, list[int]]] = []
    for k, c in a.items():
        e = k >> main & MASK
        y = k - (e << main)
        degree = sum(y >> p & MASK for p in others)
        found += [{} for _ in range(degree + 1 - len(found))]
        row = found[degree].setdefault(y, [])
        row += [0] * (e + 1 - len(row))
        row[e] = c
    return found


def _moved(a: Terms, place: int, value: int) -> Terms:
    """The polynomial with y + value for the variable y."""
    if not value:
        return a
    total: Terms = {}
    for k, c in a.items():
        e = k >> place & MASK
        for j in range(e + 1):
            l = k - (j << place)
            total[l] = total.get(l, 0) + c * comb(e, j) * value**j
    return {k: c for k, c in total.items() if c}


def _product(parts: Sequence[list[int]], lead: int, prime: int) -> list[int]:
    """The product with another leading coefficient, modulo a prime."""
    product = [1]
    for part in parts:
        product = [c % prime for c in convolved(product, part)]
    scale = lead * pow(product[-1], -1, prime)
    return [c * scale % prime for c in product]


def _prime(bits: int) -> int:
    """A prime above 2^bits, one of Mersenne's."""
    listed = (127, 521, 1279, 2203, 4423, 9941, 21701, 44497, 86243, 216091)
    if bits >= listed[-1]:
        raise MemoryError("a polynomial is too large to be factored")
    return (1 << next(e for e in listed if e > bits)) - 1


def _list(a: Terms, place: int) -> list[int]:
    return [a.get(k << place, 0) for k in range(max((k >> place & MASK for k in a), default=-1) + 1)]


def _positive(a: Terms) -> Terms:
    return a if a[max(a)] > 0 else {k: -c for k, c in a.items()}
