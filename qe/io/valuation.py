"""The values of terms: polynomials, quotients with their guards, and values behind auxiliary names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.algebraic_text import square_part
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, exists, neg, root_atom
from qe.formula.syntax import TRUE, And, Formula, Relation
from qe.io import cases, terms
from qe.io import surface as s
from qe.io.auxiliaries import Auxiliaries, Auxiliary, Meaning, Place
from qe.io.cases import Case, Cases
from qe.io.sharing import chain
from qe.io.terms import TermError, Value
from qe.io.total import Total


class Valuation(Auxiliaries):
    """The values of terms over one ring, whose names ``extra`` are for auxiliary values. ``condition`` lowers the
    conditions of case distinctions."""

    def __init__(
        self,
        ring: Ring,
        fail: s.Fail,
        extra: Sequence[str],
        total: Total | None,
        condition: Callable[[s.Node, Place], Formula],
    ) -> None:
        super().__init__(ring, extra, total)
        self.fail, self.condition = fail, condition
        self.terms: dict[int, Meaning] = {}

    # --- terms -----------------------------------------------------------------------------------------------
    def term(self, term: s.Term) -> Meaning:
        """What a term means: a polynomial where it can be one."""
        if (known := self.terms.get(id(term))) is not None:
            return known
        try:
            match term:
                case s.Number(value):
                    return terms.number(self.ring, value)
                case s.Name(name, at):
                    if name not in self.ring.index:
                        raise self.fail(f"unknown variable {name}", at)
                    return terms.variable(self.ring, name)
                case s.Polynomial(coefficients):
                    return terms.combination(self.ring, coefficients)
                case s.Sum(parts):
                    return self.sum([self.term(part) for part in parts])
                case s.Minus(part):
                    return self.negated(self.term(part))
                case s.Power(base, exponent, at):
                    return self.power(self.term(base), self.rational(exponent, at))
                case s.Product() | s.Quotient():
                    return self.product(term)
                case s.Apply(function, arguments):
                    return self.apply(function, [self.term(argument) for argument in arguments])
                case s.Choice():
                    return self.choice(term)
                case s.Algebraic(number):
                    return self.number(number)
                case s.Root():
                    return self.root(term)
                case s.Infinity(at):
                    raise self.fail("infinity is no number; it can only be a whole side of a comparison", at)
        except TermError as error:
            raise self.fail(str(error), getattr(term, "at", -1)) from None

    def product(self, term: s.Product | s.Quotient) -> Meaning:
        first, links = chain(term, self.terms)
        value = self.term(first)
        for link in links:
            right = self.term(link.right)
            try:
                value = self.times(value, right) if isinstance(link, s.Product) else self.over(value, right)
            except TermError as error:
                raise self.fail(str(error), link.at) from None
        return value

    def sum(self, parts: list[Meaning]) -> Meaning:
        polynomials = [part for part in parts if isinstance(part, Value)]
        rest = [part for part in parts if not isinstance(part, Value)]
        if not rest:
            return terms.total(polynomials)
        result = rest[0] if not polynomials else cases.plain(terms.total(polynomials))
        for part in rest if polynomials else rest[1:]:
            result = cases.combine(self.few(result, part), cases.total)
        return result

    def negated(self, value: Meaning) -> Meaning:
        if isinstance(value, Value):
            return terms.negative(value)
        return tuple(cases.negative(case) for case in value)

    def times(self, left: Meaning, right: Meaning) -> Meaning:
        if isinstance(left, Value) and isinstance(right, Value):
            return terms.product(left, right)
        return cases.combine(self.few(left, right), lambda pair: cases.times(*pair))

    def over(self, left: Meaning, right: Meaning) -> Meaning:
        if isinstance(right, Value) and right.poly.is_constant and (right.poly or self.total is None):
            bottom = Fraction(right.poly.constant_value(), right.den)
            if not bottom:
                raise TermError("division by zero")
            return self.times(left, terms.number(self.ring, 1 / bottom))
        quotient = self.times(left, self.inverse(right))
        if self.total is None:
            return quotient
        zero = [(*case.guards, atom(case.value.poly, Relation.EQ)) for case in self.listed(right)]
        outside = [case for n in self.listed(left) for case in self.outside("/", n)]
        return (*self.listed(quotient), *(c for case in outside for g in zero for c in cases.guarded(g, case)))

    def inverse(self, value: Meaning) -> Cases:
        return tuple(
            inverted
            for case in self.listed(value)
            if case.value.poly
            for inverted in cases.guarded(case.guards, cases.inverse(case))
        )

    def power(self, base: Meaning, exponent: Fraction) -> Meaning:
        if exponent.denominator > 1:
            base = self.radical(base, exponent.denominator)
        k = abs(exponent.numerator)
        if isinstance(base, Value):
            result: Meaning = terms.power(base, k)
        else:
            result = tuple(c for case in base for c in cases.guarded(case.guards, cases.power(case, k)))
        return result if exponent >= 0 else self.over(terms.number(self.ring, 1), result)

    # --- functions -------------------------------------------------------------------------------------------
    def apply(self, function: str, arguments: list[Meaning]) -> Meaning:
        match function:
            case "sqrt":
                return self.radical(arguments[0], 2)
            case "cbrt":
                return self.radical(arguments[0], 3, odd=True)
            case "abs":
                return self.choose(self.signed(arguments[0], Relation.GE), arguments[0], self.negated(arguments[0]))
            case "sign":
                one, zero = terms.number(self.ring, 1), terms.number(self.ring, 0)
                negative = self.choose(self.signed(arguments[0], Relation.LT), self.negated(one), zero)
                return self.choose(self.signed(arguments[0], Relation.GT), one, negative)
        best = arguments[0]
        for argument in arguments[1:]:
            gap = self.signed(self.sum([best, self.negated(argument)]), Relation.GE)
            best = self.choose(gap, best, argument) if function == "max" else self.choose(gap, argument, best)
        return best

    def signed(self, value: Meaning, relation: Relation) -> list[tuple[Formula, Formula]]:
        """The ways in which ``value relation 0`` can hold or not: the guards of a case, with and without it."""
        ways = []
        for case in self.listed(value):
            holds = cases.holds(case._replace(guards=()), relation)
            fails = cases.holds(case._replace(guards=()), relation.negated)
            ways.append((conj((*case.guards, holds)), conj((*case.guards, fails))))
        return ways

    def choose(self, ways: list[tuple[Formula, Formula]], then: Meaning, other: Meaning) -> Meaning:
        """``then`` where the first of a pair holds, ``other`` where the second does."""
        chosen: list[Case] = []
        for yes, no in ways:
            for guard, value in ((yes, then), (no, other)):
                guards = guard.args if isinstance(guard, And) else (guard,)
                chosen += [c for case in self.listed(value) for c in cases.guarded(guards, case)]
        return self.simple(tuple(chosen))

    def choice(self, term: s.Choice) -> Meaning:
        loose = self.loose
        self.loose = False
        condition = self.condition(term.condition, Place())
        if self.loose and self.total is not None:
            self.total.unclear = True
        self.loose = self.loose or loose
        then = self.term(term.then)
        other: Meaning = () if term.other is None else self.term(term.other)
        return self.choose([(condition, neg(condition))], then, other)

    # --- roots -----------------------------------------------------------------------------------------------
    def radical(self, value: Meaning, degree: int, odd: bool = False) -> Meaning:
        """The root of a degree: not negative and of arguments that are not (``odd``: the only real one)."""
        if degree > terms.MAX_EXPONENT:
            raise TermError(f"a root of degree {degree} is above the limit of {terms.MAX_EXPONENT}")
        roots: list[Case] = []
        for case in self.listed(value):
            inside = () if odd else (cases.holds(case._replace(guards=()), Relation.GE),)
            for guarded in cases.guarded(inside, case):
                root = self.square_root(guarded) if degree == 2 else self.other_root(guarded, degree, odd)
                roots += [c for part in root for c in cases.guarded(guarded.guards, part)]
            if inside and self.total is not None:
                negative = cases.holds(case, Relation.LT)
                roots += [c for part in self.outside("sqrt", case) for c in cases.guarded((negative,), part)]
        return self.simple(tuple(roots))

    def square_root(self, case: Case) -> Cases:
        """``sqrt(case)``: squares are taken out, and s^2 is a polynomial t for the one root s that may be left."""
        inside, outside = terms.product(case.value, terms.number(self.ring, case.value.den)).poly, self.ring.constant(1)
        below = self.ring.constant(1)
        for factor, k in case.below:
            inside = inside * factor ** (k % 2)
            below = below * factor ** ((k + 1) // 2)
        if not inside:
            return cases.plain(terms.number(self.ring, 0))
        unit, factors = cases.split(inside)
        whole = square_part(abs(unit))
        rest = self.ring.constant(unit // whole**2)
        for factor, k in factors:
            outside, rest = outside * factor ** (k // 2), rest * factor ** (k % 2)
        root: Meaning = terms.number(self.ring, Fraction(whole, case.value.den))
        if rest != self.ring.constant(1):
            root = self.times(root, cases.plain(terms.variable(self.ring, self.root_name(rest))))
        size = self.over(self.absolute(outside), self.absolute(below))
        return self.listed(self.times(root, size))

    def absolute(self, poly: Poly) -> Meaning:
        value = Value(poly, 1, poly.height_bits())
        if poly.is_constant or all(k % 2 == 0 for _, k in cases.split(poly)[1]):
            return value
        return self.apply("abs", [value])

    def root_name(self, radicand: Poly) -> str:
        """The name for the square root of a polynomial."""

        def made(name: str) -> Auxiliary:
            root = self.ring.var(name)
            square = atom(root * root - radicand, Relation.EQ)
            inside = atom(radicand, Relation.GE)
            return Auxiliary(name, conj((atom(root, Relation.GE), square)), inside, radicand)

        return self.named(("sqrt", radicand), made)

    def other_root(self, case: Case, degree: int, odd: bool) -> Cases:
        def made(name: str) -> Auxiliary:
            root = terms.variable(self.ring, name)
            gap = cases.total((Case((), terms.power(root, degree)), cases.negative(case)))
            sign = TRUE if odd else atom(root.poly, Relation.GE)
            definition = conj((sign, cases.holds(gap._replace(guards=case.guards), Relation.EQ)))
            return Auxiliary(name, definition, conj(case.guards))

        return cases.plain(terms.variable(self.ring, self.named(("root", degree, odd, case), made)))

    def number(self, number: RealAlgebraic) -> Meaning:
        if number.is_rational:
            return terms.number(self.ring, number.as_fraction())
        coefficients = number.minimal_polynomial
        if number.degree == 2:
            c, b, a = coefficients
            root = self.radical(terms.number(self.ring, b * b - 4 * a * c), 2)
            signed = root if number.index else self.negated(root)
            scale = terms.number(self.ring, Fraction(1, 2 * a))
            return self.times(self.sum([terms.number(self.ring, -b), signed]), scale)

        def made(name: str) -> Auxiliary:
            value = self.ring.var(name)
            zero = sum((c * value**k for k, c in enumerate(coefficients)), self.ring.constant(0))
            low, high = (Fraction(end) for end in number.interval())
            ends = ((low, Relation.GE), (high, Relation.LE))
            near = (atom(value * end.denominator - end.numerator, relation) for end, relation in ends)
            return Auxiliary(name, conj((atom(zero, Relation.EQ), *near)), TRUE)

        return cases.plain(terms.variable(self.ring, self.named(("number", coefficients, number.index), made)))

    def root(self, term: s.Root) -> Meaning:
        """``root(k, p, x)`` as a term."""
        k = self.constant(term.number, "the first argument of root is its number: root(2, x^2 - y, x)", term.at)
        poly = self.polynomial(term.poly, term.at)
        if term.variable is None and len(poly.variables) != 1:
            message = "root(…) of a polynomial in several variables needs its variable, as in root(2, x^2 - y, x)"
            raise self.fail(message, term.at)
        index = poly.level if term.variable is None else self.ring.index[term.variable]
        if k == 0 or not poly.degree(index):
            raise self.fail("no such root: roots are counted from 1 or -1, in a variable of the polynomial", term.at)
        if len(poly.variables) == 1:
            roots = real_roots(poly.to_univariate(index))
            if not 1 <= abs(k) <= len(roots):
                return ()
            return self.number(roots[k - 1 if k > 0 else k])

        def made(name: str) -> Auxiliary:
            definition = root_atom(name, Relation.EQ, poly.compose({index: self.ring.var(name)}), k)
            return Auxiliary(name, definition, exists((name,), definition))

        name = self.named(("root in", poly, index, k), made)
        auxiliary = self.made[name]
        assert auxiliary is not None
        return cases.guarded((auxiliary.defined,), Case((), terms.variable(self.ring, name)))

    # --- constants -------------------------------------------------------------------------------------------
    def rational(
        self, term: s.Term, at: int, message: str = "an exponent must be a rational number, without variables"
    ) -> Fraction:
        """An exponent."""
        if isinstance(term, s.Number):
            return Fraction(term.value)
        value = self.term(term)
        if not isinstance(value, Value) or not value.poly.is_constant:
            raise self.fail(message, at)
        return Fraction(value.poly.constant_value(), value.den)

    def constant(self, term: s.Term, message: str, at: int) -> int:
        """An integer."""
        number = self.rational(term, at, message)
        if number.denominator != 1:
            raise self.fail(message, at)
        return int(number)

    def polynomial(self, term: s.Term, at: int) -> Poly:
        """A polynomial, up to a positive factor."""
        value = self.term(term)
        if not isinstance(value, Value):
            raise self.fail("a polynomial expected here", at)
        return value.poly
