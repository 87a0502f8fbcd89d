"""Branch and bound: conditions on many variables refuted piece by piece, by linear relaxations.

THEOREM. A nonnegative combination of conditions p >= 0, of products of distances f - lo, hi - f of linear forms from
their bounds, and of squares that is a negative number excludes the piece of space with these conditions and bounds
(McCormick 1976; Sherali, Adams 1990; Farkas 1902 where monomials count as variables). Pieces f <= c and f >= c are all;
so are those of the parts of a disjunction.

The forms are those of which conditions have squares and products (Lagrange's reduction), so that pieces are cut where
the relaxation is furthest from the truth. The evidence: one identity for each piece, and the clauses of the tree.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import chain, pairwise
from itertools import product as all_of
from math import inf, isfinite, lcm, prod

from qe.elimination.protocol import Context, Outcome, shown
from qe.elimination.samples import Trials
from qe.elimination.search.linear_forms import FormBounds, LinearForm, Monomial, over_monomials
from qe.errors import InternalError, Unable
from qe.exact.number import Values
from qe.exact.ring import Poly
from qe.formula.block import Block
from qe.formula.build import exists
from qe.formula.syntax import FALSE, Atom, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.options import Budget, Options
from qe.proof.on_demand import Evidence, OnDemand
from qe.rules.lift import holds_at
from qe.rules.ordered import in_order
from qe.rules.ranges import Number, ranges_of

RULE, ORDER = "branch and bound", "exchangeable variables in order"

NODE, ENTRIES, DEEPEST, TRIED = 5, 200, 60, 3
"""Units of work of a piece beside the simplex method, of which so many entries are one; cuts on the way to a piece, at
most, and after how many of them there is a trial."""

Powers = tuple[tuple[Poly, int], ...]
Identity = tuple[tuple[Fraction, Powers], ...]
Ends = tuple[Number, Number]


class BranchAndBound:
    """Sentences of many variables, with bounds."""

    name = "branching"

    def suits(self, problem: Block, options: Options) -> str | None:
        """Sentences of one block without root atoms."""
        if not problem.is_flat or problem.free or problem.has_root_atoms or problem.body.ring is None:
            return None
        return f"{len(problem.variables)} variables, {problem.curved} curved conditions"

    def run(self, problem: Block, context: Context) -> Outcome | None:
        """The decision; None where the pieces do not get small enough to be refuted."""
        body, exchanges = in_order(problem.positive)
        ordered = Block.of(problem.asked(exists(problem.variables, body))) if exchanges else problem
        assert ordered is not None
        tree = _Tree(body, Trials.of(problem.positive), context.budget)
        try:
            point = tree.decide()
        except Unable:
            context.budget.check("branching")
            return None
        if point is not None:
            return shown(problem, point, context, RULE)
        if exchanges:
            listed = [[[[*pair] for pair in exchange.items()] for exchange in step] for step in exchanges]
            context.log.step(ORDER, problem.formula, ordered.formula, evidence={"proof": {"exchanges": listed}})
        evidence = {"proof": OnDemand(tree.proof.evidence)}
        return Outcome(context.log.step(RULE, ordered.formula, problem.asked(FALSE), evidence=evidence))


class _Relaxation(FormBounds):
    """Facts about polynomials as bounds of linear forms in monomials; the reason of each is the product that it is
    about."""

    def __init__(self) -> None:
        super().__init__()
        self._forms: dict[Powers, LinearForm] = {}

    def _bound_square(self, monomial: Monomial) -> None:
        """Squares are said like anything else."""

    def say(self, powers: Powers, relation: Relation) -> None:
        """That a product is in a relation to 0."""
        poly = prod((q**e for q, e in powers[1:]), start=powers[0][0] ** powers[0][1])
        form = self._forms.get(powers) or over_monomials(poly)
        self._forms[powers] = form
        x, kind = self.of(form.direction), relation if form.scale > 0 else relation.flipped
        for side, bounded in ((1, self.at_least), (-1, self.at_most)):
            if -side not in kind.signs and not self.stuck:
                bounded(x, form.bound, strict=0 not in kind.signs, reason=powers)

    def undo(self, mark: int, forms: int) -> None:
        """Back to a state with so many forms."""
        self.back(mark)
        self.stuck = []
        for direction in [*self.forms][forms:]:
            x = self.forms.pop(direction)
            if len(direction) > 1:  # else it is a monomial, which other forms have
                self.forget(x)

    def refutation(self, budget: Budget) -> Identity | None:
        """A combination of what was said that is a number, and cannot be."""
        done = self.work

        def check() -> None:
            nonlocal done
            budget.spend((self.work - done) // ENTRIES)
            budget.check("branching")
            done = self.work

        if not self.stuck and self.conflict(check) is None:
            return None
        parts, self.stuck = self.contradiction(), []
        weights: dict[Powers, Fraction] = {(): Fraction(0)}
        sums = Counter[Monomial]()
        for powers, c in parts:
            assert isinstance(powers, tuple)  # all reasons are products
            form = self._forms[powers]
            weights[powers] = weights.get(powers, Fraction(0)) - Fraction(c) / form.scale
            weights[()] -= c * form.bound
            for monomial, factor in form.direction:
                sums[monomial] += c * factor  # type: ignore[assignment]
        if any(sums.values()):
            raise InternalError("a combination of bounds that is no number")
        if not any(weights.values()):  # a condition and its contrary
            powers = next(filter(None, weights))
            return (Fraction(1), powers), (Fraction(-1), powers)
        return tuple((weight, powers) for powers, weight in weights.items() if weight)


@dataclass(frozen=True, slots=True)
class _Proof:
    """``lemmas``: an identity for each piece that is excluded; ``clauses``: of each piece that was cut again, which of
    the literals that make it cannot hold together, in an order in which they follow; ``roots``: what proves the bounds
    of all space."""

    lemmas: list[Identity] = field(default_factory=list)
    clauses: list[frozenset[Atom]] = field(default_factory=list)
    roots: dict[Poly, list[Identity]] = field(default_factory=dict)

    def evidence(self, budget: Budget) -> Evidence:
        """The identities with what they rest on, and the clauses of pieces that were cut again."""
        roots, waiting = dict[Poly, list[Identity]](), [*self.lemmas]
        while waiting:
            used = {q for _, powers in waiting.pop() for q, _ in powers if q in self.roots} - roots.keys()
            roots |= {q: self.roots[q] for q in used}
            waiting += (identity for q in used for identity in self.roots[q])
        identities = []
        for identity in (*chain.from_iterable(roots.values()), *self.lemmas):
            whole = lcm(*(w.denominator for w, _ in identity))
            identities.append([(int(w * whole), powers) for w, powers in identity])
        clauses = [[Atom(a.poly, a.relation.negated) for a in clause] for clause in self.clauses if clause]
        return {"identities": identities, "clauses": clauses}


class _Tree:
    """The pieces of the space of a formula; ``trials`` look for a point near to what the relaxation takes for one."""

    def __init__(self, body: Formula, trials: Trials | None, budget: Budget) -> None:
        self.body, self.trials, self.budget, self.proof = body, trials, budget, _Proof()
        self.atoms = [a for a in conjuncts(body) if isinstance(a, Atom) and a.relation is not Relation.NE]
        self.cases = [case for part in conjuncts(body) if (case := _alternatives(part))]
        polys = [a.poly for a in (*self.atoms, *(a for case in self.cases for a in case))]
        self.products = list(dict.fromkeys(t for p in dict.fromkeys(polys) for t in _products(p)))
        self.relaxation = _Relaxation()

    def decide(self) -> Values | None:
        """A point, or None where there is none. Raises ``Unable``."""
        for a in self.atoms:
            self.relaxation.say(((a.poly, 1),), a.relation)
        forms = dict.fromkeys(f for t in self.products for f in t)
        known = ranges_of(self.atoms), ranges_of([a for a in self.atoms if a.poly.total_degree == 1])
        ends: dict[Poly, Ends] = dict.fromkeys(forms, (-inf, inf))
        for f in forms:
            below, above = zip(*(_interval(f, ranges) for ranges in known))
            ends[f] = self._proved(f, below, -1), self._proved(f, above, 1)
        self._cut(ends, self.products)
        return found if isinstance(found := self._search(ends, {}, 0), dict) else None

    def _proved(self, f: Poly, bounds: Sequence[Number], side: int) -> Number:
        """The first of these bounds, or 0 where it is better, of which the relaxation shows that it holds."""
        for value in (Fraction(0), *bounds):
            if isinstance(value, Fraction) and (value != 0 or bounds[0] * side >= 0):
                poly, sign = _distance(f, value)
                mark = self.relaxation.mark()
                self.relaxation.say(((poly, 1),), Relation.GT if sign * side > 0 else Relation.LT)
                refuted = self.relaxation.refutation(self.budget)
                self.relaxation.back(mark)
                if refuted is not None:
                    self.proof.roots.setdefault(poly, []).append(refuted)
                    self.relaxation.say(((poly, 1),), Relation.LE if sign * side > 0 else Relation.GE)
                    return value
        return side * inf

    def _cut(self, ends: Mapping[Poly, Ends], products: Iterable[tuple[Poly, ...]]) -> None:
        """What the bounds say of products."""
        for product in products:
            for sides in all_of((0, 1), repeat=len(product)):
                chosen = list(zip(product, sides))
                if any(f == g and s > t for (f, s), (g, t) in pairwise(chosen)):
                    continue  # the same in another order
                bounds = [ends[f][side] for f, side in chosen]
                if all(map(isfinite, bounds)):
                    distances = [_distance(f, bound) for (f, _), bound in zip(chosen, bounds)]
                    sign = prod(sign for _, sign in distances) * (-1) ** sum(sides)
                    powers = Counter(poly for poly, _ in distances)
                    self.relaxation.say(tuple(powers.items()), Relation.GE if sign > 0 else Relation.LE)

    def _search(self, ends: dict[Poly, Ends], path: dict[Atom, None], depth: int) -> Values | frozenset[Atom]:
        """A point of a piece, or the literals on the path by which it is empty."""
        self.budget.spend(NODE)
        refuted = self.relaxation.refutation(self.budget)
        if refuted is not None:
            return self._leaf(refuted, path)
        point, values = self._point()
        if holds_at(self.body, point):
            return {**point}
        if depth % TRIED == 0 and self.trials and (found := self.trials.near(point.values(), self.budget)) is not None:
            return found
        if depth > DEEPEST:
            raise Unable("the pieces do not get small enough")
        pieces = self._pieces(ends, point, values)
        needed: frozenset[Atom] = frozenset()
        lemmas, clauses = self.proof.lemmas, self.proof.clauses
        written = len(lemmas), len(clauses)
        for literal, changed, products in pieces:
            before = len(lemmas), len(clauses)
            mark, forms = self.relaxation.mark(), len(self.relaxation.forms)
            self.relaxation.say(((literal.poly, 1),), literal.relation)
            self._cut(changed, products)
            result = self._search(changed, {**path, literal: None}, depth + 1)
            self.relaxation.undo(mark, forms)
            if isinstance(result, dict):
                return result
            if literal not in result:  # what was written for the pieces before is not needed
                del lemmas[written[0] : before[0]], clauses[written[1] : before[1]]
                return result
            needed |= result - {literal}
        clauses.append(needed)
        return needed

    def _leaf(self, refuted: Identity, path: dict[Atom, None]) -> frozenset[Atom]:
        used = {poly for _, powers in refuted for poly, e in powers}
        self.proof.lemmas.append(refuted)
        return frozenset(literal for literal in path if literal.poly in used)

    def _point(self) -> tuple[dict[str, Fraction], dict[Monomial, Fraction]]:
        """What the relaxation takes for a point: variables, and all monomials."""
        assert self.body.ring is not None
        names, values = self.body.ring.names, self.relaxation.values_of_monomials()
        return {name: values.get(((i, 1),), Fraction(0)) for i, name in enumerate(names)}, values

    def _pieces(
        self, ends: dict[Poly, Ends], point: dict[str, Fraction], values: dict[Monomial, Fraction]
    ) -> Iterator[tuple[Atom, dict[Poly, Ends], list[tuple[Poly, ...]]]]:
        """The parts of a disjunction that fails at the point, or both sides of a cut."""
        at = [*point.values()]

        def gap(product: tuple[Poly, ...]) -> float:
            whole = prod(product[1:], start=product[0])
            said = sum((c * values.get(m, Fraction(0)) for m, c in whole.sparse_terms()), Fraction(0))
            return abs(float(said - prod((f.evaluate(at) for f in product), start=Fraction(1))))

        def holds(a: Atom) -> bool:
            said = sum((c * (values.get(m, Fraction(0)) if m else 1) for m, c in a.poly.sparse_terms()), Fraction(0))
            return a.relation.holds((said > 0) - (said < 0))

        for case in self.cases:
            if not any(map(holds, case)):
                for a in case:
                    yield a, ends, []
                return
        product = max(self.products, key=gap, default=())
        if not product or gap(product) < 1e-9:
            raise Unable("no product is far from what the relaxation takes for it")
        f = max(product, key=lambda f: ends[f][1] - ends[f][0])
        low, high = ends[f]
        middle = _between(low, high)
        poly, sign = _distance(f, middle)
        products = [t for t in self.products if f in t]
        for side in (-1, 1):
            changed = {**ends, f: (low, middle) if side < 0 else (middle, high)}
            yield Atom(poly, Relation.GE if side * sign > 0 else Relation.LE), changed, products


def _alternatives(part: Formula) -> tuple[Atom, ...]:
    """The atoms of a disjunction of nothing else."""
    if isinstance(part, Atom) and part.relation is Relation.NE:
        return Atom(part.poly, Relation.LT), Atom(part.poly, Relation.GT)
    args = part.args if isinstance(part, Or) else ()
    atoms = tuple(a for a in args if isinstance(a, Atom) and a.relation is not Relation.NE)
    return atoms if len(atoms) == len(args) else ()


def _distance(f: Poly, end: Number) -> tuple[Poly, int]:
    """f - end is the primitive polynomial times a number of this sign."""
    number = Fraction(end)
    content, poly = (f * number.denominator - number.numerator).normal()
    return poly, 1 if content > 0 else -1


def _products(poly: Poly) -> Iterator[tuple[Poly, ...]]:
    """Linear forms of whose products a polynomial is a combination, beside linear terms (Lagrange; above degree 2 the
    variables)."""
    ring = poly.ring
    if poly.total_degree > 2:
        for powers, _ in poly.sparse_terms():
            if sum(e for _, e in powers) > 1:
                yield tuple(ring.gen(i) for i, e in powers for _ in range(e))
        return
    rest = ring.from_sparse([(m, c) for m, c in poly.sparse_terms() if sum(e for _, e in m) == 2])
    while rest:
        squares = [i for i in rest.variables if rest.degree(i) == 2]
        i = min(squares or rest.variables, key=lambda i: rest.derivative(i).term_count())
        one = rest.derivative(i)
        if squares:
            lead = one.leading(i).constant_value()
            rest, pair = rest * 2 * lead - one * one, (one, one)
        else:
            j = one.variables[0]
            other = rest.derivative(j)
            rest, pair = rest * one.leading(j).constant_value() - one * other, (one, other)
        rest = rest.normal()[1] if rest else rest
        yield tuple(f.normal()[1] for f in pair)


def _interval(f: Poly, known: dict[int, Ends]) -> Ends:
    """The values of a linear form for variables in these ranges."""
    low: Number = Fraction(0)
    high: Number = Fraction(0)
    for powers, c in f.sparse_terms():
        ends = known.get(powers[0][0], (-inf, inf)) if powers else (Fraction(1),) * 2
        a, b = (c * e for e in (ends if c > 0 else ends[::-1]))
        low, high = low + a, high + b
    return low, high


def _between(low: Number, high: Number) -> Fraction:
    """Where a range is cut: 0, or a round number near the middle."""
    if low < 0 < high:
        return Fraction(0)
    if not isinstance(high, Fraction):
        return max(Fraction(1), 2 * Fraction(low))
    if not isinstance(low, Fraction):
        return min(Fraction(-1), 2 * Fraction(high))
    unit = Fraction(1)
    while unit > (high - low) / 4:
        unit /= 2
    return round((low + high) / 2 / unit) * unit
