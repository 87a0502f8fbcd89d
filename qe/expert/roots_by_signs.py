"""Rule "roots by signs": a block about one polynomial in one variable, by the signs of Hermite's forms.

THEOREM. Let f have degree n in y, with leading coefficient a /= 0. Where its roots lie, their multiplicities and the
sign of a decide whether f rel 0 for some y (on the line; for y > 0; or f = 0 and g rel 0); and they constrain the signs
of minors and coefficients (``arithmetic.root_patterns``). So a formula in these that has the right truth on all rows of
signs that some pattern of roots allows is the answer where a /= 0. Rows that occur nowhere may be among them.
On an interval y stands for the x with x = (l + u*y)/(1 + y), or l + y, or u - y: it runs through the inner points as y
does through y > 0, y = 0 gives l (u where there is no l), and the sign of the coefficient of y^n is that of f at u.

Evidence: none. What stands after is, with the condition that the interval is not empty, a formula that the rows make
right where a /= 0, and that for a = 0 becomes the question for f without its first term (or true, where a = 0 is the
value at a closed end and is as asked).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from qe.errors import Unable
from qe.exact.ring import Poly
from qe.expert.arithmetic.root_patterns import Pattern, charts, descartes, forms, leading_minors, patterns
from qe.formula.build import atom, conj, exists
from qe.formula.syntax import FALSE, TRUE, And, Atom, Constant, Exists, Formula, Or, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.block import existential
from qe.kernel.renaming import shape
from qe.kernel.step import Claim, Context, Limits, only
from qe.kernel.substitution import mapped, quotient

EQ, GT, GE = Relation.EQ, Relation.GT, Relation.GE
WEAK = (Relation.LE, Relation.GE)
MOST_DEGREE, MOST_ROWS = 6, 400_000


@dataclass(frozen=True, slots=True)
class _Asked:
    """Whether f relation 0 for some y, y > 0 where ``ends`` says whether 0 and oo take part, or under ``condition``."""

    f: tuple[Poly, ...]
    relation: Relation
    ends: tuple[bool, bool] | None = None
    condition: Atom | None = None
    side: Formula = TRUE

    def truth(self, lead: int, found: Pattern) -> bool:
        """By the signs that f takes, where its leading coefficient has the sign ``lead``."""
        if self.condition is not None:
            places = {1: found.above, 0: found.on, -1: found.below}
            return any(places[s] for s in self.condition.relation.signs)
        if self.ends is None:
            return any(map(self.relation.holds, charts(lead, found.real)))
        signs = list(charts(lead, found.above))
        if self.ends[0]:
            signs.append(0 if found.on else signs[-1])
        return any(map(self.relation.holds, signs))

    def lower(self, x: int) -> Formula:
        """The question where the leading coefficient is 0."""
        if self.ends is not None and self.ends[1] and self.relation.holds(0):
            return TRUE
        ring = self.f[0].ring
        y = ring.gen(x)
        rest = sum((c * y**k for k, c in enumerate(self.f[:-1])), start=ring.constant(0))
        body: list[Formula] = [atom(rest, self.relation)]
        if self.ends is not None:
            body.append(atom(y, GE if self.ends[0] else GT))
        if self.condition is not None:
            body.append(self.condition)
        return exists([ring.names[x]], conj(body))


def check_roots_by_signs(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected``. Raises ``Unable`` past the limits."""
    only(claim)
    before, after = existential(claim)
    if not isinstance(before, Exists) or len(before.variables) != 1 or not before.body.is_quantifier_free:
        raise claim.fail("a block of one variable over a formula without quantifiers expected")
    x = claim.ring.index[before.variables[0]]
    asked = _read(before.body, x, claim)
    core = _beside(asked.side, after, claim)
    _check_lower(core, asked, x, claim)
    literals = _literals(asked, core, x, claim)
    truths: dict[tuple[int, ...], set[bool]] = {}
    for signs, truth in _rows(asked, literals, x, limits):
        truths.setdefault(signs, set()).add(truth)
    known = {p: (place, turn) for place, (_, p, turn) in enumerate(literals.used)}
    for signs, found in truths.items():
        if any(found != {_holds(core, known, signs, left)} for left in (False, True)):
            raise claim.fail("signs that roots may give are decided wrongly")


# --- what is asked ---------------------------------------------------------------------------------
def _read(body: Formula, x: int, claim: Claim) -> _Asked:
    parts = [p for p in conjuncts(body) if isinstance(p, Atom) and p.poly.degree(x)]
    if len(parts) < len(conjuncts(body)):
        raise claim.fail("comparisons of polynomials with the variable expected")
    ends = [a for a in parts if a.poly.degree(x) == 1 and a.poly.derivative(x).is_constant and _is_bound(a)]
    others = [a for a in parts if a not in ends]
    equations = [a for a in others if a.relation is EQ]
    if any(a.poly.degree(x) > MOST_DEGREE for a in others):
        raise Unable("a polynomial of a degree that is out of reach")
    if len(others) == 2 and len(equations) == 1 and not ends:
        (condition,) = (a for a in others if a not in equations)
        return _Asked(equations[0].poly.coefficients(x), EQ, condition=condition)
    if len(others) != 1 or others[0].relation is Relation.NE:
        raise claim.fail("one polynomial, with an interval or a condition, expected")
    if not ends:
        return _Asked(others[0].poly.coefficients(x), others[0].relation)
    return _moved(others[0], ends, x, claim)


def _is_bound(found: Atom) -> bool:
    return found.relation not in (EQ, Relation.NE)


def _moved(found: Atom, ends: Sequence[Atom], x: int, claim: Claim) -> _Asked:
    """On the positive half-line."""
    y, one = claim.ring.gen(x), claim.ring.constant(1)
    places: dict[bool, tuple[Poly, int, bool]] = {}
    for end in ends:
        slope = end.poly.derivative(x).constant_value()
        rest = end.poly - y * slope
        is_low = (1 if end.relation in (GT, GE) else -1) * slope > 0
        if is_low in places:
            raise claim.fail("one end on each side expected")
        places[is_low] = (-rest if slope > 0 else rest), abs(slope), end.relation in WEAK
    if len(places) == 1:
        is_low, (top, bottom, closed) = next(iter(places.items()))
        step = y * (bottom if is_low else -bottom)
        f = quotient(found.poly, x, top + step, one * bottom)
        return _Asked(f.coefficients(x), found.relation, (closed, False))
    (low, k, closed), (high, m, closed_high) = places[True], places[False]
    f = quotient(found.poly, x, low * m + high * k * y, (one + y) * (k * m))
    if f.degree(x) < found.poly.degree(x):
        raise claim.fail("the polynomial vanishes at an end of the interval, whatever the parameters are")
    side = atom(high * k - low * m, GE if closed and closed_high else GT)
    return _Asked(f.coefficients(x), found.relation, (closed, closed_high), None, side)


def _beside(side: Formula, after: Formula, claim: Claim) -> Formula:
    """What stands after, without the condition that the interval is not empty."""
    if side == TRUE or after == FALSE:
        return after
    parts = conjuncts(after)
    if side not in parts:
        raise claim.fail("nothing says that the interval is not empty")
    return conj(p for p in parts if p != side)


# --- a leading coefficient 0 ---------------------------------------------------------------------------
def _check_lower(core: Formula, asked: _Asked, x: int, claim: Claim) -> None:
    """For a leading coefficient 0 the question of lower degree is left."""
    lead = asked.f[-1]
    if lead.is_constant:
        return
    zero, wanted = lead.normal()[1], asked.lower(x)

    def change(found: Atom) -> Formula:
        return (TRUE if found.relation.holds(0) else FALSE) if found.poly == zero else found

    if shape(mapped(core, change, (lead,), claim)) != shape(wanted):
        raise claim.fail("not the question of lower degree where the leading coefficient is 0")


# --- rows of signs -------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class _Literals:
    """``groups``: the names of the groups whose signs make a row. ``used``: places of the polynomials that the formula
    names, normalised, with the sign of their factors. ``tied``: (k, j, t): the sign at k is t times that at j, or t for
    j < 0.
    """

    groups: tuple[str, ...]
    used: tuple[tuple[int, Poly, int], ...]
    tied: tuple[tuple[int, int, int], ...]


def _literals(asked: _Asked, core: Formula, x: int, claim: Claim) -> _Literals:
    """The polynomials whose signs are spoken of: coefficients, minors, I."""
    f, one, named = asked.f, claim.ring.constant(1), _names(core)
    n = len(f) - 1
    groups: dict[str, list[Poly]] = {"c": list(f) if asked.ends else [f[-1]], "P": leading_minors(f, [one])}
    if asked.ends is not None:
        groups["A"] = leading_minors(f, [one - one, one])
    if asked.condition is not None:
        g = asked.condition.poly
        groups["A"] = leading_minors(f, g.coefficients(x))
        if not named <= {p.normal()[1] for part in groups.values() for p in part}:
            groups["Q"] = leading_minors(f, (g * g).coefficients(x))
    if n == 4:
        groups["I"] = [12 * (f[4] * f[0]) - 3 * (f[3] * f[1]) + f[2] * f[2]]
    first: dict[Poly, tuple[int, int]] = {}
    tied: list[tuple[int, int, int]] = []
    for k, p in enumerate(p for group in groups.values() for p in group):
        unit, normal = p.normal()
        turn = (unit > 0) - (unit < 0)
        if p.is_constant:
            tied.append((k, -1, turn))
        elif normal in first:
            tied.append((k, first[normal][0], turn * first[normal][1]))
        else:
            first[normal] = k, turn
    if not named <= set(first):
        raise claim.fail("a polynomial that is no coefficient, minor or invariant")
    used = tuple((first[p][0], p, first[p][1]) for p in sorted(named, key=str))
    return _Literals(tuple(groups), used, tuple(tied))


def _names(core: Formula) -> set[Poly]:
    """The polynomials in atoms outside of quantifiers."""
    match core:
        case Atom(poly, _):
            return {poly}
        case And(args) | Or(args):
            return set[Poly]().union(*map(_names, args))
    return set()


def _rows(asked: _Asked, literals: _Literals, x: int, limits: Limits) -> Iterator[tuple[tuple[int, ...], bool]]:
    """The signs of the polynomials that are used, on every row that a pattern allows, with its truth."""
    n, count = len(asked.f) - 1, 0
    for found in patterns(n):
        if not _fits(asked, found):
            continue
        limits.tick()
        for lead in (-1, 1):
            truth = asked.truth(lead, found)
            for parts in product(*(_signs(asked, name, found, lead, x) for name in literals.groups)):
                count += 1
                if count > MOST_ROWS:
                    raise Unable("too many rows of signs")
                row = sum(parts, ())
                if all(row[k] == (t if j < 0 else t * row[j]) for k, j, t in literals.tied):
                    yield tuple(row[k] for k, _, _ in literals.used), truth


def _fits(asked: _Asked, found: Pattern) -> bool:
    """Whether a pattern is one of the place: without g nothing is told apart, and x is 0 at one root only."""
    if asked.condition is not None:
        return True
    if found.zero_pairs:
        return False
    return len(found.on) <= 1 if asked.ends is not None else not found.on and not found.below


def _signs(asked: _Asked, name: str, found: Pattern, lead: int, x: int) -> Sequence[tuple[int, ...]]:
    """What a group of polynomials may have for signs."""
    n, real = len(asked.f) - 1, len(found.real)
    signature = len(found.above) - len(found.below)
    match name:
        case "c" if asked.ends is None:
            return [(lead,)]
        case "c":
            rows = ((*signs, lead) for signs in product((-1, 0, 1), repeat=n))
            return [row for row in rows if descartes(row, found)]
        case "P":
            return [row for row in forms(n).get((found.distinct, real), []) if row[0] == 1]  # the first one is n
        case "A":
            odd = asked.condition is None or asked.condition.poly.degree(x) % 2
            turned = lead if odd else 1
            return [tuple(turned * s for s in row) for row in forms(n).get((found.rank, signature), [])]
        case "Q":
            return forms(n).get((found.rank, len(found.above) + len(found.below)), [])
    return [(s,) for s in found.quartic_invariant()]


def _holds(core: Formula, known: Mapping[Poly, tuple[int, int]], signs: tuple[int, ...], left: bool) -> bool:
    """The truth for these signs, where what is left quantified is ``left``."""
    match core:
        case Constant(value):
            return value
        case Atom(poly, relation):
            place, turn = known[poly]
            return relation.holds(turn * signs[place])
        case And(args):
            return all(_holds(a, known, signs, left) for a in args)
        case Or(args):
            return any(_holds(a, known, signs, left) for a in args)
    return left
