"""What ``qe region`` and ``qe minimize`` do inside the worker."""

from __future__ import annotations

import json
import tempfile
import time
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qe.cli.work import Reply, Request, certificate_text, read_formula
from qe.errors import InputError, Unable
from qe.spelling import quoted
from qe.worker import Channel

if TYPE_CHECKING:
    from qe.regions.region import Region

PICTURES = (".png", ".pdf", ".svg", ".html")
LONGEST = 200
"""Characters of an exact number in texts for people."""
DIGITS = 10
"""Decimal digits shown next to an exact number; for reading only."""


def region(channel: Channel, request: Request, picture: str | None) -> Reply:
    """``qe region``: a description for people, or the region's JSON."""
    from qe import api

    if picture is not None and picture not in PICTURES:
        raise InputError(f"--plot: a file ending in {', '.join(PICTURES)} expected, {picture} found")
    start = time.perf_counter()
    formula = read_formula(channel, request.source)
    found = api.region(formula, order=request.order, timeout=request.timeout, progress=channel.event)
    seconds = time.perf_counter() - start
    files: dict[str, str | bytes] = {}
    if request.certificate:
        files["certificate"] = certificate_text(found)
    if picture is not None:
        files["plot"] = _drawn(found, picture)
    text = found.to_json() if request.json else "\n".join(_in_words(found, seconds))
    return Reply(text, files=files)


def _drawn(found: Region, ending: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"region{ending}"
        found.plot(path)
        return path.read_bytes()


def _in_words(found: Region, seconds: float) -> list[str]:
    names = ", ".join(map(quoted, found.order))
    if found.is_empty:
        return [f"empty: no real {names} satisfy the formula ({seconds:.3f} s)"]
    count = len(found.cells)
    lines = [f"{count} cell{'s' if count > 1 else ''} in {names}, dimension {found.dimension} ({seconds:.3f} s)"]
    for name in found.order:
        low, high = found.bounds(name)
        lines.append(f"{quoted(name)} from {shown(low, '-infinity')} to {shown(high, 'infinity')}")
    lines += [f"cell {k}: {cell.brief()}" for k, cell in enumerate(found.cells, 1)]
    return lines


def optimize(channel: Channel, request: Request, objective: str, maximize: bool) -> Reply:
    """``qe minimize``: the exact value, the point, and what is active there."""
    from qe import api

    start = time.perf_counter()
    solve = api.maximize if maximize else api.minimize
    constraints = read_formula(channel, request.source)
    best = solve(objective, constraints, timeout=request.timeout, progress=channel.event)
    seconds = time.perf_counter() - start
    if best.value is None:
        raise Unable(f"{best.status.name.lower()}: no {'greatest' if maximize else 'least'} value")
    files: dict[str, str | bytes] = {"certificate": certificate_text(best)} if request.certificate else {}
    if request.json:
        data = {
            "status": best.status.name.lower(),
            "value": exact_and_decimal(best.value),
            "point": {name: exact_and_decimal(value) for name, value in best.point.items()},
            "active": [best.constraints[i] for i in best.active],
            "unique": best.unique,
            "attained": best.attained,
            "multipliers": [exact_and_decimal(value) for value in best.multipliers],
            "seconds": round(seconds, 6),
        }
        return Reply(json.dumps(data, indent=2, ensure_ascii=False), files=files)
    lines = [f"value {shown(best.value)}"]
    lines += [f"{quoted(name)} = {shown(value)}" for name, value in best.point.items()]
    lines.append(f"active: {', '.join(best.constraints[i] for i in best.active) or 'nothing'}")
    if best.attained is False:
        lines.append("not attained: the value is a limit")
    lines.append(f"proved optimal in {seconds:.3f} s")
    return Reply("\n".join(lines), files=files)


def shown(value: object, unbounded: str = "") -> str:
    """An exact number, with a decimal next to it unless it is an integer."""
    if value is None:
        return unbounded
    text = str(value)
    if len(text) > LONGEST:
        return f"about {decimal(value)} (the exact text has {len(text)} characters)"
    return text if text.lstrip("-").isdigit() else f"{text} (about {decimal(value)})"


def decimal(value: Any) -> str:
    """The first digits of a number."""
    return f"{float(value):.{DIGITS}g}"


def exact_and_decimal(value: object) -> dict[str, str]:
    """Both forms of a number, for machines."""
    return {"exact": str(Fraction(value) if isinstance(value, int) else value), "decimal": decimal(value)}
