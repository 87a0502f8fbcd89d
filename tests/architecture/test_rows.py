"""Who may import whom (docs/architecture.md): a module imports only from rows above its own."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("qe", "bezier", "experiments", "paper_repro")

ROWS = {
    "qe.errors": 0,
    "qe.truth": 0,
    "qe.progress": 0,
    "qe.spelling": 0,
    "qe.arguments": 0,
    "qe.options": 0,
    "qe.worker": 0,
    "qe.execution": 0,
    "qe.exact": 1,
    "qe.formula": 2,
    "qe.io": 2,
    "qe.io.sympy_numbers": 2,
    "qe.evidence": 3,
    "qe.reference": 3,
    "qe.certify": 4,
    "qe.prepare": 4,
    "qe.plan": 4,
    "qe.eliminate.vs": 5,
    "qe.eliminate.cad": 5,
    "qe.eliminate.critical": 5,
    "qe.eliminate.cgs": 5,
    "qe.eliminate": 5,
    "qe.solution": 6,
    "qe.report": 6,
    "qe.pipeline": 7,
    "qe.api": 7,
    "qe.cli": 7,
    "qe": 7,
    "bezier": 8,
    "experiments": 9,
    "paper_repro": 9,
}
# Parts that know each other: a number tells SymPy what it is by the door for SymPy; printing a formula needs a writer,
# and writers need the syntax; a region can draw itself; the budget speaks in events and errors; row 7 is the line of
# arrows itself.
TOGETHER = (
    {"qe.exact", "qe.io.sympy_numbers"},
    {"qe.formula", "qe.io", "qe.io.sympy_numbers"},
    {"qe.solution", "qe.report"},
    *({k for k, row in ROWS.items() if row == same} for same in (0, 7)),
)


def part(module: str) -> str:
    """The longest listed prefix of a module name; ``qe.cli_input`` belongs to ``qe.cli``."""
    names = module.replace("qe.cli_", "qe.cli.").replace("qe.api_", "qe.api.").replace("qe.pipeline_", "qe.pipeline.")
    pieces = names.split(".")
    for length in range(len(pieces), 0, -1):
        if (name := ".".join(pieces[:length])) in ROWS and not (name == "qe" and len(pieces) > 1):
            return name
    raise KeyError(module)


def modules() -> Iterator[tuple[str, Path]]:
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
            yield name.removesuffix(".__init__"), path


def imports(path: Path, module: str) -> Iterator[tuple[int, str]]:
    """(line, absolute module name) of every import statement, wherever it stands, type-checking ones included."""
    is_package = path.name == "__init__.py"
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                parents = module.split(".")[: len(module.split(".")) - node.level + is_package]
                base = ".".join([*parents, base]).strip(".")
            for alias in node.names:  # "from qe.exact import ring" imports a module, "from qe import Exists" a name
                inner = ROOT.joinpath(*base.split("."), alias.name)
                is_module = inner.with_suffix(".py").exists() or inner.is_dir()
                yield node.lineno, f"{base}.{alias.name}" if is_module else base


MODULES = list(modules())


def allowed(importer: str, imported: str) -> bool:
    if importer == imported or ROWS[imported] < ROWS[importer]:
        return True
    if imported.startswith("qe.eliminate") and importer == "qe.eliminate":
        return False
    if imported == "qe.eliminate" and importer.startswith("qe.eliminate."):
        return True  # the protocol they share
    return any({importer, imported} <= group for group in TOGETHER)


@pytest.mark.parametrize(("module", "path"), MODULES, ids=[m for m, _ in MODULES])
def test_rows(module: str, path: Path) -> None:
    own = part(module)
    wrong = [
        f"line {line}: {name}"
        for line, name in imports(path, module)
        if name.split(".")[0] in PACKAGES and not allowed(own, part(name))
    ]
    assert not wrong, f"{module} (row {ROWS[own]}) imports {wrong}"


def test_flint_is_imported_only_in_the_exact_layer() -> None:
    wrong = [
        f"{module}:{line}"
        for module, path in MODULES
        if part(module) != "qe.exact"
        for line, name in imports(path, module)
        if name.split(".")[0] in ("flint", "ctypes") and (name, module) != ("ctypes", "qe.worker")
    ]
    assert not wrong


def test_sympy_enters_only_by_its_own_door() -> None:
    wrong = [
        f"{module}:{line}"
        for module, path in MODULES
        if module.startswith("qe") and module not in ("qe.io.sympy", "qe.io.sympy_numbers")
        for line, name in imports(path, module)
        if name.split(".")[0] == "sympy"
    ]
    assert not wrong


def test_the_checker_shares_nothing_with_producers() -> None:
    producers = ("qe.eliminate", "qe.solution", "qe.prepare", "qe.plan", "qe.pipeline", "qe.api")
    wrong = [
        f"{module}:{line} {name}"
        for module, path in MODULES
        if part(module) == "qe.certify"
        for line, name in imports(path, module)
        if name.startswith(producers)
    ]
    assert not wrong


def test_the_reference_brings_its_own_polynomials() -> None:
    path = ROOT / "qe" / "reference.py"
    names = {name for _, name in imports(path, "qe.reference")}
    assert not any(n.startswith(("qe.eliminate", "qe.solution", "qe.prepare", "flint")) for n in names)


def test_the_rule_itself() -> None:
    """The test above can fail: forbidden directions are seen as such."""
    assert not allowed("qe.certify", "qe.eliminate.cad")
    assert not allowed("qe.eliminate.vs", "qe.eliminate.cad")
    assert not allowed("qe.exact", "qe.formula")
    assert not allowed("qe.prepare", "qe.plan")
    assert allowed("qe.eliminate.cad", "qe.prepare")
    assert part("qe.cli_input") == "qe.cli"
