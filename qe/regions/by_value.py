"""Solutions by what is said of the variables: each value and each range once, under the condition on the parameters
under which it is a solution.

Over a cell of the parameters a section is a root of a factor. Where the sign of the factor's leading coefficient and
the number of its roots are known there, it is a quotient (degree 1), has a square root (degree 2, and degree 4 with
even powers alone), is a radical (two terms), else the k-th root. What lies between two of them is a range.
Cells over which the same is said are put together, and the condition that it holds is read off the signs
(``formula_of_cells``). So the cases say what the cells of the table say, and need not be disjoint.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache, partial, reduce
from itertools import groupby, product
from math import prod
from operator import mul
from typing import NamedTuple

from qe.decomposition.pieces import RootFunction, Sections, range_text
from qe.decomposition.radicals import NONZERO, NOT_NEGATIVE, bracketed, quotient_text, radicals
from qe.decomposition.sampled_cells import Place, any_true, child, leaves
from qe.elimination.rootsigns.forms import minors
from qe.elimination.rootsigns.theory import minors as signs_of_minors
from qe.errors import Unable
from qe.exact.algebraic import RealAlgebraic, real_roots
from qe.exact.radicals import radical_text
from qe.exact.ring import Poly, Ring, format_poly
from qe.exact.sample import FibreRoot
from qe.formula.build import atom, conj, convert
from qe.formula.syntax import TRUE, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget
from qe.proof.cells import CHARACTER_OF, SIGN_OF, Cell, CellTable
from qe.regions.parameter_conditions import Columned, Terms, both, cells_outside, columns_of, condition, only, parts_of
from qe.spelling import quoted

MOST_CELLS = 2_000
"""Cells of the parameters; more are described as pieces. (Two linear equations with six parameters have 700.)"""

MOST_CONJUGATES = 16
"""Coordinates of a point of at most so many conjugates are written as numbers."""

MOST_WAYS = 6
"""Polynomials that say the variable before that are tried for a value in the parameters alone."""

MOST_TEXTS = 12
"""Texts of a value that are combined with those of the variables after it."""

MOST_TERMS = 40
"""Terms of a polynomial in which others are put, times their degrees."""

TERM = 15
"""So many characters more may a value have than a term in other variables that are solved for, or ``root``."""
POSITIVE = frozenset((1,))
_RELATIONS = {NONZERO: Relation.NE, NOT_NEGATIVE: Relation.GE, POSITIVE: Relation.GT}
_SIDE = re.compile(r"= ((?:(?! and | or | if |, )[^\n])*)")


class Conditioned(NamedTuple):
    """What is said of the variables under a condition, a text, perhaps a disjunction; each of ``terms`` is solutions.
    ``base``: the first cell of the parameters where it holds."""

    base: Place
    condition: str
    is_or: bool
    terms: list[Terms]

    @property
    def lines(self) -> list[str]:
        """Cases as texts; what is said of the first variable is said once."""
        parts = parts_of(self.terms)
        if not (self.condition and parts):
            return parts or [self.condition or "true"]
        return [both((self.condition, self.is_or), (" or ".join(parts), len(parts) > 1))]


def cases_by_value(
    table: CellTable, parameters: int, budget: Budget, known: Formula = TRUE
) -> list[Conditioned] | None:
    """The cases, with ``or`` between their lines a formula for the true cells of a table without quantifiers.

    ``parameters``: how many variables are not solved for; ``known``: what the conditions on them need not say. Where a
    variable before the last has neither finitely many values nor all, it is a parameter, too. None where there are too
    many cells.
    """
    ring, cases = Ring.of(table.order), list[Conditioned]()
    given = convert(conj(f for f in conjuncts(known) if {*f.free} <= {*table.order[:parameters]}), ring)
    everything: frozenset[tuple[int, ...]] = frozenset()  # cells that are said, with all that is over them
    for depth in range(parameters, len(table.order)):
        bases = list(leaves(table, depth=depth))
        if len(bases) > MOST_CELLS:
            return None
        last = depth == len(table.order) - 1
        determined = {i for i, base in enumerate(bases) if last or is_determined(base.cell, len(table.order) - depth)}
        outside = cells_outside(table, bases, given)
        cases += _cases(table, depth, bases, determined, everything, outside, depth > parameters, budget)
        rest = frozenset(base.path for i, base in enumerate(bases) if i not in determined)
        if not rest:
            return cases
        everything |= {base.path for base in bases if _is_all(base.cell)}
        table = only(table, rest | everything)
    return None


def _cases(
    table: CellTable,
    depth: int,
    bases: list[Place],
    known: set[int],
    everything: frozenset[tuple[int, ...]],
    outside: frozenset[int],
    solved: bool,
    budget: Budget,
) -> list[Conditioned]:
    """The cases over those cells of the parameters that are known to have finitely many values or ranges, or all; but
    not over those with ``everything``, which is said already. Conditions may or may not include what is ``outside``."""
    said = _Said(table, depth, Sections(table, budget))
    found: dict[tuple[int, tuple[int, ...]], set[Terms]] = {}
    for i in sorted(known):
        budget.check("solutions by value")
        found |= {(i, place.path): terms for place, terms in said.over(bases[i], _fixed(table, bases[i]))}
    free = frozenset(i for i in known if _is_all(bases[i].cell))
    holding: dict[tuple[frozenset[int], frozenset[int]], list[Terms]] = {}
    for terms in _cover(found, table.order[depth:]):
        cells = frozenset(i for (i, _), all_terms in found.items() if terms in all_terms)
        defined = frozenset(i for i in free if said.is_defined(terms, bases[i]))
        holding.setdefault((cells, defined - cells), []).append(terms)
    new = frozenset(i for i in free if not any(bases[i].path[:k] in everything for k in range(depth + 1)))
    if new:
        holding[new, free - new] = [()]
    ordered = sorted(holding.items(), key=lambda pair: min(pair[0][0]))
    columns = partial(columns_of, table.factors[:depth], cache(partial(said.counted, bases)), bases)
    cases = []
    for (cells, open_), several in ordered:
        either = (open_ | outside) - cells
        natural = said.defined(several, bases, cells, either)
        where = condition(table, bases, cells, either, columns, solved, budget, natural)
        cases.append(Conditioned(bases[min(cells)], *where, several))
    return cases


def _is_all(cell: Cell) -> bool:
    """Whether everything over a cell is true."""
    return cell.truth is True if cell.stack is None else all(map(_is_all, cell.stack.cells))


def is_determined(cell: Cell, levels: int) -> bool:
    """Whether over a cell each variable before the last has finitely many values that are solutions, or all are."""
    if cell.stack is None or levels == 1 or _is_all(cell):
        return True
    inner = cell.stack.cells
    return not any(map(any_true, inner[::2])) and all(is_determined(below, levels - 1) for below in inner)


def _fixed(table: CellTable, base: Place) -> dict[int, Fraction]:
    """The parameters that have one rational value on a cell, the root of a factor in them alone."""
    values = {}
    for i, (used, signs) in enumerate(zip(base.used, base.signs, strict=True)):
        number = base.point.number(i)
        alone = any(s == "0" and table.factors[i][j].variables == (i,) for j, s in zip(used, signs, strict=True))
        if alone and isinstance(number, Fraction):
            values[i] = number
    return values


@dataclass(frozen=True, slots=True)
class _Said:
    """What is said of the variables over cells of so many ``parameters``. ``needs``: polynomials in a text, with the
    signs with which it has a value."""

    table: CellTable
    parameters: int
    sections: Sections
    needs: dict[str, list[tuple[Poly, frozenset[int]]]] = field(default_factory=lambda: defaultdict(list))
    fixed: dict[tuple[int, ...], dict[int, Fraction]] = field(default_factory=dict)

    def over(
        self, place: Place, fixed: Mapping[int, Fraction], before: Sequence[tuple[Poly, ...]] = ((),)
    ) -> Iterator[tuple[Place, set[Terms]]]:
        """The solutions over a cell, with the terms that say them; ``fixed``: the variables with a rational value;
        ``before``: ways in which polynomials say the variables before, the last one first."""
        stack = place.cell.stack
        if stack is None or _is_all(place.cell):
            return
        ends = self.sections.of(place)
        counts = Counter(end.poly for candidates in ends for end in candidates)
        name = quoted(self.table.order[place.depth])
        values = [
            {t for end in candidates for t in self.texts(end, counts[end.poly], place, fixed, before, 2 * k + 1)}
            for k, candidates in enumerate(ends)
        ]
        for start, stop in _runs(stack.cells):
            first = child(self.table, place, start)
            equal = values[start // 2] | self.numbers(first) if start % 2 and start == stop else set()
            if not equal or _is_all(first.cell):
                low, high = (values[k] if k in range(len(values)) else {""} for k in ((start - 1) // 2, stop // 2))
                between = [(a, b) for a, b in product(low, high) if a != b]
                said = {range_text(name, *pair, start % 2 == 1, stop % 2 == 1): pair for pair in between}
                said |= {f"{name} = {value}": (value, "") for value in equal}
                self.needs.update(
                    {text: [*self.needs.get(a, ()), *self.needs.get(b, ())] for text, (a, b) in said.items()}
                )
                yield first, {(text,) for text in said}
                continue
            number = first.point.number(place.depth)
            is_fixed = isinstance(number, Fraction) and str(number) in equal
            inner = {**fixed, place.depth: number} if isinstance(number, Fraction) and is_fixed else fixed
            shortest = sorted(
                equal, key=lambda value: (effort([f"= {value}"], self.table.order[self.parameters :]), value)
            )
            equations = {f"{name} = {value}": self.needs[value] for value in shortest[:MOST_TEXTS]}
            self.needs.update(equations)
            polys = sorted({end.poly for end in ends[start // 2]}, key=self.directness)
            ways = [(poly, *before[0]) for poly in polys[:MOST_WAYS]]
            for end, terms in self.over(first, inner, ways):
                yield end, {(text, *rest) for text in equations for rest in terms}

    def numbers(self, place: Place) -> set[str]:
        """The last coordinate of a single point as a number or in radicals, where that is little work."""
        if not all(k % 2 for k in place.path):
            return set()
        if prod(_degree(place.point.coordinate(i)) for i in range(place.depth)) > MOST_CONJUGATES:
            return set()
        text = radical_text(place.point.number(place.depth - 1))
        return set() if "root(" in text else {text}

    def directness(self, poly: Poly) -> tuple[int, int, str]:
        """How many variables that are solved for are in a polynomial, its degree, and its text."""
        return sum(i >= self.parameters for i in poly.variables), poly.degree(poly.level), format_poly(poly)

    def explicit(self, poly: Poly, place: Place, before: tuple[Poly, ...]) -> Poly | None:
        """The only factor that can have the root that a factor has, without the variables that those before say."""
        parts = poly.ring.remembered(("explicit", poly, before), partial(_without, poly, before))
        having = [factor for factor in parts if factor.degree(place.depth)]
        others = [factor for factor in parts if not factor.degree(place.depth)]
        return having[0] if len(having) == 1 and all(self.sign(one, place) for one in others) else None

    def by_parameters(self, poly: Poly, place: Place, position: int) -> Iterator[str]:
        """The root of a polynomial in the parameters, of degree 1 or without a linear term, that the section at a
        position of the stack over a cell is, as far as signs tell which one that is."""
        c = poly.coefficients(place.depth)
        if len(c) == 2 and self.sign(c[1], place):
            yield from self.valued(RootFunction(poly, 1), 1, place, {})
        elif len(c) == 3 and not c[1] and (sign := self.sign(c[0], place)) is not None and self.sign(c[2], place):
            is_positive = child(self.table, place, position).point.sign(poly.ring.gen(place.depth)) > 0
            yield from self.valued(RootFunction(poly, 1 + is_positive), 2 if sign else 1, place, {})

    def texts(
        self,
        end: RootFunction,
        count: int,
        place: Place,
        fixed: Mapping[int, Fraction],
        before: Sequence[tuple[Poly, ...]],
        at: int,
    ) -> Iterator[str]:
        """The terms that a section, ``at`` a position of the stack, is as one of ``count`` roots of a factor."""
        if end.value is not None:
            yield radical_text(end.value)
            return
        for way in before:
            if (same := self.explicit(end.poly, place, way)) is not None:
                yield from self.by_parameters(same, place, at)
        seen = [(i, value) for i, value in fixed.items() if i in end.poly.variables]
        inner = {i: value for i, value in seen if i >= self.parameters}
        outer = len(seen) - len(inner)  # with these values, too, it may be shorter
        ways = [{**dict(seen[:size]), **more} for size in range(outer + 1) for more in (inner, {})]
        texts: dict[str, bool] = {}
        for k, known in enumerate(ways):
            if known not in ways[:k]:
                texts = {**dict.fromkeys(self.valued(end, count, place, known), k < 2), **texts}
        yield from texts
        if not any(texts.values()):
            text = f"root({end.k}, {format_poly(end.poly)}, {quoted(self.table.order[place.depth])})"
            self.needs[text] = [(end.poly.ring.constant(1), frozenset())]
            yield text

    def valued(self, end: RootFunction, count: int, place: Place, values: Mapping[int, Fraction]) -> Iterator[str]:
        """The root as a number or by radicals, with these ``values`` in the places of variables."""
        level, known = place.depth, end.poly
        form = reduce(lambda form, item: form.at_rational(*item), values.items(), known)
        parts = [factor**power for factor, power in form.factors()[1]]
        kept = [part for part in parts if part.degree(level)]  # none of the others is zero here
        if values and 0 < len(kept) < len(parts):
            known = form = reduce(mul, kept)
        if form.variables == (level,):
            yield radical_text(real_roots(form.to_univariate(level))[end.k - 1])
            return
        signs = [self.sign(c, place) for c in known.coefficients(level)]
        degree = max((k for k, sign in enumerate(signs) if sign != 0), default=0)
        if degree == 2 and signs[2] == 1:
            yield from self.over_root(form.coefficients(level), end.k, count, place)
        if lead := signs[degree]:
            make = lambda: [*radicals(form.coefficients(level)[: degree + 1], end.k, count, lead)]  # noqa: E731
            for radical in form.ring.remembered(("radicals", form, level, degree, end.k, count, lead), make):
                self.needs.setdefault(radical.text, [*radical.needs])
                yield radical.text

    def over_root(self, c: Sequence[Poly], k: int, count: int, place: Place) -> Iterator[str]:
        """The ``k``-th of ``count`` roots of a*x^2 - b^2 = 0 as ±b/sqrt(a), where b has a known sign."""
        b = None if c[1] or c[2].is_constant else (-c[0]).square_root()
        sign = None if b is None else self.sign(b, place)
        if b is None or sign is None:
            return
        for side in {sign * (2 * k - 3)} if count == 2 else (-1, 1):
            top = quotient_text(b * side, None, c[2].ring.constant(1), 0)
            text = f"{bracketed(top, ' ')}/sqrt({format_poly(c[2])})"
            self.needs.setdefault(text, [(c[2], POSITIVE)])
            yield text

    def counted(self, bases: Sequence[Place]) -> Columned:
        """Minors of Hermite's forms of factors whose roots are solutions, with those of their signs on cells that the
        number of real roots over them and what else is known there leave."""
        level, listed = bases[0].depth, Columned()
        for j, poly in enumerate(self.table.factors[level]):
            c = poly.coefficients(level)
            if len(c) < 4 or not c[-1].is_constant:
                continue
            try:
                forms = minors(c, [poly.ring.constant(1)], self.sections.budget)
            except Unable:
                continue
            for base in bases:
                for form, signs in zip(forms, zip(*self.possible(forms, j, base), strict=True)):
                    unit, plain = form.normal()
                    known = listed.setdefault(plain, {})
                    if len({*signs}) == 1 and not plain.is_constant:
                        known[base.path] = CHARACTER_OF[signs[0] if unit > 0 else -signs[0]]
        return {poly: signs for poly, signs in listed.items() if not poly.is_constant}

    def possible(self, forms: Sequence[Poly], j: int, base: Place) -> Iterator[tuple[int, ...]]:
        """The signs that these minors, of factor ``j``, may have over a cell."""
        if (stack := base.cell.stack) is None:
            return
        count = sum(j in members for members in stack.sections)
        known = [self.sign(form, base) for form in forms]
        for rank in range(max(count, 1), len(forms) + 1):
            for row in signs_of_minors(len(forms), rank, count):
                if all(sign in (None, other) for sign, other in zip(known, row, strict=True)):
                    yield row

    def is_defined(self, terms: Terms, base: Place) -> bool:
        """Whether the texts have values over a cell of the parameters, as far as signs that are known there tell."""
        needs = (need for text in terms for need in self.needs[text])
        return all(poly.level >= base.depth or self.sign(poly, base) in signs for poly, signs in needs)

    def defined(
        self, terms: list[Terms], bases: list[Place], cells: frozenset[int], either: frozenset[int]
    ) -> Formula | None:
        """The formula that the texts have values, if that says which cells: those, and perhaps some of the others."""
        needs = {need for texts in terms for text in texts for need in self.needs[text]}
        inside = [(poly, signs) for poly, signs in needs if poly.level < bases[0].depth]
        for i, base in enumerate(bases):
            known = [(self.sign(poly, base), signs) for poly, signs in inside]
            fails = any(sign is not None and sign not in signs for sign, signs in known)
            if i not in either and (fails if i in cells else not fails or not known):
                return None
            if i in cells and any(sign is None for sign, _ in known):
                return None
        return conj(atom(poly, _RELATIONS[signs]) for poly, signs in inside)

    def sign(self, poly: Poly, place: Place) -> int | None:
        """The sign of a polynomial on the cell; None where those of its factors, also at the values that variables have
        there, are not among those that the table says."""
        unit, factors = poly.factors() if poly else (0, ())
        result = (unit > 0) - (unit < 0)
        for factor, exponent in factors:
            sign = self.listed(factor, place)
            if sign is None:
                values = self.fixed.setdefault(place.path, _fixed(self.table, place))
                inner = factor.at_rationals(values)
                sign = None if inner == factor else self.sign(inner, place)
            if sign is None:
                return None
            result *= sign**exponent
        return result

    def listed(self, factor: Poly, place: Place) -> int | None:
        """The sign of a factor that the table says."""
        level = factor.level
        if level >= place.depth or factor not in self.table.factors[level]:
            return None
        j = self.table.factors[level].index(factor)
        if j not in place.used[level]:
            return None
        character = place.signs[level][place.used[level].index(j)]
        return None if character == "?" else SIGN_OF[character]


def _without(poly: Poly, before: Sequence[Poly]) -> list[Poly]:
    """The factors of the resultant with polynomials that say variables; none where it is zero or that takes long."""
    if prod(one.degree(one.level) for one in before) * poly.term_count() > MOST_TERMS:
        return []
    rest = reduce(lambda form, one: form.resultant(one, one.level), before, poly)
    return [] if rest == poly else [factor for factor, _ in rest.factors()[1]] if rest else []


def _degree(value: object) -> int:
    """The degree of the equation that tells a coordinate of a point from those before it."""
    if isinstance(value, FibreRoot):
        return len(value.fibre.coefficients) - 1
    return value.degree if isinstance(value, RealAlgebraic) else 1


def _runs(cells: Sequence[Cell]) -> Iterator[tuple[int, int]]:
    """First and last of neighbouring cells of a stack over which all is true, and each other one that has solutions."""
    for whole, run in groupby(range(len(cells)), key=lambda k: _is_all(cells[k])):
        places = list(run)
        if whole:
            yield places[0], places[-1]
        else:
            yield from ((k, k) for k in places if any_true(cells[k]))


def effort(texts: Iterable[str], names: Iterable[str]) -> int:
    """Characters, and ``TERM`` for each equation whose right side has one of these variables, or a ``root``."""
    lines, solved = list(texts), re.compile(rf"(?<!\w)({'|'.join(map(re.escape, (*names, 'root')))})(?!\w)")
    return sum(map(len, lines)) + TERM * sum(
        bool(solved.search(side)) for line in lines for side in _SIDE.findall(line)
    )


def _cover(found: Mapping[tuple[int, tuple[int, ...]], set[Terms]], names: Sequence[str]) -> list[Terms]:
    """Few and short terms that are all solutions."""
    where: dict[Terms, set[tuple[int, tuple[int, ...]]]] = {}
    for solution, all_terms in found.items():
        for terms in all_terms:
            where.setdefault(terms, set()).add(solution)
    efforts = {terms: effort(terms, names) for terms in where}
    uncovered, chosen = set(found), []
    while uncovered:
        best = min(where, key=lambda terms: (-len(where[terms] & uncovered), efforts[terms], min(where[terms]), terms))
        chosen.append(best)
        uncovered -= where[best]
    return sorted(
        chosen, key=lambda terms: (min(where[terms]), ["+ sqrt" in text for text in terms], sorted(where[terms]))
    )
