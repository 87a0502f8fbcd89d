"""All real solutions of a polynomial system with finitely many complex ones, exactly."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qe.errors import InputError, Unable
from qe.exact.algebraic import RealAlgebraic, select_root
from qe.exact.groebner import Basis, Limits, groebner_basis
from qe.exact.quotient import Quotient
from qe.exact.ring import Poly
from qe.exact.univariate import from_univariate
from qe.exact.zeros import Zero

LIMITS = Limits(elements=600, terms=4000, bits=40_000, modular=True)

_WEIGHTS = (1009, 1013, 1019, 1021, 1031, 1033, 1039, 1049, 1051, 1061, 1063, 1069)
"""Nearly equal weights for variables above constants: sorted by degree, and no ties that the constants would break."""


def solve_system(
    equations: Sequence[Poly],
    *,
    variables: Sequence[int] = (),
    constants: Mapping[int, RealAlgebraic] | None = None,
    limits: Limits = LIMITS,
) -> list[Zero]:
    """All real solutions, each with its multiplicity: exact numbers for the variables (and constants) by name.

    ``variables``: what is to be found beside the variables that occur. ``constants``: variables of the ring that stand
    for real algebraic numbers; they join the system by their minimal polynomials, and of the zeros over all
    conjugates those at the given numbers remain. The number of zeros (over all conjugates) is found twice, by
    isolation and as a signature of the trace form. Raises ``PositiveDimensional`` where infinitely many complex
    solutions exist, ``Unable`` at a limit, ``InputError`` without equations.
    """
    basis = system_basis(equations, variables=variables, constants=constants, limits=limits)
    return solutions(basis, constants=constants)


def system_basis(
    equations: Sequence[Poly],
    *,
    variables: Sequence[int] = (),
    constants: Mapping[int, RealAlgebraic] | None = None,
    limits: Limits = LIMITS,
) -> Basis:
    """A Groebner basis of the system with the minimal polynomials of its constants; see ``solve_system``."""
    fixed = dict(constants or {})
    if not any(equations):
        raise InputError("equations: at least one equation other than 0 = 0 expected")
    ring = equations[0].ring
    free = sorted({*variables, *(i for p in equations for i in p.variables)} - fixed.keys(), reverse=True)
    used = [i for i in fixed if any(i in p.variables for p in equations)]
    moduli = [from_univariate(ring, i, fixed[i].poly) for i in used]
    weights = [_WEIGHTS[k % len(_WEIGHTS)] for k in range(len(free))] + [1] * len(used) if used else []
    basis = groebner_basis([*equations, *moduli], variables=[*free, *used], weights=weights, limits=limits)
    if basis is None:
        raise Unable("the Gröbner basis of the system grows past its limits")
    return basis


def solutions(basis: Basis, *, constants: Mapping[int, RealAlgebraic] | None = None) -> list[Zero]:
    """The real zeros of a basis at which every constant has its own value."""
    names = basis.ring.names
    given = {names[i]: value for i, value in (constants or {}).items()}
    zeros = Quotient(basis).zeros()
    asked = [(z, [(z.values[name], value) for name, value in given.items() if name in z.values]) for z in zeros]
    return [z for z, pairs in asked if all(select_root(v.poly, x.ball).index == v.index for x, v in pairs)]
