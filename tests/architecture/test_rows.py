"""Who may import whom (docs/architecture.md): a module imports only from rows above its own."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("qe", "bezier", "experiments", "paper_repro")

ROWS = {
    "qe.errors": 0,
    "qe.truth": 0,
    "qe.progress": 0,
    "qe.spelling": 0,
    "qe.arguments": 0,
    "qe.options": 0,
    "qe.processes": 0,
    "qe.services": 0,
    "qe.extras": 0,
    "qe.exact": 1,
    "qe.formula": 2,
    "qe.io": 2,
    "qe.proof": 3,
    "qe.kernel": 4,
    "qe.expert": 4,
    "qe.certify": 4,
    "qe.theorems": 4,
    "qe.simplifier": 4,
    "qe.positivity": 4,
    "qe.coq": 5,
    "qe.plain": 5,
    "qe.rules": 5,
    "qe.decomposition": 5,
    "qe.groebner": 5,
    "qe.convex": 6,
    "qe.elimination.vs": 7,
    "qe.elimination.cad": 7,
    "qe.elimination.cgs": 7,
    "qe.elimination.critical": 7,
    "qe.elimination.convex": 7,
    "qe.elimination.projection": 7,
    "qe.elimination.witness": 7,
    "qe.elimination": 7,
    "qe.proving": 8,
    "qe.engine": 9,
    "qe.regions": 10,
    "qe.optimization": 11,
    "qe.api": 12,
    "qe.cli": 12,
    "qe.__main__": 12,
    "qe.sympy": 12,
    "qe": 12,
    "bezier.proofs": 13,
    "bezier.curves": 13,
    "bezier.conic": 13,
    "bezier.input": 14,
    "bezier.obstacles": 15,
    "bezier.chains": 16,
    "bezier.chains.plan": 24,
    "bezier.chains.command": 25,
    "bezier.trajectories": 16,
    "bezier.trajectories.along": 19,
    "bezier.trajectories.command": 24,
    "bezier.trajectories.links": 19,
    "bezier.scenes": 16,
    "bezier.scenes.command": 25,
    "bezier.retiming": 18,
    "bezier.retiming.least_time": 23,
    "bezier.retiming.command": 25,
    "bezier.paths": 16,
    "bezier.motion": 17,
    "bezier.arm": 18,
    "bezier.problem": 18,
    "bezier.pictures": 19,
    "bezier.report.html": 19,
    "bezier.plans": 20,
    "bezier.methods.control": 21,
    "bezier.report": 22,
    "bezier.methods": 23,
    "bezier.methods.quadratic": 23,
    "bezier.methods.cubic": 23,
    "bezier.methods.single": 23,
    "bezier.methods.refuted": 23,
    "bezier.planner": 24,
    "bezier.check": 25,
    "bezier.compare": 25,
    "bezier.exports": 25,
    "bezier.interface": 26,
    "bezier.cli": 26,
    "bezier.__main__": 27,
    "bezier": 27,
    "experiments": 28,
    "paper_repro": 28,
}
# Parts of one row that know each other: the budget speaks in events and errors; row 12 is the public face.
TOGETHER = tuple({k for k, row in ROWS.items() if row == same} for same in (0, 12))
BESIDE = {
    ("qe.io", "qe.formula"),
    ("qe.expert", "qe.kernel"),
    ("qe.certify", "qe.kernel"),
    ("qe.certify", "qe.expert"),
    ("qe.expert", "qe.certify"),
}
"""Importer and imported, of one row. The second ring asks what a certificate inside its evidence claims."""


def part(module: str) -> str:
    """The longest listed prefix of a module name."""
    pieces = module.split(".")
    for length in range(len(pieces), 0, -1):
        if (name := ".".join(pieces[:length])) in ROWS and not (name in ("qe", "bezier") and len(pieces) > 1):
            return name
    raise KeyError(module)


def modules() -> Iterator[tuple[str, Path]]:
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
            yield name.removesuffix(".__init__"), path


@cache
def imports(path: Path, module: str) -> tuple[tuple[int, str], ...]:
    """(line, absolute module name) of every import statement, wherever it stands, type-checking ones included."""
    return tuple(_imports(path, module))


def _imports(path: Path, module: str) -> Iterator[tuple[int, str]]:
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
    if (importer, imported) in BESIDE:
        return True
    if imported.startswith("qe.elimination") and importer == "qe.elimination":
        return False
    if imported == "qe.elimination" and importer.startswith("qe.elimination."):
        return True  # the protocol they share
    return any({importer, imported} <= group for group in TOGETHER)


def test_rows() -> None:
    wrong = [
        f"{module} (row {ROWS[part(module)]}), line {line}: {name}"
        for module, path in MODULES
        for line, name in imports(path, module)
        if name.split(".")[0] in PACKAGES and not allowed(part(module), part(name))
    ]
    assert not wrong


BALLS = ("qe.kernel.arithmetic.", "qe.expert.arithmetic.", "bezier.proofs.course", "bezier.proofs.square_roots")
BALLS += ("bezier.arm.motion_chain", "bezier.arm.tip")


def test_flint_is_imported_only_in_the_exact_layer_and_in_the_arithmetic_of_the_checkers() -> None:
    wrong = [
        f"{module}:{line}"
        for module, path in MODULES
        if part(module) != "qe.exact" and not module.startswith(BALLS)
        for line, name in imports(path, module)
        if name.split(".")[0] in ("flint", "ctypes") and (name, module) != ("ctypes", "qe.processes.worker")
    ]
    assert not wrong


def test_sympy_enters_only_by_its_own_door() -> None:
    wrong = [
        f"{module}:{line}"
        for module, path in MODULES
        if module.startswith("qe") and not re.fullmatch(r"qe\.io\.sympy(_reader)?|qe\.sympy|qe\.api\.measure", module)
        for line, name in imports(path, module)
        if name.split(".")[0] == "sympy"
    ]
    assert not wrong


def test_the_checker_shares_nothing_with_producers() -> None:
    producers = (
        "qe.elimination",
        "qe.simplifier",
        "qe.rules",
        "qe.decomposition",
        "qe.convex",
        "qe.engine",
        "qe.regions",
        "qe.api",
        "bezier.curves",
        "bezier.obstacles",
        "bezier.arm",
    )
    wrong = [
        f"{module}:{line} {name}"
        for module, path in MODULES
        if part(module) in ("qe.kernel", "qe.expert", "qe.certify", "bezier.proofs")
        for line, name in imports(path, module)
        if name.startswith(producers)
    ]
    assert not wrong


def test_the_reference_brings_its_own_polynomials() -> None:
    path = ROOT / "experiments" / "reference.py"
    names = {name for _, name in imports(path, "experiments.reference")}
    assert not any(n.startswith(("qe.elimination", "qe.rules", "qe.engine", "flint")) for n in names)


def test_the_rule_itself() -> None:
    """The test above can fail: forbidden directions are seen as such."""
    assert not allowed("qe.certify", "qe.elimination.cad")
    assert not allowed("qe.kernel", "qe.expert") and not allowed("qe.kernel", "qe.certify")
    assert not allowed("qe.elimination.vs", "qe.elimination.cad")
    assert not allowed("qe.exact", "qe.formula")
    assert not allowed("qe.formula", "qe.io")
    assert not allowed("qe.rules", "qe.convex")
    assert allowed("qe.elimination.cad", "qe.rules")
    assert part("qe.cli.source") == "qe.cli"
    assert not allowed("bezier.methods.cubic", "bezier.methods.quadratic")
    assert not allowed("bezier.plans", "bezier.planner")
    assert not allowed("bezier.methods.control", "bezier.methods.single")
    assert allowed("bezier.methods.single", "bezier.methods.control")
    assert part("bezier.methods.control.terms") == "bezier.methods.control"
