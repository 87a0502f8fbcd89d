"""Values that are taken without pydantic are those that typer makes with it; so are all messages."""

from __future__ import annotations

from typing import Any

import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st
from typer.main import get_command

from bezier.cli.app import app as bezier_app
from experiments.cli import app as experiments_app
from qe.cli.app import app
from qe.cli.values import take_leading_minus, take_plain_values
from tests.tables import each

NUMBERS = ("5", "0.25", "007", "1e3", "-1", " 5", "5 ", "1_000", "inf", "nan", "٣", "12345678901234567890", "5.", "0")
OTHERS = ("", "abc", "text", "TEXT", "vs", "x", "\udcff")


@each("--timeout", "--memory", "--format", "--order", "--method", "--certificate")
def test_plain_values_are_those_that_typer_would_make(option: str) -> None:
    def parsed(command: Any, value: str) -> object:
        try:
            made = command.commands["eliminate"].make_context("eliminate", ["x > 0", option, value])
        except typer.TyperException as error:
            return error.format_message()
        return {name: (type(found), str(found)) for name, found in made.params.items()}

    plain, converted = get_command(app), get_command(app)
    take_plain_values(plain)
    others = [value for value in OTHERS if value] if option == "--certificate" else OTHERS  # no name is refused
    for value in (*NUMBERS, *others, ".", "no/such/file", "~/x", __file__):
        assert parsed(plain, value) == parsed(converted, value), value


NEGATIVE = st.text("0123456789xyab^*/+-.=()<> ", min_size=1).map("-{}".format).filter(lambda text: text[1] != "-")


def leaves(command: Any, *path: str) -> dict[str, Any]:
    inner = getattr(command, "commands", {})
    found = {name: leaf for key, one in inner.items() for name, leaf in leaves(one, *path, key).items()}
    return found or {" ".join(path): command}


COMMANDS = {
    name: command
    for program, made in (("qe", app), ("bezier", bezier_app), ("experiments", experiments_app))
    for name, command in leaves(get_command(made), program).items()
}


@given(first=NEGATIVE, second=NEGATIVE)
@pytest.mark.parametrize("name", COMMANDS)
def test_what_begins_with_a_minus_sign_is_no_option_in_any_command(name: str, first: str, second: str) -> None:
    """``bezier ik ev3-120 100 -50 20`` was refused: "No such option: -5"."""
    command = COMMANDS[name]
    take_leading_minus(command)
    parser = command.make_parser(command.context_class(command, info_name=name, **command.context_settings))
    parser._args = []  # the arguments take nothing: what is no option is over
    assert parser.parse_args([first, "x", second])[1] == [first, "x", second]
