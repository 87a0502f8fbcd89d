"""The signature of a symmetric matrix as sign conditions on polynomials: leading minors, or a characteristic
polynomial.

**Minors.** A leading minor D_k that is not 0 after j - 1 ones that are adds to the signature sign(D_k*D_(k-j)) for j =
1, its negative for j = 3 and 0 for j = 2, where the two have opposite signs (Jacobi, Gundelfinger, Frobenius). For
trace forms in the powers of one variable, which are Hankel matrices, every odd j adds (-1)^((j-1)/2) times that sign,
every even j nothing (Frobenius 1894), and behind the last D_k that is not 0 nothing is left. Elsewhere longer gaps and
minors that are 0 at the end leave the signature open, and it is read from the characteristic polynomial there.

**Characteristic polynomial.** All its roots are real, so by Descartes' rule it has as many positive roots as sign
variations, and as many negative ones as the polynomial with x replaced by -x. Where two neighbouring coefficients are
0 so are all that follow; a single 0 stands between opposite signs or at the end.

Both are decision diagrams in the signs of one polynomial after the other. Sign vectors that cannot occur are left to
chance.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product

from qe.errors import Unable
from qe.exact.hermite import added_signature
from qe.exact.ring import Poly
from qe.exact.watch import IDLE
from qe.formula.build import atom, conj, disj
from qe.formula.relation import BY_SIGNS
from qe.formula.syntax import FALSE, TRUE, Formula, Relation
from qe.formula.traverse import atoms

MOST_ATOMS = 3000
SMALL = 4
"""Up to this size the two diagrams are woven into one, which simplifies better; for larger ones it would be long."""


@dataclass(frozen=True)
class _State:
    """What was read: the last sign other than 0, the zeros since, the signature so far (None: it was left open)."""

    last: int
    zeros: int
    signature: int | None


@dataclass(frozen=True)
class SignatureConditions:
    """A symmetric matrix of polynomials by its leading minors (from 1 by 1 on) and its characteristic polynomial.

    ``coefficients()``: of the latter, highest first, worked out where they are needed. ``is_hankel``: a trace form in
    the powers of one variable. ``least``: what the signature is at least, where that is known. ``watch`` is asked while
    conditions are made.
    """

    minors: tuple[Poly, ...]
    coefficients: Callable[[], tuple[Poly, ...]]
    is_hankel: bool = False
    least: int | None = None
    watch: Callable[[], object] = IDLE

    @property
    def size(self) -> int:
        """The signature lies between -size and size."""
        return len(self.minors)

    def is_in(self, wanted: Collection[int]) -> Formula:
        """That the signature is one of these numbers."""

        if self.is_hankel or self.size <= SMALL:
            return self._by_minors(wanted, regular=False)
        last = self.minors[-1]
        regular = conj([atom(last, Relation.NE), self._by_minors(wanted, regular=True)])
        return disj([regular, conj([atom(last, Relation.EQ), self._by_descartes(wanted)])])

    def _by_minors(self, wanted: Collection[int], *, regular: bool) -> Formula:
        """By minors first; ``regular``: where the whole determinant is not 0."""

        def after(state: _State, sign: int) -> _State | None:
            gap = state.zeros + 1
            if state.signature is None or (gap > 3 and not self.is_hankel):
                return _State(sign, 0, None)
            added = added_signature(gap, sign, state.last)
            return None if added is None else _State(sign, 0, state.signature + added)

        def end(state: _State) -> Formula | None:
            if state.zeros and regular:
                return None
            if state.signature is None or (state.zeros and not self.is_hankel):
                return self._by_descartes(wanted)
            return self._leaf(state.signature, wanted)

        return self._diagram(self.minors, after, end)

    def _leaf(self, signature: int, wanted: Collection[int]) -> Formula | None:
        if self.least is not None and signature < self.least:
            return None
        return TRUE if signature in wanted else FALSE

    def _by_descartes(self, wanted: Collection[int]) -> Formula:
        def after(state: _State, sign: int) -> _State | None:
            if state.zeros > 1 or (state.zeros == 1 and sign == state.last):
                return None
            mirrored = state.last if state.zeros else -state.last
            change = (sign != state.last) - (sign != mirrored)
            return _State(sign, 0, (state.signature or 0) + change)

        return self._diagram(self.coefficients()[1:], after, lambda state: self._leaf(state.signature or 0, wanted))

    def _diagram(
        self,
        polys: Sequence[Poly],
        after: Callable[[_State, int], _State | None],
        end: Callable[[_State], Formula | None],
    ) -> Formula:
        """The condition that reading the signs of the polynomials from a positive one on leads to."""

        @cache
        def decided(k: int, state: _State) -> Formula | None:
            self.watch()
            if k == len(polys):
                return end(state)
            return _chosen(polys[k], {sign: step(k, state, sign) for sign in (1, 0, -1)})

        def step(k: int, state: _State, sign: int) -> Formula | None:
            if sign == 0:
                return decided(k + 1, _State(state.last, state.zeros + 1, state.signature))
            reached = after(state, sign)
            return None if reached is None else decided(k + 1, reached)

        found = decided(0, _State(1, 0, 0))
        if found is None:
            return FALSE
        if sum(1 for _ in atoms(found)) > MOST_ATOMS:
            raise Unable("the sign conditions on a trace form grow past their limits")
        return found


def _chosen(poly: Poly, cases: dict[int, Formula | None]) -> Formula | None:
    """A case distinction by the sign of a polynomial; None where no case is possible."""
    if poly.is_constant:
        value = poly.constant_value()
        return cases[(value > 0) - (value < 0)]
    possible = {sign: f for sign, f in cases.items() if f is not None}
    groups: dict[Formula, list[int]] = {}
    for sign, f in possible.items():
        groups.setdefault(f, []).append(sign)
    if not groups:
        return None
    if len(groups) == 1:
        return next(iter(groups))
    free = [sign for sign in cases if sign not in possible]
    parts = []
    for f, signs in groups.items():
        chosen = [*signs, *free] if BY_SIGNS.get(frozenset([*signs, *free])) else signs
        parts.append(conj([atom(poly, BY_SIGNS[frozenset(chosen)]), f]))
        free = [] if chosen is not signs else free
    return disj(parts)


def signatures_sum_to(matrices: Sequence[tuple[int, SignatureConditions]], wanted: Collection[int]) -> Formula:
    """That weighted signatures of several matrices add up to one of these numbers."""
    *others, (last, final) = matrices
    options = []
    for values in product(*(range(-m.size, m.size + 1) for _, m in others)):
        so_far = sum(weight * v for (weight, _), v in zip(others, values, strict=True))
        rest = {v for v in range(-final.size, final.size + 1) if so_far + last * v in wanted}
        if rest:
            options.append(conj([*(m.is_in({v}) for (_, m), v in zip(others, values, strict=True)), final.is_in(rest)]))
    return disj(options)
