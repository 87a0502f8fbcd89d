"""Rule "classification": parameter space by the number of real solutions.

Evidence: ``variables``, ``parameters``, ``constants`` ([name, minimal polynomial, low, high]: a parameter that is its
only root in between), ``polynomials``, ``positive``, ``equal`` and ``nonzero`` (polynomials in the parameters),
``classes`` ([count or null, condition]) and ``proofs``.

It says: for all real values of the parameters at which ``equal`` vanish and nothing of ``nonzero`` does, the system
polynomials = 0 has exactly ``count`` different real solutions with all of ``positive`` positive iff the condition
holds, and infinitely many complex solutions iff that of ``null`` does; no other count occurs.

THEOREM. The checker divides parameter space into cases with a Gröbner basis each (``arithmetic.parametric``). Over a
case with finitely many complex solutions the count is a combination of signatures of Hermite's trace forms (Ben-Or,
Kozen, Reif 1986), and a signature is read off the signs of the coefficients of the characteristic polynomial: all its
roots are real, so by Descartes' rule it is the number of sign variations minus that of the polynomial with x replaced
by -x. So every case is one sentence about the parameters; ``proofs`` are derivations of these, in the same order.
First-order logic has no word for infinitely many complex solutions: the sentence is about the other parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from itertools import product as choices

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.expert.arithmetic.ideal import product
from qe.expert.arithmetic.parametric import Case, Conditions, Terms, cases
from qe.expert.arithmetic.parametric_forms import ParametricForms
from qe.expert.sentences import Sentence, renamed
from qe.formula.build import atom, conj, convert, disj, exists, forall, iff, implies, neg
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.kernel.arithmetic.sturm import count_roots_between
from qe.kernel.nested import is_true
from qe.kernel.step import Limits
from qe.proof.entry import Entry, formula_from_json

MOST_SOLUTIONS, MOST_POSITIVE = 8, 2
"""Complex solutions of a case, and conditions, of which formulas are made."""

Classes = Sequence[tuple[int | None, Formula]]


@dataclass(frozen=True)
class Question:
    """A parametric system. ``ring``: of the parameters, constants first. ``constants``: conditions that single them
    out. ``polys`` and ``positive`` have coefficients in ``ring``; ``size``: how many variables."""

    ring: Ring
    constants: tuple[Formula, ...]
    polys: tuple[Terms, ...]
    positive: tuple[Terms, ...]
    equal: tuple[Poly, ...]
    nonzero: tuple[Poly, ...]
    size: int

    def sentences(self, classes: Classes, tick: Callable[[], None]) -> Iterator[Formula]:
        """One for each case: they hold iff the classes are right. Raises ``Unable`` beyond the limits."""
        where = Conditions.of(self.ring, self.equal, self.nonzero, tick)
        for case in cases(self.polys, self.size, where):
            here = [*self.constants]
            here += [atom(p, Relation.EQ) for p in case.where.equal]
            here += [atom(p, Relation.NE) for p in case.where.nonzero]
            counts = _counts(case, self.positive)
            claims = [iff(condition, counts.pop(count, FALSE)) for count, condition in classes]
            yield forall(self.ring.names, implies(conj(here), conj([*claims, *map(neg, counts.values())])))


def check_classification(evidence: Entry, limits: Limits) -> Sentence:
    """What the evidence proves; or raise ``CertificateRejected`` naming the entry that fails. Raises ``Unable``."""
    question, classes, proofs = read_question(evidence)
    listed = iter(list(proofs.items()))
    for case in question.sentences(classes, limits.tick):
        if case == TRUE:
            continue
        entry = next(listed, None)
        if entry is None:
            raise proofs.fail("a case is left without a proof")
        if not is_true(case, entry, limits):
            raise entry.fail("not a proof of the sentence of this case")
    if (entry := next(listed, None)) is not None:
        raise entry.fail("there are not so many cases")
    return sentence(evidence)


def sentence(evidence: Entry) -> Sentence:
    """That ``count`` is the number of solutions iff it is that of the class whose condition holds, where those on the
    parameters do: "exactly k" is "k different ones, and no k + 1"."""
    names, _, _, *groups, _, _ = evidence.fields(*_MEMBERS)
    question, classes, _ = read_question(evidence)
    most = max((count for count, _ in classes if count is not None), default=0)
    variables, own = names.names(), question.ring.names
    count, *copies = renamed(("count", *(v for _ in range(most + 1) for v in variables)), own)
    ring = Ring.of((*own, count, *copies))
    points = [tuple(copies[k : k + len(variables)]) for k in range(0, len(copies), len(variables))]
    given = [*question.constants, *(atom(p, Relation.EQ) for p in question.equal)]
    given += [atom(p, Relation.NE) for p in question.nonzero]
    given += [neg(condition) for number, condition in classes if number is None]
    where = convert(conj(given), ring)

    def solutions(k: int) -> Formula:
        """That there are k different ones."""
        pairs = (zip(*pair, strict=True) for pair in combinations(points[:k], 2))
        parts = [disj(atom(ring.var(x) - ring.var(y), Relation.NE) for x, y in pair) for pair in pairs]
        for point in points[:k]:
            place = Ring.of((*own, *point))
            for group, relation in zip(groups[:2], (Relation.EQ, Relation.GT), strict=True):
                read = (entry.polynomial(Ring.of((*own, *variables))) for entry in group.items())
                parts += [atom(place.from_terms(dict(p.terms())).convert(ring), relation) for p in read]
        return exists([v for point in points[:k] for v in point], conj(parts))

    def is_number(k: int) -> Formula:
        return atom(ring.var(count) - k, Relation.EQ)

    exactly = [conj((is_number(k), solutions(k), neg(solutions(k + 1)))) for k in range(most + 1)]
    before = disj((*exactly, conj((is_number(most + 1), solutions(most + 1)))))
    after = disj(conj((is_number(k), convert(f, ring))) for k, f in classes if k is not None)
    return conj((where, before)), conj((where, after))


_MEMBERS = ("variables", "parameters", "constants", "polynomials", "positive", "equal", "nonzero", "classes", "proofs")


def read_question(payload: Entry) -> tuple[Question, Classes, Entry]:
    """What is claimed, and the entry with the proofs. Raises ``CertificateRejected`` for malformed entries."""
    variables_entry, parameters_entry, constants_entry, *lists, classes_entry, proofs = payload.fields(*_MEMBERS)
    variables, parameters = (entry.names() for entry in (variables_entry, parameters_entry))
    fixed = [list(e.items()) for e in constants_entry.items()]
    if any(len(parts) != 4 for parts in fixed):
        raise constants_entry.fail("expected [name, minimal polynomial, low, high]")
    names = [*(parts[0].text() for parts in fixed), *parameters]
    if not variables or len({*variables, *names}) < len(variables) + len(names):
        raise variables_entry.fail("expected different variables, at least one, and no parameter among them")
    ring, whole = Ring.of(names), Ring.of((*names, *variables))
    polys, positive, equal, nonzero = (
        [e.polynomial(whole if k < 2 else ring) for e in entry.items()] for k, entry in enumerate(lists)
    )
    constants, minimal = [], []
    for parts in fixed:
        formulas, poly = _constant(parts, ring)
        constants += formulas
        minimal.append(poly)
    found: list[tuple[int | None, Formula]] = []
    for entry in classes_entry.items():
        number, condition = entry.row("count or null", "condition")
        count = None if number.value is None else number.integer()
        if count in [known for known, _ in found]:
            raise entry.fail("a count is listed twice")
        found.append((count, formula_from_json(condition, ring)))
    split = [tuple(_split(p, ring, len(variables)) for p in group) for group in (polys, positive)]
    question = Question(ring, tuple(constants), split[0], split[1], (*minimal, *equal), tuple(nonzero), len(variables))
    return question, tuple(found), proofs


def _constant(parts: list[Entry], ring: Ring) -> tuple[list[Formula], Poly]:
    """Formulas that hold for one number only, and its polynomial."""
    name, poly, low, high = parts[0].text(), parts[1], parts[2].rational(), parts[3].rational()
    p = poly.polynomial(ring)
    i = ring.index[name]
    if p.variables != (i,):
        raise poly.fail("expected a polynomial in the constant")
    x = ring.gen(i)
    ends = (low.denominator * x - low.numerator, high.numerator - high.denominator * x)
    at_ends = [not p.at_rational(i, end) for end in (low, high)]
    is_single = at_ends == [True, True] if low == high else low < high and at_ends == [False, False]
    if not is_single or (low < high and count_roots_between(p.to_univariate(i), low, high) != 1):
        raise poly.fail("expected one root in the interval")
    return [atom(p, Relation.EQ), *(atom(end, Relation.GE) for end in ends)], p


def _split(p: Poly, ring: Ring, size: int) -> Terms:
    """A polynomial by its monomials in the variables, which stand last in its ring."""
    found: dict[tuple[int, ...], dict[tuple[int, ...], int]] = {}
    for e, c in p.terms():
        found.setdefault(tuple(e[ring.size :]), {})[tuple(e[: ring.size])] = c
    assert all(len(e) == size for e in found), "the variables stand last"
    return {e: ring.from_terms(part) for e, part in found.items()}


# --- numbers of solutions ----------------------------------------------------------------------------------------


def _counts(case: Case, positive: Sequence[Terms]) -> dict[int | None, Formula]:
    """For every number of solutions when a case has it; None for infinitely many complex ones."""
    if not case.is_finite:
        return {None: TRUE}
    size = len(case.monomials)
    if size > MOST_SOLUTIONS or len(positive) > MOST_POSITIVE:
        raise Unable(
            f"a case has more than {MOST_SOLUTIONS} complex solutions, or more than {MOST_POSITIVE} conditions"
        )
    if not size:
        return {0: TRUE}
    forms = ParametricForms(case)
    products: list[Terms] = [{(0,) * case.size: case.where.ring.constant(1)}]
    for g in positive:  # (s + s^2)/2 is 1 for a positive sign s, and 0 for the others
        products = [p for q in products for p in (product(q, g), product(product(q, g), g))]
    rows = [forms.coefficients(forms.matrix(h)) if h else None for h in products]
    signatures = [_signatures(row, size) if row is not None else {0: TRUE} for row in rows]
    scale = 1 << len(positive)
    parts: dict[int, list[Formula]] = {k: [] for k in range(size + 1)}
    for chosen in choices(*(s.items() for s in signatures)):
        total, rest = divmod(sum(value for value, _ in chosen), scale)
        if not rest and 0 <= total <= size:  # no other combination occurs
            parts[total].append(conj([condition for _, condition in chosen]))
    return {k: disj(group) for k, group in parts.items()}


def _signatures(coefficients: Sequence[Poly], size: int) -> dict[int, Formula]:
    """For every signature of a symmetric matrix when it has it, by the characteristic polynomial."""

    @cache
    def following(k: int, last: int, mirrored: int, so_far: int) -> dict[int, Formula]:
        """``last`` and ``mirrored``: the last signs other than 0, of the polynomial and of that with -x."""
        if k > size:
            return {so_far: TRUE}
        found: dict[int, list[Formula]] = {}
        for sign, relation in ((1, Relation.GT), (0, Relation.EQ), (-1, Relation.LT)):
            condition = atom(coefficients[k], relation)
            if condition == FALSE:
                continue
            turned = sign if k % 2 == 0 else -sign
            after = so_far + ((sign != last) - (turned != mirrored) if sign else 0)
            for value, f in following(k + 1, sign or last, turned or mirrored, after).items():
                found.setdefault(value, []).append(conj([condition, f]))
        return {value: disj(group) for value, group in found.items()}

    return following(1, 1, 1, 0)
