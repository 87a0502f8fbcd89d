"""What ``qe region``, ``solve``, ``find``, ``witnesses`` and ``equivalent`` do inside the worker."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import qe.api.eliminate as api_eliminate
import qe.api.solve as api_solve
from qe.api.decide import compared
from qe.api.input import read_block
from qe.cli.numbers import shown
from qe.cli.source import Reply, Request, Source, in_json, read_question
from qe.errors import InputError
from qe.exact.number import point_text
from qe.exact.radicals import radical_text
from qe.io.text import solved_for
from qe.processes.channel import Channel
from qe.regions.region import Region
from qe.spelling import quoted

PICTURES = (".png", ".pdf", ".svg", ".html")


def region(channel: Channel, request: Request, picture: str | None) -> Reply:
    """``qe region``: a description for people, or the region's JSON."""
    if picture is not None and picture not in PICTURES:
        raise InputError(f"--plot: a file ending in {', '.join(PICTURES)} expected, {picture} found")
    formula, keywords = request.read(channel)
    solution_set = api_eliminate.region(formula, **keywords)
    files: dict[str, str | bytes] = {"certificate": solution_set.proof.to_json()} if request.certificate else {}
    if picture is not None:
        files["plot"] = _drawn(solution_set, picture)
    text = solution_set.to_json() if request.json else "\n".join(_in_words(solution_set, request.seconds))
    return Reply(text, files=files, verdict=request.verdict(solution_set))


def solve(channel: Channel, request: Request, variables: tuple[str, ...] | None) -> Reply:
    """``qe solve``."""
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


def find(channel: Channel, request: Request, n: int, seed: int) -> Reply:
    """``qe find``: a point a line; ``none`` where there is no point."""
    formula, keywords = request.read(channel)
    points = api_solve.find(formula, n, seed=seed, **keywords)
    listed = [{name: str(value) for name, value in point.items()} for point in points]
    lines = [point_text({name: radical_text(value) for name, value in p.items()}) or "true" for p in points]
    data = request.data(points=listed)
    text = in_json(data) if request.json else "\n".join(lines) or "none"
    return Reply(text, verdict="checked" if request.check else "")  # or an error was raised


def witnesses(channel: Channel, request: Request) -> Reply:
    """``qe witnesses``: guarded terms, one case a line."""
    _, keywords = request.read(channel)
    block, _ = read_block(request.source.text, request.source.format.value)
    listed = api_solve.witnesses(block, **keywords)
    cases = [{"guard": str(one.guard), "terms": dict(one.terms)} for one in listed]
    data = request.data(witnesses=cases)
    return request.reply(listed.answer, "\n".join(map(str, listed)) or "none", data)


def equivalent(channel: Channel, request: Request, other: Source) -> Reply:
    """``qe equivalent``: true or false."""
    one, keywords, text = request.read(channel, other.text)
    two, also = read_question(channel, replace(other, text=text))
    keywords["assuming"] = [also] if keywords["assuming"] is None else [also, keywords["assuming"]]
    answer = compared(one, two, keywords)
    data = request.data(truth=answer.truth)
    return request.reply(answer, "true" if answer.truth else "false", data)
