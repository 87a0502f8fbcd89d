"""How far convex constraints are from being satisfied together: violation forms, and proposals from floats for both
outcomes. Nothing proposed is believed; the callers check it exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from qe.convex.interior_point import Proposal, interior_point
from qe.exact.quadratic_form import Quadratic, combine

_ZERO, _ONE = Fraction(0), Fraction(1)
_TRUSTED = 1e-3
"""A proposal of a larger residual is not rounded: that would only fail, exactly."""
_DENOMINATORS = (10, 10**3, 10**6)
_WITNESS_DENOMINATORS = (1, 4, 16, 10**2, 10**4, 10**7)


def violation_form(form: Quadratic) -> tuple[Quadratic, Fraction]:
    """(scale * form - t with t a further, last coordinate; scale > 0 rational, one over the largest coefficient).

    Quadratic coefficients decide where there are any, so that balls stay balls of one kind and the least violation
    of balls is a rational problem.
    """
    size = form.size
    largest = max((abs(h) for row in form.hessian for h in row), default=_ZERO)
    scale = 1 / (largest or max((abs(b) for b in form.gradient), default=_ZERO) or _ONE)
    hessian = (*((*(h * scale for h in row), _ZERO) for row in form.hessian), (_ZERO,) * (size + 1))
    return Quadratic(hessian, (*(b * scale for b in form.gradient), -_ONE), form.constant * scale), scale


def violation_forms(forms: Sequence[Quadratic], size: int) -> tuple[list[Quadratic], list[Fraction]]:
    """Each form's violation form <= 0, and -1 - t <= 0 so that t is bounded below."""
    pairs = [violation_form(form) for form in forms]
    bound = Quadratic.linear((_ZERO,) * size + (-_ONE,), -1)
    return [*(form for form, _ in pairs), bound], [scale for _, scale in pairs]


def height(size: int) -> Quadratic:
    """The violation t itself, as a polynomial in ``size`` coordinates and t."""
    return Quadratic.linear((_ZERO,) * size + (_ONE,))


def _rounded_contradiction(
    proposal: Proposal, forms: Sequence[Quadratic], scales: Sequence[Fraction]
) -> tuple[Fraction, ...] | None:
    """Rational weights w >= 0 with sum w_i forms_i > 0 everywhere.

    Being infeasible with room to spare is an open condition: the multipliers of the least violation, which the
    proposal approximates, may be rounded.
    """
    for denominator in _DENOMINATORS:
        rounded = [Fraction(m).limit_denominator(denominator) for m in proposal.multipliers[: len(forms)]]
        weights = tuple(m * s for m, s in zip(rounded, scales, strict=True))
        if not any(weights) or any(w < 0 for w in weights):
            continue
        total = combine(weights, forms)
        solution = total.stationary()
        if solution is not None and total.value(solution.particular) > 0:
            return weights
    return None


def proposed(forms: Sequence[Quadratic]) -> tuple[tuple[Fraction, ...] | None, tuple[Fraction, ...] | None]:
    """(witness, weights) for forms <= 0: a rational point with all forms < 0, or the weights of a contradiction.

    At most one of the two is found; none where the forms touch or floats do not tell.
    """
    size = forms[0].size
    extended, scales = violation_forms(forms, size)
    proposal = interior_point(height(size), extended, [0.0] * (size + 1))
    if not proposal.residual < _TRUSTED:
        return None, None
    if proposal.point[-1] > 0:
        return None, _rounded_contradiction(proposal, forms, scales)
    for denominator in _WITNESS_DENOMINATORS:
        point = tuple(Fraction(v).limit_denominator(denominator) for v in proposal.point[:size])
        if all(form.value(point) < 0 for form in forms):
            return point, None
    return None, None
