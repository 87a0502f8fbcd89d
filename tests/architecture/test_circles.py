"""No circle of files: one can read, test and load a module without those that are built on it."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterator, Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("qe", "bezier", "experiments", "paper_repro")
"""The packages that have no circle of files."""


def modules(package: str) -> dict[str, Path]:
    """The file of every module; a package's own file is called as the package."""
    names = ((".".join(p.relative_to(ROOT).with_suffix("").parts), p) for p in sorted((ROOT / package).rglob("*.py")))
    return {name.removesuffix(".__init__"): path for name, path in names}


def imported(source: str, module: str, known: Container[str], *, is_package: bool = False) -> Iterator[str]:
    """The known modules that import statements name, wherever they stand: in functions and for type checking as well.

    ``from qe.exact import ring`` means the file ring, not that of the package it lies in.
    """
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in known)
        elif isinstance(node, ast.ImportFrom):
            parents = module.split(".")
            base = parents[: len(parents) - node.level + is_package] if node.level else []
            whole = ".".join([*base, *([node.module] if node.module else [])])
            for alias in node.names:
                yield from [name for name in (f"{whole}.{alias.name}", whole) if name in known][:1]


def graph(package: str) -> dict[str, set[str]]:
    """What each file of the package imports of the others."""
    files = modules(package)
    return {
        module: set(imported(path.read_text(), module, files, is_package=path.name == "__init__.py"))
        for module, path in files.items()
    }


def circles(edges: Mapping[str, set[str]]) -> list[list[str]]:
    """The strongly connected components of more than one node (Tarjan 1972), and the nodes that import themselves."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    open_nodes: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        number[node] = low[node] = len(number)
        open_nodes.append(node)
        for other in sorted(edges[node]):
            if other not in number:
                visit(other)
            if other in open_nodes:
                low[node] = min(low[node], low[other])
        if low[node] == number[node]:
            component = open_nodes[open_nodes.index(node) :]
            del open_nodes[open_nodes.index(node) :]
            if len(component) > 1 or node in edges[node]:
                found.append(sorted(component))

    for node in edges:
        if node not in number:
            visit(node)
    return found


@pytest.mark.parametrize("package", PACKAGES)
def test_no_circle_of_files(package: str) -> None:
    edges = graph(package)
    assert sum(map(len, edges.values())) > len(edges), "the imports were not found"
    found = circles(edges)
    shown = [{module: sorted(edges[module].intersection(circle)) for module in circle} for circle in found]
    assert not found, shown


def test_circles_are_found() -> None:
    edges = {"a": {"b"}, "b": {"c"}, "c": {"b"}, "d": {"d"}, "e": {"a", "d"}, "f": set()}
    assert circles(edges) == [["b", "c"], ["d"]]


def test_imports_are_found_wherever_they_stand() -> None:
    source = (
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from qe.a import b\n"
        "def f():\n    import qe.c\n    from . import d\n    from ..e import f\nimport os"
    )
    known = {"qe", "qe.a", "qe.a.b", "qe.c", "qe.one", "qe.one.d", "qe.e"}
    assert list(imported(source, "qe.one.two", known)) == ["qe.a.b", "qe.c", "qe.one.d", "qe.e"]
    assert list(imported("from . import d", "qe.one", known, is_package=True)) == ["qe.one.d"]
