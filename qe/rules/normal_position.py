"""Affine coordinates of bound variables in which the polynomials are short: where the origin is, which forms are axes.

THEOREM. Let x be a variable of a block and x = (c*x' + l)/q, with numbers c, q /= 0 and a linear form l in the other
variables of the block. Then x takes every real value as x' does, whatever the others are: the block has the same truth
with (c*x' + l)/q for x, and a polynomial of degree d in x may be multiplied by |q|^d.

The measure of a position is the length of all irreducible factors, terms and digits. A step is taken only where it
becomes less, so that what is short stays as it is, and what is reached hardly depends on the coordinates in which the
question was asked. Steps that are tried:

- x = x' - c*y, or x' - c, for a number c that most conditions agree on: where the terms with x^k and x^(k-1)*y are the
  first ones of a form in x and y, c = a_(k-1)/(k*a_k) takes the second away (Tschirnhaus 1683), or c is a root of it;
  first x' - c for all variables at once (the centre of one quadric, of all);
- x = p^t*x' for a prime p and several variables x at once: the number of factors p in all coefficients together, once
  every polynomial is primitive again, is a convex function of t.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from math import gcd, isqrt, log2, prod

from qe.exact.ring import Poly, Ring
from qe.exact.watch import IDLE
from qe.rules.lift import Solve

_TERM = 4  # what a term adds to the measure, beside the digits of its coefficient (base 2)
_TERMS = 1000  # terms of all factors together up to which positions are looked for
_ROUNDS = 6  # how often all steps are tried one after the other
_TRIED = 2  # numbers c that are tried for one variable and one direction
_SMALL = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47)
_LEAST, _GAIN = 0.1, 0.15
"""Every step makes what it changes shorter by the first part, and all steps together the whole by the second; or else
every step what it changes by the second. As they are given, polynomials may have symmetries that new axes break (of 199
problems of the literature 58 are changed; of the same ones after x -> x + y nine in ten)."""

Terms = Sequence[tuple[tuple[int, ...], int]]
"""Exponents and coefficients."""


def steps_to_normal_position(
    polys: Sequence[Poly], blocks: Sequence[Sequence[int]], watch: Callable[[], object] = IDLE
) -> list[Solve]:
    """The steps, one after the other, for polynomials and the variables of each block."""
    factors = list(dict.fromkeys(f for p in polys for f, _ in p.factors()[1]))
    if sum(f.term_count() for f in factors) > _TERMS:
        return []
    steps: list[Solve] = []
    for gain in (_LEAST, _GAIN):
        position = _Position(factors.copy(), blocks, gain, watch)
        steps = position.all_steps()
        if not steps or position.length() <= (1 - _GAIN) * sum(map(_length, factors)):
            break
    return steps


def at_steps(poly: Poly, steps: Sequence[Solve]) -> Poly:
    """A positive multiple of the polynomial with the values of the steps' variables in their places."""
    unit, factors = poly.factors()
    images = (reduce(_image, steps, factor) ** power for factor, power in factors)
    return prod(images, start=poly.ring.constant(1 if unit > 0 else -1))


def coefficients(step: Solve) -> list[tuple[str, Fraction]]:
    """The linear form that is the step's value, by variables, and "1" for the number in it."""
    names, bottom = step.numerator.ring.names, step.denominator.constant_value()
    return [(names[e.index(1)] if any(e) else "1", Fraction(c, bottom)) for e, c in step.numerator.terms()]


def _image(poly: Poly, step: Solve) -> Poly:
    """A primitive positive multiple of the polynomial after one step."""
    x = poly.ring.index[step.variable]
    if not poly.degree(x):
        return poly
    unit, primitive = poly.at_quotient(x, step.numerator, step.denominator).normal()
    return primitive if unit > 0 else -primitive


def _length(poly: Poly) -> float:
    return sum(_TERM + log2(abs(int(c))) for _, c in poly.p.terms())


@dataclass(slots=True)
class _Position:
    """The polynomials after the ``steps``; a new origin or axis has to ``gain`` so much for what it changes."""

    polys: list[Poly]
    blocks: Sequence[Sequence[int]]
    gain: float
    watch: Callable[[], object]
    steps: list[Solve] = field(default_factory=list)
    written: dict[Poly, Terms] = field(default_factory=dict)
    images: dict[tuple[Poly, Solve], Poly] = field(default_factory=dict)

    @property
    def ring(self) -> Ring:
        return self.polys[0].ring

    @property
    def variables(self) -> tuple[int, ...]:
        return tuple(x for block in self.blocks for x in block)

    def length(self) -> float:
        """Of all polynomials."""
        return sum(map(_length, self.polys))

    def terms(self, poly: Poly) -> Terms:
        """The terms, written out once."""
        return self.written.get(poly) or self.written.setdefault(poly, poly.terms())

    def all_steps(self) -> list[Solve]:
        """Steps until none helps."""
        for _ in range(_ROUNDS):
            before = len(self.steps)
            self.centre()
            if len(self.steps) > before:
                self.scale_all()
            for block in self.blocks:
                for x in block:
                    places = [k for k, p in enumerate(self.polys) if p.degree(x)]
                    beside = {y for k in places for y in self.polys[k].variables}  # no other one proposes a number
                    for y in (None, *(y for y in block if y != x and y in beside)):
                        self.shift(x, y, places)
            self.scale_all()
            if len(self.steps) == before:
                break
        return self.steps

    def take(self, steps: Sequence[Solve]) -> None:
        self.steps += steps
        self.polys = [reduce(self.image, steps, p) for p in self.polys]

    def image(self, poly: Poly, step: Solve) -> Poly:
        """``_image``, which the next round asks for again."""
        if not poly.degree(self.ring.index[step.variable]):
            return poly
        return self.images.get((poly, step)) or self.images.setdefault((poly, step), _image(poly, step))

    def centre(self) -> None:
        """A new origin for all variables at once, as all polynomials propose together, or one of them; or the same
        number for all, which differences do not notice."""
        linear, curved = ([p for p in self.polys if (p.total_degree > 1) is one] for one in (False, True))
        proposed: list[Sequence[Solve]] = []
        alike: Counter[Fraction] = Counter()
        for chosen in (curved, *([poly] for poly in curved), linear):
            terms, among = [self.terms(p) for p in chosen], {x for p in chosen for x in p.variables}
            numbers = {x: found for x in self.variables if x in among if (found := _numbers(terms, x, None))}
            proposed.append([self.step(x, None, c) for x, (c, *_) in numbers.items()])
            alike.update(c for found in numbers.values() for c in found)
        same = [[self.step(x, None, c) for x in self.variables] for c, _ in alike.most_common(_TRIED)]
        for several in (same, proposed):  # variables that may be exchanged stay so, unless that is much longer
            self.take_best([steps for steps in several if len(steps) > 1], range(len(self.polys)))

    def shift(self, x: int, y: int | None, places: Sequence[int]) -> None:
        """x = x' - c*y, or x' - c, for the best number c, by the polynomials at ``places``, in which x is."""
        numbers = _numbers([self.terms(self.polys[k]) for k in places], x, y)
        self.take_best([[self.step(x, y, c)] for c in numbers], places)

    def step(self, x: int, y: int | None, c: Fraction) -> Solve:
        along = self.ring.constant(1) if y is None else self.ring.gen(y)
        top = self.ring.gen(x) * c.denominator - along * c.numerator
        return Solve(self.ring.names[x], top, self.ring.constant(c.denominator))

    def take_best(self, proposed: Sequence[Sequence[Solve]], places: Collection[int]) -> None:
        """Of several steps those that make the polynomials at these places shortest, if they gain enough."""
        fixed = self.fixed()
        proposed = [steps for steps in proposed if fixed.isdisjoint(step.variable for step in steps)]
        if not proposed:
            return
        best: Sequence[Solve] = ()
        polys = [(p, _length(p), set(p.variables)) for p in (self.polys[k] for k in places)]
        most = (1 - self.gain) * sum(size for _, size, _ in polys)
        for steps in proposed:
            self.watch()
            moved = {self.ring.index[step.variable] for step in steps}
            length = 0.0
            for p, size, own in polys:
                length += size if moved.isdisjoint(own) else _length(reduce(self.image, steps, p))
                if length >= most:
                    break
            else:
                best, most = steps, length
        self.take(best)

    def fixed(self) -> set[str]:
        """Axes of an orthant stay: variables that are factors, where all of a block are, or of three all but one."""
        alone = {p.variables[0] for p in self.polys if p.total_degree == p.term_count() == 1}
        orthants = (block for block in self.blocks if len({*block} - alone) <= (len(block) > 2))
        return {self.ring.names[x] for block in orthants for x in alone.intersection(block)}

    def scale_all(self) -> None:
        """Single variables, those of a block, and all of them."""
        for names in dict.fromkeys((*((x,) for x in self.variables), *map(tuple, self.blocks), self.variables)):
            self.scale(names)

    def scale(self, names: tuple[int, ...]) -> None:
        """The same power of a prime for these variables, each prime after the other."""
        parts, by = self.parts(names), Fraction(1)
        for prime in sorted({p for degrees in parts for content, _ in degrees.values() for p in _primes(content)}):
            by *= Fraction(prime) ** _exponent(
                [[(k, _order(c, prime), n) for k, (c, n) in degrees.items()] for degrees in parts]
            )
        if by != 1:
            top, bottom = by.numerator, self.ring.constant(by.denominator)
            self.take([Solve(self.ring.names[x], self.ring.gen(x) * top, bottom) for x in names])

    def parts(self, names: tuple[int, ...]) -> list[dict[int, tuple[int, int]]]:
        """For every polynomial, by the degree in these variables: the content, and how many terms there are."""
        listed = []
        for poly in self.polys:
            if any(poly.degree(x) for x in names):
                parts: dict[int, tuple[int, int]] = {}
                for exponents, c in self.terms(poly):
                    degree = sum(exponents[x] for x in names)
                    content, count = parts.get(degree, (0, 0))
                    parts[degree] = gcd(content, c), count + 1
                listed.append(parts)
        return listed


def _numbers(polys: Sequence[Terms], x: int, y: int | None) -> list[Fraction]:
    """The numbers that most polynomials propose, if they are not fewer than those that want to stay."""
    votes: Counter[Fraction] = Counter()
    stay = 0
    for terms in polys:
        forms: dict[object, dict[int, int]] = {}
        for exponents, c in terms:
            key = list(exponents)
            power, key[x] = key[x], 0
            if y is not None:
                key[x], key[y] = power + key[y], 0
            forms.setdefault(tuple(key), {})[power] = c
        for form in forms.values():
            if len(form) > 1:
                votes.update(_proposed(form))
            elif 0 not in form:
                stay += 1
    stay += votes.pop(Fraction(0), 0)
    return [c for c, n in sorted(votes.items(), key=lambda item: (-item[1], item[0])) if n >= stay][:_TRIED]


def _proposed(form: Mapping[int, int]) -> Iterator[Fraction]:
    """Numbers c such that x = x' - c*y makes a form in x and y, given by powers of x, shorter."""
    k = max(form)
    lead, second = form[k], form.get(k - 1, 0)
    yield Fraction(second, k * lead)
    square = second * second - 4 * lead * form.get(0, 0)
    if k == 2 and square > 0 and isqrt(square) ** 2 == square:
        yield from (Fraction(second + s * isqrt(square), 2 * lead) for s in (1, -1))


def _primes(number: int) -> Iterator[int]:
    """Small prime factors, and what is left without them, as if it were prime."""
    for prime in filter(lambda p: number % p == 0, _SMALL):
        yield prime
        number //= prime ** _order(number, prime)
    if 1 < number < 2**60:
        yield number


def _order(number: int, prime: int) -> int:
    count = 0
    while number % prime == 0:
        number, count = number // prime, count + 1
    return count


def _exponent(polys: Sequence[Sequence[tuple[int, int, int]]]) -> int:
    """The t with the least number of factors; polynomials in parts: degree, order of the prime, number of terms."""

    def factors(t: int) -> int:
        """Up to a constant: of a part without its content, less what becomes the content of the whole."""
        return sum(sum(n * (k * t - min(o + j * t for j, o, _ in parts)) for k, _, n in parts) for parts in polys)

    sign = 1 if factors(1) < factors(0) else -1
    t = 0
    while factors(t + sign) < factors(t):
        t += sign
    return t
