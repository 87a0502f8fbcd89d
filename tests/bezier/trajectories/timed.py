"""Paths timed by toppra, as trajectories: a spline composed with a piecewise quadratic law."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from bezier.trajectories.exact import composed
from bezier.trajectories.piecewise import Trajectory
from bezier.trajectories.readers import from_scipy
from qe.exact.rational_poly import RationalPoly


def spline(points: Any) -> CubicSpline:
    """The natural cubic spline through the points on [0, 1]."""
    return CubicSpline(np.linspace(0, 1, len(points)), points, bc_type="natural")


def least_time_law(path: CubicSpline, axes: int, count: int) -> tuple[Any, Any, Any, Any]:
    """(times, s, s', s'') of toppra on ``count`` intervals, for |v| <= 1, |a| <= 2."""
    toppra = pytest.importorskip("toppra")
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    geometric = toppra.SplineInterpolator(path.x, path(path.x), bc_type="natural")
    bounds = np.array([[-1.0, 1.0]] * axes)
    listed = [constraint.JointVelocityConstraint(bounds), constraint.JointAccelerationConstraint(2 * bounds)]
    grid = np.linspace(0, 1, count + 1)
    instance = algorithm.TOPPRA(listed, geometric, gridpoints=grid, parametrizer="ParametrizeConstAccel")
    law = instance.compute_trajectory(0, 0)
    return law._ts, law._ss, law._velocities, law._us


def timed(path: CubicSpline, law: tuple[Any, Any, Any, Any]) -> Trajectory:
    """q(s(t)), every float exactly."""
    times, s, speed, force = ([Fraction(float(x)) for x in part] for part in law)
    laws = [RationalPoly.of([s[i], speed[i], force[i] / 2]) for i, _ in enumerate(pairwise(times))]
    return composed(from_scipy(path), times, laws)
