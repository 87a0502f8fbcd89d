"""Pictures of regions: files of the right kind, ends followed where they should be, clear refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import qe
from qe.errors import InputError
from qe.report.picture import root


@pytest.mark.parametrize(
    "text",
    [
        "x^2 < 2 and x /= 0 or x = 3",
        "x^2 + y^2 <= 4 and (x - 1)^2 + y^2 < 4 or x = 3 and y = 1",
        "y > x^2",
        "y^2 < x^3 - x",
        "x^2 + y^2 + z^2 <= 4 and x + y + z >= 1",
        "x^2 < 0",
    ],
)
def test_one_to_three_variables(tmp_path: Path, text: str) -> None:
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
    with pytest.raises(InputError, match="ending"):
        qe.region("x > 0").plot(tmp_path / "r.doc")


def test_ends_are_followed() -> None:
    """On the circle x^2 + y^2 = 4 the ends over x are -sqrt(4 - x^2) and sqrt(4 - x^2)."""
    (piece,) = qe.region("x^2 + y^2 <= 4", order=("x", "y")).cells
    x = np.linspace(-2, 2, 9)
    low, high = (root(end, [x]) for end in (piece.ranges[1].lower, piece.ranges[1].upper))
    assert np.allclose(high, np.sqrt(4 - x * x))
    assert np.allclose(low, -high)


def test_the_middle_root_of_a_cubic() -> None:
    """Between its outer roots, y^3 - y = x has its middle root where |x| is small."""
    region = qe.region("y^3 - y = x and y^2 < 1/3", order=("x", "y"))
    piece = next(p for p in region.cells if not p.ranges[0].is_point)
    x = np.array([-0.2, 0.0, 0.2])
    y = root(piece.ranges[1].lower, [x])
    assert np.allclose(y**3 - y, x)
    assert np.all(np.abs(y) < 0.58)
