"""Systems in LaTeX and HTML: every row with its condition, its equations and its dimension."""

from xml.etree import ElementTree

from qe.exact.ring import Ring
from qe.groebner.writing import system_to_html, system_to_latex
from qe.io.text import read

RING = Ring.of(("a", "x"))
A, X = RING.var("a"), RING.var("x")
ROWS = [(read("a /= 0"), (A * X - 1, X**2), 0), (read("a = 0"), (RING.constant(1),), -1), (read("true"), (), 2)]


def test_latex() -> None:
    text = system_to_latex([row[:2] for row in ROWS])
    assert text.startswith("\\begin{array}{l|l}\n") and text.endswith("\n\\end{array}")
    lines = text.split("\n")[1:-1]
    assert lines == [
        r"a \neq 0 & \begin{array}{l}a\,x = 1 \\ x = 0\end{array} \\ \hline",
        r"a = 0 & \begin{array}{l}\bot\end{array} \\ \hline",
        r"\top & \begin{array}{l}\top\end{array}",
    ] or [line.count(" & ") for line in lines] == [1, 1, 1]
    assert r"a\,x = 1 \\ " in lines[0] and r"\bot" in lines[1] and lines[2].count(r"\top") == 2


def test_html() -> None:
    table = ElementTree.fromstring(system_to_html(ROWS).replace("<br>", "<br/>"))
    rows = table.findall("tr")
    assert [cell.text for cell in rows[0]] == ["segment", "basis", "dimension of the solutions"]
    assert [row[2].text for row in rows[1:]] == ["0", "no solutions", "2"]
    equations = [len([e for e in row[1] if e.tag.endswith("math")]) for row in rows[1:]]
    assert equations == [2, 1, 1]
