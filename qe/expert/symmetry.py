"""Rule "homogeneous scaling": a block that looks the same from many points.

THEOREM. Let w be weights, 0 outside the bound variables, with p(t^w v) = t^d p(v) for every p. Then f has the same
truth at v and t^w v for all t > 0, so where w_x /= 0:  ex x, y f iff ex y f[1] or ex y f[0] or ex y f[-1]; a value may
be left out if f implies that x has not its sign. Bound are the variables of the block and of quantifiers inside, which
range over R before and after a scaling; x is one of the block, and no name is bound twice on the way down or both free
and bound. (With whole weights in terms of that of x it is made of the kernel's steps, see ``qe.proving.elaborators``.)

Evidence: ``variable``, ``weights`` ([[name, rational], ...]), ``values`` (those put in) and ``theory``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from fractions import Fraction

from qe.exact.ring import Poly
from qe.formula.build import atom, disj, exists
from qe.formula.syntax import Exists, ForAll, Formula, Relation
from qe.formula.traverse import atoms, conjuncts, subformulas
from qe.kernel.boolean import ByLemmas, Goal
from qe.kernel.step import Claim, Context, Limits, only, outside
from qe.kernel.substitution import at_number
from qe.proof.entry import Entry

_SIGN = {1: Relation.GT, 0: Relation.EQ, -1: Relation.LT}


def scaling_goals(claim: Claim, context: Context) -> list[Goal]:
    """The polynomials are homogeneous, and numbers are put in; the values left out are to be impossible."""
    variable, weights, values, _ = only(claim, "variable", "weights", "values", "theory")
    block, x, vector = _moved(variable, weights, claim)
    for poly in _polynomials(block.body):
        degrees = {sum((w * exponents[i] for i, w in vector.items()), Fraction(0)) for exponents, _ in poly.terms()}
        if len(degrees) > 1:
            raise weights.fail("a polynomial is not homogeneous for these weights")
    ring, kept = claim.ring, [e.integer(-1) for e in values.items()]
    if kept != [s for s in (1, 0, -1) if s in kept]:
        raise values.fail("expected some of 1, 0, -1, in this order")
    known = outside(context, block.variables)
    rest = [v for v in block.variables if v != ring.names[x]]
    if claim.after != disj(exists(rest, at_number(block.body, x, Fraction(s), claim)) for s in kept):
        raise claim.fail("not the block with these values for the variable")
    excluded = [relation for sign, relation in _SIGN.items() if sign not in kept]
    return [(*known, *conjuncts(block.body), atom(ring.gen(x), relation)) for relation in excluded]


check_scaling = ByLemmas(scaling_goals)


def _moved(variable: Entry, weights: Entry, claim: Claim) -> tuple[Exists, int, dict[int, Fraction]]:
    """The block, the variable for which a number is put in, and the weights."""
    block, name, x = claim.variable(variable)
    inner = [v for f in subformulas(block.body) if isinstance(f, Exists | ForAll) for v in f.variables]
    bound = {*block.variables, *inner}
    if set(inner) & set(block.variables) or bound & set(block.free) or set(inner) & set(block.body.free):
        raise claim.fail("a name is bound twice, or free and bound")
    vector = read_vector(weights, bound, claim)
    if not vector.get(x):
        raise weights.fail(f"{name} does not move")
    return block, x, vector


def read_vector(weights: Entry, names: Set[str], claim: Claim) -> dict[int, Fraction]:
    """The numbers of a vector by variable, these variables alone; ``CertificateRejected`` for anything else."""
    vector: dict[int, Fraction] = {}
    for entry in weights.items():
        variable, number = entry.row("variable that may move", "rational number")
        if variable.text() not in names or claim.ring.index[variable.text()] in vector:
            raise entry.fail("expected variables that may move, each once")
        vector[claim.ring.index[variable.text()]] = number.rational()
    return vector


def check_constant_on(polys: Iterable[Poly], vector: Mapping[int, Fraction], entry: Entry, limits: Limits) -> None:
    """``CertificateRejected`` where a polynomial is not constant along the vector."""
    for poly in polys:
        limits.tick()
        total: dict[tuple[int, ...], Fraction] = {}
        for i, w in vector.items():
            for exponents, coefficient in poly.derivative(i).terms():
                total[exponents] = total.get(exponents, Fraction(0)) + w * coefficient
        if any(total.values()):
            raise entry.fail("a polynomial is not constant along this direction")


def _polynomials(body: Formula) -> list[Poly]:
    return list(dict.fromkeys(a.poly for a in atoms(body)))
