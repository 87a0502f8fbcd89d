"""Files appear all or none."""

import os

import pytest

from bezier.outputs import all_or_none
from qe.errors import InputError


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
