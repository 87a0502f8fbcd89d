"""The public functions that decide: sentences, instances, witnesses, equivalence."""

from __future__ import annotations

from collections.abc import Container, Mapping
from fractions import Fraction
from functools import partial
from typing import Any, Unpack, cast

from qe import arguments
from qe.api.eliminate import answered_under, instance
from qe.api.input import AnyFormula, of_one_problem, order_of, read_polynomial
from qe.api.limits import limits_of, posed, read_under, under
from qe.api.settings import Decision, Search, settings_in, with_settings
from qe.errors import InputError, Unable
from qe.exact.number import Assignment
from qe.exact.ring import Poly, Ring
from qe.formula.assumed import Posed
from qe.formula.build import conj, convert, exists, forall, iff, implies
from qe.formula.counting import without_root_atoms
from qe.formula.numbers import bounds_of_numbers, unknowns
from qe.formula.syntax import TRUE, Formula
from qe.io.names import names_in
from qe.io.substitution import over_one_ring
from qe.processes.limits import Limits
from qe.proof.answer import Answer


@with_settings(Decision)
def decide(formula: AnyFormula, **settings: Unpack[Decision]) -> bool:
    """The truth of a sentence; of a formula in variables that ``assuming`` speaks of, wherever that holds.

    Raises ``InputError`` for other free variables and ``Unable`` at a limit.
    """
    limits = limits_of(settings)
    given = posed(formula, settings, limits, numbers=True)
    strange = [name for name in given.formula.free if name not in given.known.free]
    sentence = given.formula if strange else given.closed(given.formula)
    return _decided(sentence, formula, settings, limits).truth is True


@with_settings(Decision)
def find_instance(formula: AnyFormula, **settings: Unpack[Decision]) -> Assignment | None:
    """Exact values of the free variables that satisfy the formula, or None if there are none.

    Raises ``Unable`` at a limit.
    """
    limits = limits_of(settings)
    given = posed(formula, settings, limits).restricted
    return instance(_decided(exists(given.free, given), formula, settings, limits), given)


@with_settings(Search)
def check_witness(sentence: AnyFormula, witness: Mapping[Any, AnyFormula], **settings: Unpack[Search]) -> bool:
    """Whether existential variables can be given by these polynomials in the variables quantified further outside.

    The polynomials (text, ``Poly`` or SymPy) are substituted and the stronger sentence is decided: True proves
    the sentence, False says only that this witness does not work everywhere. Raises ``InputError`` for a name that is
    not existentially quantified, or a polynomial in variables that are not known at its place.
    """
    from qe.elimination.witness import Term, instantiate

    limits = limits_of(settings)
    stated = posed(sentence, settings, limits, numbers=True)
    given = without_root_atoms(stated.formula)
    offered, known = arguments.by_name(witness, "witness"), names_in(given)
    read = read_under(limits, partial(_polynomials, offered, known), offered)
    rings = [r for r in (given.ring, *(poly.ring for poly, _ in read.values())) if r is not None]
    ring = Ring.of(dict.fromkeys(name for r in rings for name in r.names))
    terms = {name: Term.of(poly.convert(ring), scale) for name, (poly, scale) in read.items()}
    whole = under(instantiate(convert(given, ring), terms), TRUE, stated.known, limits, numbers=True)
    return _decided(whole.closed(whole.formula), sentence, settings, limits).truth is True


def _polynomials(offered: Mapping[str, AnyFormula], known: Container[str]) -> dict[str, tuple[Poly, Fraction]]:
    return {name: read_polynomial(term, f"witness: {name}", known=known) for name, term in offered.items()}


@with_settings(Search)
def equivalent(left: AnyFormula, right: AnyFormula, **settings: Unpack[Search]) -> bool:
    """Whether two formulas have the same solutions in all their free variables together, where ``assuming`` holds.

    Raises ``Unable`` at a limit.
    """
    return compared(left, right, settings).truth is True


def compared(first: AnyFormula, second: AnyFormula, given: Mapping[str, Any]) -> Answer:
    """The answer to the question whether two formulas are equivalent; ``given``: settings, the others have defaults."""
    settings = cast(Search, {name: s.default for name, (_, s) in settings_in(Search).items()} | {**given})
    limits = limits_of(settings)
    plain: dict[str, Any] = {**settings, "assuming": None}
    first, second, assuming = of_one_problem(first, second, settings["assuming"])
    one, other = (posed(formula, plain, limits, numbers=True) for formula in (first, second))
    f, g, *inner = over_one_ring(one.formula, other.formula, one.known, other.known)
    stated = under(iff(f, g), conj(inner), assuming, limits, others=(*f.free, *g.free), numbers=True)
    names = unknowns(dict.fromkeys((*f.free, *g.free, *stated.known.free)))
    claim = forall(names, implies(stated.known, stated.formula))
    return _decided(claim, [first, second], settings, limits)


def _decided(sentence: Formula, given: AnyFormula, settings: Search, limits: Limits) -> Answer:
    """The answer to a sentence, which is true or false; ``given``: what it was made of.

    Numbers that are not algebraic are free in it: what holds for some values between their bounds only is not decided.
    """
    known = bounds_of_numbers(sentence)
    if free := unknowns(sentence.free):
        names = ", ".join(free)
        raise InputError(f"a sentence expected; free: {names} (all {names}. … or ex {names}. … says what is meant)")
    sentence, known = over_one_ring(sentence, known)
    answer = answered_under(Posed(sentence, known), order_of(settings["order"], given, sentence), settings, limits)
    if answer.truth is None:
        raise Unable(answer.reason or "no decision was reached")
    return answer
