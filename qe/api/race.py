"""Elimination methods raced: each in a process of its own, the first answer wins."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from qe.options import Budget, Method
from qe.processes.racing import first
from qe.processes.worker import Channel
from qe.proof.answer import Answer, Status


def raced(asked: Callable[[Method, Budget], Answer], methods: Iterable[Method], budget: Budget) -> Answer:
    """The first answer that ``asked`` has by one of the methods; UNABLE, with the reasons of all, where none has one.

    To be called in a worker process, which the processes of the methods do not outlive.
    """

    unproved: list[Answer] = []

    def attempt(method: Method, channel: Channel) -> Answer:
        return asked(method, Budget(budget.remaining(), listener=channel.event, keep=channel.keep))

    def keep(answer: Answer) -> None:
        unproved.append(answer)
        budget.keep(unproved[0])

    order = sorted(methods, key=lambda method: method.value)
    winner, found = first(
        {method: partial(attempt, method) for method in order},
        lambda answer: answer.status is Status.SOLVED,
        seconds=budget.remaining(),
        progress=budget.listener,
        kept=keep,
    )
    answer = None if winner is None else found[winner]
    if winner is not None and isinstance(answer, Answer):
        others = ", ".join(method.value for method in order if method is not winner)
        answer.log.choice("", (), f"the first answer was that of {winner.value}, ahead of {others or 'no other'}")
        return answer
    if unproved:
        return unproved[0]
    reasons = [f"{method.value}: {_reason(found.get(method))}" for method in order]
    return Answer(Status.UNABLE, None, reason="; ".join(reasons))


def _reason(outcome: object) -> str:
    if isinstance(outcome, Answer):
        return outcome.reason
    return "its process ended without an answer" if outcome is None else str(outcome)
