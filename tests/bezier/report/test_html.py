"""Pages of reports: HTML, mathematics that may end a line, what a browser shows, and what comes first."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from fractions import Fraction
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from pathlib import Path as FilePath
from xml.etree import ElementTree

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from markupsafe import Markup

import qe
from bezier.curves.enclosure import Enclosure
from bezier.planner.command import write_folder
from bezier.planner.planning import make_plan
from bezier.planner.table import method_of
from bezier.plans import Clock, Plan
from bezier.problem import load_problem, read_problem
from bezier.report import first, html, mathml
from bezier.report.html import Card, Page, Section
from bezier.report.page import page_of, render
from qe.io.text import read
from tests.tables import each

VOID = {"meta", "link", "input", "img", "br"}
SPITEFUL = "<b>\"&'</b></script><!--"


class Reader(HTMLParser):
    """The text of a page; fails where an element is not closed in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.text: list[str] = []
        self.links: list[str] = []
        self.ids: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        known = dict(attributes)
        self.ids += [str(known["id"])] if "id" in known else []
        self.links += [str(known["href"])] if tag == "a" else []

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not self.open or self.open[-1] not in ("style", "script"):
            self.text.append(data)


def parsed(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    reader.close()
    assert not reader.open
    return reader


@example(SPITEFUL)
@example("a < b & c")
@settings(max_examples=60, deadline=None)
@given(st.text(alphabet=st.characters(exclude_categories=("Cs", "Cc")), max_size=30))
def test_text_comes_out_as_it_went_in(text: str) -> None:
    pieces = html.joined(
        html.table((text, "b"), [(text, html.toned(text, True))]),
        html.folded(text, html.pre(text)),
        html.bullets([text]),
        html.formula([text]),
        html.paragraph(text, "note"),
        html.heading(html.strong(text)),
        html.figures([("<svg></svg>", text)]),
    )
    card = Card(text, text, "good", text)
    page = Page(title=text, lead=text, cards=[card], sections=[Section("a", text, pieces)], footer=text)
    assert "".join(parsed(html.document(page)).text).count(text) >= 14


def test_a_page_leads_to_its_sections() -> None:
    sections = [Section(key, f"about {key}", html.paragraph(SPITEFUL), short=key) for key in ("one", "two")]
    page = parsed(html.document(Page(title=SPITEFUL, lead="", sections=sections, footer="")))
    assert page.links == ["#content", "#one", "#two"] and {"content", "one", "two"} <= set(page.ids)
    assert "data-scene" not in html.document(Page(title="", lead="", sections=sections, footer=""))


def test_drawings_have_alternative_texts() -> None:
    shown = html.described('<svg width="3"><path/></svg>', 'a "view"')
    assert shown == '<svg role="img" aria-label="a &#34;view&#34;" width="3"><path/></svg>'


def test_tables_without_rows_are_nothing() -> None:
    assert html.table(("a",), []) == "" and html.bullets([]) == "" and html.figures([]) == ""
    assert html.table((), [("x", Markup("<b>1</b>"))], numbers=(1,)).count('<td class="num"><b>1</b></td>') == 1


def elements(line):
    return [ElementTree.fromstring(part) for part in line.split("<wbr>")]


def written(line):
    return "".join("".join(element.itertext()) for element in elements(line))


def test_a_long_sum_ends_at_its_signs():
    (line,) = mathml.conjunction_lines(read("4*x^2 + 4*y^2 - 3*x*y - 48 <= 0"))
    _, *rest = elements(line)
    assert len(rest) == 3 and all(e[0].text in "+−" and e[0].get("form") == "infix" for e in rest)
    whole = mathml.math(mathml.formula(read("4*x^2 + 4*y^2 - 3*x*y - 48 <= 0")))
    assert written(line) == "".join(ElementTree.fromstring(whole).itertext())


def test_brackets_roots_and_fractions_stay_whole():
    body = mathml.number_text("(3 - sqrt(5 + 2))/2")
    assert "<wbr>" not in mathml.lines(body)
    assert len(elements(mathml.lines(f"<mo>∃</mo><mi>x</mi><mo>(</mo>{body}<mo>∧</mo>{body}<mo>)</mo>"))) == 2
    bracketed = "<mrow><mo>(</mo><mi>a</mi><mo>+</mo><mi>b</mi><mo>)</mo></mrow>"
    assert mathml.lines(bracketed) == mathml.math(bracketed)


def test_a_sign_at_the_beginning_is_no_end():
    (line,) = mathml.conjunction_lines(read("x*y = 0"))
    assert "<wbr>" not in line
    assert re.match(r"<math[^>]*><mo>−</mo>", mathml.lines("<mrow><mo>−</mo><mi>x</mi></mrow>"))


BROWSER = next(
    (path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None
)
needs_browser = pytest.mark.skipif(BROWSER is None, reason="no browser is installed")
PROBE = """<script>
addEventListener("load", () => setTimeout(() => {
  const seen = c => {
    const w = c.width, h = c.height, d = c.getContext("2d").getImageData(0, 0, w, h).data;
    let inked = 0, edge = 0;
    for (let i = 0; i < w * h; i++) if (d[4 * i + 3] > 0) {
      inked++;
      const x = i % w, y = Math.floor(i / w);
      if (x === 0 || y === 0 || x === w - 1 || y === h - 1) edge++;
    }
    return [inked / (w * h), edge === 0];
  };
  const box = e => e.getBoundingClientRect();
  const out = document.createElement("pre");
  out.id = "found";
  out.textContent = JSON.stringify({
    inside: document.documentElement.scrollWidth <= innerWidth,
    canvases: [...document.querySelectorAll("canvas")].map(c => [box(c).width, ...seen(c)]),
    drawings: [...document.querySelectorAll("figure svg")].map(e => [box(e).width, box(e).height]),
    nameless: [...document.querySelectorAll("canvas, figure svg")].filter(e => !e.getAttribute("aria-label")).length,
    cards: box(document.querySelector(".cards")).top,
    told: document.querySelector("output").textContent,
    back: getComputedStyle(document.body).backgroundColor,
  });
  document.body.append(out);
}, 600));
</script></body>"""

READER = """<script>onload = () => setTimeout(() => {
  document.body.append(document.querySelector("iframe").contentDocument.getElementById("found").cloneNode(true));
}, 1500);</script>"""
"""A window of a phone's width is given by a frame: browsers have a least width."""


@pytest.fixture(scope="module")
def page(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    made = make_plan(load_problem(root / "examples" / "obstacle_motion.toml"))
    write_folder(made, folder, folder, Clock(), plots=True)
    report = folder / "report.html"
    probed = folder / "probed.html"
    probed.write_text(report.read_text().replace("</body>", PROBE))
    return probed


def opened(page: Path, folder: Path, width: int, dark: bool) -> dict[str, object]:
    frame = folder / "frame.html"
    inner = f'<iframe src="{page.as_uri()}" style="width:{width}px;height:900px;border:0"></iframe>'
    frame.write_text(inner + READER)
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--window-size=1500,1000"]
    flags += ["--allow-file-access-from-files", "--virtual-time-budget=4000", f"--user-data-dir={folder / 'profile'}"]
    flags += ["--blink-settings=preferredColorScheme=0"] if dark else []
    done = subprocess.run(
        [str(BROWSER), *flags, "--dump-dom", frame.as_uri()], capture_output=True, text=True, timeout=240
    )
    assert not [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    (text,) = re.findall(r'<pre id="found">(.*?)</pre>', done.stdout, re.DOTALL)
    found: dict[str, object] = json.loads(text)
    return found


@needs_browser
@each((420, True), (1400, False), daily=2)
def test_the_page_in_a_browser(width: int, dark: bool, page: Path, tmp_path: Path) -> None:
    found = opened(page, tmp_path, width, dark)
    assert found["inside"], "nothing is wider than the screen"
    assert found["canvases"] and found["nameless"] == 0
    for wide, ink, free in found["canvases"]:  # type: ignore[attr-defined]
        assert wide > 0.4 * min(width, 1100) and ink > 0.02, "something is drawn"
        assert free, "and nothing touches the frame"
    assert all(w > 200 and h > 100 for w, h in found["drawings"])  # type: ignore[attr-defined]
    assert dark or float(str(found["cards"])) < 400, "the figures are on the first screen"
    assert re.match(r"t = .* s · \(.*\) mm · .* mm/s", str(found["told"]))
    assert found["back"] == ("rgb(16, 23, 29)" if dark else "rgb(243, 245, 247)")


START = 'start = [-4, 2, 1]\nvia = [[-1, 2, "5/2"], [1, 2, "5/2"]]\ngoal = [4, 2, 1]\nradius = 6\n'
LIMITS = "[timing]\nmax_speed = 2\n"
GOING_ROUND = '[[obstacle]]\nname = "pole"\nkind = "ball"\ncentre = [0, -3, 1]\nradius = 1\n'


@cache
def planned(*tables: str) -> Plan:
    """Planned once; tests leave it as it is."""
    return make_plan(read_problem("\n".join(tables), "problem.toml"), Clock())


@given(st.fractions(0, 1000), st.fractions(0, Fraction(1, 10)))
def test_a_number_shown_for_an_enclosure_is_right_to_its_last_digit(low: Fraction, width: Fraction) -> None:
    text = Enclosure(low, low + width).shown()
    if "…" not in text:
        digits = len(re.sub(r"e.*|\D", "", text).lstrip("0"))
        unit = Fraction(10) ** (len(str(int(low + width))) - digits + 1)
        assert abs(Fraction(text) - low) <= unit and abs(Fraction(text) - low - width) <= unit
    else:
        below, above = map(Fraction, text.split(" … "))
        assert below <= low and low + width <= above


def test_no_end_is_said() -> None:
    assert Enclosure(Fraction(3), None).shown().startswith("at least 3")


def labels(plan: Plan) -> list[str]:
    return [card.label for card in first.cards(plan)]


def test_cards_are_those_of_the_problem() -> None:
    plain = planned(START)
    assert "least distance to an obstacle" not in labels(plain) and "least time" not in labels(plain)
    full = planned(START, LIMITS, GOING_ROUND)
    assert {"result", "length", "least distance to an obstacle", "least time", "largest curvature"} <= {*labels(full)}
    told = {card.label: card for card in first.cards(full)}
    assert told["least time"].note == "quintic law; limits kept at all times, proved"
    assert full.quality is not None and full.quality.motion is not None
    assert float(told["least time"].value.split()[0]) == pytest.approx(float(full.quality.motion.duration), rel=1e-4)
    assert told["result"].note.startswith("proved") and "NOT" not in told["result"].note


def test_solving_and_drawing_are_told_apart() -> None:
    plan = replace(planned(START), seconds={"elimination": 1.0, "pictures": 2.0, "report": 0.5})
    card = first.cards(plan)[-1]
    assert (card.value, card.note) == ("1.00 s solving", "2.50 s drawing")


def test_where_there_is_no_path_the_reason_comes_first(root: FilePath) -> None:
    plan = make_plan(load_problem(root / "examples" / "no_control_point.toml"))
    page = page_of(plan, method_of(plan.problem.method), None)
    assert page.sections[0].key == "none" and "least 6" in page.sections[0].content
    assert page.title == "no control point: no path exists" and page.first is None


def test_the_scene_moves_with_the_motion(tmp_path: FilePath) -> None:
    plan = planned(START, LIMITS, GOING_ROUND)
    method = method_of(plan.problem.method)
    page = render(plan, method, method.draw(plan, tmp_path))
    data = json.loads(re.findall(r'type="application/json">(.*?)</script>', page)[0])
    assert plan.quality is not None and plan.quality.motion is not None
    end = float(plan.quality.motion.duration)
    assert data["motion"]["unit"] == "s" and data["motion"]["t"][-1] == pytest.approx(end, rel=1e-4)
    assert data["motion"]["p"][:3] == [-4, 2, 1] and data["motion"]["p"][-3:] == [4, 2, 1]
    assert max(data["motion"]["speed"]) <= 2.001 and len(data["bodies"]) == 1
    assert page.count("<canvas") == page.count('<canvas role="img" tabindex="0" aria-label="')
    assert page.count("<svg") == page.count('<svg role="img" aria-label="') and len(page) < 1_500_000


@each(("x^2 - 2*a", "<mo>−</mo>"), ("2*x^2 - a", "<mfrac>"), ("x^2 - a*x + 1", "<mfrac>"))
def test_a_bound_of_degree_two_is_a_radical_over_a_number_above_one(poly: str, shape: str) -> None:
    (cell,) = qe.region(f"{poly} < 0 and a > 0 and a < 10", order=("a", "x")).cells[-1:]
    written = mathml.cell(cell)[-1]
    assert shape in written and "<msqrt>" in written and ("<mfrac>" in written) is (shape == "<mfrac>")
