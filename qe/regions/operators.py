"""What sets are asked and joined by that needs the engine: the operators and further questions of a region.

Their work stands where the engine is known, in ``qe.api.region_operators``, which is reached by ``qe.services``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

from qe.services import Service, SymPyForm, service

if TYPE_CHECKING:  # loaded with ``qe`` itself, which loads nothing of the engine
    from qe.decomposition.interval import Coordinate, Interval, Number


class SetOperations(SymPyForm):
    """Operators and questions of sets in the space of the variables ``order``.

    The other operand is a region in the same variables, or a formula (of any kind that ``qe.region`` takes) in some of
    them. All are exact. They work under the limits of the region; ``timeout`` (seconds) goes before these.
    All raise ``InputError`` for what is no such set, ``Unable`` where the engine does, ``BudgetExceeded`` at a limit.
    """

    __slots__ = ()
    order: tuple[str, ...]
    contains: Callable[..., bool]

    def __and__(self, other: object) -> Self:
        """The intersection."""
        return self._made("joined", "and", other)

    __rand__ = __and__

    def __or__(self, other: object) -> Self:
        """The union."""
        return self._made("joined", "or", other)

    __ror__ = __or__

    def __sub__(self, other: object) -> Self:
        """The points that are not in the other set."""
        return self._made("joined", "minus", other)

    def __xor__(self, other: object) -> Self:
        """The points of just one of both sets."""
        return self._made("joined", "xor", other)

    def __contains__(self, point: Any) -> bool:
        """Whether a point lies in it, as ``contains`` takes it; on a line the number alone may be given."""
        alone = len(self.order) == 1 and (isinstance(point, str) or not isinstance(point, Mapping | Iterable))
        return self.contains([point] if alone else point)

    def __invert__(self) -> Self:
        """The complement."""
        return self.complement()

    def __le__(self, other: object) -> bool:
        """Whether it is a subset."""
        return self.is_subset(other)

    def __ge__(self, other: object) -> bool:
        """Whether the other set is a subset of it."""
        return bool(_ways().compared("superset", self, other, None))

    def __eq__(self, other: object) -> bool:
        """Whether both are the same set of points; regions in other variables are not. The engine decides it."""
        if not isinstance(other, SetOperations):
            return NotImplemented
        return self is other or (set(self.order) == set(other.order) and self.equals(other))

    def __hash__(self) -> int:
        return hash(frozenset(self.order))

    def complement(self, *, timeout: float | None = None) -> Self:
        """All points of the space that are not in the set."""
        return self._made("complement", timeout)

    def closure(self, *, timeout: float | None = None) -> Self:
        """The set with all its limit points."""
        return self._made("topological", "closure", timeout)

    def interior(self, *, timeout: float | None = None) -> Self:
        """The points around which there is a ball inside the set."""
        return self._made("topological", "interior", timeout)

    def boundary(self, *, timeout: float | None = None) -> Self:
        """The closure without the interior."""
        return self._made("topological", "boundary", timeout)

    def components(self, *, timeout: float | None = None) -> list[Self]:
        """The connected components, those with the least first coordinate first; of nothing there are none.

        In one to three variables (see ``qe.regions.planar`` and ``qe.regions.spatial``, which may take another variable
        for the first), and of sets that are seen to be convex in any number; otherwise raises ``Unable``.
        """
        parts: list[Self] = _ways().components(self, timeout)
        return parts

    def is_subset(self, other: object, *, timeout: float | None = None) -> bool:
        """Whether all points of the set are in the other one; so says ``a <= b``."""
        return bool(_ways().compared("subset", self, other, timeout))

    def is_disjoint(self, other: object, *, timeout: float | None = None) -> bool:
        """Whether the sets have no common point."""
        return bool(_ways().compared("disjoint", self, other, timeout))

    def equals(self, other: object, *, timeout: float | None = None) -> bool:
        """Whether both sets have the same points; so says ``a == b``."""
        return bool(_ways().compared("equal", self, other, timeout))

    def bounding_box(self, *, timeout: float | None = None) -> dict[str, Interval]:
        """The exact bounds of every variable; ``InputError`` for an empty set."""
        box: dict[str, Interval] = _ways().bounding_box(self, timeout)
        return box

    def project(self, variables: Any, *, timeout: float | None = None) -> Self:
        """The set of all values of some of the variables (in the order given) with which points of the set begin."""
        return self._made("project", variables, timeout)

    def section(self, values: Mapping[Any, Coordinate], *, timeout: float | None = None) -> Self:
        """The points of the set with these values of some variables, in the space of the other variables."""
        return self._made("section", values, timeout)

    def distance(
        self, point: Mapping[Any, Coordinate] | Sequence[Coordinate], *, timeout: float | None = None
    ) -> Number:
        """The exact distance of a point: the infimum over the set, 0 for its limit points, too.

        Raises ``InputError`` for an empty set.
        """
        distance: Number = _ways().distance(self, point, timeout)
        return distance

    def exact_volume(self, *, timeout: float | None = None) -> Any:
        """The length, area or volume in closed form, as a SymPy expression.

        The number lies in the enclosure that ``volume`` proves; where its terms come from see ``qe.api.measure``.
        Raises ``Unable`` for unbounded sets, and where no closed form is known: ``volume`` encloses it.
        """
        return _ways().exact_volume(self, timeout)

    def sample(self, seed: int = 0, *, timeout: float | None = None) -> dict[str, Number]:
        """An exact point of the set, the same for the same seed; rational coordinates wherever there are some.

        Random steps from variable to variable: every piece can be met, but no distribution is promised.
        Raises ``InputError`` for an empty set.
        """
        values: dict[str, Number] = _ways().sample(self, seed, timeout)
        return values

    def find_instances(self, n: int, *, seed: int = 0, timeout: float | None = None) -> list[dict[str, Number]]:
        """Up to ``n`` different points of the set; fewer only where it has no more."""
        points: list[dict[str, Number]] = _ways().instances(self, n, seed, timeout)
        return points

    def _made(self, way: str, *given: Any) -> Self:
        made: Self = getattr(_ways(), way)(self, *given)
        return made


def _ways() -> Any:
    return service(Service.REGION_OPERATORS)
