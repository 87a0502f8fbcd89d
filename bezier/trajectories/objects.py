"""Trajectories from SciPy's objects and arrays: PPoly (CubicSpline, ...), BSpline; every float is taken exactly."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from bezier.trajectories.exact import by_spline
from bezier.trajectories.piecewise import Trajectory
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly


def from_scipy(value: Any) -> Trajectory:
    """From a ``scipy.interpolate`` PPoly, BPoly's power form, or BSpline. Raises ``InputError`` for others."""
    if all(hasattr(value, name) for name in ("t", "c", "k")):
        return from_arrays({"t": value.t, "c": value.c, "k": value.k})
    if all(hasattr(value, name) for name in ("c", "x")) and type(value).__name__ != "BPoly":
        return from_arrays({"c": value.c, "x": value.x})
    raise InputError(f"trajectory: expected a PPoly or a BSpline of SciPy, found {type(value).__name__}")


def load_arrays(file: Path) -> Trajectory:
    """From an .npz file with the arrays c and x of a PPoly, or t, c and k of a BSpline."""
    try:
        with np.load(file, allow_pickle=False) as data:
            return from_arrays({name: data[name] for name in data.files}, str(file))
    except (OSError, ValueError, EOFError, AttributeError) as error:
        raise InputError(f"{file}: expected an .npz file of arrays of numbers, found: {error}") from None


def from_arrays(arrays: dict[str, Any], source: str = "trajectory") -> Trajectory:
    """``c[k, i, axis]`` is the coefficient of (t - x[i])^(n - k); of a B-spline c[i, axis] a control point."""
    if not ({"c", "x"} <= arrays.keys() or {"c", "t", "k"} <= arrays.keys()):
        raise InputError(f"{source}: expected arrays c and x (PPoly) or t, c and k (BSpline), found {sorted(arrays)}")
    is_spline = "t" in arrays
    c = _numbers(arrays["c"], f"{source}: c")
    ends = _numbers(arrays["t" if is_spline else "x"], f"{source}: {'t' if is_spline else 'x'}")
    c = c.reshape((*c.shape[: 1 if is_spline else 2], -1))
    names = tuple(f"q{k + 1}" for k in range(c.shape[-1]))
    times = tuple(map(Fraction, ends.ravel().tolist()))
    if is_spline:
        degree = _numbers(arrays["k"], f"{source}: k").ravel()
        if degree.size != 1 or degree[0] != int(degree[0]):
            raise InputError(f"{source}: k: expected a degree")
        n = len(times) - int(degree[0]) - 1  # SciPy allows more control points than are used
        return by_spline(names, times, [list(map(Fraction, row)) for row in c[: max(n, 0)].tolist()], int(degree[0]))
    if c.ndim != 3 or c.shape[1] != len(times) - 1:
        raise InputError(f"{source}: c: expected (order, {len(times) - 1}, axes), found the shape {arrays['c'].shape}")
    listed = c[::-1].transpose(1, 2, 0).tolist()
    pieces = tuple(tuple(RationalPoly.of(list(map(Fraction, p))) for p in row) for row in listed)
    return Trajectory(names, times, pieces)


def _numbers(raw: Any, place: str) -> Any:
    array = np.asarray(raw)
    if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8 or not np.all(np.isfinite(array)):
        raise InputError(f"{place}: expected finite numbers of at most 64 bits")
    return array.astype(float) if array.dtype.kind == "f" else array
