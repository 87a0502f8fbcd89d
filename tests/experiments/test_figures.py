"""Tables, figures and the page: they carry the data, and a browser shows them."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import asdict

import pytest

from experiments import cli
from experiments.figures import Picture, pictures
from experiments.page import html
from experiments.results import Appender, Comparison, Log
from experiments.tables import page
from tests.experiments.test_measures import log_of
from tests.experiments.test_results import result

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)


def sample() -> Log:
    rows = [result(set="public", id=f"p{i}", seconds=0.01 * 3**i, answer="x > 0") for i in range(6)]
    rows += [result(set="public", id=f"p{i}", seconds=0.07 * 2**i, solver="qepcad") for i in range(4)]
    rows += [result(set="public", id="p4", status="timeout", limit=15.0, solver="qepcad")]
    rows += [result(set="public", id="p5", status="unsupported", solver="qepcad")]
    rows += [result(set="scaling/balls", id=f"b{n}", seconds=0.01 * n**2, size=n) for n in (2, 4, 8)]
    rows += [result(set="scaling/balls", id="b16", status="timeout", limit=15.0, size=16)]
    found = log_of(*rows)
    found.environments[""] = {"processors": 2, "machine": "Test CPU", "memory_mib": 1, "system": "Linux", "python": "3"}
    return found


@pytest.fixture
def log() -> Log:
    return sample()


@pytest.fixture(scope="module")
def drawn() -> dict[str, Picture]:
    return {p.name: p for p in pictures(sample())}


def test_all_pictures_are_there(drawn):
    assert set(drawn) == {"cactus-public", "cactus-scaling", "growth-balls", "scatter-qepcad"}
    assert list(pictures(Log())) == []


def test_solved_over_time_carries_every_time(drawn):
    lines = drawn["cactus-public"].figure.axes[0].get_lines()
    assert [line.get_label() for line in lines] == ["ours", "qepcad"]
    times, counts = lines[0].get_xdata(), lines[0].get_ydata()
    assert (min(times), max(times), max(counts)) == (0.01, pytest.approx(2.43), 6)


def test_scatter_shows_every_problem_offered_to_both(drawn):
    axes = drawn["scatter-qepcad"].figure.axes[0]
    points = axes.collections[0].get_offsets().tolist()
    assert len(points) == 5 and [0.01, 0.07] in points and [pytest.approx(0.81), 30.0] in points
    low, high = axes.get_xlim()
    assert all(low < value < high for point in points for value in point)


def test_growth_shows_the_exponent_and_what_was_not_solved(drawn):
    axes = drawn["growth-balls"].figure.axes[0]
    solved, lost = axes.get_lines()
    assert "size^2.0" in solved.get_label()
    assert list(solved.get_xdata()) == [2, 4, 8] and list(lost.get_xdata()) == [16]
    low, high = axes.get_xlim()
    assert low < 2 and high > 16


def test_vector_graphics_are_well_formed_and_repeatable(drawn):
    for picture in drawn.values():
        text = picture.svg()
        tree = ElementTree.fromstring(text)
        assert tree.tag.endswith("svg") and len(list(tree.iter("{http://www.w3.org/2000/svg}path"))) > 10
    assert text == picture.svg()


def test_tables(log):
    text = page(log, [("a caption", "images/a.svg")])
    assert "**No wrong answer**" in text and "![a caption](images/a.svg)" in text and "2 x Test CPU" in text
    row = next(line for line in text.splitlines() if line.startswith("| qepcad | 5"))
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert cells[:6] == ["qepcad", "5", "4", "4", "0", "1"] and cells[6] == "31"
    assert re.search(r"\| scaling/balls \| ours \| 2…8 \| 0.04…0.64 \| 2 \| 1 ", text)


def test_wrong_answers_come_first(log):
    row = result(set="public", id="p9", status="WRONG", answer="x < 0 or | y |")
    log.results[row.key] = row
    log.comparisons["public", "p8", "ours", "z3"] = Comparison("public", "p8", "ours", "z3", "different", "d")
    text = page(log)
    headings = [line for line in text.splitlines() if line.startswith("## ")]
    assert headings[:2] == ["## WRONG ANSWERS", "## Disagreements"] and "No wrong answer" not in text
    assert "x < 0 or \\| y \\|" in text and "| ours | z3 | public | p8 |" in text
    assert "<td>x &lt; 0 or | y |</td>" in html(log, [])


def test_the_commands_write_everything(log, tmp_path, capsys):
    path = tmp_path / "r.jsonl"
    file = Appender(path)
    for row in log.results.values():
        file.write(asdict(row))
    path.write_text(path.read_text() + "spoilt\n")
    for command in ("table", "figures", "html"):
        assert cli.main([command, "--results", str(path), "--out", str(tmp_path / command)]) == 0
    assert f"{path}:17: line skipped" in capsys.readouterr().err
    assert len(list((tmp_path / "figures").glob("*.svg"))) == 4
    assert (tmp_path / "html").read_text().count("<svg") == 4
    assert "| qepcad | 5 |" in (tmp_path / "table").read_text()


MEASURE = """
<script>
window.addEventListener("load", () => {
  const sizes = [...document.querySelectorAll("figure svg")].map(e => e.getBoundingClientRect());
  const seen = sizes.filter(b => b.width > 100 && b.height > 100).length;
  const painted = [...document.querySelectorAll("figure svg")].filter(e => e.getBBox().width > 100).length;
  document.body.setAttribute("data-seen", `${seen} ${painted} of ${sizes.length}`);
});
</script>
</body>"""


@pytest.mark.skipif(BROWSER is None, reason="no browser is installed")
def test_the_page_in_a_browser(log, drawn, tmp_path):
    path = tmp_path / "page.html"
    path.write_text(html(log, list(drawn.values())).replace("</body>", MEASURE))
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0", "--dump-dom"]
    command = [BROWSER, *flags, f"--user-data-dir={tmp_path / 'profile'}", path.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert "CONSOLE" not in done.stderr
    assert 'data-seen="4 4 of 4"' in done.stdout
    assert not re.search(r'(src|href)="(?!#|data:)', path.read_text()), "nothing is loaded from elsewhere"
