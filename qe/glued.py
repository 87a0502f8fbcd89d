"""Names that may have been meant as products: ``ab`` next to a and b."""

from __future__ import annotations

from collections.abc import Collection, Iterable


def joined_names(names: Iterable[str], letters: Collection[str]) -> dict[str, str]:
    """The names that look like products of different letters, one of ``letters`` among them, of which all but perhaps
    one are names or ``letters`` themselves. Each with the product that may be meant: ``ax`` beside x with ``a*x``."""
    known = {*names, *letters}
    return {
        name: "*".join(name)
        for name in names
        if len({*name} & known) >= len(name) - 1 > 0 and name.isalpha()
        if name not in letters and not {*name}.isdisjoint(letters)
    }


def glued(names: Collection[str], letters: Collection[str]) -> str:
    """A hint where a name is made of others, as ``abc`` of the letters a, b and c: a product was meant."""
    made = next(iter(joined_names(names, letters).items()), None)
    return "" if made is None else f" ({made[0]} is one name; a product is written {made[1]})"
