"""Every row of the table of doors: a Python function, a command, a word at the prompt and a row of the page, alike."""

from __future__ import annotations

import inspect
import json
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from typer.main import get_command

import qe
from qe.api.doors import DOORS, Door
from qe.api.settings import settings_in
from qe.cli.app import app
from qe.cli.options import ELSEWHERE
from qe.cli.prompt import COMMANDS as WORDS
from qe.cli.prompt import HELP, Session
from tests.cli import command

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = get_command(app).commands  # type: ignore[attr-defined]

ASKED: dict[str, tuple[Callable[[], object], list[str], str, str]] = {
    "eliminate": (lambda: qe.eliminate("ex x. a*x^2 = 1"), ["ex x. a*x^2 = 1"], "ex x. a*x^2 = 1", "a > 0"),
    "decide": (lambda: qe.decide("ex x. x^2 = 2"), ["ex x. x^2 = 2"], "ex x. x^2 = 2", "true"),
    "find": (lambda: qe.find("x^2 = 4", 2), ["x^2 = 4", "-n", "2"], "2: x^2 = 4", "-2"),
    "solve": (lambda: qe.solve("x^2 = a", "x"), ["x^2 = a", "--variables", "x"], "x: x^2 = a", "x = sqrt(a)"),
    "region": (lambda: qe.region("x^2 <= 4").bounds("x"), ["x^2 <= 4"], "x^2 <= 4", "-2"),
    "simplify": (lambda: qe.simplify("x > 0 and (x > 0 or y > 0)"), ["x > 0 and (x > 0 or y > 0)"], "x > 0", "x > 0"),
    "equivalent": (lambda: qe.equivalent("x > 0", "x^3 > 0"), ["x > 0", "x^3 > 0"], "x > 0 ; x^3 > 0", "true"),
    "witnesses": (lambda: list(map(str, qe.witnesses("ex x. a*x = b"))), ["ex x. a*x = b"], "ex x. a*x = b", "b/a"),
    "minimize": (lambda: qe.minimize("x", "x^2 <= 9").value, ["x", "x^2 <= 9"], "x: x^2 <= 9", "-3"),
    "maximize": (lambda: qe.maximize("x", "x^2 <= 9").value, ["x", "x^2 <= 9"], "x: x^2 <= 9", "3"),
    "optimum": (lambda: qe.optimum("x", "x^2 <= 9"), ["x", "x^2 <= 9"], "x: x^2 <= 9", "-3"),
}
"""What each door is asked: from Python, as words of a command, at the prompt; and what has to be in the answer."""


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("doors") / "c.json"
    answer = qe.eliminate("ex x. a*x^2 + b*x + c = 0", assuming="a > 0", check=True)
    assert answer.certificate is not None
    path.write_text(answer.certificate.to_json())
    return path


run = partial(command.run, "qe")


@pytest.mark.parametrize("door", DOORS.values(), ids=list(DOORS))
def test_a_door_has_one_name_and_one_set_of_keywords(door: Door) -> None:
    function, offered = getattr(qe, door.name), COMMANDS[door.name]
    taken = inspect.signature(function).parameters
    options = {option.name: option for option in offered.params}
    for name, (_, setting) in settings_in(door.settings).items():
        if door.name != "verify":
            assert taken[name].default == setting.default
        if name not in ELSEWHERE:
            assert options[name].default in (setting.default, None)
    if "check" in settings_in(door.settings):
        assert {"check", "json", "plain"} <= set(options) and taken["check"].default is False
        assert ("certificate" in options) is door.certified is (door.name not in ("find", "optimum"))
    if door.name != "verify":
        assert "assuming" in taken and "assuming" in options
    assert offered.short_help == door.says and door.name in WORDS
    for name in door.also:
        assert callable(getattr(qe, name))


@pytest.mark.parametrize("name", ASKED)
def test_a_door_answers_from_python_the_shell_and_the_prompt(name: str) -> None:
    call, words, line, part = ASKED[name]
    assert part in str(call()).lower() if part == "true" else part in str(call())
    done = run(name, *words)
    assert done.returncode == 0 and part in done.stdout and not done.stderr, done
    data = json.loads(run(name, *words, "--json").stdout)
    assert isinstance(data, dict)
    assert part in Session().reply(f":{name} {line}").replace("\n", " ")


@pytest.mark.parametrize("name", [name for name in ASKED if name != "optimum"])
def test_check_says_that_it_is_proved(name: str) -> None:
    done = run(name, *ASKED[name][1], "--check")
    assert done.returncode == 0 and done.stderr == "checked\n", done
    plain = run(name, *ASKED[name][1])
    assert plain.stdout.split(" (")[0].split(" in ")[0] == done.stdout.split(" (")[0].split(" in ")[0]


def test_verify(certificate: Path) -> None:
    asked = ["--formula", "ex x. a*x^2 + b*x + c = 0"]
    assert run("verify", str(certificate), *asked, "--assuming", "a > 0").returncode == 0
    assert run("check", str(certificate), *asked).returncode == 4
    assert run("check", str(certificate), *asked, "--assuming", "a >= 0").returncode == 4
    assert Session().reply(f":verify {certificate}") == "accepted"


def table_of_doors() -> str:
    """All doors as a table in Markdown."""
    rows = []
    for door in DOORS.values():
        says = door.says.replace("FORMULA", "a formula").replace("CONSTRAINTS", "constraints")
        names = ", ".join(f"`qe.{name}`" for name in (door.name, *door.also))
        rows.append(f"| {says} | {names} | `qe {door.name}` | `:{door.name} {door.line}` |")
    return "\n".join(["| what | Python | command | at the prompt |", "|---|---|---|---|", *rows])


def test_the_page_has_the_table() -> None:
    assert table_of_doors() in (ROOT / "docs" / "doors.md").read_text()


def test_the_help_of_the_prompt_names_all_words() -> None:
    said = Session().reply(":help")
    assert all(f":{name} " in said for name in DOORS if name != "eliminate") and "{doors}" in HELP


def test_an_unknown_name_gets_the_nearest_one() -> None:
    with pytest.raises(AttributeError, match="did you mean 'minimize'"):
        qe.minimise
    with pytest.raises(TypeError, match="Did you mean 'assuming'"):
        qe.eliminate("x > 0", asuming="x > 1")  # type: ignore[call-arg]
    done = run("minimise", "x")
    assert done.returncode == 2 and "Did you mean 'minimize'" in done.stderr and done.stderr.count("\n") == 1
    assert "did you mean --assuming?" in run("decide", "x > 0", "--asuming", "x > 1").stderr
    assert "did you mean :witnesses?" in Session().reply(":witness ex x. x = a")


def test_settings_at_the_prompt_hold_for_the_doors_that_take_them() -> None:
    session = Session()
    assert "assuming a>0" in session.reply(":assuming a>0")
    assert session.reply("ex x. a*x^2 + b*x + c = 0") == "b^2 - 4*a*c >= 0"
    assert session.reply(":solve x: x^2 = a").count("sqrt(a)") == 2
    session.reply(":check on")
    assert session.reply("ex x. a*x^2 + b*x + c = 0").endswith("\nchecked")
    session.reply(":assuming off")
    session.reply(":generic on")
    assert "assuming a /= 0" in session.reply("ex x. a*x = b")
    assert session.reply(":instance x^2 = 4 and x > 0") == "x = 2" and ":equivalent" in session.reply(
        ":equivalent x > 0"
    )


def test_what_is_assumed_in_files_is_read(tmp_path: Path) -> None:
    session, call = tmp_path / "q.qepcad", tmp_path / "q.red"
    session.write_text("[ ]\n(a,b,c,x)\n3\n(E x)[ a x^2 + b x + c = 0 ].\nassume [ a > 0 ]\nfinish\n")
    call.write_text("rlqe(ex(x, a*x**2 + b*x + c = 0), {a > 0});\n")
    for path in (session, call):
        assert str(qe.eliminate(path)) == run("eliminate", str(path)).stdout.strip() == "b^2 - 4*a*c >= 0"
        assert run("eliminate", str(path), "--assuming", "c > 0 and b = 0").stdout.strip() == "false"


def test_generic_answers_name_what_they_assume() -> None:
    done = run("eliminate", "ex x. a*x = b", "--generic", "--check")
    assert done.stdout == "true\nassuming a /= 0\n" and done.stderr == "checked\n"
    assert json.loads(run("eliminate", "ex x. a*x = b", "--generic", "--json").stdout)["assuming"] == "a /= 0"


def test_contradicting_assumptions_are_noted() -> None:
    done = run("eliminate", "ex x. x = a", "--assuming", "a > 0 and a < 0")
    assert done.stdout == "true\n" and "nothing meets these conditions" in done.stderr
    assert run("find", "x > a", "--assuming", "a > 0 and a < 0").stdout == "none\n"


def test_progress_is_written_through_a_pipe_where_it_is_wanted() -> None:
    hard = "ex x, y. x^4 + y^4 + a*x*y + b = 0 and x^3 - y^2 + a > 0 and x + y^3 > b"
    said = run("eliminate", hard, "--timeout", "3", "--progress").stderr.splitlines()
    assert any("..." in line and " s)" in line for line in said[:-1])
    assert run("eliminate", "ex x. x^2 = a", "--plain").stderr == ""
