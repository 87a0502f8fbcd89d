"""Primitive "open": polynomials that vanish nowhere inside an open set. Steps are called "open block", and "inequations
that remove no interior".

THEOREM. A nonempty open set does not lie in the zeros of finitely many polynomials that are not the zero polynomial.
Let every comparison of f that has variables of a block v be <, > or /=, under conjunctions and disjunctions only: its
solutions are an open set T, for all values of the parameters, and so is the set of those v for which ex x f.
(Inequations.) ex v (f and p_1 /= 0 and ...) iff ex v (f and, for each i, some coefficient of p_i in v is not 0).
(Open block.) Let ex x f iff F1 or ... or Fk, and let Fi' be Fi with "p vanishes identically in v" for p = 0, and that
or p < 0 for p <= 0, in and/or combinations. Then ex v, x f iff ex v F1' or ... or ex v Fk'. Proof. Fi' implies Fi. A
point of T outside all Fi' lies on the zeros of a polynomial that does not vanish identically. (Some Fi may be left as
they are.)

Evidence of an open block: ``variable`` x, ``steps`` from ex x F to F1 or ... or Fk, ``pieces`` F1, ..., Fk, and
``parts``: for each the steps from ex v Fi' on. The claim is the disjunction of what they lead to.
"""

from __future__ import annotations

from collections.abc import Collection

from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import And, Atom, Atomic, Constant, Exists, Formula, Or, Relation
from qe.formula.traverse import conjuncts, map_atoms
from qe.kernel.elimination_set import block_of, check_parts
from qe.kernel.step import Claim, Context, Limits, only, outside
from qe.proof.entry import formula_from_json


def check_inequations(claim: Claim, context: Context, limits: Limits) -> None:
    """The conditions on coefficients take the place of the inequations."""
    only(claim)
    block = claim.block()
    if not shows_open(block.body, block.variables):
        raise claim.fail("the solutions need not form an open set")
    if claim.after != exists(block.variables, generic(block)):
        raise claim.fail("not what the theorem gives")


def generic(block: Exists) -> Formula:
    """The body with conditions on coefficients, behind the others, for the inequations with the block's variables."""
    names, parts = set(block.variables), conjuncts(block.body)
    removed = [p for p in parts if isinstance(p, Atom) and p.relation is Relation.NE and names & set(p.free)]
    indices = frozenset(i for p in removed for i in p.poly.variables if p.poly.ring.names[i] in names)
    conditions = [disj(atom(c, Relation.NE) for c in p.poly.coefficients_in(indices)) for p in removed]
    return conj((*(p for p in parts if p not in removed), *conditions))


def check_open_block(claim: Claim, context: Context, limits: Limits) -> None:
    """Accept silently, or raise ``CertificateRejected`` naming the entry that fails."""
    variable, steps, pieces, parts = only(claim, "variable", "steps", "pieces", "parts")
    block, name, _ = claim.variable(variable)
    if not shows_open(block.body, set(block.variables)):
        raise claim.fail("the solutions need not form an open set")
    listed = [formula_from_json(piece, claim.ring, quantified=True) for piece in pieces.items()]
    known = outside(context, block.variables)
    if limits.replay(steps, block_of((name,), block.body, claim.ring), known, claim.ring) != disj(listed):
        raise pieces.fail("not the formulas to which the steps lead")
    rest = [v for v in block.variables if v != name]
    check_parts(claim, [block_of(rest, inside(f, rest), claim.ring) for f in listed], parts, context, limits)


def shows_open(formula: Formula, names: Collection[str]) -> bool:
    """Whether the syntax shows that the solutions in these variables form an open set."""
    if not set(names) & set(formula.free):
        return True
    match formula:
        case Atom(_, relation):
            return relation.is_strict
        case And(args) | Or(args):
            return all(shows_open(a, names) for a in args)
    return False


def inside(formula: Formula, names: Collection[str]) -> Formula:
    """The formula Fi' of the theorem; other than and/or combinations of atoms stay as they are."""
    return map_atoms(formula, lambda found: _inside(found, names)) if _is_plain(formula) else formula


def _is_plain(formula: Formula) -> bool:
    if isinstance(formula, And | Or):
        return all(map(_is_plain, formula.args))
    return isinstance(formula, Atomic | Constant)


def _inside(found: Atomic, names: Collection[str]) -> Formula:
    if not isinstance(found, Atom) or found.relation.is_strict or not set(names) & set(found.free):
        return found
    ring = found.poly.ring
    coefficients = found.poly.collected([ring.index[n] for n in names])
    nothing = conj(atom(c, Relation.EQ) for c in coefficients.values())
    if found.relation is Relation.EQ:
        return nothing
    strict = Relation.LT if found.relation is Relation.LE else Relation.GT
    return disj((Atom(found.poly, strict), nothing))
