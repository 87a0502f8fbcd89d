"""Quadratic polynomials, semidefiniteness and linear systems over Q and over number fields."""

from fractions import Fraction as F

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.field import NumberField
from qe.exact.quadratic_form import Definiteness, definiteness, independent_rows, quadratic, solve_linear
from qe.exact.ring import Ring

integers = st.integers(-4, 4)


@st.composite
def matrices(draw, rows: int | None = None, columns: int | None = None):
    m, n = rows or draw(st.integers(1, 4)), columns or draw(st.integers(1, 4))
    return [[F(draw(integers)) for _ in range(n)] for _ in range(m)]


def _minors(matrix) -> list[F]:
    """All principal minors, by the Leibniz-Laplace rule."""
    n = len(matrix)
    subsets = [[i for i in range(n) if k >> i & 1] for k in range(1, 1 << n)]
    return [_det([[matrix[i][j] for j in s] for i in s]) for s in subsets]


def _det(m) -> F:
    if not m:
        return F(1)
    return sum(((-1) ** j * m[0][j] * _det([r[:j] + r[j + 1 :] for r in m[1:]]) for j in range(len(m))), F(0))


@given(st.integers(1, 3), st.data())
def test_semidefinite_iff_all_principal_minors_are_nonnegative(n, data) -> None:
    half = data.draw(matrices(n, n))
    symmetric = [[half[i][j] + half[j][i] for j in range(n)] for i in range(n)]
    minors = _minors(symmetric)
    leading = [_det([row[:k] for row in symmetric[:k]]) for k in range(1, n + 1)]
    expected = Definiteness.NOT_SEMIDEFINITE
    if all(m >= 0 for m in minors):
        expected = Definiteness.POSITIVE_SEMIDEFINITE
    if all(m > 0 for m in leading):
        expected = Definiteness.POSITIVE_DEFINITE
    assert definiteness(symmetric) is expected


@given(matrices())
def test_gram_matrices_are_semidefinite_and_definite_iff_of_full_rank(a) -> None:
    columns = len(a[0])
    gram = [[sum(row[i] * row[j] for row in a) for j in range(columns)] for i in range(columns)]
    full = len(independent_rows(a)) == columns
    assert definiteness(gram) is (Definiteness.POSITIVE_DEFINITE if full else Definiteness.POSITIVE_SEMIDEFINITE)


@given(matrices(), st.data())
def test_linear_systems(a, data) -> None:
    width = len(a[0])
    x = [F(data.draw(integers)) for _ in range(width)]
    rhs = [sum(c * v for c, v in zip(row, x, strict=True)) for row in a]
    solution = solve_linear(a, rhs, width)
    assert solution is not None
    assert [sum(c * v for c, v in zip(row, solution.particular, strict=True)) for row in a] == rhs
    assert len(solution.kernel) == width - len(independent_rows(a))
    for direction in solution.kernel:
        assert not any(sum(c * v for c, v in zip(row, direction, strict=True)) for row in a)


def test_inconsistent_system() -> None:
    assert solve_linear([[F(1), F(1)], [F(2), F(2)]], [F(1), F(3)], 2) is None


def test_over_a_number_field() -> None:
    root = NumberField.from_root([-2, 0, 1], 1, 2).generator()
    solution = solve_linear([[root, F(1)], [F(2), root]], [root, F(2)], 2)  # second row = sqrt(2) * first
    assert solution is not None and len(solution.kernel) == 1
    assert definiteness([[root, 1], [1, root]]) is Definiteness.POSITIVE_DEFINITE
    assert definiteness([[root, 2], [2, root]]) is Definiteness.NOT_SEMIDEFINITE
    assert definiteness([[root, 2], [2, 2 * root]]) is Definiteness.POSITIVE_SEMIDEFINITE


@given(st.data())
def test_reading_value_slope_and_restriction(data) -> None:
    ring = Ring.of(("x", "y", "z"))
    variables = [ring.gen(i) for i in range(3)]
    monomials = [u * v for i, u in enumerate(variables) for v in variables[i:]] + variables + [ring.constant(1)]
    poly = sum((data.draw(integers) * m for m in monomials), ring.constant(0))
    form = quadratic(poly, range(3))
    assert form is not None
    point = [F(data.draw(integers), 3) for _ in range(3)]
    assert form.value(point) == poly.evaluate(point)
    assert form.slope(point) == [poly.derivative(i).evaluate(point) for i in range(3)]
    origin, basis = point, [[F(data.draw(integers)) for _ in range(3)] for _ in range(2)]
    z = [F(data.draw(integers), 2) for _ in range(2)]
    image = [o + z[0] * u + z[1] * v for o, u, v in zip(origin, *basis, strict=True)]
    assert form.restrict(origin, basis).value(z) == poly.evaluate(image)


def test_higher_degree_is_refused() -> None:
    ring = Ring.of(("x",))
    assert quadratic(ring.gen(0) ** 3, [0]) is None
