"""What ``qe find``, ``qe witnesses`` and ``qe equivalent`` do inside the worker."""

from __future__ import annotations

from dataclasses import replace

from qe.cli.source import Source
from qe.cli.work import Reply, Request, in_json, read_question
from qe.exact.number import point_text
from qe.exact.radicals import radical_text
from qe.processes.channel import Channel


def find(channel: Channel, request: Request, n: int, seed: int) -> Reply:
    """``qe find``: a point a line; ``none`` where there is no point."""
    import qe.api.solve as api

    formula, keywords = request.read(channel)
    points = api.find(formula, n, seed=seed, **keywords)
    listed = [{name: str(value) for name, value in point.items()} for point in points]
    lines = [point_text({name: radical_text(value) for name, value in p.items()}) or "true" for p in points]
    data = request.data(points=listed)
    text = in_json(data) if request.json else "\n".join(lines) or "none"
    return Reply(text, verdict="checked" if request.check else "")  # or an error was raised


def witnesses(channel: Channel, request: Request) -> Reply:
    """``qe witnesses``: guarded terms, one case a line."""
    import qe.api.solve as api
    from qe.api.input import read_block

    _, keywords = request.read(channel)
    block, _ = read_block(request.source.text, request.source.format.value)
    listed = api.witnesses(block, **keywords)
    cases = [{"guard": str(one.guard), "terms": dict(one.terms)} for one in listed]
    data = request.data(witnesses=cases)
    return request.reply(listed.answer, "\n".join(map(str, listed)) or "none", data)


def equivalent(channel: Channel, request: Request, other: Source) -> Reply:
    """``qe equivalent``: true or false."""
    from qe.api.decide import compared

    one, keywords, text = request.read(channel, other.text)
    two, also = read_question(channel, replace(other, text=text))
    keywords["assuming"] = [also] if keywords["assuming"] is None else [also, keywords["assuming"]]
    answer = compared(one, two, keywords)
    data = request.data(truth=answer.truth)
    return request.reply(answer, "true" if answer.truth else "false", data)
