"""How the commands start."""

import pytest

from qe.cli import start


@pytest.mark.parametrize("name", ("qe", "bezier"))
def test_an_interrupt_while_a_command_is_loaded_is_one_line(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C while Python imported the package gave a traceback."""

    def interrupted(module: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("qe.cli.start.import_module", interrupted)
    assert getattr(start, name)() == 130
    assert capsys.readouterr().err == f"{name}: interrupted\n"
