"""The page in a browser, where one is installed: no complaints on the console, every picture and formula has a size."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from paper_repro import __main__ as command

BROWSER = next(
    (path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None
)
PROBE = """<script>
addEventListener("load", () => {
  const empty = [...document.querySelectorAll("figure svg, math")].filter(e => !(e.getBoundingClientRect().height > 4));
  const wide = document.documentElement.scrollWidth > innerWidth;
  document.title = `figures ${document.querySelectorAll("figure svg").length} empty ${empty.length} wide ${wide}`;
});
</script>"""


@pytest.mark.deep
@pytest.mark.skipif(BROWSER is None, reason="no browser is installed")
def test_the_page_in_a_browser(tmp_path: Path) -> None:
    keys = ("radius-rule", "de-casteljau", "eq-6", "eq-7", "eq-4")
    assert command.main(["--out", str(tmp_path), *(word for key in keys for word in ("--only", key))]) == 0
    probed = tmp_path / "probed.html"
    html = (tmp_path / "index.html").read_text()
    # What lies in a closed <details> has no size; it is opened for the probe.
    probed.write_text(html.replace("</body>", PROBE + "</body>").replace("<details>", "<details open>"))
    flags = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--window-size=1100,900"]
    page = subprocess.run(
        [str(BROWSER), *flags, "--virtual-time-budget=5000", "--dump-dom", probed.as_uri()],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert not [line for line in page.stderr.splitlines() if "CONSOLE" in line]
    (title,) = re.findall(r"<title>(.*?)</title>", page.stdout)
    assert title == "figures 3 empty 0 wide false"
