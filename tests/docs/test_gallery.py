"""Every script of the gallery runs, and its proof is accepted."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

SCRIPTS = sorted((Path(__file__).resolve().parents[2] / "examples" / "gallery").glob("*.py"))


def test_there_are_twenty_four() -> None:
    assert len(SCRIPTS) == 24


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_script(
    script: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(script))
    printed = capsys.readouterr().out.splitlines()
    text = script.read_text()
    assert printed.count("accepted") == text.count("qe.verify(")
    assert len(list(tmp_path.glob("*.png"))) == text.count(".plot(")
