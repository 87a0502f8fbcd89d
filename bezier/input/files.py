"""Reading text files of people."""

from __future__ import annotations

from pathlib import Path

from qe.errors import InputError

MAX_BYTES = 1_000_000


def read_text(path: Path) -> str:
    """The text of a file of at most ``MAX_BYTES``. Raises ``InputError`` when it cannot be read."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)  # some files of devices never end
        if len(data) > MAX_BYTES:
            raise InputError(f"{path}: expected a problem of at most {MAX_BYTES} bytes, found more")
        return data.decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: expected a readable file, found: {error.strerror or error}") from None
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected UTF-8 text, found byte {data[error.start]:#04x} at {error.start}") from None
