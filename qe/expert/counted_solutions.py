"""Rule "comprehensive Gröbner system": a block over equations becomes conditions on the parameters.

THEOREM. Over all points of a case of the parameters the equations of a conjunction have one Gröbner basis
(``arithmetic.parametric``). Where there are finitely many complex solutions, the number of real ones with g > 0, g >= 0
or g /= 0 is a combination of signatures of Hermite's trace forms for products of powers of the g: the weights make a
polynomial in the sign of g that is 1 where the condition holds and 0 elsewhere (Ben-Or, Kozen, Reif 1986; Pedersen,
Roy, Szpirglas 1993). Signatures are read off signs (``arithmetic.signature``). Where there are infinitely many, ex v, w
A iff ex v ex w A, and v joins the parameters. So over each case there are two formulas: "some" holds wherever there is
a solution, "none" wherever there is not, and one of the two situations is the case at every point. The step is right
if over each case "some" implies what the block became, and "none" its negation.

Evidence: ``proofs``: for each case lemmas by which this sentence about the parameters is true (as for the rule
"signs"), or a certificate that it is. Nothing says what the cases are: the checker divides the parameter space
by itself. (Of a sentence that is false: ``no_solutions``.)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import prod

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.parametric import Case, Conditions, Exponents, Terms, cases
from qe.expert.arithmetic.parametric_forms import ParametricForms
from qe.expert.arithmetic.signature import Signatures, signatures
from qe.expert.no_solutions import check_no_solutions, conjunctions
from qe.formula.build import atom, conj, convert, disj, exists, forall, implies, neg
from qe.formula.syntax import FALSE, TRUE, Atom, Exists, Formula, Relation
from qe.kernel.block import check_block, existential
from qe.kernel.negation import normal
from qe.kernel.nested import is_true
from qe.kernel.step import Claim, Context, Limits, only
from qe.proof.entry import Entry

MOST_SOLUTIONS, MOST_COMBINATIONS = 16, 3000
"""Complex solutions of a case (determinants by expansion take twice as long with each: 0.3 s for 12, two for 16), and
values that the signatures of all its forms may have together."""

_WEIGHTS = {
    Relation.GT: (2, {1: 1, 2: 1}),
    Relation.GE: (2, {0: 2, 1: 1, 2: -1}),
    Relation.NE: (1, {2: 1}),
}
"""(c, {power: weight}): the weighted powers of a sign add up to c where the relation to 0 holds, to 0 elsewhere."""


def check_counted_solutions(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the case that fails. Raises ``Unable`` at a limit."""
    if isinstance(claim.evidence.value, dict) and "systems" in claim.evidence.value:
        return check_no_solutions(claim, context, limits)
    entry = only(claim, "proofs")[0]
    listed = iter(list(entry.items()))
    for sentence in sentences(claim, limits.tick):
        proof = next(listed, None)
        if proof is None:
            raise entry.fail("a case is left without a proof")
        if isinstance(proof.value, dict) and "theory" in proof.value:
            check_block(by_lemmas(sentence, claim.ring, proof), (), limits)
            continue
        if not is_true(sentence, proof, limits):
            raise proof.fail("not a proof of the sentence of this case")
    if (proof := next(listed, None)) is not None:
        raise proof.fail("there are not so many cases")
    return None


def by_lemmas(sentence: Formula, ring: Ring, evidence: Entry) -> Claim:
    """That a sentence is true, for the checker of simplifications."""
    return Claim("signs", sentence, TRUE, ring, evidence, evidence.path)


def sentences(claim: Claim, tick: Callable[[], None]) -> Iterator[Formula]:
    """One about the parameters for each case, but those that are plainly true: the step is right iff they hold.

    Raises ``CertificateRejected`` where the step is about something else, ``Unable`` at a limit.
    """
    before, after = existential(claim)
    if not isinstance(before, Exists) or not before.body.is_quantifier_free:
        raise claim.fail("expected a block over a formula without quantifiers")
    if set(before.variables) & set(after.free):
        raise claim.fail("a variable of the block is free in what becomes of it")
    ring = Ring.of(n for n in claim.ring.names if n in before.free)
    parts = [_Conjunction.of(p, before.variables, claim) for p in conjunctions(normal(before.body)) if FALSE not in p]
    for case in _refined(parts, Conditions.of(ring, (), (), tick), claim.ring):
        found = conj([implies(case.some, after), implies(case.none, neg(after))])
        sentence = forall(ring.names, implies(case.where, found))
        if sentence != TRUE:
            yield sentence


@dataclass(frozen=True)
class _Truth:
    """Under ``where``: ``some`` wherever a solution exists, ``none`` wherever none does."""

    where: Formula
    some: Formula
    none: Formula


@dataclass(frozen=True)
class _Conjunction:
    """``equations`` = 0 and ``conditions`` in ``names``, and ``outside``, which is free of them."""

    ring: Ring
    names: tuple[str, ...]
    equations: tuple[Poly, ...]
    conditions: tuple[tuple[Poly, Relation], ...]
    outside: Formula

    @staticmethod
    def of(members: frozenset[Formula], block: Sequence[str], claim: Claim) -> _Conjunction:
        ordered = sorted(members, key=str)  # the same in every process
        inside = [a for a in ordered if set(block) & set(a.free)]
        listed = [a for a in inside if isinstance(a, Atom)]
        if len(listed) < len(inside):
            raise claim.fail("expected comparisons of polynomials")
        upward = {Relation.LT: Relation.GT, Relation.LE: Relation.GE}
        return _Conjunction(
            claim.ring,
            tuple(v for v in block if any(v in a.free for a in listed)),
            tuple(a.poly for a in listed if a.relation is Relation.EQ),
            tuple(
                (-a.poly, upward[a.relation]) if a.relation in upward else (a.poly, a.relation)
                for a in listed
                if a.relation is not Relation.EQ
            ),
            conj(a for a in ordered if a not in inside),
        )

    def truths(self, where: Conditions) -> Iterator[tuple[Conditions, Formula, Formula]]:
        """Cases of the parameters that cover ``where``, with "some" and "none"."""
        if not self.names:
            yield where, self.outside, neg(self.outside)
            return
        if not self.equations:
            left = exists(self.names, conj(atom(g, r) for g, r in self.conditions))
            yield where, conj([self.outside, left]), disj([neg(self.outside), neg(left)])
            return
        given = [_split(p, where.ring, self.names) for p in self.equations]
        for case in cases(given, len(self.names), where):
            some, none = self._over(case)
            yield case.where, conj([self.outside, some]), disj([neg(self.outside), none])

    def _over(self, case: Case) -> tuple[Formula, Formula]:
        if case.is_unit:
            return FALSE, TRUE
        if case.is_finite:
            return self._counted(case)
        free = {self.names[k] for k in independent([lead for lead, _ in case.basis], case.size)}
        moved = tuple(v for v in self.names if v in free)
        inner = replace(self, names=tuple(v for v in self.names if v not in free), outside=TRUE)
        here = case.where
        ring = Ring.of((*here.ring.names, *moved))
        equal, nonzero = ([p.convert(ring) for p in group] for group in (here.equal, here.nonzero))
        if not inner.names:
            inner = replace(inner, names=moved, equations=())
            return next((some, none) for _, some, none in inner.truths(here))
        some: list[Formula] = []
        none: list[Formula] = []
        for there, has, lacks in inner.truths(Conditions.of(ring, equal, nonzero, here.tick)):
            where = _formula(there, self.ring)
            some.append(conj([where, has]))
            none.append(implies(where, lacks))
        return exists(moved, disj(some)), forall(moved, conj(none))

    def _counted(self, case: Case) -> tuple[Formula, Formula]:
        size = len(case.monomials)
        if size > MOST_SOLUTIONS:
            raise Unable(f"a case has more than {MOST_SOLUTIONS} complex solutions")
        forms = ParametricForms(case)
        hankel = sum(any(e[k] for e in case.monomials) for k in range(case.size)) <= 1
        factors, scale = self._factors(case), prod(_WEIGHTS[relation][0] for _, relation in self.conditions)
        found = [(w, _signatures(forms, h, hankel, square)) for h, (w, square) in factors]
        if prod(len(possible) for _, possible in found) > MOST_COMBINATIONS:
            raise Unable("too many conditions for trace forms")
        some: list[Formula] = []
        none: list[Formula] = []
        for chosen in product(*(possible.items() for _, possible in found)):
            total = sum(w * value for (w, _), (value, _) in zip(found, chosen, strict=True))
            if total >= 0 and total % scale == 0:  # others do not occur
                (some if total else none).append(conj([f for _, f in chosen]))
        return convert(disj(some), self.ring), convert(disj(none), self.ring)

    def _factors(self, case: Case) -> list[tuple[Terms, tuple[int, bool]]]:
        """The products of powers of the conditions, with their weights, and whether all powers are even."""
        found = []
        tables = [_WEIGHTS[relation][1] for _, relation in self.conditions]
        for powers in product(*tables):
            h, weight = self.ring.constant(1), 1
            for (g, _), weights, power in zip(self.conditions, tables, powers, strict=True):
                h, weight = h * g**power, weight * weights[power]
            terms = _split(h, case.where.ring, self.names)
            found.append((terms, (weight, all(power % 2 == 0 for power in powers))))
        return found


def _refined(parts: Sequence[_Conjunction], where: Conditions, ring: Ring) -> Iterator[_Truth]:
    """Cases that suit all conjunctions, with "some" and "none" for their disjunction."""
    if not parts:
        yield _Truth(_formula(where, ring), FALSE, TRUE)
        return
    for here, some, none in parts[0].truths(where):
        for rest in _refined(parts[1:], here, ring):
            yield _Truth(rest.where, disj([some, rest.some]), conj([none, rest.none]))


def _formula(where: Conditions, ring: Ring) -> Formula:
    found = [atom(p, Relation.EQ) for p in where.equal] + [atom(p, Relation.NE) for p in where.nonzero]
    return convert(conj(found), ring)


def _signatures(forms: ParametricForms, h: Terms, hankel: bool, square: bool) -> Signatures:
    matrix = forms.matrix(h)
    return signatures(forms.minors(matrix), lambda: forms.coefficients(matrix)[1:], hankel=hankel, square=square)


def _split(p: Poly, ring: Ring, names: Sequence[str]) -> Terms:
    """A polynomial by its monomials in some variables; coefficients over the ring of the others."""
    whole = p.convert(Ring.of((*ring.names, *names)))
    found: dict[Exponents, dict[Exponents, int]] = {}
    for e, c in whole.terms():
        found.setdefault(tuple(e[ring.size :]), {})[tuple(e[: ring.size])] = c
    return {e: ring.from_terms(part) for e, part in found.items()}


def independent(leads: Sequence[Exponents], size: int) -> tuple[int, ...]:
    """Variables of which no leading monomial is made: as many as there are, the first such set."""
    for width in range(size, 0, -1):
        for chosen in combinations(range(size), width):
            if not any(all(k in chosen for k, power in enumerate(lead) if power) for lead in leads):
                return chosen
    return ()
