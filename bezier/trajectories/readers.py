"""Trajectories from files. Decimals in text are exact (0.1 is one tenth); floats in .npz are the dyadic numbers that
they are. docs/trajectories.md lists the forms.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from bezier.input import stored
from bezier.input.numbers import NotANumber, describe, parse
from bezier.input.toml_table import read_bytes
from bezier.trajectories.exact import by_control_points, by_points, by_spline
from bezier.trajectories.piecewise import Trajectory
from qe.errors import InputError
from qe.exact.rational_poly import RationalPoly

MAX_BYTES = 50_000_000
ORDERS = {"linear": 1, "cubic": 2, "quintic": 3}
STATES = ("positions", "velocities", "accelerations")


def load(file: Path, interpolation: str | None = None) -> Trajectory:
    """The trajectory in a file, by its ending. ``interpolation``: linear, cubic or quintic, where states are given;
    by default the highest that they allow. Raises ``InputError``."""
    kind = file.suffix.lower()
    if kind == ".npz":
        return load_arrays(file)
    if kind not in (".csv", ".json", ".yaml", ".yml"):
        raise InputError(f"{file}: expected a trajectory (.csv, .json, .yaml, .npz), found the ending {kind or 'none'}")
    try:
        text = read_bytes(file, MAX_BYTES).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{file}: expected UTF-8 text") from None
    reader = _Reader(interpolation)
    try:
        return reader.table(text) if kind == ".csv" else reader.tree(_parsed(text, kind))
    except InputError as error:
        raise InputError(f"{file}: {error}") from None


def _parsed(text: str, kind: str) -> Any:
    try:
        return stored.parsed(text) if kind == ".json" else _yaml(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"expected {kind[1:].upper()}, found: {' '.join(str(error).split())}") from None


def _yaml(text: str) -> Any:
    """Lists, dictionaries and texts, so that decimals stay exact."""
    try:
        import yaml
    except ImportError:
        raise InputError("reading YAML needs the package PyYAML") from None
    try:
        return yaml.load(text, Loader=yaml.BaseLoader)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from None


class _Reader:
    """Of the content of a file; how its states are interpolated."""

    def __init__(self, interpolation: str | None) -> None:
        self.interpolation = interpolation

    def number(self, raw: object, place: str) -> Fraction:
        """An exact number."""
        try:
            if isinstance(raw, bool) or not isinstance(raw, (int, str)):
                raise NotANumber(describe(raw))
            return parse(str(raw))
        except NotANumber as error:
            raise InputError(f"{place}: expected a number, found {error}") from None

    def numbers(self, raw: object, place: str, count: int | None = None) -> list[Fraction]:
        """A list of them."""
        if not isinstance(raw, list) or (count is not None and len(raw) != count):
            many = "numbers" if count is None else f"{count} numbers"
            raise InputError(f"{place}: expected a list of {many}, found {describe(raw)}")
        return [self.number(value, f"{place}[{k}]") for k, value in enumerate(raw)]

    def orders(self, given: int) -> int:
        """How many of positions, velocities and accelerations are used."""
        if self.interpolation is None:
            return given
        wanted = ORDERS[self.interpolation]
        if wanted > given:
            raise InputError(f"{self.interpolation} interpolation: expected {STATES[wanted - 1]}")
        return wanted

    # --- tables --------------------------------------------------------------------------------------------------

    def table(self, text: str) -> Trajectory:
        """CSV."""
        rows = [row for row in csv.reader(text.splitlines()) if any(cell.strip() for cell in row)]
        head = [cell.strip() for cell in rows[0]] if rows else []
        if len(rows) < 2 or len(head) < 2 or len({*head}) != len(head):
            raise InputError("expected a line of different names of columns, and lines of numbers")
        for i, row in enumerate(rows):
            if len(row) != len(head):
                raise InputError(f"row {i + 1}: expected {len(head)} values, found {len(row)}")
        columns: dict[str, list[Fraction]] = {}
        for k, name in enumerate(head):
            columns[name] = [self.number(row[k], f"row {i}, column {name}") for i, row in enumerate(rows[1:], start=2)]
        if head[0].lower() == "duration":
            return self._polynomials(columns, head)
        if head[0].lower() not in ("t", "time"):
            raise InputError(f"first column: expected time or duration, found {head[0]}")
        names = [name for name in head[1:] if not name.endswith(("_velocity", "_acceleration"))]
        given, known = 1, {head[0], *names}
        for ending in ("_velocity", "_acceleration"):
            wanted = [name + ending for name in names]
            if all(name in columns for name in wanted):
                given, known = given + 1, known | {*wanted}
            else:
                break
        if odd := [name for name in head if name not in known]:
            raise InputError(f"column {odd[0]}: expected such a column for every axis, velocities first")
        endings = ("", "_velocity", "_acceleration")[: self.orders(given)]
        states = [[[columns[n + e][i] for n in names] for e in endings] for i in range(len(rows) - 1)]
        return by_points(names, columns[head[0]], states)

    def _polynomials(self, columns: Mapping[str, Sequence[Fraction]], head: Sequence[str]) -> Trajectory:
        axes: dict[str, dict[int, Sequence[Fraction]]] = {}
        for name in head[1:]:
            axis, _, power = name.partition("^")
            if not power.isdecimal() or len(power) > 2:
                raise InputError(f"column {name}: expected a power such as x^3")
            axes.setdefault(axis, {})[int(power)] = columns[name]
        breaks, pieces = [Fraction(0)], []
        for i, length in enumerate(columns[head[0]]):
            breaks.append(breaks[-1] + length)
            rows = ([p[k][i] if k in p else Fraction(0) for k in range(max(p) + 1)] for p in axes.values())
            pieces.append(tuple(map(RationalPoly.of, rows)))
        return Trajectory(tuple(axes), tuple(breaks), tuple(pieces))

    # --- trees ---------------------------------------------------------------------------------------------------

    def tree(self, data: Any) -> Trajectory:
        """ROS 2 or Drake."""
        for key in ("trajectory", "joint_trajectory"):
            if isinstance(data, dict) and isinstance(data.get(key), dict):
                data = data[key]
        if isinstance(data, dict) and "points" in data:
            return self._joints(data)
        if isinstance(data, dict) and "basis" in data:
            return self._spline(data)
        listed = data if isinstance(data, list) else [data]
        if listed and all(isinstance(part, dict) and "control_points" in part for part in listed):
            return self._curves(listed)
        raise InputError("expected points (JointTrajectory) or control_points (Drake)")

    def _joints(self, data: Mapping[str, Any]) -> Trajectory:
        names, points = data.get("joint_names"), data["points"]
        if not isinstance(names, list) or not names or not all(isinstance(n, str) for n in names):
            raise InputError("joint_names: expected a list of names")
        if not isinstance(points, list) or len(points) < 2 or not all(isinstance(p, dict) for p in points):
            raise InputError("points: expected at least two points")
        given = next((k for k, name in enumerate(STATES) if not all(p.get(name) for p in points)), len(STATES))
        if not given:
            raise InputError("points: expected positions in each of them")
        for i, point in enumerate(points):
            if extra := [name for name in STATES[given:] if point.get(name)]:
                raise InputError(f"points[{i}]: expected {extra[0]} in all points or in none")
        orders = self.orders(given)
        states = [
            [self.numbers(p[name], f"points[{i}].{name}", len(names)) for name in STATES[:orders]]
            for i, p in enumerate(points)
        ]
        times = [self._time(p.get("time_from_start"), f"points[{i}].time_from_start") for i, p in enumerate(points)]
        return by_points(names, times, states)

    def _time(self, raw: object, place: str) -> Fraction:
        if not isinstance(raw, dict):
            return self.number(raw, place)
        if not raw or {*raw} - {"sec", "nanosec", "secs", "nsecs"}:
            raise InputError(f"{place}: expected sec and nanosec")
        scale = {"sec": 1, "secs": 1, "nanosec": 10**9, "nsecs": 10**9}
        return sum((self.number(v, f"{place}.{k}") / scale[k] for k, v in raw.items()), Fraction(0))

    def _points(self, raw: object, place: str) -> list[tuple[Fraction, ...]]:
        """Control points from a matrix with one row for each axis."""
        if not isinstance(raw, list) or not raw or not isinstance(raw[0], list) or not raw[0]:
            raise InputError(f"{place}: expected a list of numbers for each axis")
        rows = [self.numbers(row, f"{place}[{k}]", len(raw[0])) for k, row in enumerate(raw)]
        return list(zip(*rows, strict=True))

    def _spline(self, data: Mapping[str, Any]) -> Trajectory:
        basis = data["basis"]
        if not isinstance(basis, dict):
            raise InputError("basis: expected order and knots")
        points = self._points(data.get("control_points"), "control_points")
        order = self.number(basis.get("order"), "basis.order")
        if order.denominator > 1 or not 1 <= order <= 32:
            raise InputError(f"basis.order: expected a whole number from 1 to 32, found {order}")
        knots = self.numbers(basis.get("knots"), "basis.knots")
        return by_spline(_axes(len(points[0])), knots, points, int(order) - 1)

    def _curves(self, listed: Sequence[Mapping[str, Any]]) -> Trajectory:
        breaks, pieces = list[Fraction](), []
        for i, part in enumerate(listed):
            start, end = (self.number(part.get(k), f"curve {i + 1}: {k}") for k in ("start_time", "end_time"))
            if breaks and breaks[-1] != start:
                raise InputError(f"curve {i + 1}: expected to start where the one before ends")
            if start >= end:
                raise InputError(f"curve {i + 1}: expected end_time after start_time")
            breaks += [end] if breaks else [start, end]
            pieces.append(by_control_points(self._points(part["control_points"], f"curve {i + 1}"), end - start))
        return Trajectory(_axes(len(pieces[0])), tuple(breaks), tuple(pieces))


def _axes(count: int) -> tuple[str, ...]:
    return tuple(f"q{k + 1}" for k in range(count))


# --- SciPy --------------------------------------------------------------------------------------------------
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
