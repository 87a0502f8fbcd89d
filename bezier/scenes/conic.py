"""Convex problems with second-order cones, put together row by row for clarabel. Floating point."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

Terms = Sequence[tuple[int, float]]


class Conic:
    """Least cost (linear, with squares) under inequalities, equations and |(r_1, ..., r_k)| <= r_0."""

    def __init__(self) -> None:
        self._width = 0
        self._rows: list[tuple[Terms, float]] = []
        self._cones: list[tuple[str, int]] = []
        self._cost: list[tuple[int, float]] = []
        self._squares: list[Terms] = []

    def columns(self, count: int) -> list[int]:
        """New variables."""
        self._width += count
        return list(range(self._width - count, self._width))

    def cone(self, rows: Sequence[tuple[Terms, float]]) -> None:
        """The first of these affine forms is at least the length of the others."""
        self._rows += rows
        self._cones.append(("SecondOrderConeT", len(rows)))

    def at_least(self, terms: Terms, bound: float) -> None:
        """terms >= bound."""
        self._rows.append((terms, -bound))
        self._cones.append(("NonnegativeConeT", 1))

    def equal(self, terms: Terms, value: float) -> None:
        """terms = value."""
        self._rows.append((terms, -value))
        self._cones.append(("ZeroConeT", 1))

    def add_cost(self, terms: Terms) -> None:
        """Terms of the cost."""
        self._cost += terms

    def add_square(self, terms: Terms) -> None:
        """The square of a form as a part of the cost."""
        self._squares.append(terms)

    def solved(self) -> list[float] | None:
        """The variables, as well as clarabel knows them, which may be badly; None where it says that there are none."""
        import clarabel
        from scipy import sparse

        def matrix(rows: Sequence[Terms]) -> Any:
            places = [(i, j, c) for i, terms in enumerate(rows) for j, c in terms]
            i, j, c = zip(*places, strict=True) if places else ((), (), ())
            return sparse.csc_matrix((c, (i, j)), shape=(len(rows), self._width))

        cost = np.zeros(self._width)
        for k, c in self._cost:
            cost[k] += c
        squares = matrix(self._squares)
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        cones = [getattr(clarabel, name)(count) for name, count in self._cones]
        right = np.array([value for _, value in self._rows])
        quadratic = sparse.triu(2 * squares.T @ squares, format="csc")
        answer = clarabel.DefaultSolver(
            quadratic, cost, -matrix([t for t, _ in self._rows]), right, cones, settings
        ).solve()
        values = list(map(float, answer.x))
        hopeless = "Infeasible" in str(answer.status) or not np.isfinite(values).all()
        return None if hopeless else values
