"""A linear form gets a name: what is curved is curved along one line only, and the rest is linear.

THEOREM. Let l = 0 stand in f, and let b*p = q(L) + m*l for polynomials m and L and a number b > 0. Then p and q(L) have
the same sign where l = 0, so with a new variable y, for conditions p on which this is known,

    ex x (p rel 0 and f)  iff  ex y (q(y) rel 0 and ex x (y = L and f)).

Where f is linear in x, so is the inner block: linear substitution eliminates it (Loos, Weispfenning 1993), and the
roots of q are put into its answer. Solving l = 0 first would put a quotient into p instead, and that into everything.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations
from math import gcd, prod

from qe.elimination.protocol import Context, Outcome
from qe.exact.ideals import fresh
from qe.exact.ring import Poly, Ring
from qe.formula.block import Block
from qe.formula.build import atom, conj, convert, exists
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import atoms, conjuncts
from qe.options import Options

MOST_FACTORS, MOST_TERMS, ROUNDS = 4, 200, 6
"""Content factors that are tried in a form; terms of a polynomial that is looked at; shifts of a form."""


class NamedForm:
    """Conditions of degree 2 in the block that are quadratic in one linear form, beside linear ones."""

    name = "linear form named"

    def suits(self, problem: Block, options: Options) -> str | None:
        """A block of two variables and more with parameters, over a quantifier-free body."""
        flat = problem.is_flat and len(problem.variables) > 1 and problem.free
        return self.name if flat and not problem.has_root_atoms else None

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The nested problem; None where the conditions are not of this kind."""
        found = _named(problem.dual)
        if found is None:
            return None
        after, scales = found
        evidence = {"proof": {"scales": scales}}
        return Outcome(context.log.step(self.name, problem.formula, problem.asked(after), evidence=evidence))


@dataclass(frozen=True, slots=True)
class _Block:
    """The block's variables, and the polynomial of an equation linear in them, or None."""

    indices: tuple[int, ...]
    line: Poly | None

    def degree(self, poly: Poly) -> int:
        """The degree in the variables of the block."""
        return max((sum(exponents) for exponents in poly.collected(self.indices)), default=0)

    def is_entangled(self, line: Poly) -> bool:
        """Whether a linear equation cannot be solved without a sum in the denominator."""
        slopes = [c for c in (line.derivative(i) for i in self.indices) if c]
        return bool(slopes) and all(c.term_count() > 1 for c in slopes)

    def part(self, poly: Poly, degree: int) -> Poly:
        """The homogeneous part of this degree in the variables of the block."""
        ring, total = poly.ring, poly.ring.constant(0)
        for exponents, coefficient in poly.collected(self.indices).items():
            if sum(exponents) == degree:
                for i, e in zip(self.indices, exponents, strict=True):
                    coefficient = coefficient * ring.gen(i) ** e
                total = total + coefficient
        return total

    def rest(self, form: Poly) -> Poly:
        """A homogeneous polynomial where the linear part of the equation vanishes, times a power of a coefficient that
        depends on its degree only."""
        if self.line is None:
            return form
        line = self.part(self.line, 1)
        x = next(i for i in self.indices if line.degree(i))
        below, lead = line.coefficients(x)
        return form.at_quotient(x, -below, lead) * lead ** (self.degree(form) - form.degree(x))

    def reduced(self, poly: Poly, degree: int) -> Poly:
        """The polynomial less a multiple of the equation, without its part of this degree where that is possible."""
        part = self.part(poly, degree)
        if self.line is None or not part:
            return poly
        line = self.part(self.line, 1)
        if part.gcd(line) not in (line, -line):
            return poly
        return poly - part.exact_divide(line) * self.line


@dataclass(frozen=True, slots=True)
class _Quadratic:
    """b*p is square*y^2 + slope*y + offset where y is the form and the equation holds; ``b`` = ``scale`` > 0."""

    scale: int
    square: int
    slope: Poly
    offset: Poly

    def moved(self, shift: Poly) -> _Quadratic:
        """The same where y is the form and ``shift``."""
        slope = self.slope - shift * (2 * self.square)
        return _Quadratic(self.scale, self.square, slope, self.offset + shift * (shift * self.square - self.slope))

    def at(self, y: Poly) -> Poly:
        """q(y) of the theorem."""
        slope, offset = self.slope.convert(y.ring), self.offset.convert(y.ring)
        return (y * self.square + slope) * y + offset


def _named(problem: Block) -> tuple[Formula, list[Fraction]] | None:
    """The nested problem, and for its outer conditions the numbers b of the theorem (for the atoms as they stand)."""
    parts, ring = conjuncts(problem.body), problem.body.ring
    assert ring is not None
    indices = tuple(ring.index[v] for v in problem.variables)
    plain = _Block(indices, None)
    linear = [p for p in parts if all(plain.degree(a.poly) <= 1 for a in atoms(p))]
    curved = [p for p in parts if p not in linear]
    conditions = [p for p in curved if isinstance(p, Atom) and _is_plane_curve(p.poly, plain)]
    if not curved or len(conditions) < len(curved) or not any(set(p.free) & set(problem.variables) for p in linear):
        return None
    lines = [p.poly for p in linear if isinstance(p, Atom) and p.relation is Relation.EQ and plain.is_entangled(p.poly)]
    for line in (*lines, None):
        block = _Block(indices, line)
        for form in _forms(block.part(conditions[0].poly, 2), block):
            quadratic_forms = [q for p in conditions if (q := _in_form(p.poly, form, block)) is not None]
            if len(quadratic_forms) == len(conditions):
                shift = _shift(quadratic_forms[0])
                quadratics = [q.moved(shift) for q in quadratic_forms]
                return _nested(problem, linear, conditions, form + shift, quadratics)
    return None


def _is_plane_curve(poly: Poly, block: _Block) -> bool:
    """Whether it is worth a look: of degree 2 in two variables of the block or more, and not too long."""
    several = len(set(block.indices).intersection(poly.variables)) > 1
    return several and block.degree(poly) == 2 and poly.term_count() <= MOST_TERMS


def _forms(curved: Poly, block: _Block) -> Iterator[Poly]:
    """The factors of a homogeneous polynomial of degree 2 that are linear in the block, times factors without it."""
    factors = [f for f, times in curved.factors()[1] for _ in range(times)]
    outer = [f for f in factors if not block.degree(f)][:MOST_FACTORS]
    products = [prod(chosen) for chosen in chain.from_iterable(combinations(outer, n) for n in range(len(outer) + 1))]
    for factor in dict.fromkeys(f for f in factors if block.degree(f) == 1):
        yield from (factor * product for product in dict.fromkeys(products))


def _in_form(poly: Poly, form: Poly, block: _Block) -> _Quadratic | None:
    """The polynomial as a quadratic one in the form, up to multiples of the equation."""
    top, square = block.rest(block.part(poly, 2)), block.rest(form**2)
    if not square or (top and top.normal()[1] != square.normal()[1]):
        return None
    units = square.normal()[0], top.normal()[0]
    common = gcd(*units) * (1 if units[0] > 0 else -1)
    scale, factor = units[0] // common, units[1] // common
    rest = block.reduced(poly * scale - form**2 * factor, 2)
    slope, first = block.rest(block.part(rest, 1)), block.rest(form)
    if slope.gcd(first) not in (first, -first):
        return None
    slope = slope.exact_divide(first)
    offset = block.reduced(rest - slope * form, 1)
    return None if block.degree(offset) else _Quadratic(scale, factor, slope, offset)


def _shift(quadratic: _Quadratic) -> Poly:
    """What is to be added to the form so that the quadratic polynomial becomes short."""
    ring = quadratic.slope.ring
    shift = ring.constant(0)
    for _ in range(ROUNDS):
        size, best = _size(quadratic), None
        for exponents, c in quadratic.slope.terms():
            for divisor in (quadratic.square, 2 * quadratic.square):
                if divisor and not c % divisor:
                    step = ring.from_terms({exponents: c // divisor})
                    if _size(quadratic.moved(step)) < size:
                        size, best = _size(quadratic.moved(step)), step
        if best is None:
            break
        quadratic, shift = quadratic.moved(best), shift + best
    return shift


def _size(quadratic: _Quadratic) -> int:
    return quadratic.slope.term_count() + quadratic.offset.term_count()


def _nested(
    problem: Block, linear: Sequence[Formula], conditions: Sequence[Atom], form: Poly, quadratics: Sequence[_Quadratic]
) -> tuple[Formula, list[Fraction]] | None:
    """The right side of the theorem; None where two conditions become one, or one becomes constant."""
    ring = form.ring
    name = fresh(ring)
    wider = Ring.of((*ring.names, name))
    y = wider.var(name)
    images = [q.at(y) for q in quadratics]
    outer = [atom(q, p.relation) for q, p in zip(images, conditions, strict=True)]
    if len(set(outer)) < len(outer) or not all(isinstance(part, Atom) for part in outer):
        return None
    inner = conj((*(convert(part, wider) for part in linear), atom(y - form.convert(wider), Relation.EQ)))
    nested = exists((name,), conj((*outer, exists(problem.variables, inner))))
    return nested, [Fraction(q.scale, abs(image.normal()[0])) for q, image in zip(quadratics, images, strict=True)]
