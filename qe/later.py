"""How a value reaches modules that are built on it: its operators and pictures need the engine, which knows the value.

``qe`` itself, which Python loads before any of its parts and which knows all of them, says what each name stands for
(``provide``); a method asks for it when it is called (``later``).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_PROVIDED: dict[str, Callable[[], Any]] = {}


def provide(name: str, load: Callable[[], Any]) -> None:
    """Set what a name stands for; loaded when it is asked for, not before."""
    _PROVIDED[name] = load


def later(name: str) -> Any:
    """What the name stands for."""
    return _PROVIDED[name]()
