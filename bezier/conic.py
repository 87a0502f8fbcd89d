"""Convex problems with second-order cones, put together for clarabel (extra ``squares``). Floating point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from qe.extras import wanted

Terms = Sequence[tuple[int, float]]


class Conic:
    """Least cost (linear, with squares) under inequalities, equations and |(r_1, ..., r_k)| <= r_0. ``tolerances``: of
    the solver, where they are not its own, in the order in which they are tried. ``multipliers``: of all rows."""

    def __init__(self, *tolerances: float) -> None:
        self._tolerances, self.multipliers = tolerances, list[float]()
        self._width = self._height = 0
        none = np.zeros(0)
        self._rows: list[tuple[Any, Any, Any]] = [(none.astype(int), none.astype(int), none)]
        self._right: list[Any] = [none]
        self._cones: list[tuple[str, int]] = []
        self._costs: list[tuple[Any, Any]] = []
        self._squares: list[Terms] = []
        self._products: list[tuple[int, int, float]] = []

    def variables(self, shape: tuple[int, ...], cost: Any = 0.0) -> Any:
        """The numbers of new variables, an array."""
        count = int(np.prod(shape))
        numbers = np.arange(self._width, self._width + count).reshape(shape)
        self._width += count
        self._costs.append((numbers.ravel(), np.broadcast_to(cost, shape).ravel()))
        return numbers

    def block(self, entries: Sequence[tuple[Any, Any]], right: Any, size: int = 0) -> None:
        """Rows with sum of columns * values <= ``right``, all arrays of one shape. ``size``: right - sum lies in second
        order cones of so many rows; -1: it is zero."""
        shape = np.broadcast_shapes(np.shape(right), *(np.shape(v) for pair in entries for v in pair))
        count = int(np.prod(shape))
        at = self._height + np.arange(count)
        for columns, values in entries:
            flat = np.broadcast_to(values, shape).ravel()
            kept = flat != 0
            self._rows.append((at[kept], np.broadcast_to(columns, shape).ravel()[kept], flat[kept]))
        self._right.append(np.broadcast_to(right, shape).ravel())
        self._height += count
        if size > 0:
            self._cones += [("SecondOrderConeT", size)] * (count // size)
        else:
            self._cones.append(("ZeroConeT" if size else "NonnegativeConeT", count))

    def product(self, x: Any, y: Any, z: Any) -> None:
        """z^2 <= x y for columns; y may be None, which is 1."""
        other = [] if y is None else [(y[:, None], np.array([-1.0, 1.0, 0.0]))]
        one = np.array([1.0, -1.0, 0.0]) if y is None else np.zeros(3)
        columns = np.stack([x, x, z], -1)
        self.block([(columns, np.array([-1.0, -1.0, -2.0])), *other], np.broadcast_to(one, columns.shape), 3)

    def cone(self, rows: Sequence[tuple[Terms, float]], kind: str = "SecondOrderConeT") -> None:
        """The first of these affine forms is at least the length of the others."""
        places = [(self._height + i, j, -c) for i, (terms, _) in enumerate(rows) for j, c in terms]
        at, columns, values = zip(*places, strict=True)
        self._rows.append((at, columns, values))
        self._right.append([value for _, value in rows])
        self._height += len(rows)
        self._cones.append((kind, len(rows)))

    def at_least(self, terms: Terms, bound: float) -> None:
        """terms >= bound."""
        self.cone([(terms, -bound)], "NonnegativeConeT")

    def equal(self, terms: Terms, value: float) -> None:
        """terms = value."""
        self.cone([(terms, -value)], "ZeroConeT")

    def add_cost(self, terms: Terms) -> None:
        """Terms of the cost."""
        self._costs += terms

    def add_square(self, terms: Terms) -> None:
        """The square of a form as a part of the cost."""
        self._squares.append(terms)

    def add_product(self, i: int, j: int, factor: float) -> None:
        """factor times a product of two variables, i <= j, as a part of the cost, which is to be convex."""
        self._products.append((i, j, factor * (1 + (i == j))))

    def solved(self) -> list[float] | None:
        """The variables, as well as clarabel knows them, which may be badly; None where it says that there are none."""
        with wanted():
            import clarabel
            from scipy import sparse

        settings = clarabel.DefaultSettings()
        settings.verbose = False
        cost = np.zeros(self._width)
        for k, c in self._costs:
            np.add.at(cost, k, c)
        at, columns, factors = (np.concatenate(part) for part in zip(*self._rows, strict=True))
        matrix = sparse.csc_matrix((factors, (at, columns)), shape=(self._height, self._width))
        listed = [(i, k, c) for i, terms in enumerate(self._squares) for k, c in terms]
        i, k, c = zip(*listed, strict=True) if listed else ((), (), ())
        squares = sparse.csc_matrix((c, (i, k)), shape=(len(self._squares), self._width))
        quadratic = sparse.triu(2 * squares.T @ squares, format="csc")
        i, k, c = zip(*self._products, strict=True) if self._products else ((), (), ())
        quadratic = sparse.csc_matrix(quadratic + sparse.csc_matrix((c, (i, k)), shape=quadratic.shape))
        cones = [getattr(clarabel, name)(count) for name, count in self._cones]
        for tolerance in self._tolerances or (settings.tol_feas,):
            settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance
            solver = clarabel.DefaultSolver(quadratic, cost, matrix, np.concatenate(self._right), cones, settings)
            answer = solver.solve()
            if str(answer.status) == "Solved":
                break
        values, self.multipliers = list(map(float, answer.x)), list(map(float, answer.z))
        hopeless = "Infeasible" in str(answer.status) or not np.isfinite(values).all()
        return None if hopeless else values
