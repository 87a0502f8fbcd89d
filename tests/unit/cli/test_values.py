"""Numbers, arguments and sources on the command line."""

import io
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st
from typer.main import get_command

from bezier.cli.app import app as bezier_app
from experiments.cli import app as experiments_app
from qe.arguments import content
from qe.cli.app import app
from qe.cli.numbers import LONGEST, decimal, exact_and_decimal, shown
from qe.cli.smt_values import written
from qe.cli.source import Source, is_file, read_source
from qe.cli.values import take_leading_minus, take_plain_values
from qe.errors import InputError
from qe.exact.algebraic import RealAlgebraic
from qe.io import smtlib
from qe.io.formats import BY_ENDING, Format
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


ROOT = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


@each(
    (None, "none"),
    (Fraction(3), "3"),
    (Fraction(-3), "-3"),
    (Fraction(1, 3), "1/3 (about 0.3333333333)"),
    (ROOT, "sqrt(2) (about 1.414213562)"),
    (Fraction(10**LONGEST, 1), f"about {float(10**LONGEST):.10g} (the exact text has {LONGEST + 1} characters)"),
    (Fraction(10 ** (LONGEST - 1), 1), str(10 ** (LONGEST - 1))),
)
def test_numbers_for_people(value: object, text: str) -> None:
    assert shown(value, "none") == text


def test_numbers_for_machines() -> None:
    assert exact_and_decimal(2) == {"exact": "2", "decimal": "2"}
    assert exact_and_decimal(Fraction(-1, 3)) == {"exact": "-1/3", "decimal": "-0.3333333333"}
    assert exact_and_decimal(ROOT) == {"exact": "sqrt(2)", "decimal": "1.414213562"}
    assert decimal(Fraction(123456789012345)) == "1.23456789e+14"


@each(
    (0, "0.0"),
    (7, "7.0"),
    (-7, "(- 7.0)"),
    (Fraction(2, 3), "(/ 2.0 3.0)"),
    (Fraction(-2, 3), "(- (/ 2.0 3.0))"),
    (RealAlgebraic.rational(Fraction(1, 2)), "(/ 1.0 2.0)"),
)
def test_rational_numbers(number: object, text: str) -> None:
    assert written(number) == text


@each(0, 1, 2)
def test_an_irrational_number_is_read_back(index: int) -> None:
    """The roots of x^3 - 3x + 1, each between its neighbours' bounds."""
    low, high = [(-2, -1), (0, 1), (1, 2)][index]
    number = RealAlgebraic.from_root([1, -3, 0, 1], low, high)
    text = f"(declare-const y Real)(assert (= y {written(number)}))"
    formula = smtlib.read(text)
    import qe

    assert qe.equivalent(formula, f"y^3 - 3*y + 1 = 0 and y > {low} and y < {high}")


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
        content(tmp_path / "none", "file")
    assert not is_file(tmp_path) and not is_file(Path("x" * 5000)) and not is_file(Path("a\0b")) and is_file(path)


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO("y < 1"))
    assert read_source("-", None) == Source("y < 1", Format.TEXT, "<stdin>")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"\xff"), encoding="utf-8"))
    with pytest.raises(InputError, match="<stdin>: UTF-8"):
        read_source("-", Format.TEXT)
