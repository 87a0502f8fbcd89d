"""Files appear all or none."""

import json
import os

import pytest

from bezier.planner.outputs import all_or_none
from qe.errors import InputError
from tests.tables import each


def names(folder):
    return sorted(p.name for p in folder.iterdir())


def test_a_new_folder(tmp_path):
    target = tmp_path / "a" / "b"
    with all_or_none(target) as folder:
        (folder / "x").write_text("1")
        assert not target.exists()
    assert names(target) == ["x"] and names(tmp_path) == ["a"]


def test_an_old_folder_keeps_other_files(tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    (target / "mine").write_text("keep")
    (target / "x").write_text("old")
    with all_or_none(target) as folder:
        (folder / "x").write_text("new")
    assert names(target) == ["mine", "x"] and (target / "x").read_text() == "new" and names(tmp_path) == ["out"]


def test_nothing_is_left_after_a_failure(tmp_path):
    target = tmp_path / "out"
    with pytest.raises(RuntimeError), all_or_none(target) as folder:
        (folder / "x").write_text("1")
        raise RuntimeError
    assert names(tmp_path) == []


def test_a_file_in_the_way(tmp_path):
    (tmp_path / "out").write_text("")
    with pytest.raises(InputError, match="expected a folder"), all_or_none(tmp_path / "out"):
        pass
    with pytest.raises(InputError, match="not writable"), all_or_none(tmp_path / "out" / "deeper"):
        pass


def test_a_folder_without_permission(tmp_path):
    if os.geteuid() == 0:
        target = "/proc/out"  # not even the superuser can write there
    else:
        tmp_path.chmod(0o500)
        target = tmp_path / "out"
    from pathlib import Path

    with pytest.raises(InputError, match="expected a writable folder"), all_or_none(Path(target)):
        pass


def plan_into(target, *written, listed=None):
    """A run that writes these files, and lists them in its summary, or the ones given."""
    with all_or_none(target) as folder:
        for name in written:
            (folder / name).write_text("{}")
        files = [f"somewhere/{name}" for name in (written if listed is None else listed)]
        (folder / "summary.json").write_text(json.dumps({"files": files}))


def test_a_second_run_removes_what_the_first_one_listed_as_its_own(tmp_path):
    target = tmp_path / "out"
    plan_into(target, "region.json", "path.json", "region.png")
    (target / "notes.txt").write_text("mine")
    plan_into(target, "path.json")
    assert names(target) == ["notes.txt", "path.json", "summary.json"]


def test_a_second_run_removes_nothing_else(tmp_path):
    target = tmp_path / "out"
    # a summary may list anything: only names that planning writes are removed, and only in this folder
    plan_into(target, "path.json", listed=["path.json", "notes.txt", "../outside.txt", "compare.json"])
    for name in ("notes.txt", "region.json", "compare.json"):  # region.json is not listed: it is somebody's own
        (target / name).write_text("mine")
    (tmp_path / "outside.txt").write_text("mine")
    plan_into(target)
    assert names(target) == ["compare.json", "notes.txt", "region.json", "summary.json"]
    assert (tmp_path / "outside.txt").exists()


@each("", "[]", '{"files": 3}', '{"files": [3]}', "[" * 100_000, "\ud800".encode("utf-8", "ignore"))
def test_an_unreadable_listing_removes_nothing(old, tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    (target / "path.json").write_text("mine")
    (target / "summary.json").write_bytes(old if isinstance(old, bytes) else old.encode())
    plan_into(target)
    assert names(target) == ["path.json", "summary.json"]


def test_a_failed_run_removes_nothing(tmp_path):
    target = tmp_path / "out"
    plan_into(target, "region.json")
    with pytest.raises(RuntimeError), all_or_none(target) as folder:
        (folder / "summary.json").write_text('{"files": []}')
        raise RuntimeError
    assert names(target) == ["region.json", "summary.json"]
