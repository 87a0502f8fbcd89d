"""Tests follow the house: a test file under the path of each module, or a line that says where else it is tested."""

from __future__ import annotations

from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
HOUSES = {"qe": TESTS / "unit", "bezier": TESTS / "bezier"}
NO_CODE = {"__init__", "__main__"}


def modules() -> set[str]:
    """The paths of all modules, without their ending."""
    found = (path.relative_to(ROOT).with_suffix("") for house in HOUSES for path in (ROOT / house).rglob("*.py"))
    return {path.as_posix() for path in found if path.name not in NO_CODE}


def own_file(module: str) -> Path:
    """Where its tests are, unless the list names another file."""
    house, *folders, name = module.split("/")
    return HOUSES[house].joinpath(*folders, f"test_{name}.py")


def elsewhere() -> dict[str, list[str]]:
    """The list: modules by the file that tests them."""
    lines = (TESTS / "architecture" / "tested_elsewhere.txt").read_text().splitlines()
    rows = (line.split(":") for line in lines if line and not line.startswith("#"))
    return {file: names.split() for file, names in rows}


def test_every_module_has_its_test_file_or_is_listed_once() -> None:
    listed = sorted(name for names in elsewhere().values() for name in names)
    assert listed == sorted(name for name in modules() if not own_file(name).exists())


def test_the_files_that_are_listed_have_tests() -> None:
    assert not [name for name in elsewhere() if "def test_" not in (TESTS / name).read_text()]


def test_folders_of_tests_are_folders_of_the_house() -> None:
    folders = {name: {file.parent.relative_to(at) for file in at.rglob("test_*.py")} for name, at in HOUSES.items()}
    assert not [(name, str(at)) for name, found in folders.items() for at in found if not (ROOT / name / at).is_dir()]
