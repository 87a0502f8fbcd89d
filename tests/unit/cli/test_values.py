"""Values that are taken without pydantic are those that typer makes with it; so are all messages."""

from __future__ import annotations

from typing import Any

import pytest
import typer
from typer.main import get_command

from qe.cli.app import app
from qe.cli.values import take_plain_values

NUMBERS = ("5", "0.25", "007", "1e3", "-1", " 5", "5 ", "1_000", "inf", "nan", "٣", "12345678901234567890", "5.", "0")
OTHERS = ("", "abc", "text", "TEXT", "vs", "x", "\udcff")


@pytest.mark.parametrize("option", ["--timeout", "--memory", "--format", "--order", "--method", "--certificate"])
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
