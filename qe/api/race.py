"""Elimination methods raced: each in a process of its own, the first answer wins."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from qe.options import Budget, Method
from qe.processes.channel import Channel
from qe.processes.limits import Limits
from qe.processes.racing import first
from qe.proof.answer import Answer, Status


def raced(asked: Callable[[Method, Budget], Answer], methods: Iterable[Method], limits: Limits) -> Answer:
    """The first answer that ``asked``, which can be pickled, has by one of the methods, within the limits; UNABLE, with
    the reasons of all, where none has one."""
    unproved: list[Answer] = []
    order = sorted(methods, key=lambda method: method.value)
    works = {method: partial(_attempt, asked, method) for method in order}
    winner, answers = first(works, lambda answer: answer.status is Status.SOLVED, limits, kept=unproved.append)
    answer = None if winner is None else answers[winner]
    if winner is not None and isinstance(answer, Answer):
        others = ", ".join(method.value for method in order if method is not winner)
        answer.log.choice("", (), f"the first answer was that of {winner.value}, ahead of {others or 'no other'}")
        return answer
    if unproved:
        return unproved[0]
    reasons = [f"{method.value}: {_reason(answers.get(method))}" for method in order]
    return Answer(Status.UNABLE, None, reason="; ".join(reasons))


def _reason(outcome: object) -> str:
    if isinstance(outcome, Answer):
        return outcome.reason
    return "its process ended without an answer" if outcome is None else str(outcome)


def _attempt(asked: Callable[[Method, Budget], Answer], method: Method, channel: Channel) -> Answer:
    return asked(method, channel.budget())
