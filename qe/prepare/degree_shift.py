"""Degree shift (Dolzmann, Sturm & Weispfenning, J. Automated Reasoning 21 (1998), section 3)."""

from __future__ import annotations

from math import gcd

from qe.exact.ring import Poly
from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation, RootAtom
from qe.formula.traverse import atoms
from qe.prepare.lift import RootOf
from qe.prepare.rewrite import bound_names, rewrite
from qe.prepare.step import StepKind
from qe.prepare.tree import Lifted, Node
from qe.prepare.workshop import Recur, Workshop


def shift_degree(variables: tuple[str, ...], body: Formula, shop: Workshop, recur: Recur) -> Node | None:
    """Let every exponent of x in f be a multiple of k > 1, f(x) = g(x^k). Then ex x f iff ex x (g and x >= 0) for
    even k, and iff ex x g for odd k, because x^k takes all non-negative (all) real values.

    Lift: x is the k-th root of its present value.
    """
    if StepKind.DEGREE_SHIFT not in shop.enabled:
        return None
    inner = bound_names(body)
    for name in variables:
        step = 0 if name in inner else common_exponent(body, name)
        if step > 1:
            shop.note(StepKind.DEGREE_SHIFT, f"{name}^{step}")
            shifted = rewrite(body, lambda found, n=name, k=step: _shifted(found, n, k), ())  # type: ignore[misc]
            variable = next(atoms(body)).poly.ring.var(name)
            domain = atom(variable, Relation.GE) if step % 2 == 0 else conj(())
            return Lifted(RootOf(name, step), recur(variables, conj((domain, shifted)), shop))
    return None


def common_exponent(body: Formula, name: str) -> int:
    """The greatest common divisor of the exponents of a variable; 1 where it stands in a root atom."""
    step = 0
    for found in atoms(body):
        ring = found.poly.ring
        index = ring.index[name]
        degree = found.poly.degree(index)
        if isinstance(found, RootAtom) and (degree or found.variable == name):
            return 1
        if degree:
            for exponent, coefficient in enumerate(found.poly.coefficients(index)):
                if coefficient:
                    step = gcd(step, exponent)
        if step == 1:
            break
    return step


def _shifted(found: Atom, name: str, step: int) -> Formula:
    poly = found.poly
    index = poly.ring.index[name]
    if not poly.degree(index):
        return found
    variable = poly.ring.gen(index)
    image: Poly = poly.ring.constant(0)
    for exponent, coefficient in enumerate(poly.coefficients(index)):
        if coefficient:
            image = image + coefficient * variable ** (exponent // step)
    return atom(image, found.relation)
