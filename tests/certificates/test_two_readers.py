"""The plain reader, as one file without dependencies, and the kernel on FLINT give the same verdicts.

On certificates of all rules as they are made, and on texts that are none; altered ones of all kinds are what the other
tests of this folder read (``conftest``).
"""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

import qe.kernel.signs
from qe.options import Projection
from qe.proof.certificate import Certificate
from tests.certificates.both_readers import compared
from tests.certificates.derivations import CASES, certificate
from tests.certificates.false_claims import text_of
from tests.certificates.producing import cell_table

TABLES = [
    ("x^2 + y^2 < 1 or x*y = 2", "x y", ".E"),
    ("a*x^2 + 2*x + 1 = 0 and x > a", "a x", ".E"),
    ("y^3 - x*y + 1 > 0", "x y", ".A"),
    ("x^3 - 2 < 0 and x^2 > 2", "x", ""),
    ("(x - 1)*y^2 + x*y - 1 = 0 and y > x", "x y", ".E"),
    ("x^2 = 2 and y^2 = x + 2 and z > x*y", "x y z", "EEE"),
    ("x^2 - 3 = 0 and y^3 - x*y + x = 0 and (y^2 - x)^2 > 0", "x y", "EE"),
    ("x^4 - x - 1 = 0 and y^2 < x", "x y", "EE"),
]


def test_right_certificates(reader: Path, tmp_path: Path) -> None:
    tables = [cell_table(*table, projection) for table in TABLES for projection in Projection]
    made = [*tables, Certificate.bundle([("one", tables[0]), ("two", tables[-1])]), *map(certificate, CASES.values())]
    verdicts = compared(reader, [one.to_json() for one in made], tmp_path)
    assert set(verdicts[: len(tables) + 1]) == {"accepted"}
    assert verdicts.count("accepted") > len(tables) + len(CASES) / 2  # the others need the expert ring


NO_CERTIFICATES = ("", "{}", "[" * 100_000, '{"format": "bezier-qe certificate"}', '{"format": 1}', '"x"', "[1, 2")
LISTED = (["x"], ["x", "x"], ["2*x"], ["-x"], ["1"])
"""Polynomials of lemmas have one spelling, and are listed once."""
SPELLED = ("-x + x^2", "2*x^2 - 2*x", "x*x - x", "x^2 - x^1", "x*y + x^2", "y*x", "1", f"x - {'9' * 5000}")
"""Not as a formula has it."""
SHAPES = (["atom", "-x^2 + x", "<"], ["or", ["atom", "x^2 - x", ">"]], ["and"])
RIGHT = ("x^2 - x", "x^2000 + y", f"{'9' * 5000}*x + y", "x^2 + y - 4")


def by_one_step(rule: str, before: object, after: object, evidence: object, *names: str) -> str:
    step = {"rule": rule, "at": [], "context": [], "before": before, "after": after, "evidence": evidence}
    payload: dict[str, Any] = {"order": names, "start": before, "steps": [step], "answer": after}
    return text_of({"format": "bezier-qe certificate", "version": 3, "kind": "derivation", "payload": payload})


def lemmas_text(listed: list[str]) -> str:
    """With these polynomials in the lemmas of a step."""
    claim = ["atom", "x", ">"]
    return by_one_step("signs", claim, claim, {"theory": {"polynomials": listed, "lemmas": [], "cases": []}}, "x")


def formula_text(matrix: object) -> str:
    """That a point satisfies the formula."""
    question = ["exists", ["x", "y"], matrix]
    return by_one_step("instance", question, True, {"order": ["x", "y"], "values": ["2", "1"]}, "x", "y")


def test_texts_written_by_hand(reader: Path, tmp_path: Path) -> None:
    """All by one run of the reader, whose start takes longer; numbers of any size, as commands read them."""
    texts = dict.fromkeys(NO_CERTIFICATES, "rejected")
    texts |= {lemmas_text(listed): "accepted" if listed == ["x"] else "rejected" for listed in LISTED}
    texts |= {formula_text(["atom", p, ">"]): "rejected" for p in SPELLED}
    texts |= {formula_text(shape): "rejected" for shape in SHAPES}
    texts |= {formula_text(["atom", p, ">"]): "accepted" for p in RIGHT}
    most = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        assert dict(zip(texts, compared(reader, list(texts), tmp_path), strict=True)) == texts
    finally:
        sys.set_int_max_str_digits(most)


def test_exit_status_and_words(reader: Path, tmp_path: Path) -> None:
    file = tmp_path / "certificate.json"

    def status(text: str, *more: str) -> tuple[int, str]:
        file.write_text(text)
        command = [sys.executable, "-I", str(reader), str(file), *more]
        done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
        return done.returncode, done.stdout

    right = certificate("ex x. x^2 + b*x + c = 0").to_json()
    code, words = status(right)
    assert code == 0 and words.startswith("accepted\n") and "b^2 - 4*c >= 0" in words
    assert status(right.replace("<=", "<"))[0] == 4
    assert status(cell_table(*TABLES[5]).to_json(), "--timeout", "0.001")[0] == 3
    command = [sys.executable, "-I", str(reader), "nowhere"]
    missing = subprocess.run(command, capture_output=True, text=True, check=False)
    assert missing.returncode == 2 and len(missing.stderr.splitlines()) == 1


def test_the_file_holds_the_modules_as_they_are_and_can_write_itself(reader: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.pyz"
    subprocess.run([sys.executable, "-I", "-S", str(reader), "--write-reader", str(copy)], check=True)
    assert copy.read_bytes() == reader.read_bytes()
    with zipfile.ZipFile(reader) as archive:
        names = archive.namelist()
        assert archive.read("qe/kernel/signs.py") == Path(qe.kernel.signs.__file__).read_bytes()
    assert not [name for name in names if name.startswith(("qe/expert", "qe/proving", "qe/cli"))]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "a certificate expected"),
        (["--write-reader", "no/such/folder/reader.pyz"], "No such file"),
        (["--timeout", "0", "c.json"], "a positive number of seconds"),
        (["--timeout", "nan", "c.json"], "a positive number of seconds"),
    ],
)
def test_wrong_arguments_get_one_line_and_no_traceback(arguments: list[str], said: str, reader: Path) -> None:
    command = [sys.executable, "-I", "-S", str(reader), *arguments]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
