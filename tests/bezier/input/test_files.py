"""Text files of people: what cannot be read is told in one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from bezier.input import toml_table
from qe.errors import InputError


def test_text_with_and_without_a_mark_of_order(tmp_path: Path) -> None:
    for data in ("x = 'ü'".encode(), "x = 'ü'".encode("utf-8-sig")):
        (tmp_path / "p.toml").write_bytes(data)
        assert toml_table.read_text(tmp_path / "p.toml") == "x = 'ü'"


def test_what_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "p.toml"
    with pytest.raises(InputError, match=r"p\.toml: expected a readable file, found: No such file"):
        toml_table.read_text(file)
    with pytest.raises(InputError, match="expected a readable file"):
        toml_table.read_text(tmp_path)
    file.write_bytes(b"a = '\xff'")
    with pytest.raises(InputError, match="expected UTF-8 text, found byte 0xff at 5"):
        toml_table.read_text(file)
    monkeypatch.setattr(toml_table, "MAX_BYTES", 10)
    file.write_bytes(b"0123456789")
    assert toml_table.read_text(file) == "0123456789"
    file.write_bytes(b"0123456789x")
    with pytest.raises(InputError, match="at most 10 bytes, found more"):
        toml_table.read_text(file)
