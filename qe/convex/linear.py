"""Linear problems, solved exactly: no proposal in floats, so numbers of any size and as close as they like."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from qe.convex.simplex import Endless, Nowhere, least_cost
from qe.exact.quadratic_form import Quadratic

_ZERO = Fraction(0)
Numbers = tuple[Fraction, ...]


@dataclass(frozen=True, slots=True)
class LinearBest:
    """A feasible ``point`` and multipliers ``weights`` >= 0, complementary and stationary; zero ones are left out."""

    point: Numbers
    weights: dict[int, Fraction]


@dataclass(frozen=True, slots=True)
class LinearConflict:
    """sum weights_i forms_i is a positive constant, ``weights`` >= 0."""

    weights: dict[int, Fraction]


@dataclass(frozen=True, slots=True)
class LinearFall:
    """From ``point`` the objective falls forever along ``direction``, and no form grows."""

    point: Numbers
    direction: Numbers


def linear_optimum(
    objective: Quadratic, forms: Sequence[Quadratic], *, check: Callable[[], object]
) -> LinearBest | LinearConflict | LinearFall:
    """Minimise a linear polynomial subject to linear polynomials <= 0.

    The dual problem is in standard form: the greatest sum w_i forms_i(0) for weights w >= 0 with
    sum w_i grad forms_i = -grad objective; the multipliers of its equations are the point. ``check`` is called
    between steps.
    """

    columns = [form.gradient for form in forms]
    cost = [-form.constant for form in forms]
    outcome = least_cost(columns, [-b for b in objective.gradient], cost, check=check)
    if isinstance(outcome, Endless):
        return LinearConflict(outcome.weights)
    if not isinstance(outcome, Nowhere):
        return LinearBest(outcome.dual, outcome.weights)
    anywhere = least_cost(columns, [_ZERO] * objective.size, cost, check=check)
    if isinstance(anywhere, Endless):
        return LinearConflict(anywhere.weights)
    return LinearFall(anywhere.dual, outcome.dual)
