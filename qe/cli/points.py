"""What ``qe find``, ``qe witnesses`` and ``qe equivalent`` do inside the worker."""

from __future__ import annotations

import time

from qe.cli.source import Source
from qe.cli.work import Reply, Request, in_json, read_question, with_products
from qe.errors import Unable
from qe.exact.number import point_text
from qe.exact.radicals import radical_text
from qe.processes.channel import Channel


def find(channel: Channel, request: Request, n: int, seed: int) -> Reply:
    """``qe find``: a point a line; ``none`` where there is no point."""
    import qe.api.solve as api

    if request.certificate:
        raise Unable("points have no certificate of their own; --check proves them")
    start = time.perf_counter()
    formula, known = read_question(channel, *with_products(request.source))
    points = api.find(formula, n, seed=seed, **request.keywords(channel, formula, known))
    listed = [{name: str(value) for name, value in point.items()} for point in points]
    lines = [point_text({name: radical_text(value) for name, value in p.items()}) or "true" for p in points]
    data = {"status": "solved", "points": listed, "seconds": round(time.perf_counter() - start, 6)}
    text = in_json(data) if request.json else "\n".join(lines) or "none"
    return Reply(text, verdict="checked" if request.check else "")  # or an error was raised


def witnesses(channel: Channel, request: Request) -> Reply:
    """``qe witnesses``: guarded terms, one case a line."""
    import qe.api.solve as api
    from qe.api.input import read_block

    start = time.perf_counter()
    source = request.source
    _, known = read_question(channel, source)
    block, _ = read_block(source.text, source.format.value)
    listed = api.witnesses(block, **request.keywords(channel, block, known))
    cases = [{"guard": str(one.guard), "terms": dict(one.terms)} for one in listed]
    data = {"status": "solved", "witnesses": cases, "seconds": round(time.perf_counter() - start, 6)}
    return request.reply(listed.answer, "\n".join(map(str, listed)) or "none", data)


def equivalent(channel: Channel, request: Request, other: Source) -> Reply:
    """``qe equivalent``: true or false."""
    from qe.api.decide import compared

    start = time.perf_counter()
    one, known = read_question(channel, request.source)
    two, also = read_question(channel, other)
    keywords = request.keywords(channel, one, known)
    keywords["assuming"] = [also] if keywords["assuming"] is None else [also, keywords["assuming"]]
    answer = compared(one, two, keywords)
    data = {"status": "solved", "truth": answer.truth, "seconds": round(time.perf_counter() - start, 6)}
    return request.reply(answer, "true" if answer.truth else "false", data)
