"""Lengths of files, docstrings, and words that have no place in the tree."""

from __future__ import annotations

import ast
import inspect
import re
import subprocess
import sys
import warnings
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

import pytest

import bezier
import qe

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("qe", "bezier", "experiments", "paper_repro", "tests", "examples")
CODE = [p for folder in FOLDERS for p in sorted((ROOT / folder).rglob("*.py"))]
TEXT = {".py", ".md", ".toml", ".txt", ".html", ".j2", ".css", ".js", ".json", ".cfg", ""}

LONG = 400
"""Lines; longer files are listed at the end of a run of the tests, for a look whether they say two things."""
# Written in pieces, so that this file does not contain what it looks for.
UNFINISHED = re.compile("|".join(("TO" + "DO", "FIX" + "ME", "Not" + "ImplementedError", "x" + "fail")))
MACHINE_PATHS = re.compile("|".join(("/" + "work/", "/" + "root/", "/" + r"home/\w", r"\bC:" + r"\\Users")))
BROAD = re.compile(r"except\s*(\(?\s*(Base)?Exception\b|:)")


def shown(path: Path) -> str:
    return str(path.relative_to(ROOT))


def long_files(paths: Iterable[Path]) -> list[str]:
    """The files that are long, with their lengths, the longest first."""
    lengths = {shown(p): p.read_text().count("\n") for p in paths}
    return [f"{name} ({n})" for name, n in sorted(lengths.items(), key=lambda item: -item[1]) if n > LONG]


def test_long_files_are_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if listed := long_files(CODE):
        warnings.warn(f"files of more than {LONG} lines: {', '.join(listed)}", stacklevel=1)
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    for n in (LONG, LONG + 1, LONG + 2):
        (tmp_path / f"{n}.py").write_text("\n" * n)
    assert long_files(tmp_path.iterdir()) == [f"{LONG + 2}.py ({LONG + 2})", f"{LONG + 1}.py ({LONG + 1})"]


def test_nothing_is_unfinished() -> None:
    assert not [shown(p) for p in CODE if UNFINISHED.search(p.read_text())]


def test_few_files_know_root_atoms() -> None:
    """A new kind of atom concerns few files; all others speak of ``Atomic``, and look for ``Atom`` alone."""
    knowing = [shown(p) for p in CODE if p.parts[len(ROOT.parts)] in ("qe", "bezier") and "RootAtom" in p.read_text()]
    assert len(knowing) <= 12, knowing


def test_no_exception_handler_is_broad() -> None:
    """But the one by which no answer is lost for its proof, which tests make raise (``tests/conftest.py``), and the one
    by which a worker sends home whatever error a question ends with."""
    broad = [shown(p) for p in CODE if BROAD.search(p.read_text())]
    assert broad == ["qe/processes/service.py", "qe/proving/certificates.py"]


def test_modules_and_public_names_have_docstrings() -> None:
    assert not [name for p in CODE if shown(p).startswith(("qe/", "bezier/")) for name in without_docstring(p)]


def test_folders_say_what_belongs_there_and_what_does_not() -> None:
    packages = [p for p in CODE if p.name == "__init__.py" and shown(p).startswith(("qe/", "bezier/"))]
    documents = {shown(p): ast.get_docstring(ast.parse(p.read_text())) or "" for p in packages}
    assert len(packages) > 40
    assert not [name for name, text in documents.items() if len(re.findall(r"[.:;](?=\s|$)", text)) < 2]


def without_docstring(path: Path) -> list[str]:
    """The module itself, and its public functions and classes, where they do not say what they are."""
    tree = ast.parse(path.read_text())
    public = [n for n in tree.body if isinstance(n, ast.FunctionDef | ast.ClassDef) and not n.name.startswith("_")]
    bare = [f"{shown(path)}: {n.name}" for n in public if not ast.get_docstring(n) and not is_overload(n)]
    return bare if not tree.body or ast.get_docstring(tree) else [shown(path), *bare]


@pytest.mark.parametrize("package", [qe, bezier])
def test_methods_of_exported_classes_have_docstrings(package: ModuleType) -> None:
    classes = [found for name in package.__all__ if inspect.isclass(found := getattr(package, name))]
    members = [(c, name, member) for c in classes for name, member in vars(c).items() if not name.startswith("_")]
    functions = [(c, n, m.fget if isinstance(m, property) else getattr(m, "__func__", m)) for c, n, m in members]
    assert len(functions) > 20
    assert not [f"{c.__name__}.{name}" for c, name, f in functions if inspect.isfunction(f) and not f.__doc__]


def test_a_missing_docstring_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    (tmp_path / "one.py").write_text("def public(): ...\ndef _private(): ...\n@overload\ndef signature(): ...")
    (tmp_path / "two.py").write_text('"""Two."""\nclass Good:\n    """Good."""')
    (tmp_path / "none.py").write_text("")
    assert without_docstring(tmp_path / "one.py") == ["one.py", "one.py: public"]
    assert without_docstring(tmp_path / "two.py") == without_docstring(tmp_path / "none.py") == []


def is_overload(node: ast.FunctionDef | ast.ClassDef) -> bool:
    """Whether it is only a signature, beside the function that has the docstring."""
    return any(isinstance(d, ast.Name) and d.id == "overload" for d in node.decorator_list)


def tracked() -> list[Path]:
    listing = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    if listing.returncode != 0:  # an unpacked archive has no list of files: the code alone is looked at
        return CODE
    paths = [ROOT / line for line in listing.stdout.splitlines()]
    return [p for p in paths if p.suffix in TEXT and p.is_file()]


def test_no_machine_paths() -> None:
    wrong = [shown(p) for p in tracked() if MACHINE_PATHS.search(p.read_text(errors="replace"))]
    assert not wrong


def test_no_module_called_utils() -> None:
    wrong = [p for p in CODE if p.stem in ("utils", "util", "helpers", "misc", "common")]
    assert not wrong
