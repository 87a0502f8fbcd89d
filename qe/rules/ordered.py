"""Variables that can be exchanged, in ascending order.

THEOREM. Let f say the same when two variables a and b change places, and perhaps other pairs with them, for every b of
some others. Then ``ex v f`` iff f holds at some v with a <= b for all of them: where f holds, let the least of a and of
the others change places with a. So on among the others, as f and these conditions say the same when two of them change
places, until all are in order.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from qe.formula.build import atom, conj
from qe.formula.syntax import Atom, Formula, Relation
from qe.formula.traverse import conjuncts

MOST, TOGETHER = 16, 3
"""Variables up to which exchanges are looked for; pairs that change places at a time, at most."""

Exchange = Mapping[str, str]
"""Where the variables go that change places."""


def in_order(body: Formula) -> tuple[Formula, list[list[Exchange]]]:
    """A body with all that exchanges let us assume, and the exchanges of each variable with those that are not less."""
    parts = conjuncts(body)
    atoms = [part for part in parts if isinstance(part, Atom)]
    steps, count = list[list[Exchange]](), 1
    if len(body.free) > MOST or len(atoms) < len(parts):
        return body, []
    while count <= TOGETHER:
        exchanges = next(filter(None, (_exchanges(atoms, first, count) for first in body.free)), [])
        if exchanges:
            steps.append(exchanges)
            atoms += least(body, exchanges)
        else:
            count += 1
    return conj(atoms), steps


def least(body: Formula, exchanges: Sequence[Exchange], k: int = 0) -> list[Atom]:
    """That the variable which all exchange has the least value of all, or what the k-th exchanges for it."""
    ring, first = body.ring, next(iter(exchanges[0]))
    assert ring is not None
    names = [first, *(exchange[first] for exchange in exchanges)]
    smaller = (atom(ring.var(names[k]) - ring.var(other), Relation.LE) for other in names if other != names[k])
    return [a for a in smaller if isinstance(a, Atom)]


def _exchanges(atoms: Sequence[Atom], first: str, count: int) -> list[Exchange]:
    """Those of so many pairs of a variable with others, none of which moves another one of these."""
    search = _Search(atoms)
    rest, exchanges, moved = [first], list[Exchange](), set[str]()
    for other in search.like(first):
        if other not in moved and (exchange := search.completed({first: other, other: first}, rest, count)):
            rest.append(other)
            exchanges.append(exchange)
            moved.update(exchange.keys() - {first, other})
    return exchanges


Image = tuple[frozenset[tuple[frozenset[tuple[str, int]], int]], Relation]


class _Search:
    """Exchanges that leave a conjunction alone."""

    def __init__(self, atoms: Sequence[Atom]) -> None:
        self.images = [_terms(a) for a in atoms]
        self.known = {*self.images, *(_terms(Atom(-a.poly, a.relation.flipped)) for a in atoms)}
        self.names = dict.fromkeys(v for a in atoms for v in a.free)
        self.signs = {v: self._sign(v) for v in self.names}

    def like(self, name: str) -> list[str]:
        """Other variables that look the same."""
        return [v for v in self.names if v != name and self.signs[v] == self.signs.get(name)]

    def completed(self, pairs: Exchange, fixed: Collection[str], count: int) -> Exchange | None:
        """So many exchanges, these among them, with which all parts say the same; of the ``fixed`` ones none."""
        broken = next((image for image in self.images if _image(image, pairs) not in self.known), None)
        if broken is None or len(pairs) == 2 * count:
            return pairs if broken is None else None
        for one in dict.fromkeys(v for powers, _ in broken[0] for v, _ in powers):
            for other in self.like(one):
                if not {one, other} & {*pairs, *fixed}:
                    further = self.completed({**pairs, one: other, other: one}, fixed, count)
                    if further is not None:
                        return further
        return None

    def _sign(self, name: str) -> object:
        parts = (sorted(dict(powers).get(name, 0) for powers, _ in terms) for terms, _ in self.images)
        return sorted(exponents for exponents in parts if any(exponents))


def _terms(a: Atom) -> Image:
    names = a.poly.ring.names
    return frozenset(
        (frozenset((names[i], e) for i, e in powers), c) for powers, c in a.poly.sparse_terms()
    ), a.relation


def _image(image: Image, pairs: Exchange) -> Image:
    terms, relation = image
    return frozenset((frozenset((pairs.get(v, v), e) for v, e in powers), c) for powers, c in terms), relation
