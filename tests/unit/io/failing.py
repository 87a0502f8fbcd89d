"""What a reader raises at a place of a text, with the place in front."""

from qe.errors import InputError


def fail(message: str, at: int) -> InputError:
    return InputError(f"{at}: {message}")
