"""Where a command's formula comes from."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from qe.cli.source import Source, is_file, read_source, read_text
from qe.errors import InputError
from qe.io.formats import BY_ENDING, Format


def test_a_text_is_a_text(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    assert read_source("x > 0", None) == Source("x > 0", Format.TEXT, "<argument>")
    assert read_source("x > 0", Format.SMTLIB).format is Format.SMTLIB
    assert read_source("x.y", None).text == "x.y"


@pytest.mark.parametrize("ending", sorted(BY_ENDING))
def test_the_ending_of_a_file_decides(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{ending.upper()}"
    path.write_text("x = ü")
    assert read_source(str(path), None) == Source("x = ü", BY_ENDING[ending], str(path))
    assert read_source(str(path), Format.TEXT).format is Format.TEXT
    with pytest.raises(InputError, match="no such file"):
        read_source(f"missing{ending}", None)


def test_other_files(tmp_path: Path) -> None:
    path = tmp_path / "plain"
    path.write_bytes(b"x > 0")
    assert read_source(str(path), None) == Source("x > 0", Format.TEXT, str(path))
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="UTF-8 text expected"):
        read_source(str(path), None)
    with pytest.raises(InputError, match="cannot be read"):
        read_text(tmp_path / "none")
    assert not is_file(tmp_path) and not is_file(Path("x" * 5000)) and not is_file(Path("a\0b")) and is_file(path)


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("y < 1"))
    assert read_source("-", None) == Source("y < 1", Format.TEXT, "<stdin>")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"\xff"), encoding="utf-8"))
    with pytest.raises(InputError, match="<stdin>: UTF-8"):
        read_source("-", Format.TEXT)
