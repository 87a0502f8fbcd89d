"""The notebooks run from the first cell to the last; their results are not stored but made when the site is built."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "docs" / "notebooks").glob("*.ipynb"))


def test_there_are_three() -> None:
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(
    notebook: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In IPython's shell, without a kernel in a process of its own; the build of the site starts one."""
    interactiveshell = pytest.importorskip("IPython.core.interactiveshell")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    monkeypatch.setenv("MPLBACKEND", "Agg")
    traitlets = pytest.importorskip("traitlets.config")
    shell = interactiveshell.InteractiveShell(config=traitlets.Config({"HistoryManager": {"enabled": False}}))
    cells = [cell for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
    assert not any(cell["outputs"] for cell in cells)
    for cell in cells:
        shell.run_cell("".join(cell["source"]), store_history=False).raise_error()
    assert "accepted" in capsys.readouterr().out
