"""Pictures of regions: files of the right kind, ends followed where they should be, clear refusals."""

from __future__ import annotations

from pathlib import Path

import pytest

import qe
from qe.errors import InputError
from qe.regions.ends import ends
from tests.tables import each


@each(
    "x^2 < 2 and x /= 0 or x = 3",
    "x^2 + y^2 <= 4 and (x - 1)^2 + y^2 < 4 or x = 3 and y = 1",
    "y > x^2",
    "y^2 < x^3 - x",
    "x^2 + y^2 + z^2 <= 4 and x + y + z >= 1",
    "x^2 < 0",
)
def test_one_to_three_variables(text: str, tmp_path: Path) -> None:
    path = tmp_path / "region.png"
    qe.region(text).plot(path)
    assert path.read_bytes().startswith(b"\x89PNG")
    assert path.stat().st_size > 5000


def test_other_formats(tmp_path: Path) -> None:
    region = qe.region("x^2 + y^2 <= 1")
    region.plot(tmp_path / "r.svg")
    region.plot(str(tmp_path / "r.pdf"))
    assert "<svg" in (tmp_path / "r.svg").read_text()
    assert (tmp_path / "r.pdf").read_bytes().startswith(b"%PDF")


def test_refusals(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="1 to 3 variables"):
        qe.region("a + b + c + d > 0").plot(tmp_path / "r.png")
    with pytest.raises(InputError, match="ending in"):
        qe.region("x > 0").plot(tmp_path / "r.doc")


def test_ends_are_followed() -> None:
    """On the circle x^2 + y^2 = 4 the ends over x are -sqrt(4 - x^2) and sqrt(4 - x^2)."""
    (piece,) = qe.region("x^2 + y^2 <= 4", order=("x", "y")).cells
    for x in (-1.5, 0.0, 1.0):
        low, high = ends(piece, 1, {0: x}, (-9.0, 9.0))
        assert high == pytest.approx((4 - x * x) ** 0.5)
        assert low == pytest.approx(-high)


def test_double_roots_count_once_over_a_single_value() -> None:
    """y^2 < x^3 - x: where the oval has its extreme y, x starts at the branch, not at the oval's double root."""
    pieces = [p for p in qe.region("y^2 < x^3 - x", order=("y", "x")).cells if p.ranges[0].is_point]
    assert len(pieces) == 2
    for piece in pieces:
        y = float(piece.sample["y"])
        low, _ = ends(piece, 1, {0: y}, (-9.0, 9.0))
        assert low == pytest.approx(2 / 3**0.5)
