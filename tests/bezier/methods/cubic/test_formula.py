"""Formula (7) of the paper as printed: its quantifier-free answer, with numbers and with symbols, and its existence
theorem, which the engine finds."""

from __future__ import annotations

from collections.abc import Sequence

import qe
from qe.api.input import read_formula
from qe.formula.build import convert
from qe.formula.traverse import ring_of
from tests.tables import each

AXES = "xyz"


def printed(q0: Sequence[object], r0: Sequence[object], radius_squared: str) -> str:
    """(7): the quantified control points are P1, P2, R1, R2; 4 equations per axis, 6 norms."""
    n = len(q0)
    points = {name: [f"{name}{a}" for a in AXES[:n]] for name in ("p1", "p2", "q1", "q2", "r1", "r2")}
    p1, p2, q1, q2, r1, r2 = points.values()
    parts = []
    for i in range(n):
        a, b = f"({q0[i]})", f"({r0[i]})"
        parts += [f"{p1[i]} = 4*{a} - 4*{q1[i]} + {q2[i]}", f"{p2[i]} = 2*{a} - {q1[i]}"]
        parts += [f"{r1[i]} = 2*{b} - {q2[i]}", f"{r2[i]} = {q1[i]} - 4*{q2[i]} + 4*{b}"]
    parts += [" + ".join(f"{c}^2" for c in point) + f" <= {radius_squared}" for point in points.values()]
    return f"ex {', '.join(p1 + p2 + r1 + r2)}. " + " and ".join(parts)


def six_norms(q0: Sequence[object], r0: Sequence[object], radius_squared: str) -> str:
    """The answer worked out by hand: six norms of linear combinations of Q0, R0, Q1, Q2."""
    forms = ((4, 0, -4, 1), (2, 0, -1, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0, 2, 0, -1), (0, 4, 1, -4))
    norms = []
    for a, b, c, d in forms:
        squares = [f"({a}*({q0[i]}) + {b}*({r0[i]}) + {c}*q1{x} + {d}*q2{x})^2" for i, x in enumerate(AXES[: len(q0)])]
        norms.append(f"{' + '.join(squares)} <= {radius_squared}")
    return " and ".join(norms)


def symbols(name: str, n: int) -> list[str]:
    return [f"{name}{a}" for a in AXES[:n]]


@each(
    ((-1, 3, 3), (1, 3, 3), "27"),
    (("1/2", "-3/7", 2), (0, 0, "5/3"), "9"),
    (symbols("q0", 3), symbols("r0", 3), "r^2"),
    (symbols("q0", 2), symbols("r0", 2), "r^2"),
)
def test_answer_as_printed(q0: Sequence[object], r0: Sequence[object], square: str) -> None:
    answer = qe.eliminate(printed(q0, r0, square))
    assert answer.formula is not None
    expected = read_formula(six_norms(q0, r0, square))
    ring = ring_of(expected)
    assert set(convert(answer.formula, ring).args) == set(expected.args)


def existence(n: int, *, factor: int = 1) -> str:
    """For all Q0, R0 in the ball of radius r (or ``factor`` times as far out): (7) has a solution."""
    q0, r0 = symbols("q0", n), symbols("r0", n)
    inside = [" + ".join(f"{c}^2" for c in point) + f" <= {factor}*r^2" for point in (q0, r0)]
    chosen = symbols("q1", n) + symbols("q2", n)
    formula = f"ex {', '.join(chosen)}. {printed(q0, r0, 'r^2')}"
    return f"all {', '.join(q0 + r0)}, r. {' and '.join(inside)} and r >= 0 -> ({formula})"


@each(2, 3)
def test_existence_theorem_is_found(n: int) -> None:
    answer = qe.eliminate(existence(n), timeout=120)
    assert answer.truth is True
    told = " ".join(answer.stats["plan"])
    assert f"q1{AXES[n - 1]} = q0{AXES[n - 1]}" in told and "q2x = r0x" in told


def test_existence_theorem_with_an_offered_witness() -> None:
    right = {f"q1{a}": f"q0{a}" for a in "xy"} | {f"q2{a}": f"r0{a}" for a in "xy"}
    assert qe.check_witness(existence(2), right) is True
    assert qe.check_witness(existence(2), right | {"q1x": "(q0x + r0x)/2"}) is False


def test_no_existence_outside_the_ball() -> None:
    """Via points beyond the radius: 2 Q0 - Q1 and Q1 cannot both be inside, and no witness is found for it."""
    from qe.elimination.witness import find
    from qe.options import Budget

    assert find(read_formula(existence(2, factor=2)), budget=Budget(20)) is None
