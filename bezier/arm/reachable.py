"""What an arm like the EV3 can reach, in closed form: position only, no joint limits.

Where axis 2 is orthogonal to axis 1, axis 3 parallel to axis 2 and the end point in a plane through axis 1, let a be
the distance of joint 2 from axis 1, c its height, R1 and R2 the distances from joint 2 to joint 3 and from there to the
end point. A point with distance ρ from axis 1 and height z is reached iff

    |R1 - R2| <= sqrt((σρ - a)² + (z - c)²) <= R1 + R2   for σ = 1 or σ = -1.

With h = |R1 - R2|, in the hole (ρ - a)² + (z - c)² < h² of σ = 1 the root for σ = -1 lies between 2a - h and 2a + h.
So if h <= a and 2a + h <= R1 + R2 the other sign reaches it: the reachable set is (ρ - a)² + (z - c)² <= (R1 + R2)².
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import Any

from bezier.arm.elimination import Geometry
from bezier.arm.inverse import geometry_of
from bezier.arm.model import Arm, apply
from bezier.curves.scalar import dot, is_zero, sign
from qe.errors import Unable


@dataclass(frozen=True, eq=False)
class Torus:
    """(sqrt(x² + y²) - a)² + (z - c)² <= R²: the points that can be reached (mm).

    ``a_squared``, ``c``: exact; ``first_squared``, ``second_squared``: the squares of R1 and R2 with R = R1 + R2.
    """

    a_squared: Any
    c: Any
    first_squared: Any
    second_squared: Any

    @property
    def numbers(self) -> tuple[float, float, float]:
        """a, c and R in floating point."""
        first, second = (float(v) ** 0.5 for v in (self.first_squared, self.second_squared))
        return float(self.a_squared) ** 0.5, float(self.c), first + second

    def contains(self, x: float, y: float, z: float) -> bool:
        """Whether a point can be reached, in floating point; near the border ask ``bezier.arm.inverse.solve``."""
        a, c, radius = self.numbers
        return hypot(hypot(x, y) - a, z - c) <= radius

    @property
    def half_ball(self) -> float:
        """The largest r (mm) such that every point with |p| <= r and z >= 0 can be reached: a + sqrt(R² - c²)."""
        a, c, radius = self.numbers
        return a + float((radius**2 - c**2) ** 0.5)

    def __str__(self) -> str:
        a, c, radius = self.numbers
        return f"(sqrt(x^2 + y^2) - {a:.6f})^2 + (z - {c:.6f})^2 <= {radius:.6f}^2"


def reachable_set(arm: Arm) -> Torus:
    """The reachable set. Raises ``Unable`` for an arm of another shape; then ``inverse`` decides single points."""
    geometry = geometry_of(arm)
    _check_shape(geometry)
    a_squared = dot(geometry.shift[:2], geometry.shift[:2])
    second = arm.chain.constants[2]
    zero = a_squared * 0
    centre = apply(second, (zero, zero, zero))
    end = tuple(row[3] for row in arm.chain.constants[3])
    first_squared, second_squared = dot(centre[:2], centre[:2]), dot(end[:2], end[:2])
    a, r1, r2 = (float(v) ** 0.5 for v in (a_squared, first_squared, second_squared))
    if not (a > abs(r1 - r2) * (1 + 1e-9) and 2 * a + abs(r1 - r2) < (r1 + r2) * (1 - 1e-9)):
        raise Unable(f"the reachable set of {arm.name} has a hole, which has no closed form here")
    return Torus(a_squared, geometry.shift[2], first_squared, second_squared)


def _check_shape(geometry: Geometry) -> None:
    """Whether axis 2 is orthogonal to axis 1, axis 3 parallel to axis 2, and all moves in a plane through axis 1."""
    if not all(geometry.turns):
        raise Unable(f"{geometry.arm.name}: the closed form is for arms whose joints all turn")
    parallel = is_zero(geometry.nu[2])
    flat = all(is_zero(f[2]) for f in geometry.v[1:])
    in_plane = is_zero(geometry.v[0][2] + geometry.gamma[2])
    if not (parallel and flat and in_plane and sign(dot(geometry.shift[:2], geometry.shift[:2])) > 0):
        raise Unable(f"{geometry.arm.name}: the closed form is for arms that move in a plane through their first axis")
