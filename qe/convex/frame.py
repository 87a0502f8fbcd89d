"""Coordinates in which floats can propose: where the origin lies, and what counts as 1."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from qe.exact.kkt_system import Flat
from qe.exact.quadratic_form import Quadratic, combine, dot, solve_linear

_ZERO, _ONE = Fraction(0), Fraction(1)
_NEAR_ONE = 8  # binary exponent up to which lengths are left as they are
_STRANGE = 25  # beyond, half of the digits of a float are lost
_NONE = -(10**9)  # the exponent of zero


def plain_frame(flat: Flat, forms: Sequence[Quadratic]) -> Flat:
    """The flat as it is, but for one unit of length where the constraints are much larger or smaller than 1."""
    unit = _unit(forms)
    return Flat(flat.origin, tuple(tuple(unit * d for d in direction) for direction in flat.basis))


def centred_frame(flat: Flat, forms: Sequence[Quadratic]) -> Flat:
    """The same flat with its origin amid the constraints and one unit for each direction: for problems that lie far off
    or have very different sizes along the coordinates."""
    centre, exponents = _centre_and_exponents(flat, forms)
    basis = (tuple(Fraction(2) ** e * d for d in row) for e, row in zip(exponents, flat.basis, strict=True))
    return Flat(tuple(Fraction(c) for c in flat.lift(centre)), tuple(basis))


def lies_far(flat: Flat, forms: Sequence[Quadratic]) -> bool:
    """Whether floats lose the constraints of a flat in the coordinates that it has."""
    numbers = [v for form in forms for row in (*form.hessian, form.gradient, (form.constant,)) for v in row if v]
    numbers += [v for row in (flat.origin, *flat.basis) for v in row]
    if all(max(v.numerator.bit_length(), v.denominator.bit_length()) <= _STRANGE for v in numbers):
        return False
    centre, exponents = _centre_and_exponents(flat, forms)
    off = (_binary(abs(c)) - e for c, e in zip(centre, exponents, strict=True))
    return any(abs(e) > _STRANGE for e in exponents) or any(o > _STRANGE for o in off)


def _centre_and_exponents(flat: Flat, forms: Sequence[Quadratic]) -> tuple[tuple[Fraction, ...], list[int]]:
    size = len(flat.basis)
    along = [form.restrict(flat.origin, flat.basis) for form in forms]
    centre = _centre([q for q in along if not q.is_linear], [q for q in along if q.is_linear], size)
    return centre, _exponents([q.restrict(centre, Flat.whole(size).basis) for q in along], size)


def _exponents(forms: Sequence[Quadratic], size: int) -> list[int]:
    """For each coordinate the binary exponent of its unit: as far as the curved forms reach, else as far as the linear
    forms let it follow the coordinates that have one."""
    exponents: dict[int, int] = {}
    for j in range(size):
        reach = [_size(q, j) for q in forms if q.hessian[j][j]]
        if any(e > _NONE // 4 for e in reach):
            exponents[j] = min(e for e in reach if e > _NONE // 4)
    linear = [q for q in forms if q.is_linear]
    for j in range(size):
        linked = []
        for q in linear if j not in exponents else ():
            others = [_binary(abs(q.gradient[k])) + e for k, e in exponents.items() if q.gradient[k]]
            if q.gradient[j] and others:
                linked.append(max(*others, _binary(abs(q.constant))) - _binary(abs(q.gradient[j])))
        if linked:
            exponents[j] = min(linked)
    return [exponents.get(j, 0) for j in range(size)]


def _centre(curved: Sequence[Quadratic], linear: Sequence[Quadratic], size: int) -> tuple[Fraction, ...]:
    """Where the curved forms, weighted by their sizes, have their least sum; in the directions that this leaves open,
    where the linear forms have the least sum of squares."""
    centre: tuple[Fraction, ...] = (_ZERO,) * size
    free = Flat.whole(size).basis
    if curved:
        lowest = combine([1 / max(abs(h) for row in q.hessian for h in row) for q in curved], curved).stationary()
        if lowest is not None:  # the sum may fall for ever
            centre, free = lowest.particular, lowest.kernel
    rows, values = [], []
    for q in linear:
        scale = sum((b * b for b in q.gradient), _ZERO)
        if scale:
            rows.append([dot(q.gradient, d) / scale for d in free])
            values.append(q.value(centre) / scale)
    columns = [[row[i] for row in rows] for i in range(len(free))]
    squares, right = [[dot(u, v) for v in columns] for u in columns], [-dot(u, values) for u in columns]
    steps = solve_linear(squares, right, len(free))
    return Flat(centre, free).lift(steps.particular) if steps is not None else centre


def _size(form: Quadratic, j: int) -> int:
    """The binary exponent of how far the constraint reaches along one coordinate, from the origin."""
    bend = form.hessian[j][j]
    return max(_binary(abs(form.gradient[j]) / bend), _binary(abs(form.constant) / bend) // 2)


def _unit(forms: Sequence[Quadratic]) -> Fraction:
    """A length of the size of these constraints: 1, or a power of two if they are much larger or smaller than that.

    Proposals come from floats with absolute tolerances, which fit coordinates near 1. Of a ball |x - c| <= r this
    compares c and r with 1; half-spaces have no size of their own.
    """
    sizes = []
    for form in forms:
        bend = max((abs(h) for row in form.hessian for h in row if h), default=_ZERO)
        slope = max((abs(b) for b in form.gradient if b), default=_ZERO)
        if bend and (slope or form.constant):
            sizes.append(max(_binary(slope / bend), _binary(abs(form.constant) / bend) // 2))
    exponent = min(sizes, key=abs, default=0)
    return _ONE if abs(exponent) <= _NEAR_ONE else Fraction(2) ** exponent


def _binary(value: Fraction) -> int:
    """About log2 of a positive number; very little for 0."""
    return value.numerator.bit_length() - value.denominator.bit_length() if value else _NONE
