"""Medians, PAR-2, growth and gains against numbers worked out by hand."""

import pytest

from experiments import measures
from experiments.results import Log, Status
from tests.experiments.test_results import result
from tests.tables import each


def log_of(*rows) -> Log:
    log = Log()
    for row in rows:
        log.results[row.key] = row
    return log


def test_par2_counts_unsolved_twice():
    assert measures.par2([result(seconds=3), result(status="timeout", limit=10), result(status="WRONG", limit=4)]) == 31


@each(
    ([(1, "solved"), (9, "solved"), (2, "solved")], 2, Status.SOLVED),
    ([(1, "solved"), (9, "timeout"), (9, "timeout")], 9, Status.TIMEOUT),
    ([(1, "solved"), (9, "timeout")], 9, Status.TIMEOUT),
    ([(1, "solved"), (2, "WRONG"), (3, "solved")], 2, Status.WRONG),
)
def test_repetitions(rows, seconds, status):
    row = measures.combined([result(seconds=s, status=t, repeat=i) for i, (s, t) in enumerate(rows)])
    assert (row.seconds, row.status) == (seconds, status)


def test_ratio_over_what_both_solved():
    mine = {"a": result(seconds=1), "b": result(seconds=2), "c": result(status="timeout"), "d": result(seconds=0)}
    other = {"a": result(seconds=3), "b": result(seconds=20), "c": result(), "e": result()}
    assert measures.median_ratio(mine, other) == pytest.approx(6.5)
    assert measures.median_ratio(mine, {}) is None


def test_growth_of_a_power_and_of_an_exponential():
    cubic = measures.growth([(n, 0.01 * n**3) for n in (2, 4, 8, 16)])
    assert cubic.exponent == pytest.approx(3) and cubic.exponent_fit == pytest.approx(1) and cubic.base_fit < 0.99
    doubling = measures.growth([(n, 0.01 * 2**n) for n in (2, 4, 8, 16)])
    assert doubling.base == pytest.approx(2) and doubling.base_fit == pytest.approx(1)
    assert measures.growth([(2, 1.0), (3, 2.0), (3, 2.5)]) is None
    assert measures.growth([(n, 0.5) for n in (1, 2, 3)]).exponent == pytest.approx(0)


def test_groups_keep_families_apart():
    rows = [result(set="paper/a", id="x"), result(set="paper/b", id="x"), result(set="public", solver="qepcad")]
    groups = measures.by_group(log_of(*rows))
    assert set(groups) == {"paper", "public"} and set(groups["paper"]["ours"]) == {"paper/a/x", "paper/b/x"}


def test_solvers_stand_in_a_fixed_order():
    rows = [result(solver=name) for name in ("yices", "new", "ours-cad", "qepcad", "ours")]
    assert list(measures.by_set(log_of(*rows))["s"]) == ["ours", "ours-cad", "qepcad", "yices", "new"]


def test_what_a_stage_is_worth():
    without = "ours-without-equations"
    rows = [
        result(id="a", seconds=1),
        result(id="a", seconds=4, solver=without),
        result(id="b", seconds=1),
        result(id="b", status="timeout", limit=10, solver=without),
        result(id="c", seconds=1),
    ]
    (gain,) = measures.gains(measures.by_set(log_of(*rows)).values())
    assert (gain.stage, gain.problems, gain.lost) == ("equations", 2, 1)
    assert (gain.median_ratio, gain.seconds_with, gain.seconds_without) == (4, 2, 24)
