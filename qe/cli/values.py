"""Values of a command line that are taken as they are: with a minus sign in front, and without the library by which
typer converts the others."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any

from qe import arguments

_NATURAL = re.compile(r"0|[1-9][0-9]{0,14}")
_DECIMAL = re.compile(r"[0-9]{1,9}(\.[0-9]{1,9})?")


def take_leading_minus(command: Any) -> None:
    """Let a command, and those inside it, take ``-5`` and ``-x^2`` for what they are: no options, which have two minus
    signs (or are one letter that the command knows)."""
    inner = getattr(command, "commands", {})
    for one in inner.values():
        take_leading_minus(one)
    if not inner:
        command.context_settings["ignore_unknown_options"] = True


def take_plain_values(command: Any) -> None:
    """Let the parameters of a command, and of those inside it, take plain values as they are: typer has pydantic
    convert every value, and loading that takes longer than many a problem. What is not certainly plain still goes
    there."""
    for inner in getattr(command, "commands", {}).values():
        take_plain_values(inner)
    listed = command.get_params

    def get_params(context: Any) -> list[Any]:
        parameters: list[Any] = listed(context)
        for parameter in parameters:
            converter = getattr(parameter, "get_runtime_param", None)
            if converter is not None and not isinstance(converter, partial):
                parameter.get_runtime_param = partial(_Plain, parameter, converter)
        return parameters

    command.get_params = get_params


class _Plain:
    """In the place of typer's own converter of a parameter, which ``converter`` makes when it is needed."""

    def __init__(self, parameter: Any, converter: Callable[[], Any]) -> None:
        self._parameter, self._converter = parameter, converter

    def coerce(self, value: Any, **context: Any) -> Any:
        """The value for the command. Raises what typer raises."""
        described = self._parameter.type_descriptor
        if described.annotation is Path and isinstance(value, str):
            arguments.path(value, self._parameter.opts[0])  # no name at all, and names that no system takes
        several = self._parameter.multiple or self._parameter.nargs != 1
        if several or not _is_plain(value, described.annotation, described.parameter_info):
            return self._converter().coerce(value, **context)
        if value is None or isinstance(value, described.annotation):
            return value
        return described.annotation(value)


def _is_plain(value: object, annotation: Any, asked: Any) -> bool:
    """Whether the value is of the type asked for, or a text that means just one value of it."""
    if value is None:
        return True
    if any((asked.parser, asked.min, asked.max, asked.exists, asked.writable)) or not isinstance(annotation, type):
        return False
    text = value if type(value) is str else ""
    if annotation is str:
        return type(value) is str
    if annotation is int:
        return type(value) is int or _NATURAL.fullmatch(text) is not None
    if annotation is float:
        return type(value) is float or _DECIMAL.fullmatch(text) is not None
    if annotation is Path:
        named = isinstance(value, Path) or (text.isprintable() and text != "")
        return named and (not os.path.exists(str(value)) or os.access(str(value), os.R_OK))
    if issubclass(annotation, Enum):
        return isinstance(value, annotation) or text in [member.value for member in annotation]
    return False
