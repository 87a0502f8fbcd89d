"""Degree shift (Dolzmann, Sturm & Weispfenning, J. Automated Reasoning 21 (1998), section 3)."""

from __future__ import annotations

from math import gcd

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import atoms, bound_variables, conjuncts
from qe.rules.block_context import BlockContext, Found
from qe.rules.lift import RootOf
from qe.rules.rewrite import rewrite
from qe.rules.step import StepKind
from qe.rules.tree import Lifted, Pending


def shift_degree(variables: tuple[str, ...], body: Formula, context: BlockContext) -> Found | None:
    """Let every exponent of x in f be a multiple of k > 1, f(x) = g(x^k). Then ex x f iff ex x (g and x >= 0) for
    even k, and iff ex x g for odd k, because x^k takes all non-negative (all) real values. Atoms x rel 0 may stay as
    they are for odd k, and for even k if the conjunction says x >= 0: then x and x^k have the same sign.

    Lift: x is the k-th root of its present value.
    """
    if StepKind.DEGREE_SHIFT not in context.enabled:
        return None
    inner = frozenset(bound_variables(body))
    ring = next(atoms(body)).poly.ring
    known = context.facts.extended(conjuncts(body))
    for name in variables:
        nonnegative = -1 not in known.signs(ring.var(name))
        step = 0 if name in inner else common_exponent(body, name, nonnegative)
        if step > 1:
            shifted = rewrite(body, lambda found, n=name, k=step: _shifted(found, n, k), ())  # type: ignore[misc]
            domain = atom(ring.var(name), Relation.GE) if step % 2 == 0 else conj(())
            node = Lifted((RootOf(name, step),), Pending(variables, conj((domain, shifted))))
            return Found(StepKind.DEGREE_SHIFT, f"{name}^{step}", node)
    return None


def common_exponent(body: Formula, name: str, nonnegative: bool = False) -> int:
    """The exponent k > 1 that can be shifted away, or a number below 2.

    It is the greatest common divisor of the exponents of the variable, leaving out atoms that compare the variable
    itself with 0; where those occur and the variable may be negative, its odd part. No root atom may contain it.
    """
    step, bare = 0, False
    for found in atoms(body):
        ring = found.poly.ring
        index = ring.index[name]
        degree = found.poly.degree(index)
        if isinstance(found, RootAtom) and (degree or found.variable == name):
            return 1
        if _is_bare(found, index):
            bare = True
        elif degree:
            for exponent, coefficient in enumerate(found.poly.coefficients(index)):
                if coefficient:
                    step = gcd(step, exponent)
        if step == 1:
            break
    while bare and not nonnegative and step and step % 2 == 0:
        step //= 2
    return step


def _is_bare(found: Atom | RootAtom, index: int) -> bool:
    return found.poly.total_degree == 1 and found.poly.term_count() == 1 and found.poly.degree(index) == 1


def _shifted(found: Atom, name: str, step: int) -> Formula:
    poly = found.poly
    index = poly.ring.index[name]
    if not poly.degree(index) or _is_bare(found, index):
        return found
    variable = poly.ring.gen(index)
    image: Poly = poly.ring.constant(0)
    for exponent, coefficient in enumerate(poly.coefficients(index)):
        if coefficient:
            image = image + coefficient * variable ** (exponent // step)
    return atom(image, found.relation)
