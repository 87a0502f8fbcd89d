"""Comprehensive Groebner systems as objects: segments, the one at a point, membership, and how they are written."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TypeVar

from qe import arguments
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.exact.block_order import BlockOrder, parametric_basis
from qe.exact.number import Number
from qe.exact.polynomial_system import solve_system
from qe.exact.quotient import PositiveDimensional
from qe.exact.ring import Poly, format_poly
from qe.exact.sample import Point
from qe.exact.tower import clear_denominators
from qe.exact.zeros import Zero
from qe.formula.build import atom, conj, disj
from qe.formula.syntax import Formula, Relation
from qe.groebner import files
from qe.groebner.evidence import solutions_certificate
from qe.groebner.segment import Segment
from qe.groebner.writing import system_to_html, system_to_latex
from qe.processes.channel import Channel
from qe.processes.execution import run
from qe.processes.limits import Limits
from qe.proof.certificate import Certificate
from qe.proof.entry import Json

Result = TypeVar("Result")

_WHAT = "comprehensive Gröbner system"
Numbers = Mapping[str, object] | Sequence[object]
"""A point: exact numbers for the parameters, by name or in order."""


def outside() -> InputError:
    """The segments cover what was asked about."""
    return InputError("point: one at which all of `equal` and none of `nonzero` vanish expected, another found")


@dataclass(frozen=True)
class ComprehensiveGroebnerSystem:
    """Disjoint segments that cover the whole space of parameters, each with a Groebner basis for all its points.

    ``polys``: the given generators. ``variables``: largest first; ``parameters``; ``constants``: parameters that stand
    for one real algebraic number each: every segment carries their minimal polynomials. A segment that the true numbers
    contradict is possible, since segments are told apart by algebra alone; ``at`` never finds it.
    """

    polys: tuple[Poly, ...]
    block: BlockOrder
    constants: Mapping[str, RealAlgebraic]
    segments: tuple[Segment, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        """The names of the variables, largest first."""
        return tuple(self._names[i] for i in self.block.variables)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the parameters, without constants."""
        return tuple(n for i in self.block.parameters if (n := self._names[i]) not in self.constants)

    @property
    def _names(self) -> tuple[str, ...]:
        return self.polys[0].ring.names

    def __repr__(self) -> str:
        over = f"{', '.join(self.variables)}; {', '.join(self.parameters) or 'no parameters'}"
        return f"ComprehensiveGroebnerSystem({over}: {len(self)} segment{'s' if len(self) != 1 else ''})"

    def __len__(self) -> int:
        return len(self.segments)

    def __iter__(self) -> Iterator[Segment]:
        return iter(self.segments)

    # --- at a point --------------------------------------------------------------------------
    def at(self, point: Numbers, *, timeout: float | None = None) -> Segment:
        """The segment of a point: exact numbers for the parameters, by name or in order. ``InputError`` otherwise.

        ``timeout`` in seconds: ``BudgetExceeded`` at the limit, here and below.
        """
        return within(timeout, self._at, self._values(point))

    def _at(self, values: Mapping[str, Number]) -> Segment:
        place = self._place(values)
        for segment in self.segments:
            if _lies_in(place, segment):
                return segment
        raise outside()

    def basis_at(self, point: Numbers, *, timeout: float | None = None) -> tuple[Poly, ...]:
        """The reduced Groebner basis of the ideal at a point, over the field of the constants.

        Irrational numbers of the point join the constants: the names of their parameters stay in the basis and stand
        for them. ``timeout`` in seconds. Raises ``BudgetExceeded``, and ``Unable`` where the basis grows too large.
        """
        return within(timeout, self._basis_at, self._values(point))

    def _basis_at(self, values: Mapping[str, Number]) -> tuple[Poly, ...]:
        ring, tower = self.polys[0].ring, self._place(values).tower
        # irreducible one over the other, so that what they divide out is a field
        moduli, basis = [clear_denominators(ring, m) for m in tower.moduli], self._at(values).basis
        special = [_specialised(p, values, self._names) for p in basis]
        found = parametric_basis([*special, *moduli], self.block)
        return tuple(p for p in found if not self.block.is_free(p) or p.is_constant)

    def solutions_at(self, point: Numbers, *, timeout: float | None = None) -> list[Zero]:
        """All real solutions at a point, exactly, with multiplicities; see ``qe.exact.polynomial_system``.

        ``timeout`` in seconds. Raises ``PositiveDimensional`` where infinitely many complex solutions exist, and as
        ``basis_at``.
        """
        return within(timeout, self._solutions_at, self._values(point))

    def _solutions_at(self, values: Mapping[str, Number]) -> list[Zero]:
        basis = self._basis_at(values)
        if not basis:
            raise PositiveDimensional(self.variables)
        if basis[0].is_constant:
            return []
        found = solve_system(basis, variables=self.block.variables, constants=self._all_constants(values))
        return [Zero({n: z.values[n] for n in self.variables}, z.multiplicity) for z in found]

    def certificate_at(
        self, point: Numbers, positive: Sequence[Poly] = (), *, timeout: float | None = None
    ) -> Certificate:
        """A certificate of the real solutions at a point (with all of ``positive`` positive): these, and no others.

        Kind "solutions", for ``qe.verify`` and ``qe check``; the checker works from the given polynomials, not from the
        segments. Arguments and errors as for ``solutions_at``.
        """
        values, signed = self._values(point), arguments.by_place(positive, "positive")
        for poly in signed:
            arguments.instance(poly, Poly, "positive", "polynomials of this system's kind")
        return within(timeout, self._certificate_at, values, signed)

    def _certificate_at(self, values: Mapping[str, Number], positive: Sequence[Poly]) -> Certificate:
        special = [_specialised(p, values, self._names) for p in self.polys]
        if not any(special):
            raise PositiveDimensional(self.variables)
        return solutions_certificate(
            special,
            [(_specialised(p, values, self._names), Relation.GT) for p in positive],
            variables=self.block.variables,
            constants=self._all_constants(values),
        )

    def _all_constants(self, values: Mapping[str, Number]) -> dict[int, RealAlgebraic]:
        """With the irrational numbers of a point, by ring index."""
        index = self.polys[0].ring.index
        irrational = {n: v for n, v in values.items() if isinstance(v, RealAlgebraic)}
        return {index[n]: v for n, v in {**self.constants, **irrational}.items()}

    def contains(self, poly: Poly | str, point: Numbers, *, timeout: float | None = None) -> bool:
        """Whether a polynomial in variables and parameters is in the ideal at a point, exactly."""
        return within(timeout, self._contains, self._read(poly), self._values(point))

    def _contains(self, poly: Poly, values: Mapping[str, Number]) -> bool:
        _, rest = self._at(values).reduce(poly)
        place = self._place(values)
        return all(place.sign(c) == 0 for c in self.block.terms(rest).values())

    def _read(self, poly: Poly | str) -> Poly:
        """A polynomial, or its text, in the ring of the system."""
        ring = self.polys[0].ring
        if isinstance(poly, str):
            from qe.io.text import read_polynomial

            poly = read_polynomial(poly, source="poly", known=ring.names)[0]
        found = arguments.instance(poly, Poly, "poly", "a polynomial, or text")
        if unknown := [n for i in found.variables if (n := found.ring.names[i]) not in ring.index]:
            raise InputError(f"poly: variables and parameters of the system expected, {unknown[0]} found")
        return found.convert(ring)

    def place(self, point: Numbers) -> Point:
        """A point of the parameters, with the constants, for exact signs."""
        return self._place(self._values(point))

    def _values(self, point: Numbers) -> dict[str, Number]:
        names = self.parameters
        given = arguments.point(point, names)
        if missing := [n for n in names if n not in given]:
            raise InputError(f"point: a number for {', '.join(missing)} expected, none found")
        return {name: exact_number(given[name], f"point: {name}") for name in names}

    def _place(self, values: Mapping[str, Number]) -> Point:
        known: dict[str, Number] = {**values, **self.constants}
        below = [self._names[i] for i in range(len(self.block.parameters))]
        return Point.of(self.polys[0].ring, [known[name] for name in below])

    # --- written -----------------------------------------------------------------------------
    def condition(self, segment: Segment) -> Formula:
        """The segment as a formula between parameters (and constants)."""
        return condition_of(arguments.instance(segment, Segment, "segment", "a segment of the system"))

    def to_dict(self) -> dict[str, Json]:
        """The system as plain data: polynomials as text."""
        return files.system_data(self.polys, self.block, self.constants, self.segments)

    def to_json(self, *, indent: int | None = None) -> str:
        """``to_dict`` as JSON, with format, version and digest."""
        return files.written(_WHAT, self.to_dict(), indent)

    @staticmethod
    def from_json(text: str) -> ComprehensiveGroebnerSystem:
        """The system that ``to_json`` wrote: an equal one. Raises ``InputError`` with one line naming what is wrong.

        That the segments are right is not checked; ``certificate_at`` works from the given polynomials alone.
        """
        return files.read(
            text, _WHAT, lambda entry: ComprehensiveGroebnerSystem(*files.system_parts(entry)), lambda s: s.to_dict()
        )

    def to_latex(self) -> str:
        """An array of conditions and bases, for math mode."""
        return system_to_latex([(self.condition(s), s.basis) for s in self.segments])

    def to_html(self) -> str:
        """A table of conditions, bases and dimensions; formulas in MathML."""
        return system_to_html([(self.condition(s), s.basis, s.dimension) for s in self.segments])

    def _repr_html_(self) -> str:
        return self.to_html()

    def __str__(self) -> str:
        lines = []
        for segment in self.segments:
            lines.append(f"{self.condition(segment)}:")
            lines += [f"    {format_poly(p)}" for p in segment.basis] or ["    0"]
        return "\n".join(lines)


def condition_of(segment: Segment) -> Formula:
    """The segment as a formula between parameters."""
    some = [disj(atom(p, Relation.NE) for p in segment.some)] if segment.some else []
    zero, other = (atom(p, Relation.EQ) for p in segment.equal), (atom(p, Relation.NE) for p in segment.nonzero)
    return conj([*zero, *other, *some])


def exact_number(value: object, what: str) -> Number:
    """A rational number, or a real algebraic one (also an element of a number field); ``InputError`` otherwise."""
    if isinstance(value, RealAlgebraic):
        return value.as_fraction() if value.is_rational else value
    convert = getattr(value, "to_algebraic", None)
    if convert is not None:
        return exact_number(convert(), what)
    return arguments.rational(value, what)


def within(timeout: float | None, work: Callable[..., Result], *given: object) -> Result:
    """What the work makes of what is given, within so many seconds."""
    limit = arguments.seconds(timeout)
    return work(*given) if limit is None else run(partial(_unheard, work, given), Limits(limit))


def _unheard(work: Callable[..., Result], given: tuple[object, ...], channel: Channel) -> Result:
    return work(*given)


def _lies_in(place: Point, segment: Segment) -> bool:
    return (
        all(place.sign(p) == 0 for p in segment.equal)
        and all(place.sign(p) != 0 for p in segment.nonzero)
        and (not segment.some or any(place.sign(p) != 0 for p in segment.some))
    )


def _specialised(poly: Poly, values: Mapping[str, Number], names: Sequence[str]) -> Poly:
    for name, value in values.items():
        if isinstance(value, Fraction | int):
            poly = poly.at_rational(names.index(name), value)
    return poly
