"""What ``qe region`` does inside the worker."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from qe.cli.numbers import shown
from qe.cli.work import Reply, Request
from qe.errors import InputError
from qe.processes.channel import Channel
from qe.spelling import quoted

if TYPE_CHECKING:
    from qe.regions.region import Region

PICTURES = (".png", ".pdf", ".svg", ".html")


def region(channel: Channel, request: Request, picture: str | None) -> Reply:
    """``qe region``: a description for people, or the region's JSON."""
    import qe.api.eliminate as api

    if picture is not None and picture not in PICTURES:
        raise InputError(f"--plot: a file ending in {', '.join(PICTURES)} expected, {picture} found")
    formula, keywords = request.read(channel)
    solution_set = api.region(formula, **keywords)
    files: dict[str, str | bytes] = {"certificate": solution_set.proof.to_json()} if request.certificate else {}
    if picture is not None:
        files["plot"] = _drawn(solution_set, picture)
    text = solution_set.to_json() if request.json else "\n".join(_in_words(solution_set, request.seconds))
    return Reply(text, files=files, verdict=request.verdict(solution_set))


def solve(channel: Channel, request: Request, variables: tuple[str, ...] | None) -> Reply:
    """``qe solve``."""
    import qe.api.solve as api_solve
    from qe.io.text import solved_for

    variables = variables or solved_for(request.source.text)
    formula, keywords = request.read(channel, solved=variables or ())
    solutions = api_solve.solve(formula, variables, **keywords)
    data = request.data(variables=list(solutions.order), cases=list(solutions.lines))
    return request.reply(solutions, str(solutions), data)


def _drawn(drawn: Region, ending: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"region{ending}"
        drawn.plot(path)
        return path.read_bytes()


def _in_words(described: Region, seconds: float) -> list[str]:
    names = ", ".join(map(quoted, described.order))
    if described.is_empty:
        return [f"empty: no real {names} satisfy the formula ({seconds:.3f} s)"]
    count = len(described.cells)
    lines = [f"{count} cell{'s' if count > 1 else ''} in {names}, dimension {described.dimension} ({seconds:.3f} s)"]
    for name in described.order:
        low, high = described.bounds(name)
        lines.append(f"{quoted(name)} from {shown(low, '-infinity')} to {shown(high, 'infinity')}")
    lines += [f"cell {k}: {cell.brief()}" for k, cell in enumerate(described.cells, 1)]
    return [*lines, f"not proved: {described.reason}"] if described.reason else lines
