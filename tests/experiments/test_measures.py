"""Measures, figures and speed-ups."""

from __future__ import annotations

import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from bezier.obstacles.clearance import Contact, examine
from experiments import arm_figures, cli, invariance, measures, overhead, small, speedup
from experiments.adapters.answer import Limits
from experiments.arm_figures import Figure, table
from experiments.bench_obstacles import hidden_contacts, many_pairs, sampled_contact
from experiments.cli import main
from experiments.figures import Picture, pictures
from experiments.page import html
from experiments.problem import Problem
from experiments.results import Appender, Comparison, Log, Status
from experiments.speedup import Speedup, measured
from experiments.tables import page
from qe.exact.ring import Poly
from tests.experiments.test_results import result
from tests.tables import each


def log_of(*rows) -> Log:
    log = Log()
    for row in rows:
        log.results[row.key] = row
    return log


def test_par2_counts_unsolved_twice():
    assert measures.par2([result(seconds=3), result(status="timeout", limit=10), result(status="WRONG", limit=4)]) == 31


@each(
    ([(1, "solved"), (9, "solved"), (2, "solved")], 2, Status.SOLVED),
    ([(1, "solved"), (9, "timeout"), (9, "timeout")], 9, Status.TIMEOUT),
    ([(1, "solved"), (9, "timeout")], 9, Status.TIMEOUT),
    ([(1, "solved"), (2, "WRONG"), (3, "solved")], 2, Status.WRONG),
)
def test_repetitions(rows, seconds, status):
    row = measures.combined([result(seconds=s, status=t, repeat=i) for i, (s, t) in enumerate(rows)])
    assert (row.seconds, row.status) == (seconds, status)


def test_ratio_over_what_both_solved():
    mine = {"a": result(seconds=1), "b": result(seconds=2), "c": result(status="timeout"), "d": result(seconds=0)}
    other = {"a": result(seconds=3), "b": result(seconds=20), "c": result(), "e": result()}
    assert measures.median_ratio(mine, other) == pytest.approx(6.5)
    assert measures.median_ratio(mine, {}) is None


def test_growth_of_a_power_and_of_an_exponential():
    cubic = measures.growth([(n, 0.01 * n**3) for n in (2, 4, 8, 16)])
    assert cubic.exponent == pytest.approx(3) and cubic.exponent_fit == pytest.approx(1) and cubic.base_fit < 0.99
    doubling = measures.growth([(n, 0.01 * 2**n) for n in (2, 4, 8, 16)])
    assert doubling.base == pytest.approx(2) and doubling.base_fit == pytest.approx(1)
    assert measures.growth([(2, 1.0), (3, 2.0), (3, 2.5)]) is None
    assert measures.growth([(n, 0.5) for n in (1, 2, 3)]).exponent == pytest.approx(0)


def test_groups_keep_families_apart():
    rows = [result(set="paper/a", id="x"), result(set="paper/b", id="x"), result(set="public", solver="qepcad")]
    groups = measures.by_group(log_of(*rows))
    assert set(groups) == {"paper", "public"} and set(groups["paper"]["ours"]) == {"paper/a/x", "paper/b/x"}


def test_solvers_stand_in_a_fixed_order():
    rows = [result(solver=name) for name in ("yices", "new", "ours-cad", "qepcad", "ours")]
    assert list(measures.by_set(log_of(*rows))["s"]) == ["ours", "ours-cad", "qepcad", "yices", "new"]


def test_what_a_stage_is_worth():
    without = "ours-without-equations"
    rows = [
        result(id="a", seconds=1),
        result(id="a", seconds=4, solver=without),
        result(id="b", seconds=1),
        result(id="b", status="timeout", limit=10, solver=without),
        result(id="c", seconds=1),
    ]
    (gain,) = measures.gains(measures.by_set(log_of(*rows)).values())
    assert (gain.stage, gain.problems, gain.lost) == ("equations", 2, 1)
    assert (gain.median_ratio, gain.seconds_with, gain.seconds_without) == (4, 2, 24)


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


def test_small_questions_are_the_same_at_every_call_and_answered() -> None:
    for name in small.FAMILIES:
        assert small.questions(name, 3) == small.questions(name, 4)[:3]
    (linear,) = small.measured(3, ["linear"])
    assert linear.count == 3 and linear.seconds > 0 and linear.slowest[1] in small.questions("linear", 3)


def test_rewritings_are_the_same_for_a_seed_and_measured() -> None:
    assert [r.formula for r in invariance.generated(3)] == [r.formula for r in invariance.generated(3)]
    one = next(r for r in invariance.generated(3) if r.original.id == "circle-line")
    pairs = list(invariance.measured([one, replace(one, formula="x <", kind="broken")], Limits(20.0, 2048)))
    table = "\n".join(invariance.lines(pairs))
    assert [pair.after.status for pair in pairs] == [pairs[0].before.status, Status.CRASH]
    assert "generated: 1 rewritings, 0 lost" in table and "broken: 1 rewritings, 1 lost (circle-line)" in table


def test_core_operations_are_counted_and_never_take_longer_than_all() -> None:
    problem = Problem("here", "circle", "ex y. x^2 + y^2 = 1 and x*y^3 > a and y < x")
    found = overhead.measured(problem, repeat=1)
    assert found.ratio > 1 and f"all/core {found.ratio:5.1f}" in str(found)
    assert found.core["evaluations"][0] > found.core["factorisations"][0] > 0
    assert not hasattr(Poly.resultant, "__closure__") or Poly.resultant.__closure__ is None  # nothing is left watched


def test_the_bounds_of_the_speedup() -> None:
    found = Speedup(20.0, 21.0, 1.0, 0.5, (9.0, 8.5), 14.0, True)
    least, most = found.bounds
    assert least == pytest.approx(20 / 10.5) and most == pytest.approx(20 / 9.5)
    assert "this process 1.0 s (5 % of alone)" in str(found) and "on the clock, as it was: 1.50" in str(found)


def test_the_fuller_worker_and_this_process_bound_the_gain() -> None:
    assert Speedup(20.0, 20.0, 1.0, 0.5, (16.0, 1.0), 20.0, True).bounds[1] == pytest.approx(20 / 16)
    assert Speedup(20.0, 20.0, 15.0, 0.5, (3.0, 1.0), 20.0, True).bounds[1] == pytest.approx(20 / 15)


def test_answer_and_certificate_are_those_of_one_process(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    found = measured("ex z. x*y*z > 1 and x^2 + y^2 + z^2 < 4", 1)
    assert found.same and found.alone > 0 and len(found.workers) == 1
    monkeypatch.setattr(speedup, "_timed", lambda question, method, address: (_Told(address), 1.0, 1.0))
    assert "same answer and certificate: NO" in str(measured("x > 0", 1))


class _Told:
    """An answer that depends on where it was found."""

    def __init__(self, address: str | None) -> None:
        self.formula, self.certificate = address, None


def test_the_table() -> None:
    found = [Figure("quick", (0.001, 0.003, 0.002), 0.003, "9 s"), Figure("slow", (2.0,), 1.0, remark="why")]
    lines = table(found).splitlines()
    assert lines[2] == "| quick | 2.0 ms | 3.0 ms | 9 s |  |"
    assert lines[3] == "| slow | 2.00 s | 1.00 s (OVER) |  | why |"


def test_without_the_authors_points_others_are_drawn(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(arm_figures, "CORPUS", tmp_path)
    monkeypatch.setattr(arm_figures, "POINTS", 6)
    found = list(arm_figures._points())
    assert len(found) == 3
    assert all("6 points, 0 wrong counts" in f.remark and len(f.seconds) == 6 for f in found)


def test_a_wrong_count_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(arm_figures, "CORPUS", tmp_path)
    monkeypatch.setattr(arm_figures, "POINTS", 2)
    monkeypatch.setattr(arm_figures, "_closed_form", lambda point, length: 3)
    assert "2 wrong counts" in next(arm_figures._points()).remark


def test_the_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    asked = []

    def figures(repeat: int) -> list[Figure]:
        asked.append(repeat)
        return [Figure("a question", (1.0,), None)]

    monkeypatch.setattr(arm_figures, "figures", figures)
    assert main(["run", "--suite", "arm", "--repeat", "5"]) == 0
    assert asked == [5]
    assert "| a question | 1.00 s |" in capsys.readouterr().out


def test_sampling_misses_the_contacts_that_were_hidden_from_it() -> None:
    for near in hidden_contacts():
        assert isinstance(examine(near.curve, near.obstacle), Contact), near.what
        assert not sampled_contact(near.curve, near.obstacle), near.what


def test_proofs_agree_with_sampling_on_random_pairs() -> None:
    row, pairs = many_pairs(curves=12, obstacles=10)
    assert len(pairs) == 120 and row.note.endswith("of 120 pairs meet")
    assert any(not clear for *_, clear in pairs)
    for curve, obstacle, clear in pairs:
        if sampled_contact(curve, obstacle):
            assert not clear


def test_which_mechanism_decides_is_counted(capsys: pytest.CaptureFixture[str]) -> None:
    """Two discs are a closed form; nothing else is of use after it, and its step is proved."""
    assert main(["mechanisms", "--only", "putnam", "--check"]) == 0
    head, *rows = capsys.readouterr().out.splitlines()
    assert head.split() == ["tried", "used", "problems", "seconds", "in", "vain"]
    used = {name: row.split()[:3] for row in rows for _, name in [row.split(": ", 1)] if row.split()[1] != "0"}
    assert used["two balls (project putnam)"] == ["1", "1", "1"]
    assert not any("cad" in name for name in used)
    assert main(["mechanisms", "--only", "no such problem"]) == 2
