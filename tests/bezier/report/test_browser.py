"""Pages in a browser, where one is installed: on a wide screen and on a phone, by day and by night."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from bezier.planner.command import write_folder
from bezier.planner.planning import make_plan
from bezier.plans import Clock
from bezier.problem import load_problem
from tests.tables import each

BROWSER = next(
    (path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None
)
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no browser is installed")
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


@each((1400, False), (420, True))
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
