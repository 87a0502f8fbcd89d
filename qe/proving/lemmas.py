"""Lemmas about the signs of polynomials, as evidence for boolean steps; ``qe.kernel.signs`` has what they say.

What is found here is checked where it is read: nothing depends on its being right, or complete.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from math import lcm, prod
from operator import ge

from qe.elimination.search.linear_forms import is_square
from qe.elimination.search.monomial_bounds import MonomialBounds
from qe.exact.groebner import Basis, groebner_basis
from qe.exact.groebner import Limits as BasisLimits
from qe.exact.quadratic_form import solve_linear
from qe.exact.ring import Poly, Ring
from qe.formula.syntax import FALSE, Atom, Or, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.boolean import Goal
from qe.kernel.negation import normal
from qe.kernel.step import Limits
from qe.options import Budget
from qe.proof.entry import Json, poly_to_text
from qe.proving.cofactors import cofactors
from qe.proving.expansions import as_squares, ranges, shifted
from qe.proving.goals import is_hopeless, polynomials_outside
from qe.proving.lemma_list import Lemmas, Term, without_needless
from qe.proving.refutation import NODES, Refutation
from qe.rules.cancelling import difference
from qe.simplifier.facts import factor_list, key_of

MOST_POLYNOMIALS, MOST_PAIRS, MOST_TARGETS, MOST_CHAINED, MOST_BOUNDS = 120, 400, 8, 12, 400
MOST_REDUCED = 40
BRIEF_BASIS = BasisLimits(elements=80, terms=300, bits=600)
FEW_CASES, FEW_SPLITS = 300, 8
"""A search with some of the lemmas has no more cases than this, and no more of them by the sign of a polynomial."""


def refuting(goals: Sequence[Goal], ring: Ring, limits: Limits, ideal: bool = False) -> Json | None:
    """Evidence with which each of the lists of formulas is refuted, or None where none is found.

    ``ideal``: whether equations were replaced by others that generate the same ideal. Raises ``BudgetExceeded``.
    """
    polys = polynomials_outside(f for goal in goals for f in goal)
    if len(polys) > MOST_POLYNOMIALS or any(map(is_hopeless, goals)):
        return None
    theory, pool = Lemmas(ring), dict[Poly, None]()
    given = {a.poly for a in _comparisons(goals) if a.relation is Relation.EQ}
    equations = [p for p, is_equation in polys.items() if is_equation]
    sure, perhaps = ([p for p in equations if (p in given) is k] for k in (True, False))
    modulo = [lambda: _remainders(theory, polys, sure), lambda: _ideals(theory, goals, limits.budget)]
    stages: list[Callable[[], None]] = [
        lambda: None,
        *(modulo if ideal else ()),
        lambda: _values(theory, goals, polys),
        lambda: _factors(theory, polys, pool),
        lambda: _pairs(theory, polys, sure, pool, _reduced, _cancelled),
        lambda: _pairs(theory, polys, perhaps, pool, _reduced),
        lambda: _pairs(theory, polys, perhaps, pool, _cancelled),
        lambda: _lines(theory, polys),  # behind what identities alone give: those rest on no theorem
        lambda: _expanded(theory, polys),
        lambda: _bounds(theory, goals, limits),
        lambda: _chained(theory, polys),
        *(() if ideal else modulo),
        lambda: _remainders(theory, polys, perhaps),
    ]
    searches = [Refutation(goal, limits) for goal in goals]
    for stage, search in enumerate(stages):
        count = len(theory.lemmas)
        limits.budget.check("prove")
        search()
        if stage and count == len(theory.lemmas):
            continue
        for refutation in searches:
            refutation.learn(tuple(theory.numbers), theory.facts)
        if all(refutation.go_on(FEW_CASES, FEW_SPLITS) for refutation in searches):
            break
    if not all(refutation.go_on(NODES, NODES) for refutation in searches):
        return None
    evidence = theory.only({k for refutation in searches for k in refutation.lemmas}, searches)
    return without_needless(evidence, goals, ring, limits)


def _bounds(theory: Lemmas, goals: Sequence[Goal], limits: Limits) -> None:
    """Linear combinations of comparisons, and of squares, by which the goals fail, one of a disjunction at a time."""
    bounds = MonomialBounds(theory.ring)
    for goal in goals:
        parts = [part for f in goal for part in conjuncts(normal(f))]
        known = [a for a in parts if isinstance(a, Atom)]
        cases: list[list[Atom]] = [[]]
        for part in (f for f in parts if isinstance(f, Or)):
            cases += [[a for a in conjuncts(case) if isinstance(a, Atom)] for case in part.args]
        for case in cases[: max(1, MOST_BOUNDS // (len(known) + 1))]:
            conflict = bounds.conflict([*known, *case], limits.tick)
            if conflict is not None:
                _combined_bounds(theory, [a.poly for a in (*known, *case) if a in conflict], None in conflict)
                if not case:
                    break


def _combined_bounds(theory: Lemmas, polys: Sequence[Poly], squares: bool) -> None:
    """A combination of the polynomials, with squares of monomials where these take part, that is constant."""
    first, *others = dict.fromkeys(polys)
    ring = first.ring
    monomials = list(dict.fromkeys(e for p in (first, *others) for e, _ in p.sparse_terms() if e))
    columns = [dict(p.sparse_terms()) for p in others]
    even = [e for e in monomials if is_square(e)] if squares else []
    columns += [{e: 1} for e in even]
    rows = [[Fraction(column.get(e, 0)) for column in columns] for e in monomials]
    wanted = dict(first.sparse_terms())
    solution = solve_linear(rows, [Fraction(-wanted.get(e, 0)) for e in monomials], len(columns))
    if solution is None:
        return
    weights = [Fraction(1), *solution.particular]
    scale = lcm(*(w.denominator for w in weights))
    members: list[tuple[tuple[Poly, int], ...]] = [((p, 1),) for p in (first, *others)]
    members += [tuple((ring.gen(i), k) for i, k in e) for e in even]
    terms = [(int(w * scale), powers) for w, powers in zip(weights, members, strict=True) if w]
    constants = [dict(p.sparse_terms()).get((), 0) for p in (first, *others)]
    total = sum((w * c for w, c in zip(weights, constants)), Fraction(0)) * scale
    theory.identity([*terms, (-int(total), ())])


def _factors(theory: Lemmas, polys: Iterable[Poly], pool: dict[Poly, None]) -> None:
    """Factors, differences that are constant, and squares; what they are about joins the pool."""
    _join(theory, pool, [*polys, *(part for poly in polys for part in _factored(theory, poly))])


def _pairs(
    theory: Lemmas,
    polys: Iterable[Poly],
    equations: Iterable[Poly],
    pool: dict[Poly, None],
    *changes: Callable[[Lemmas, Poly, Poly], list[Poly]],
) -> None:
    """Polynomials changed by equations, with what ``_factors`` says of what comes of them."""
    pairs = ((poly, equation) for equation in equations for poly in polys if poly != equation)
    _join(theory, pool, [part for pair in pairs for change in changes for part in change(theory, *pair)])


def _join(theory: Lemmas, pool: dict[Poly, None], polys: Iterable[Poly]) -> None:
    """Differences of these and of others in the pool that are constant, and their squares."""
    fresh = [p for p in dict.fromkeys(polys) if p not in pool]
    pool.update(dict.fromkeys(fresh))
    _differences(theory, pool)
    for poly in fresh:
        as_squares(theory, poly)


def _expanded(theory: Lemmas, polys: dict[Poly, bool]) -> None:
    """Sums of monomials, and of products of distances from bounds."""
    ranges(theory, polys)
    shifted(theory, polys)


def _comparisons(goals: Iterable[Goal]) -> list[Atom]:
    """Those that a goal says to hold."""
    parts = (part for goal in goals for f in goal for part in conjuncts(normal(f)))
    return [part for part in parts if isinstance(part, Atom)]


def _values(theory: Lemmas, goals: Sequence[Goal], polys: dict[Poly, bool]) -> None:
    """Values of variables, which equations beside all else give, put into the others, all at once."""
    lines: dict[int, Poly] = {}
    for a in _comparisons(goals):
        if a.relation is Relation.EQ and a.poly.total_degree == 1:
            variables = a.poly.variables
            if len(variables) == 1:
                lines.setdefault(variables[0], a.poly)
    for poly in polys if lines else ():
        terms, image, scale = list[Term](), poly, 1
        for x, line in lines.items():
            if poly != line and image.degree(x) > 0:
                rest, lead = line.coefficients(x)
                power = lead.constant_value() ** image.degree(x)
                reduced = image.at_quotient(x, -rest, lead)
                terms = [(c * power, powers) for c, powers in terms]
                terms.append((-1, (((image * power - reduced).exact_divide(line), 1), (line, 1))))
                image, scale = reduced, scale * power
        if terms:
            theory.identity([(scale, ((poly, 1),)), *terms, (-1, ((image, 1),))])
            if not image.is_constant:
                _factored(theory, image.normal()[1])
    for poly in list(polys) if lines else ():
        _factored(theory, poly)


def _chained(theory: Lemmas, polys: dict[Poly, bool]) -> None:
    """Linear equations put into all others, also those that appear only then: a = 1 makes 3*x^2 - 2*x - a a product, a
    factor of which gives x, and so on. What may be zero is put in as if it were; the identities hold in any case."""
    pool = dict.fromkeys(polys)
    maybe = {p for p, is_equation in polys.items() if is_equation}
    for poly in list(polys):
        parts = _factored(theory, poly)
        pool.update(dict.fromkeys(parts))
        maybe.update(parts if poly in maybe else ())
    used: set[Poly] = set()
    for _ in range(MOST_CHAINED):
        left = [p for p in maybe - used if any(p.degree(i) == 1 and p.leading(i).is_constant for i in p.variables)]
        if not left:
            break
        equation = min(left, key=lambda p: (p.total_degree, p.term_count(), poly_to_text(p)))
        used.add(equation)
        for poly in [p for p in pool if p != equation]:
            parts = _reduced(theory, poly, equation)
            pool.update(dict.fromkeys(parts))
            maybe.update(parts if poly in maybe else ())
    _join(theory, {}, pool)
    _lines(theory, pool)


def _factored(theory: Lemmas, poly: Poly) -> list[Poly]:
    parts = [(f, e) for f, e in factor_list(poly) if not f.is_constant]
    if sum(e for _, e in parts) < 2:
        return [poly]
    content, primitive = prod((f**e for f, e in parts), start=poly.ring.constant(1)).normal()
    if primitive == poly:
        theory.identity([(content, ((poly, 1),)), (-1, tuple(parts))])
    return [f for f, _ in parts]


def _reduced(theory: Lemmas, poly: Poly, equation: Poly) -> list[Poly]:
    """lead^k * poly = r + s * equation, division in the first variable in which the equation is linear."""
    x = next((i for i in equation.variables if equation.degree(i) == 1 and equation.leading(i).is_constant), None)
    if x is None or not poly.degree(x) or len(theory.lemmas) > MOST_PAIRS:
        return []
    rest, lead = equation.coefficients(x)
    if rest.term_count() > 3:
        return []
    image = poly.at_quotient(x, -rest, lead)
    scale = lead.constant_value() ** poly.degree(x)
    quotient = (poly * scale - image).exact_divide(equation)
    theory.identity([(scale, ((poly, 1),)), (-1, ((quotient, 1), (equation, 1))), (-1, ((image, 1),))])
    if image.is_constant:
        return []
    primitive = image.normal()[1]
    return [primitive, *_factored(theory, primitive)]


def _cancelled(theory: Lemmas, poly: Poly, equation: Poly) -> list[Poly]:
    """a * poly = b * equation + r, where that makes a product r."""
    known = difference(poly, equation)
    if known is None:
        return []
    a, b, rest = known
    theory.identity([(a, ((poly, 1),)), (-b, ((equation, 1),)), (-1, ((rest, 1),))])
    primitive = rest.normal()[1]
    return [primitive, *_factored(theory, primitive)]


def _differences(theory: Lemmas, pool: Iterable[Poly]) -> None:
    """u_j * p_i - u_i * p_j = constant for polynomials with one key, neighbours by value."""
    groups: dict[Poly, list[tuple[Fraction, int, int, Poly]]] = {}
    for poly in pool:
        key, unit, constant = key_of(poly)
        groups.setdefault(key, []).append((Fraction(constant, unit), unit, constant, poly))
    for members in groups.values():
        for (_, u, c, p), (_, v, d, q) in pairwise(sorted(members, key=lambda m: m[0])):
            theory.identity([(v, ((p, 1),)), (-u, ((q, 1),)), (u * d - v * c, ())])


def _lines(theory: Lemmas, polys: Iterable[Poly]) -> None:
    """All polynomials in one variable alone, by variable."""
    groups: dict[int, list[Poly]] = {}
    for poly in dict.fromkeys((*theory.numbers, *polys)):
        if len(poly.variables) == 1:
            for factor, _ in factor_list(poly):
                groups.setdefault(poly.variables[0], []).append(factor)
    for x, members in groups.items():
        theory.line(list(dict.fromkeys(members)), x)


def _remainders(theory: Lemmas, polys: Iterable[Poly], equations: Iterable[Poly]) -> None:
    """Polynomials that are the same, up to a factor, where an equation holds, and such that vanish there."""
    for equation in equations:
        basis = groebner_basis((equation,), variables=range(theory.ring.size))
        alike: dict[Poly, list[tuple[Fraction, Poly]]] = {}
        lead = basis.leads[0] if basis is not None else ()
        for p in polys:
            if basis is None or p == equation:
                continue
            reducible = any(all(map(ge, e, lead)) for e, _ in p.terms())
            scale, rest = basis.reduce(p) if reducible else (1, p)
            unit, key = rest.normal() if rest else (scale, rest)
            alike.setdefault(key, []).append((Fraction(unit, scale), p))
        for key, members in alike.items():
            for _, p in () if key else members:
                theory.identity([(1, ((p, 1),)), (-1, ((p.exact_divide(equation), 1), (equation, 1)))])
            for (u, p), (v, q) in pairwise(members) if key else ():
                ratio = v / u
                quotient = (p * ratio.numerator - q * ratio.denominator).exact_divide(equation)
                terms: list[Term] = [(ratio.numerator, ((p, 1),)), (-ratio.denominator, ((q, 1),))]
                theory.identity([*terms, (-1, ((quotient, 1), (equation, 1)))])


def _ideals(theory: Lemmas, goals: Sequence[Goal], budget: Budget) -> None:
    """What follows from ideals that equations generate."""
    _combinations(theory, goals, budget)
    _modulo(theory, goals, budget)


def _combinations(theory: Lemmas, goals: Sequence[Goal], budget: Budget) -> None:
    """What stands on one side of an equivalence as a combination of the equations on the other, up to a multiple of an
    inequality there. Where these have a Gröbner basis, it says at once what is none."""
    if len(goals) != 2 or min(map(len, goals)) < 2:
        return
    sides = [conjuncts(normal(goal[-2])) for goal in goals]
    for side, other in (sides, reversed(sides)):
        equations = [a.poly for a in side if isinstance(a, Atom) and a.relation is Relation.EQ]
        generators = list(dict.fromkeys(_squarefree(theory, p) for p in equations))
        if not generators:
            continue
        basis = groebner_basis(generators, variables=range(theory.ring.size), limits=BRIEF_BASIS)
        known = {a.poly for a in side if isinstance(a, Atom)}
        wanted = [a for a in other if isinstance(a, Atom) and a.poly not in known]
        targets = list[tuple[Poly, ...]]()
        if list(other) == [FALSE] and (basis is None or basis.is_unit):
            targets.append((generators[0].ring.constant(1),))
        for target in wanted[: MOST_REDUCED if basis else MOST_TARGETS]:
            rest = _remainder(target.poly, basis)
            if target.relation is Relation.EQ or (rest is not None and not rest):
                targets += [] if rest else [(target.poly,)]
            elif rest is not None:
                pairs = (a for a in side if isinstance(a, Atom) and a.relation is not Relation.EQ)
                targets += [(target.poly, a.poly) for a in pairs if rest == _remainder(a.poly, basis)]
        _combined(theory, targets, generators, budget, basis)


def _remainder(poly: Poly, basis: Basis | None) -> Poly | None:
    """What remains of a polynomial where the equations of a basis hold, up to a constant factor; None without one."""
    if basis is None:
        return None
    rest = basis.reduce(poly)[1]
    return rest.normal()[1] if rest else rest


def _modulo(theory: Lemmas, goals: Sequence[Goal], budget: Budget) -> None:
    """Polynomials of disjunctions that are the same, up to a factor, where all equations beside them hold, and those
    that vanish there."""
    sides = [conjuncts(normal(goal[-2])) for goal in goals if len(goal) > 1]
    systems = [tuple(a.poly for a in side if isinstance(a, Atom) and a.relation is Relation.EQ) for side in sides]
    inside = polynomials_outside(f for side in sides for f in side if isinstance(f, Or))
    for system in dict.fromkeys(systems):
        basis = groebner_basis(system, variables=range(theory.ring.size)) if len(system) > 1 else None
        alike: dict[Poly, list[Poly]] = {}
        for p in inside if basis else ():
            rest = _remainder(p, basis)
            if rest is not None:
                alike.setdefault(rest, []).append(p)
        vanishing = [(p,) for key, members in alike.items() if not key for p in members]
        pairs = [pair for key, members in alike.items() if key for pair in pairwise(members)]
        _combined(theory, [*vanishing, *pairs], system, budget, basis)


def _combined(
    theory: Lemmas,
    targets: Sequence[tuple[Poly, ...]],
    generators: Sequence[Poly],
    budget: Budget,
    basis: Basis | None,
) -> None:
    """Polynomials as combinations of generators; of two with proportional remainders modulo the basis, the sum of
    multiples that vanishes modulo it."""
    weights = [_weights(of, basis) for of in targets]
    sums = [sum((p * w for p, w in zip(of, by)), of[0].ring.constant(0)) for of, by in zip(targets, weights)]
    solved = cofactors(sums, generators, budget, basis is not None) if targets else []
    for of, by, solution in zip(targets, weights, solved, strict=True):
        if solution is not None:
            number, factors = solution
            terms: list[Term] = [(number * w, ((p, 1),)) for p, w in zip(of, by, strict=True)]
            theory.identity([*terms, *((-1, ((c, 1), (e, 1))) for c, e in zip(factors, generators, strict=True) if c)])


def _weights(targets: tuple[Poly, ...], basis: Basis | None) -> list[int]:
    """1 for a single polynomial; integers with which two, whose remainders are proportional, add up to one that
    vanishes modulo the basis."""
    if basis is None or len(targets) != 2:
        return [1] * len(targets)
    (s, p), (t, q) = (basis.reduce(target) for target in targets)
    return [s * q.normal()[0], -t * p.normal()[0]]


def _squarefree(theory: Lemmas, poly: Poly) -> Poly:
    """The product of the distinct factors, with lemmas that say so."""
    parts = _factored(theory, poly)
    whole = prod(parts, start=poly.ring.constant(1)).normal()[1]
    if whole != poly:
        _factored(theory, whole)
    return whole
