"""What ``bezier compare`` does inside the worker: compare, draw, write, and say it as a table or as JSON."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path as FilePath
from time import perf_counter

from bezier.compare.comparison import Comparison, compare
from bezier.compare.output import table, to_json
from bezier.planner import derivations
from bezier.planner.command import Reply
from bezier.planner.outputs import COMPARED, COMPARISON
from bezier.plans import Clock
from bezier.problem import Problem
from bezier.report.first import DRAWING
from qe.cli.shell import OK
from qe.processes.channel import Channel

PAGE, DATA = "compare.html", COMPARISON


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What the command line asked for; ``folder`` is where the files are written first, for ``target``, if at all."""

    problem: Problem
    folder: FilePath | None = None
    target: FilePath | None = None
    plots: bool = True
    json: bool = False
    timeout: float | None = None


def run(channel: Channel, request: Request) -> Reply:
    """The comparison, with its files in ``request.folder`` if there is one, and what to print."""
    clock = Clock(limit=request.timeout, listener=channel.event, note=channel.fact)
    found = compare(request.problem, clock, proofs=request.folder is not None)
    files, told = [], ""
    if request.folder is not None and request.target is not None:
        files = _write(found, request.folder, request.target, plots=request.plots)
        told = f"\n{len(files)} files in {request.target}: open {request.target / PAGE}"
    if request.json:
        return Reply(json.dumps(to_json(found, files), indent=1, ensure_ascii=False), OK)
    return Reply(table(found) + told, OK)


def _write(found: Comparison, folder: FilePath, target: FilePath, *, plots: bool) -> list[str]:
    """All files into ``folder``; the places where they will be."""
    names, drawings, first = [PAGE, DATA], {}, None
    if plots:
        start = perf_counter()
        from bezier.compare import pictures as plot_compare

        regions = plot_compare.regions_of(found)
        names += plot_compare.save(found, folder, regions)
        drawings, first = plot_compare.charts(found, regions), plot_compare.first(found)
        found = replace(found, seconds={**found.seconds, DRAWING[0]: perf_counter() - start})
    from bezier.compare.page import derivation_title, render

    files_of = found.derivation_pages
    pages = {
        files_of[name]: derivations.page(name, item, COMPARED, derivation_title(name))
        for name, item in found.derivations.items()
    }
    texts = {COMPARED: found.certificate.to_json(), **pages}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    files = [str(target / name) for name in sorted([*names, *texts])]
    (folder / PAGE).write_text(render(found, drawings, first), encoding="utf-8")
    text = json.dumps(to_json(found, files), indent=1, ensure_ascii=False)
    (folder / DATA).write_text(text + "\n", encoding="utf-8")
    return files
