"""What is installed beside the package: extras that are missing, and extensions."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from qe.errors import Unable
from qe.extras import _EXTRAS, lacking
from tests.tables import each

ROOT = Path(__file__).resolve().parents[2]
EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
PACKAGES = {
    "z3": "z3-solver",
    "pysat": "python-sat",
    "jinja2": "Jinja2",
    "mpl_toolkits": "matplotlib",
    "markupsafe": "Jinja2",
}
LINE = re.compile(r"qe.errors.Unable: \w+ is not installed; it comes with: pip install 'bezier-qe\[\w+\]'")
LESS = f"import sys\nfor name in {sorted(_EXTRAS)!r}: sys.modules[name] = None\n"
BARE = f"{LESS}from qe.processes import worker\nworker.START = {LESS!r} + worker.START\n"


def run(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", BARE + code], cwd=folder, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize(("module", "extra"), _EXTRAS.items())
def test_the_extra_brings_the_module(module: str, extra: str) -> None:
    names = [re.split(r"[\[>=]", requirement)[0] for requirement in EXTRAS[extra]]
    assert PACKAGES.get(module, module) in names


def test_an_unknown_module_is_a_bug() -> None:
    assert lacking(ImportError("no", name="qe.nothing")) is None
    assert isinstance(lacking(ImportError("no", name="scipy.spatial")), Unable)


def test_the_library_is_named_that_people_know() -> None:
    """A core installation asked for markupsafe, which nobody installs by that name."""
    assert str(lacking(ImportError("no", name="markupsafe"))).startswith("jinja2 is not installed")


def test_the_core_works(tmp_path: Path) -> None:
    code = "import qe; print(qe.eliminate('ex x. x^2 = b').formula, qe.region('x^2 <= 2').bounds('x').upper)"
    assert run(code, tmp_path).stdout.strip() == "b >= 0 sqrt(2)"


@each("on", "off")
def test_a_picture_without_its_library(process: str, tmp_path: Path) -> None:
    code = f"import os; os.environ['QE_PROCESS'] = {process!r}\nimport qe\nqe.region('x^2 <= 2').plot('a.png')"
    last = run(code, tmp_path).stderr.splitlines()[-1]
    assert LINE.fullmatch(last) and "bezier-qe[pictures]" in last


def test_the_command_without_its_library(tmp_path: Path) -> None:
    code = "from qe.cli.app import main; sys.exit(main(['region', 'x^2 <= 2', '--plot', 'a.png']))"
    done = run(code, tmp_path)
    assert done.returncode == 3
    assert "pip install 'bezier-qe[pictures]'" in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_a_plan_without_its_libraries(tmp_path: Path) -> None:
    problem = str(ROOT / "examples" / "three_balls.toml")
    done = run(f"from bezier.cli import main; sys.exit(main(['plan', {problem!r}, '--out', 'out']))", tmp_path)
    assert done.returncode == 3
    assert "pip install 'bezier-qe[p" in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_planning_from_python_without_its_libraries(tmp_path: Path) -> None:
    asked = "bezier.plan(start=[-4, 2, 1], via=[[-1, 2, 3], [1, 2, 3]], goal=[4, 2, 1])"
    assert LINE.fullmatch(run(f"import bezier\n{asked}", tmp_path).stderr.splitlines()[-1])
    assert "NoPath" in run("import bezier\nprint(bezier.NoPath)", tmp_path).stdout


WITHOUT_NUMPY = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
import bezier
plan = bezier.plan(start=[-4, 2, 1], via=[[-1, 2, 3], [1, 2, 3]], goal=[4, 2, 1], radius=6, limits={{"duration": 5}})
print(plan.certified, plan.points["Q1"] == (0, 2, 3), len(plan.to_csv().splitlines()) > 100)
for name in [n for n in sys.modules if n.partition(".")[0] == "numpy"]: del sys.modules[name]
sys.modules["numpy"] = sys.modules["scipy"] = sys.modules["matplotlib"] = None
"""


ASKED = ("plan(1)", "plan.to_svg()", "plan.save('a.npz')", "plan.to_ros()", "plan.save('out')")


def test_what_a_plan_cannot_give_without_them(tmp_path: Path) -> None:
    """Each is refused, one after the other."""
    asking = f"for asked in {ASKED!r}:\n  try: eval(asked)\n  except qe.errors.Unable: traceback.print_exc()"
    code = [sys.executable, "-c", f"{WITHOUT_NUMPY}\nimport qe.errors, traceback\n{asking}"]
    done = subprocess.run(code, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.stdout.strip() == "True True True"
    assert sum(LINE.fullmatch(line) is not None for line in done.stderr.splitlines()) == len(ASKED)
    assert not list(tmp_path.iterdir())


BIN = Path(sys.executable).parent
TEXT = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", TEXT, re.DOTALL)
SESSION = "\n".join(text for language, text in BLOCKS if language == "pycon")
DOCTEST = """
import doctest, pathlib, sys
session = pathlib.Path("session.txt").read_text(encoding="utf-8")
test = doctest.DocTestParser().get_doctest(session, {}, "extending", "docs/extending.md", 0)
outcome = doctest.DocTestRunner().run(test)
print(outcome.attempted)
sys.exit(outcome.failed > 0)
"""


def named(text: str) -> tuple[str, str]:
    """The file that a block names in its first line, and the rest."""
    first, _, rest = text.partition("\n")
    return first.removeprefix("# ").strip(), rest


def patched(before: str, change: str) -> str:
    """The text with the lines marked with + put below the others above them, each of which stands there once, and
    without those marked with -."""
    lines, place = before.splitlines(), None
    for line in change.splitlines():
        if line.startswith("+"):
            assert place is not None
            place += 1
            lines.insert(place, line[1:])
        else:
            (place,) = (k for k, old in enumerate(lines) if old == line[1:])
            if line.startswith("-"):
                del lines[place]
                place -= 1
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("tree")
    for package in ("qe", "bezier", "paper_repro", "experiments"):
        shutil.copytree(ROOT / package, place / package, ignore=shutil.ignore_patterns("*.pyc.*"))  # compiled ones, too
    for language, text in BLOCKS:
        if language in ("python", "toml"):
            name, rest = named(text)
            assert not (place / name).exists()
            (place / name).write_text(rest, encoding="utf-8")
        elif language == "diff":
            name, rest = named(text)
            (place / name).write_text(patched((place / name).read_text(encoding="utf-8"), rest), encoding="utf-8")
    (place / "session.txt").write_text(SESSION, encoding="utf-8")
    return place


def run_extension(tree: Path, *command: str | Path) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    return subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, timeout=120)


def test_the_sessions(tree: Path) -> None:
    done = run_extension(tree, sys.executable, "-c", DOCTEST)
    assert done.returncode == 0, done.stdout + done.stderr
    assert int(done.stdout.split()[-1]) == SESSION.count(">>> ") > 15


def test_the_commands(tree: Path) -> None:
    steps = "\n".join(text for language, text in BLOCKS if language == "console").split("$ ")[1:]
    assert len(steps) >= 2
    for command, *shown in (step.splitlines() for step in steps):
        program, *arguments = shlex.split(command)
        done = run_extension(tree, BIN / program, *arguments)
        assert done.returncode == 0, (command, done.stderr)
        assert [line for line in shown if line] == done.stdout.splitlines()[: len(shown)], (command, done.stdout)


def test_the_style_of_the_new_files(tree: Path) -> None:
    new = [named(text)[0] for language, text in BLOCKS if language == "python"]
    assert len(new) == 6
    shutil.copy(ROOT / "pyproject.toml", tree)
    done = run_extension(tree, sys.executable, "-m", "ruff", "check", "--ignore", "I001", *new)
    assert done.returncode == 0, done.stdout


def test_a_change_that_fits_nowhere_is_seen() -> None:
    assert patched("a\nb\n", " a\n+c\n+d\n b\n+e") == "a\nc\nd\nb\ne\n"
    assert patched("a\nb\n", "-a\n+c\n b\n+d") == "c\nb\nd\n"
    for before in ("b\n", "a\na\n"):
        with pytest.raises(ValueError):
            patched(before, " a\n+c")
