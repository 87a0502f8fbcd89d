"""Certificates that a test here reads go to both readers in the end, right, altered and malformed ones alike."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import wraps
from pathlib import Path

import pytest

from qe.proof.certificate import Certificate
from tests.certificates.both_readers import compared


@pytest.fixture(scope="session")
def reader(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plain reader as one file."""
    file = tmp_path_factory.mktemp("reader") / "reader.pyz"
    subprocess.run([sys.executable, "-m", "qe.plain", "--write-reader", str(file)], check=True)
    return file


MOST = 500
"""So many texts that tests of this folder read go to both readers, evenly chosen; with the deep tests all of them."""


@pytest.fixture(scope="package", autouse=True)
def both_readers_agree(
    reader: Path, tmp_path_factory: pytest.TempPathFactory, pytestconfig: pytest.Config
) -> Iterator[None]:
    """After the tests of this folder: the same verdicts on the texts that were read, whatever was made of them then."""
    read, texts = Certificate.from_json, dict[str, None]()

    @wraps(read)
    def kept(text: str) -> Certificate:
        with suppress(AttributeError, UnicodeEncodeError):  # of what no file can hold
            texts.setdefault(text.encode().decode())
        return read(text)

    Certificate.from_json = staticmethod(kept)  # type: ignore[method-assign]
    try:
        yield
    finally:
        Certificate.from_json = staticmethod(read)  # type: ignore[method-assign]
    step = 1 if "not deep" not in pytestconfig.option.markexpr else max(1, len(texts) // MOST)
    compared(reader, list(texts)[::step], tmp_path_factory.mktemp("texts"))
