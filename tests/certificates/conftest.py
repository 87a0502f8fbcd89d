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


@pytest.fixture(scope="session")
def texts(
    reader: Path, tmp_path_factory: pytest.TempPathFactory, pytestconfig: pytest.Config
) -> Iterator[dict[str, None]]:
    """What the tests of this folder read; after all tests: the same verdicts by both readers, whatever was made of it.

    Once in a process: pytest-xdist takes the files in any order, with those of other folders between them.
    """
    read = dict[str, None]()
    yield read
    step = 1 if "not deep" not in pytestconfig.option.markexpr else max(1, -(-len(read) // MOST))
    compared(reader, list(read)[::step], tmp_path_factory.mktemp("texts"))


@pytest.fixture(scope="package", autouse=True)
def both_readers_agree(texts: dict[str, None]) -> Iterator[None]:
    """In the end, on what is read meanwhile."""
    read = Certificate.from_json

    @wraps(read)
    def kept(text: str) -> Certificate:
        with suppress(AttributeError, UnicodeEncodeError):  # of what no file can hold
            texts.setdefault(text.encode().decode())
        return read(text)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Certificate, "from_json", staticmethod(kept))
        yield
