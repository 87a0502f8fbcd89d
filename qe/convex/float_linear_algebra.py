"""Small linear algebra in floats for proposals: kernels up to a tolerance, Carathéodory reduction."""

from __future__ import annotations

from collections.abc import Sequence

_TOLERANCE = 1e-6
_ZERO, _NOISE = 1e-12, 1e-9  # what counts as zero: a row or weight; an entry of a vector of length about one


def _eliminate(rows: Sequence[Sequence[float]], width: int) -> tuple[list[list[float]], list[int]]:
    """Gauss–Jordan with full pivoting, rows scaled to unit size; (reduced pivot rows, their pivot columns)."""
    work = []
    for row in rows:
        size = max((abs(v) for v in row), default=0.0)
        if size > _ZERO:
            work.append([v / size for v in row])
    done: list[list[float]] = []
    columns: list[int] = []
    while work and len(columns) < width:
        best, index, column = max(
            (abs(row[c]), r, c) for r, row in enumerate(work) for c in range(width) if c not in columns
        )
        if best < _TOLERANCE:
            break
        pivot = work.pop(index)
        pivot = [v / pivot[column] for v in pivot]
        for group in (work, done):
            for r, row in enumerate(group):
                if row[column]:
                    group[r] = [a - row[column] * b for a, b in zip(row, pivot, strict=True)]
        done.append(pivot)
        columns.append(column)
    return done, columns


def free_columns(rows: Sequence[Sequence[float]], width: int) -> list[int]:
    """Columns that can be chosen freely in the kernel of the rows (up to a tolerance)."""
    _, columns = _eliminate(rows, width)
    return [c for c in range(width) if c not in columns]


def _kernel_vector(rows: Sequence[Sequence[float]], width: int) -> list[float] | None:
    done, columns = _eliminate(rows, width)
    free = next((c for c in range(width) if c not in columns), None)
    if free is None:
        return None
    vector = [0.0] * width
    vector[free] = 1.0
    for row, column in zip(done, columns, strict=True):
        vector[column] = -row[free]
    return vector


def caratheodory(chosen: Sequence[int], weights: Sequence[float], slopes: Sequence[Sequence[float]]) -> list[int]:
    """A subset with (about) linearly independent slopes whose cone still holds sum weights_i * slopes_i.

    While the slopes are dependent, the weights move along the dependency until one becomes zero (Carathéodory).
    """
    kept = {i: max(weights[i], _ZERO) for i in chosen}
    while kept:
        names = list(kept)
        rows = [[slopes[i][j] for i in names] for j in range(len(slopes[names[0]]))]
        vector = _kernel_vector(rows, len(names))
        if vector is None:
            break
        if max(vector) <= 0:
            vector = [-v for v in vector]
        step, leaving = min((kept[i] / v, i) for i, v in zip(names, vector, strict=True) if v > _NOISE)
        for i, v in zip(names, vector, strict=True):
            kept[i] = max(kept[i] - step * v, 0.0)
        del kept[leaving]
    return sorted(kept)
