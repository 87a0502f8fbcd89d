"""The critical pairs of a growing list of polynomials that are left by the criteria of Gebauer and Möller (1988)."""

from __future__ import annotations

from dataclasses import dataclass, field

from qe.exact.packed import PackedMonomials


@dataclass
class CriticalPairs:
    """``heads``: the leading monomials of the polynomials in the order in which they were added; ``alive``: numbers of
    those that are no multiples of later ones; ``pairs``: (least common multiple, number, number).

    If the S-polynomials of all pairs that were ever in ``pairs`` at the end of an addition and not removed by a later
    one reduce to zero, the polynomials are a Groebner basis.
    """

    monomials: PackedMonomials
    heads: list[int] = field(default_factory=list)
    fields: list[int] = field(default_factory=list)
    alive: list[int] = field(default_factory=list)
    pairs: list[tuple[int, int, int]] = field(default_factory=list)

    def add(self, head: int) -> None:
        """Another polynomial, with this leading monomial."""
        m = self.monomials
        own, number = m.fields(head), len(self.heads)
        self.pairs = [pair for pair in self.pairs if not self._is_covered(pair, head, own)]
        multiples: dict[int, list[int]] = {}
        for i in self.alive:
            multiples.setdefault(m.lcm(self.heads[i], head), []).append(i)
        smaller: list[int] = []
        for t in sorted(multiples):
            fields = m.fields(t)
            if any(m.divides(u, fields) for u in smaller):
                continue
            smaller.append(fields)
            if not any(m.are_coprime(self.heads[i], head) for i in multiples[t]):
                self.pairs.append((t, multiples[t][0], number))
        self.alive = [i for i in self.alive if not m.divides(own, self.fields[i])]
        self.alive.append(number)
        self.heads.append(head)
        self.fields.append(own)

    def _is_covered(self, pair: tuple[int, int, int], head: int, own: int) -> bool:
        """Whether the pair follows from those of its members with a new polynomial, whose pairs are smaller."""
        t, i, j = pair
        m = self.monomials
        if not m.divides(own, m.fields(t)):
            return False
        return t not in (m.lcm(self.heads[i], head), m.lcm(self.heads[j], head))

    def taken(self) -> list[tuple[int, int, int]]:
        """The pairs of the least degree, which are pending no longer."""
        degree = self.monomials.degree
        least = min(degree(t) for t, _, _ in self.pairs)
        chosen = [pair for pair in self.pairs if degree(pair[0]) == least]
        self.pairs = [pair for pair in self.pairs if degree(pair[0]) != least]
        return chosen
