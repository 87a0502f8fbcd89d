"""Reading text files of people."""

from __future__ import annotations

from pathlib import Path

from qe.errors import InputError

MAX_BYTES = 1_000_000


def read_text(path: Path) -> str:
    """The text of a file of at most ``MAX_BYTES``. Raises ``InputError`` when it cannot be read."""
    try:
        data = path.read_bytes()
        if len(data) > MAX_BYTES:
            raise InputError(f"{path}: expected a problem of at most {MAX_BYTES} bytes, found {len(data)}")
        return data.decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected UTF-8 text, found byte {data[error.start]:#04x} at {error.start}") from None
