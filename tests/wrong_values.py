"""Values of every kind, for arguments that want something else."""

from __future__ import annotations

import math

WRONG: dict[str, object] = {
    "int": 5,
    "huge": 10**5000,
    "negative": -1,
    "zero": 0,
    "float": 0.5,
    "nan": math.nan,
    "inf": math.inf,
    "bool": True,
    "none": None,
    "complex": 1j,
    "text": "no such thing",
    "digits": "10",
    "empty": "",
    "bytes": b"x > 0",
    "list": [],
    "dict": {},
    "set": {1},
    "nested": [[1]],
    "object": object(),
    "function": len,
    "class": int,
    "error": ValueError("x"),
    "module": math,
}
