"""What values offer by modules that are built on them: operators, pictures, forms for SymPy, theorems of rules.

A value stands in a lower row than the module that does this for it, and imports nothing of it. So the service has a
name here; ``qe`` itself, which Python loads before any of its parts and which knows all of them, says where each of
them is (``provide``), and a method of the value looks it up when it is called (``service``). Nowhere else is anything
registered for later.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum
from typing import Any


class Service(Enum):
    """The services. ``qe`` has to provide all of them."""

    CONNECTED = "formulas connected by an operator of Python"
    SUBSTITUTED = "a formula with terms in the place of variables"
    COMPARISON = "a comparison as people write it"
    WRITTEN = "a formula in one of the formats"
    SYMPY = "a value as SymPy writes it"
    REGION = "the solution set of a formula"
    REGION_OPERATORS = "the module with the operators of regions"
    PARTIAL_PICTURE = "a picture of an answer in parts"
    TRUSTS = "what a certificate needs besides the primitives of the kernel"
    THEOREM = "the theorems on which a rule's checker rests"


_LOADERS: dict[Service, Callable[[], Any]] = {}


def provide(loaders: Mapping[Service, Callable[[], Any]]) -> None:
    """Set what loads each service; it is called when the service is looked up, not before."""
    _LOADERS.update(loaders)


def service(name: Service) -> Any:
    """What does this."""
    return _LOADERS[name]()


class SymPyForm:
    """A value that SymPy understands: ``sympy.sympify`` and the operators of SymPy take it as it is."""

    __slots__ = ()

    def _sympy_(self) -> Any:
        """The same in SymPy, exactly; ``InputError`` for what SymPy cannot express."""
        return service(Service.SYMPY)(self)

    def to_sympy(self) -> Any:
        """As ``_sympy_``."""
        return self._sympy_()
