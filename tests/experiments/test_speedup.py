"""What helpers gain: the bounds that processor times give."""

from __future__ import annotations

import pytest

from experiments import speedup
from experiments.speedup import Speedup, measured


def test_the_bounds_of_the_speedup() -> None:
    found = Speedup(20.0, 21.0, 1.0, 0.5, (9.0, 8.5), 14.0, True)
    least, most = found.bounds
    assert least == pytest.approx(20 / 10.5) and most == pytest.approx(20 / 9.5)
    assert "this process 1.0 s (5 % of alone)" in str(found) and "on the clock, as it was: 1.50" in str(found)


def test_the_fuller_worker_and_this_process_bound_the_gain() -> None:
    assert Speedup(20.0, 20.0, 1.0, 0.5, (16.0, 1.0), 20.0, True).bounds[1] == pytest.approx(20 / 16)
    assert Speedup(20.0, 20.0, 15.0, 0.5, (3.0, 1.0), 20.0, True).bounds[1] == pytest.approx(20 / 15)


def test_answer_and_certificate_are_those_of_one_process(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    found = measured("ex z. x*y*z > 1 and x^2 + y^2 + z^2 < 4", 1)
    assert found.same and found.alone > 0 and len(found.workers) == 1
    monkeypatch.setattr(speedup, "_timed", lambda question, method, address: (_Told(address), 1.0, 1.0))
    assert "same answer and certificate: NO" in str(measured("x > 0", 1))


class _Told:
    """An answer that depends on where it was found."""

    def __init__(self, address: str | None) -> None:
        self.formula, self.certificate = address, None
