"""What ``qe find``, ``qe witnesses`` and ``qe equivalent`` do inside the worker."""

from __future__ import annotations

import json
import time
from typing import Any

from qe.cli.source import Source
from qe.cli.work import Reply, Request, certificate_text, read_question
from qe.errors import Unable
from qe.processes.channel import Channel
from qe.spelling import quoted


def find(channel: Channel, request: Request, n: int, seed: int) -> Reply:
    """``qe find``: a point a line; ``none`` where there is no point."""
    import qe.api.solve as api

    if request.certificate:
        raise Unable("points have no certificate of their own; --check proves them")
    start = time.perf_counter()
    formula, known = read_question(channel, request.source)
    points = api.find(formula, n, seed=seed, **request.keywords(channel, formula, known))
    listed = [{name: str(value) for name, value in point.items()} for point in points]
    verdict = "checked" if request.check else ""
    if request.json:
        return _json({"status": "solved", "points": listed}, start, verdict=verdict)
    lines = [", ".join(f"{quoted(name)} = {value}" for name, value in p.items()) or "true" for p in listed]
    return Reply("\n".join(lines) or "none", verdict=verdict)


def witnesses(channel: Channel, request: Request) -> Reply:
    """``qe witnesses``: guarded terms, one case a line."""
    import qe.api.solve as api
    from qe.api.input import read_block

    start = time.perf_counter()
    source = request.source
    _, known = read_question(channel, source)
    block, _ = read_block(source.text, source.format.value)
    listed = api.witnesses(block, **request.keywords(channel, block, known))
    files = {"certificate": certificate_text(listed.answer)} if request.certificate else {}
    verdict = request.verdict(listed.answer)
    if request.json:
        cases = [{"guard": str(one.guard), "terms": dict(one.terms)} for one in listed]
        return _json({"status": "solved", "witnesses": cases}, start, files, verdict)
    return Reply("\n".join(map(str, listed)) or "none", files=files, verdict=verdict)


def equivalent(channel: Channel, request: Request, other: Source) -> Reply:
    """``qe equivalent``: true or false."""
    from qe.api.decide import compared

    start = time.perf_counter()
    one, known = read_question(channel, request.source)
    two, also = read_question(channel, other)
    keywords = request.keywords(channel, one, known)
    keywords["assuming"] = [also] if keywords["assuming"] is None else [also, keywords["assuming"]]
    answer = compared(one, two, keywords)
    files = {"certificate": certificate_text(answer)} if request.certificate else {}
    if request.json:
        return _json({"status": "solved", "truth": answer.truth}, start, files, request.verdict(answer))
    return Reply("true" if answer.truth else "false", files=files, verdict=request.verdict(answer))


def _json(data: dict[str, Any], start: float, files: Any = None, verdict: str = "") -> Reply:
    data["seconds"] = round(time.perf_counter() - start, 6)
    return Reply(json.dumps(data, indent=2, ensure_ascii=False), files=files or {}, verdict=verdict)
