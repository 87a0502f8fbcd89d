"""Settings: one table, from which signatures, checks, documentation and options are made."""

import ast
import inspect
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from typer.main import get_command

import qe
from qe.api import settings
from qe.api.settings import MOST_WORKERS, Elimination, settings_in
from qe.cli.app import app
from qe.cli.options import ELSEWHERE, checked
from qe.options import Method, Projection
from tests.tables import each

ROOT = Path(__file__).resolve().parents[3]
TABLE = settings_in(Elimination)
FUNCTIONS: list[Callable[..., Any]] = [
    qe.eliminate,
    qe.decide,
    qe.find_instance,
    qe.check_witness,
    qe.equivalent,
    qe.region,
    qe.solve,
    qe.find_instances,
    qe.parametric_witnesses,
    qe.minimize,
    qe.maximize,
    qe.comprehensive_groebner,
    qe.real_root_classification,
]


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_signature_shows_the_settings(function: Callable[..., Any]) -> None:
    parameters = inspect.signature(function).parameters
    assert not [p for p in parameters.values() if p.kind is p.VAR_KEYWORD]
    assert {"timeout", "memory", "progress", "process"} <= set(parameters)
    explicit = set(inspect.signature(inspect.unwrap(function)).parameters)
    for name in parameters.keys() & TABLE.keys() - explicit:
        hint, setting = TABLE[name]
        assert parameters[name].default == setting.default and parameters[name].annotation == hint
        assert f"``{name}``: {setting.says}" in " ".join((function.__doc__ or "").split())


def test_the_signature_of_eliminate() -> None:
    assert set(inspect.signature(qe.eliminate).parameters) == {"formula", *TABLE}
    assert "timeout: float | None = None" in str(inspect.signature(qe.eliminate))


@pytest.mark.parametrize("function", FUNCTIONS)
def test_other_keywords_are_refused(function: Callable[..., Any]) -> None:
    name = function.__name__
    with pytest.raises(
        TypeError, match=rf"^{name}\(\) got an unexpected keyword argument 'timeot'. Did you mean 'timeo"
    ):
        function("x > 0", timeot=3)
    with pytest.raises(TypeError, match=rf"^{name}\(\) got an unexpected keyword argument 'zzz'$"):
        function("x > 0", zzz=3)


@each(
    ("workers", (0, 3, MOST_WORKERS), (-1, MOST_WORKERS + 1, True, "2", 1.5)),
    ("cluster", (None, "host:1", "tcp://host:8786"), ("host", "host:", 3, "a b:1")),
    ("race", ((), "vs", ["vs", qe.Method.CAD]), ("fastest", 3, ["vs", 3])),
    ("timeout", (None, 2, 0.5), (-1, 0, "1", True)),
    ("process", (True, False), (0, "yes", None)),
)
def test_values_are_checked(name: str, values: tuple[object, ...], wrong: tuple[object, ...]) -> None:
    check = TABLE[name][1].check
    for value in values:
        assert check(check(value, what=name), what=name) == check(value, what=name)
    for value in wrong:
        with pytest.raises(qe.InputError, match=f"^{name}: "):
            check(value, what=name)


def test_workers_and_cluster_exclude_each_other() -> None:
    with pytest.raises(qe.InputError, match="one of them"):
        qe.eliminate("x > 0", workers=2, cluster="host:1")


def test_every_setting_is_said_once() -> None:
    tree = ast.parse(Path(settings.__file__).read_text())
    fields = [
        n.target.id
        for c in tree.body
        if isinstance(c, ast.ClassDef)
        for n in c.body
        if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)
    ]
    assert set(TABLE) <= set(fields) and all(fields.count(name) == 1 for name in TABLE if name != "check")


def table_of_settings() -> str:
    """All settings of ``qe.eliminate`` as a table in Markdown."""
    rows = [f"| `{name}` | {_shown(s.default)} | {s.says} |" for name, (_, s) in settings_in(Elimination).items()]
    return "\n".join(["| keyword | default | meaning |", "|---|---|---|", *rows])


def _shown(default: object) -> str:
    value = default.value if isinstance(default, Method | Projection) else default
    return "no listener" if callable(value) else f"`{value!r}`"


def test_the_reference_has_the_table() -> None:
    assert table_of_settings() in (ROOT / "docs" / "api.md").read_text()


def test_the_command_line_has_the_settings_as_options() -> None:
    commands = get_command(app).commands  # type: ignore[attr-defined]
    for name, also in (("eliminate", set()), ("decide", {"anytime", "generic"})):
        options = {o.name: o for o in commands[name].params}
        assert set(TABLE) - ELSEWHERE - also <= set(options)
        assert not options["workers"].default and options["timeout"].help == "Seconds, enforced."


def test_an_option_is_checked_by_its_own_name() -> None:
    assert checked({"race": "vs,cad", "order": "x,y"}) == {
        "race": frozenset({qe.Method.VS, qe.Method.CAD}),
        "order": ("x", "y"),
    }
    for name, value in (("race", "fastest"), ("timeout", 0.0), ("workers", -1), ("order", "x x"), ("cluster", "here")):
        with pytest.raises(qe.InputError, match=f"^--{name}: "):
            checked({name: value})


def test_users_of_type_checkers_see_the_keywords(tmp_path: Path) -> None:
    user = tmp_path / "user.py"
    user.write_text(
        "import qe\n"
        'answer: qe.Answer = qe.eliminate("x > 0", timeout=3, method="cad", race=["vs"], anytime=True)\n'
        'optimum: qe.Optimum = qe.minimize("x", method="convex", timeout=3)\n'
        'qe.decide("x > 0", timeot=3)\n'
        'qe.solve("x > 0", timeout="3")\n'
    )
    public = ["qe/__init__.py", "qe/api", "qe/proof/answer.py", "qe/convex/optimum.py"]  # not all that they rest on
    checked = [sys.executable, "-m", "mypy", "--strict", "--follow-imports", "skip", "--cache-dir", str(tmp_path)]
    run = subprocess.run([*checked, str(user), *public], cwd=ROOT, capture_output=True, text=True, timeout=300)
    lines = [line for line in run.stdout.splitlines() if "error:" in line and user.name in line]
    assert len(lines) == 2 and 'did you mean "timeout"' in lines[0] and '"timeout" to "solve"' in lines[1], run.stdout
