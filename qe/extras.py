"""Libraries that only some uses need: which extra of the package brings which, said in one line where one is absent."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from qe.errors import Unable

_EXTRAS = {
    "clarabel": "squares",
    "highspy": "linear",
    **dict.fromkeys(("matplotlib", "mpl_toolkits", "numpy"), "pictures"),
    **dict.fromkeys(("jinja2", "markupsafe", "networkx", "scipy", "trimesh"), "plan"),
    "pysat": "sat",
    **dict.fromkeys(("dask", "distributed", "pyarrow"), "sweep"),
    "yourdfpy": "robots",
    "z3": "solvers",
}
"""Module to extra, as ``pyproject.toml`` lists them."""
_PARTS = {"markupsafe": "jinja2", "mpl_toolkits": "matplotlib"}
"""Modules that come with others, which are those that people know."""


def lacking(error: ImportError) -> Unable | None:
    """What to tell the user where the absent module belongs to an extra, None where it does not."""
    module = (error.name or "").split(".")[0]
    if module not in _EXTRAS:
        return None
    known, extra = _PARTS.get(module, module), _EXTRAS[module]
    return Unable(f"{known} is not installed; it comes with: pip install 'bezier-qe[{extra}]'")


@contextmanager
def wanted() -> Iterator[None]:
    """What is imported inside may be absent. Raises ``Unable`` with the extra that brings it."""
    try:
        yield
    except ImportError as error:
        raise lacking(error) or error from None
