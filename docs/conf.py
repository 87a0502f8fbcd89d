"""The documentation site: `make docs` builds it into build/site."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import qe

HERE = Path(__file__).resolve().parent

project = "bezier-qe"
author = "the bezier-qe team"
release = qe.__version__
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["notes/*", *(f"gallery/*.{e}" for e in ("ipynb", "py", "json", "zip")), "sg_execution_times.rst"]
suppress_warnings = ["config.cache"]

html_show_copyright = False
html_theme = "furo"
html_title = "bezier-qe"
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
nb_execution_mode = "auto"
nb_execution_timeout = 120
nb_execution_in_temp = True
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = False
python_use_unqualified_type_names = True
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True


def written_pictures(
    block: tuple[str, str, int], block_vars: Mapping[str, Any], gallery_conf: Mapping[str, Any], **keywords: Any
) -> str:
    """The PNG files that a script of the gallery has written beside itself, moved into the page."""
    from sphinx_gallery.scrapers import figure_rst

    script = Path(block_vars["src_file"])
    places: Iterator[str] = block_vars["image_path_iterator"]
    moved: list[str] = []
    for picture in sorted(script.parent.glob("*.png")):
        moved.append(next(places))
        shutil.move(picture, moved[-1])
    return str(figure_rst(moved, gallery_conf["src_dir"]))


sphinx_gallery_conf = {
    "examples_dirs": [str(HERE.parent / "examples" / "gallery")],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "default_thumb_file": str(HERE / "_static" / "formula.svg"),
    "image_scrapers": (written_pictures,),
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "min_reported_time": 10,
}


def example_of_a_derivation(app: Any, error: Exception | None) -> None:
    """The page to which ``derivations.md`` links, as ``Derivation.to_html`` writes it."""
    if error is None:
        answer = qe.eliminate("ex x, y. x^2 + y^2 = a and x + y = b")
        (Path(app.outdir) / "derivation_example.html").write_text(answer.derivation.to_html(), "utf-8")


def reference_of_commands(app: Any) -> None:
    """The page of all commands and options, made of the commands themselves."""
    pages = []
    for name, module in (("qe", "qe.cli.app"), ("bezier", "bezier.cli.app")):
        run = [sys.executable, "-m", "typer", module, "utils", "docs", "--name", name]
        page = subprocess.run(run, capture_output=True, text=True, check=True).stdout
        pages.append(re.sub(r"^Examples:\n((?:  .*\n)+)", r"**Examples**:\n\n```console\n\1```\n", page, flags=re.M))
    text = re.sub(r"^#", "##", "\n".join(pages), flags=re.M)
    (HERE / "commands.md").write_text(f"# The commands\n\n{text}", "utf-8")


def setup(app: Any) -> None:
    """The page of the commands is written before the site is, the example after it."""
    app.connect("builder-inited", reference_of_commands)
    app.connect("build-finished", example_of_a_derivation)
