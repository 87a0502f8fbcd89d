"""The plain reader, as one file without dependencies, and the kernel on FLINT give the same verdicts.

On certificates of all kinds and rules as they are made, and as they are altered.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

import qe.kernel.signs
from qe.options import Projection
from qe.proof.certificate import Certificate
from tests.certificates.altered_derivations import altered_derivation
from tests.certificates.both_readers import compared
from tests.certificates.derivations import CASES, certificate
from tests.certificates.false_claims import derivation, derivation_by_a_rule, other_claim, text_of
from tests.certificates.mutation import leaves, replaced
from tests.certificates.producing import cell_table
from tests.certificates.test_false_claims import true_certificates

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


def altered(rng: random.Random, text: str, count: int) -> Iterator[str]:
    """The certificate with other claims, other leaves of its data, and, of a derivation, other steps."""
    whole = json.loads(text)
    for _ in range(count):
        if "payload" in whole and "answer" in whole["payload"]:
            yield text_of(other_claim(rng, whole))
        path, old = rng.choice([(path, old) for path, old in leaves(whole) if path[0] == "payload"])
        others = ("0", "1", "x", "-x + 1/2", "<", "", None, [], f"{old} ")
        value = old + 1 if isinstance(old, int) else rng.choice(others)
        yield replaced(whole, path, value)
        if whole["kind"] == "derivation" and (made := altered_derivation(rng, whole)) is not None:
            yield text_of(made)


def test_derivations_of_all_rules(reader: Path, tmp_path: Path) -> None:
    texts = [certificate(text).to_json() for text in CASES.values()]
    verdicts = compared(reader, texts, tmp_path)
    assert verdicts.count("accepted") > len(texts) / 2  # the others need the expert ring


def test_cell_tables_and_bundles(reader: Path, tmp_path: Path) -> None:
    tables = [cell_table(*table, projection) for table in TABLES for projection in Projection]
    bundle = Certificate.bundle([("one", tables[0]), ("two", tables[-1])])
    texts = [table.to_json() for table in (*tables, bundle)]
    assert set(compared(reader, texts, tmp_path)) == {"accepted"}


KINDS = ["derivation", "derivation by a rule", "cells", "substitution", "witness", "optimum", "containment"]
KINDS += ["clearance"]


@pytest.mark.parametrize("kind", KINDS)
def test_certificates_of_random_questions_and_altered_ones(kind: str, reader: Path, tmp_path: Path) -> None:
    rng = random.Random(3)
    made = [text_of(data) for data in islice(true_certificates(rng, kind), 4)]
    compared(reader, [*made, *(other for text in made for other in altered(rng, text, 8))], tmp_path)


def test_altered_derivations_and_tables(reader: Path, tmp_path: Path) -> None:
    rng = random.Random(5)
    texts = [certificate(text).to_json() for text in rng.sample(list(CASES.values()), 12)]
    texts += [cell_table(*table).to_json() for table in TABLES]
    verdicts = compared(reader, [other for text in texts for other in altered(rng, text, 4)], tmp_path)
    assert verdicts.count("rejected") > 80


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(8))
def test_many_altered_certificates(seed: int, reader: Path, tmp_path: Path) -> None:
    rng = random.Random(seed)
    makers = (derivation, derivation_by_a_rule)
    made = (rng.choice(makers)(rng) for _ in range(60))
    texts = [found.to_json() for found in made if found is not None]
    texts += [cell_table(*table, projection).to_json() for table in TABLES for projection in Projection]
    compared(reader, [other for text in texts for other in (text, *altered(rng, text, 6))], tmp_path)


NO_CERTIFICATES = ("", "{}", "[" * 100_000, '{"format": "bezier-qe certificate"}', '{"format": 1}', '"x"', "[1, 2")


def lemmas_text(listed: list[str]) -> str:
    """With these polynomials in the lemmas of a step."""
    claim = ["atom", "x", ">"]
    evidence = {"theory": {"polynomials": listed, "lemmas": [], "cases": []}}
    step = {"rule": "signs", "at": [], "context": [], "before": claim, "after": claim, "evidence": evidence}
    payload = {"order": ["x"], "start": claim, "steps": [step], "answer": claim}
    return text_of({"format": "bezier-qe certificate", "version": 2, "kind": "derivation", "payload": payload})


LISTED = {lemmas_text(listed): listed for listed in (["x"], ["x", "x"], ["2*x"], ["-x"], ["1"])}


@pytest.fixture(scope="module")
def verdicts(reader: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Of all these texts, by one run of the reader, whose start takes longer."""
    texts = [*NO_CERTIFICATES, *LISTED]
    return dict(zip(texts, compared(reader, texts, tmp_path_factory.mktemp("verdicts")), strict=True))


@pytest.mark.parametrize("text", NO_CERTIFICATES)
def test_what_is_no_certificate(text: str, verdicts: dict[str, str]) -> None:
    assert verdicts[text] == "rejected"


@pytest.mark.parametrize("text", LISTED, ids=map(str, LISTED.values()))
def test_polynomials_of_lemmas_have_one_spelling_and_are_listed_once(text: str, verdicts: dict[str, str]) -> None:
    assert verdicts[text] == ("accepted" if LISTED[text] == ["x"] else "rejected")


def formula_text(matrix: object) -> str:
    question = ["exists", ["x", "y"], matrix]
    point = {"order": ["x", "y"], "values": ["2", "1"]}
    step = {"rule": "instance", "at": [], "context": [], "before": question, "after": True, "evidence": point}
    payload: dict[str, Any] = {"order": ["x", "y"], "start": question, "steps": [step], "answer": True}
    return text_of({"format": "bezier-qe certificate", "version": 3, "kind": "derivation", "payload": payload})


def test_formulas_have_one_spelling(reader: Path, tmp_path: Path) -> None:
    wrong = ["-x + x^2", "2*x^2 - 2*x", "x*x - x", "x^2 - x^1", "x*y + x^2", "y*x", "1"]
    matrices = [["atom", text, ">"] for text in ("x^2 - x", *wrong)]
    matrices += [["atom", "-x^2 + x", "<"], ["or", ["atom", "x^2 - x", ">"]], ["and"]]
    verdicts = compared(reader, list(map(formula_text, matrices)), tmp_path)
    assert verdicts == ["accepted", *["rejected"] * (len(matrices) - 1)]


def test_numbers_and_exponents_of_any_size(reader: Path, tmp_path: Path) -> None:
    most = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)  # as commands do
    try:
        texts = ["x^2000 + y", f"x - {'9' * 5000}", f"{'9' * 5000}*x + y", "x^2 + y - 4"]
        verdicts = compared(reader, [formula_text(["atom", text, ">"]) for text in texts], tmp_path)
    finally:
        sys.set_int_max_str_digits(most)
    assert verdicts == ["accepted", "rejected", "accepted", "accepted"]


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
