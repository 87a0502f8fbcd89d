"""The motion as SciPy's piecewise polynomials."""

from __future__ import annotations

from math import comb
from typing import TYPE_CHECKING

import numpy as np

from bezier.motion.track import Array, Track
from qe.errors import Unable
from qe.extras import lacking

if TYPE_CHECKING:
    from scipy.interpolate import BSpline, PPoly

HIGH = 8
"""The degree that powers over a whole piece keep to about 14 digits; twice of it over each half."""


def bspline(track: Track) -> BSpline:
    """Degree d with d-fold inner knots: its coefficients are the control points, those at the joins once.

    A Bézier chain is a B-spline with knots of this multiplicity (Farin, "Curves and Surfaces for CAGD", chapter 8).
    """
    try:
        from scipy.interpolate import BSpline
    except ImportError as error:
        raise lacking(error) or error from None
    degree = track.control.shape[1] - 1
    knots = np.concatenate([track.breaks[:1], np.repeat(track.breaks, degree), track.breaks[-1:]])
    points = np.concatenate([track.control[0, :1], track.control[:, 1:].reshape(-1, 3)])
    return BSpline(knots, points, degree, extrapolate=False)


def ppoly(track: Track) -> PPoly:
    """The same by powers of the time since the last break; long polynomials get breaks between, as high powers over
    a long time cancel each other in floating point. Raises ``Unable`` where floating point has none of them."""
    try:
        from scipy.interpolate import PPoly
    except ImportError as error:
        raise lacking(error) or error from None
    parts = 1
    while track.control.shape[1] - 1 > HIGH * parts:
        track, parts = track.halved(), 2 * parts
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            powers = _powers(track)
    except FloatingPointError:
        raise Unable("powers of times so long or short are outside floating point; to_bspline has none") from None
    return PPoly(powers, track.breaks, extrapolate=False)


def _powers(track: Track) -> Array:
    """(d+1, n, 3), the highest power first: the coefficient of u^k is C(d, k) times the k-th difference."""
    degree, length = track.control.shape[1] - 1, np.diff(track.breaks)[:, None]
    rows = [comb(degree, k) * np.diff(track.control, n=k, axis=1)[:, 0] / length**k for k in range(degree + 1)]
    return np.array(rows[::-1])
