"""``.npz``: the motion as numpy arrays."""

from __future__ import annotations

import io

import numpy as np

from bezier.motion.track import Track

ROWS = 151


def npz(track: Track, rows: int = ROWS) -> bytes:
    """A file for ``numpy.load``, without pickles.

    ``time`` (rows,), ``position``, ``velocity``, ``acceleration`` (rows, 3), and the motion itself as Bézier pieces:
    ``breaks`` (n+1,) and ``control`` (n, d+1, 3).
    """
    time = np.linspace(0.0, track.end, rows)
    file = io.BytesIO()
    np.savez_compressed(
        file,
        time=time,
        position=track.at(time),
        velocity=track.derivative.at(time),
        acceleration=track.derivative.derivative.at(time),
        breaks=track.breaks,
        control=track.control,
    )
    return file.getvalue()
