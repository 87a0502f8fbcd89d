"""The filter of the authors' test points, and their published data where they are present."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest

from bezier.arm.inverse import solve
from bezier.arm.reader import load_arm
from paper_repro import drawn_points, published
from tests.tables import each


def test_the_reach_is_that_of_the_arm() -> None:
    points = np.random.default_rng(3).integers((-330, -330, -100), (330, 330, 450), (60, 3))
    arm = load_arm("ev3-112")
    counts = [solve(arm, [int(c) for c in p]).is_reachable for p in points]
    assert counts == drawn_points.reaches(*points.T.astype(float)).tolist()
    assert 10 < sum(counts) < 50


def test_bounds_of_the_share_hold_the_share_and_shrink() -> None:
    x, y, z = np.random.default_rng(4).uniform((-200, -200, 0), (200, 200, 300), (300_000, 3)).T
    reached, passed = drawn_points.reaches(x, y, z), drawn_points.passes(x, y, z)
    share = np.count_nonzero(reached & ~passed) / np.count_nonzero(reached)
    bounds = [drawn_points.share_thrown_away(cells) for cells in (101, 301, 901)]
    for low, high in bounds:
        assert low - 2e-3 < share < high + 2e-3
    for (low, high), (inner_low, inner_high) in itertools.pairwise(bounds):
        assert low < inner_low < inner_high < high


def test_absent_data_are_no_data(tmp_path: Path) -> None:
    assert published.rows("queries_L112", tmp_path) == []
    assert published.segments("cgs_F_L112", tmp_path) == []
    (tmp_path / "some.jsonl").write_text('{"x": "1/2"}\n')
    assert published.rows("some", tmp_path) == [{"x": "1/2"}]


@each("arm-no-point-without", "arm-mean-errors", "arm-51-points")
def test_the_checks_do_without_the_data(key: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from paper_repro.claim import examine
    from paper_repro.claims import CLAIMS

    monkeypatch.setattr(published, "rows", lambda name: [])
    (given,) = (c for c in CLAIMS if c.key == key)
    entry = examine(given)
    assert entry.evidence and not entry.failures
