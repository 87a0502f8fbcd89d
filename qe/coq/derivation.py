"""Derivations for Coq, whole: every step as an equivalence, and what they lead to.

What ``primitives.v`` proves is applied there: congruence at a place, quantifiers, signs, linear equations, terms,
points. A step by a theorem that is not proved there (virtual substitution, theorems of ``qe.theorems``, Sturm's, ...),
and one for which no proof was found, is an axiom with the name of its rule that says what the step says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from qe.coq.signs import Identity, Tree
from qe.coq.text import Text
from qe.errors import CertificateRejected, Unable
from qe.exact.ring import Poly, Ring
from qe.formula.build import atom, conj, disj, exists
from qe.formula.syntax import FALSE, TRUE, And, Atom, Exists, ForAll, Formula, Not, Or, Relation
from qe.formula.traverse import conjuncts, disjuncts
from qe.kernel.block import existential, opened
from qe.kernel.derivation import replaced
from qe.kernel.elimination_points import read_points
from qe.kernel.elimination_set import start
from qe.kernel.linear_equation import Pivot, pivot_of, substituted
from qe.kernel.negation import negation, normal
from qe.kernel.signs import Line, read_lemma, read_polynomials
from qe.kernel.step import Claim, Context, outside
from qe.kernel.substitution import mapped
from qe.kernel.terms import Terms, at_terms, block_opened, multiplied_out, terms_of
from qe.proof.entry import Entry, formula_from_json

_SIGNS = {1: Relation.LT, 2: Relation.EQ, 4: Relation.GT}


def derivation(payload: dict[str, Any], prefix: str) -> Iterator[str]:
    """The lines of a derivation; ``Unable`` where it has what cannot be written."""
    order, question, steps, answer = Entry(payload, "payload").fields("order", "start", "steps", "answer")
    ring = Ring.of(order.names())
    before, after = (formula_from_json(e, ring, quantified=True) for e in (question, answer))
    text = Text(ring, prefix)
    lemma, last = _Steps(text).run(steps, before, ())
    assert last == after
    names = [v for v in ring.names if v in before.free or v in after.free]
    values = "; ".join(text.words[v] if v in names else "0" for v in reversed(ring.names))
    every = f"forall {' '.join(text.words[v] for v in names)} : R, " if names else ""
    yield from text.lines
    yield f"Theorem {prefix} : {every}({text.said(before)}) <-> ({text.said(after)})."
    yield f"Proof. intros. exact (said _ _ (env_of [{values}]) {lemma}). Qed."
    yield f"Print Assumptions {prefix}."


class _Steps:
    """The lemmas of one derivation. Each method returns the name of a lemma, ``equiv context f g`` by default."""

    def __init__(self, text: Text) -> None:
        self.text, self.ring = text, text.ring
        self.fresh = text.ring.size

    def run(self, steps: Entry, current: Formula, context: Context) -> tuple[str, Formula]:
        """The lemma of all steps together, and the formula to which they lead."""
        first, whole = current, None
        for entry in steps.items():
            lemma, changed = self.step(entry, current, context)
            whole = lemma if whole is None else self.trans(context, (first, current, changed), whole, lemma)
            current = changed
        return whole or self.same(context, current, current), current

    def step(self, entry: Entry, current: Formula, context: Context) -> tuple[str, Formula]:
        """One step at its place."""
        rule, at, old, new, used, evidence = entry.fields("rule", "at", "before", "after", "context", "evidence")
        before, after = (formula_from_json(e, self.ring, quantified=True) for e in (old, new))
        known = tuple(formula_from_json(e, self.ring, quantified=True) for e in used.items())
        place = tuple(e.integer() for e in at.items())
        _, changed = replaced(current, place, before, after, context, at)
        claim = Claim(rule.text(), before, after, self.ring, evidence, entry.path)
        return self.at(context, current, changed, place, before, after, known, self.claim(claim, known)), changed

    def claim(self, claim: Claim, context: Context) -> str:
        """The lemma of the step itself; an axiom where there is no proof of it."""
        mark = len(self.text.lines), len(self.text.axioms)
        rule = _RULES.get(claim.rule)
        if rule is not None:
            try:
                return rule(self, claim, context)
            except (Unable, CertificateRejected, RecursionError):
                if len(self.text.lines) < mark[0]:
                    raise
        return self.text.axiom(claim.rule, context, claim.before, claim.after)

    # --- frame

    def lemma(self, context: Context, f: Formula, g: Formula, proof: str, conditions: int = 0) -> str:
        return self.text.lemma(self.text.equiv(context, f, g), proof, conditions)

    def same(self, context: Context, f: Formula, g: Formula) -> str:
        return self.lemma(context, f, g, "same _ _ _", 1)

    def trans(self, context: Context, formulas: tuple[Formula, Formula, Formula], one: str, two: str) -> str:
        f, g, h = formulas
        return self.lemma(context, f, h, f"trans _ _ {self.text.formula(g)} _ {one} {two}")

    def chain(self, context: Context, formulas: Sequence[Formula], lemmas: Sequence[str]) -> str:
        whole = lemmas[0]
        for k in range(1, len(lemmas)):
            whole = self.trans(context, (formulas[0], formulas[k], formulas[k + 1]), whole, lemmas[k])
        return whole

    def via(self, context: Context, claim: Claim, f: Formula, g: Formula, lemma: str) -> str:
        """For the claim, from what ``existential`` makes of its sides."""
        negated = "true" if isinstance(claim.before, ForAll) else "false"
        names = f"{self.text.formula(f)} {self.text.formula(g)}"
        return self.lemma(context, claim.before, claim.after, f"via {negated} _ _ _ {names} {lemma}", 2)

    def at(
        self,
        context: Context,
        current: Formula,
        changed: Formula,
        place: Sequence[int],
        before: Formula,
        after: Formula,
        known: Context,
        lemma: str,
    ) -> str:
        """A lemma under ``known``, at a place."""
        whole, path = _arranged(current, place, before)
        sides = f"[{'; '.join(path)}]"
        data = f"{self.text.formulas(known)} {self.text.formula(before)} {self.text.formula(after)}"
        proof = f"step {sides} _ _ _ {data} {self.text.formula(whole)} {lemma}"
        if whole == current:
            return self.lemma(context, current, changed, proof, 4)
        last = self.lemma(context, whole, changed, proof, 4)  # its parts stand in another order
        return self.trans(context, (current, whole, changed), self.moved(context, current, whole), last)

    def under(self, context: Context, names: Sequence[str], f: Formula, g: Formula, lemma: str) -> str:
        """From a lemma about the body under what does not have the variables: ex names f <-> ex names g."""
        one, two = exists(names, f), exists(names, g)
        if not isinstance(one, Exists) or one.body != f:
            raise Unable("a block inside a block")
        return self.at(context, one, two, (0,), f, g, outside(context, names), lemma)

    # --- signs

    def trees(
        self, theory: Entry | None, goals: Iterable[Sequence[Formula]], more: Sequence[_Product] = ()
    ) -> list[str]:
        """The polynomials, the identities, and a tree for each goal, as arguments of the theorems about signs."""
        polys, identities = self.identities(theory)
        for product in more:
            identities.append(_expanded(product, polys))
        trees = [Tree(map(normal, goal), polys, identities) for goal in goals]
        texts = [tree.text() for tree in trees]
        for k, tree in enumerate(trees):
            for mark, f in tree.quantified.items():
                texts[k] = texts[k].replace(mark, self.text.formula(f))
        named = "; ".join(self.text.poly(p) for p in polys)
        terms = "; ".join(f"[{'; '.join(map(_term, identity))}]" for identity in identities)
        return [f"[{named}]", f"[{terms}]", *texts]

    def identities(self, theory: Entry | None) -> tuple[list[Poly], list[Identity]]:
        """The polynomials and identities of the evidence."""
        if theory is None:
            return [], []
        listed, lemmas, _, _ = _theory(theory)
        polys = list(read_polynomials(listed, self.ring))
        found: list[Identity] = []
        for lemma in lemmas.items():
            if isinstance(lemma.value, dict) and "identity" in lemma.value:
                terms = [term.row("coefficient", "powers") for term in lemma.fields("identity")[0].items()]
                found.append(tuple((int(c.rational()), _powers(powers)) for c, powers in terms))
        return polys, found

    def facts(self, theory: Entry | None) -> list[tuple[Formula, Callable[[], str]]]:
        """What holds everywhere by the evidence beside the identities, each with what writes ``equiv [] fact true``.

        What the lemmas about polynomials in one variable say is believed; that comparisons do not hold together is
        shown by steps.
        """
        if theory is None:
            return []
        listed, lemmas, _, refuted = _theory(theory)
        polys, found = read_polynomials(listed, self.ring), list[tuple[Formula, Callable[[], str]]]()
        for entry in lemmas.items():
            is_line = isinstance(entry.value, dict) and "line" in entry.value
            if is_line and isinstance(line := read_lemma(entry, polys, self.ring), Line):
                signs = [zip(line.polynomials, cell, strict=True) for cell in line.cells]
                cells = disj(conj(atom(polys[i], _SIGNS[s]) for i, s in cell) for cell in signs)
                found.append((cells, partial(self.text.axiom, "Sturm", (), cells, TRUE)))
        for entry in () if refuted.value is None else refuted.items():
            atoms, steps = entry.fields("atoms", "steps")
            together = conj(formula_from_json(e, self.ring) for e in atoms.items())
            found.append((negation(together), partial(self.never, together, steps)))
        return found

    def never(self, together: Formula, steps: Entry) -> str:
        """The lemma that the negation is true, from steps to false."""
        sentence, negative = exists(together.free, together), negation(together)
        lemma = self.refuted(sentence, together, self.run(steps, sentence, ())[0])
        positive = self.text.lemma(self.text.entails((), negative), f"entails_same _ _ _ {lemma}", 1)
        return self.lemma((), negative, TRUE, f"entails_equiv _ _ {positive}")

    def equal(self, context: Context, f: Formula, g: Formula, theory: Entry) -> str:
        """By the signs that the lemmas allow."""
        if f == g:
            return self.same(context, f, g)
        facts = self.facts(theory)
        known = (*(fact for fact, _ in facts), *context)
        goals = ((negation(g), normal(f), *known), (negation(f), normal(g), *known))
        ps, identities, one, two = self.trees(theory, goals)
        found = self.lemma(known, f, g, f"signs_equiv {ps} {identities} {one} {two} _ _ _", 2)
        for k, (_, lemma) in enumerate(facts):
            found = self.lemma(known[k + 1 :], f, g, f"also _ _ _ _ {lemma()} {found}")
        return found

    def follows(self, context: Context, f: Formula, theory: Entry | None, more: Sequence[_Product] = ()) -> str:
        """``entails context f``, by signs."""
        if self.facts(theory):
            raise Unable("a lemma that is no identity")
        ps, identities, tree = self.trees(theory, [(negation(f), *context)], more)
        return self.text.lemma(self.text.entails(context, f), f"signs_entail {ps} {identities} {tree} _ _", 1)

    # --- rules

    def steps(self, claim: Claim, context: Context) -> str:
        before, after = existential(claim)
        lemma, _ = self.run(claim.evidence.fields("steps")[0], before, context)
        return self.via(context, claim, before, after, lemma)

    def converse(self, claim: Claim, context: Context) -> str:
        lemma, _ = self.run(claim.evidence.fields("steps")[0], claim.after, context)
        return self.lemma(context, claim.before, claim.after, f"converse _ _ _ {lemma}")

    def quantifiers(self, claim: Claim, context: Context) -> str:
        return self.moved(context, claim.before, claim.after)

    def moved(self, context: Context, f: Formula, g: Formula) -> str:
        """By the laws of quantifiers."""
        return self.lemma(context, f, g, "quantifiers _ _ _", 2)

    def block(self, claim: Claim, context: Context) -> str:
        before, after = existential(claim)
        theory = claim.evidence.fields("theory")[0]
        if not isinstance(before, Exists):
            return self.via(context, claim, before, after, self.equal(context, before, after, theory))
        names = before.variables
        bodies = disj(opened(piece, names, claim) for piece in disjuncts(after))
        inner = self.equal(outside(context, names), before.body, bodies, theory)
        middle = exists(names, bodies)
        lemmas = [self.under(context, names, before.body, bodies, inner), self.moved(context, middle, after)]
        return self.via(context, claim, before, after, self.chain(context, (before, middle, after), lemmas))

    def parts(self, context: Context, starts: Sequence[Formula], parts: Entry, goal: Formula) -> tuple[Formula, str]:
        """The disjunction of the starts, and the lemma that it is the goal."""
        ends, lemmas = list[Formula](), list[str]()
        for first, steps in zip(starts, parts.items(), strict=True):
            lemma, last = self.run(steps, first, context)
            ends.append(last)
            lemmas.append(lemma)
        one, two = _joined(starts), _joined(ends)
        if not lemmas:
            return one, self.same(context, one, goal)
        proof = "".join(f"(or_both _ _ _ _ _ {lemma} " for lemma in lemmas[:-1])
        proof += lemmas[-1] + ")" * (len(lemmas) - 1)
        whole = self.lemma(context, one, two, proof)
        return one, self.trans(context, (one, two, goal), whole, self.same(context, two, goal))

    def no_exception(self, claim: Claim, context: Context) -> str:
        entries, found = claim.evidence.fields("exceptions")[0].items(), []
        for one, other in ((claim.before, claim.after), (claim.after, claim.before)):
            wrong = conj((*map(normal, context), normal(one), negation(other)))
            sentence = exists(wrong.free, wrong)
            lemma = self.same((), FALSE, FALSE) if wrong == FALSE else self.run(next(entries), sentence, ())[0]
            found.append((wrong, self.refuted(sentence, wrong, lemma)))
        (c, one_way), (d, back) = found
        proof = f"no_exception _ _ _ {self.text.formula(c)} {self.text.formula(d)} {one_way} {back}"
        return self.lemma(context, claim.before, claim.after, proof, 2)

    def refuted(self, sentence: Formula, body: Formula, lemma: str) -> str:
        """``entails [] (not body)``, from the lemma that no values make it true."""
        name, whole = self.text.formula(body), self.text.formula(sentence)
        return self.text.lemma(f"entails [] (nnf true {name})", f"refuted {whole} {name} {lemma}", 1)

    def elimination_set(self, claim: Claim, context: Context) -> str:
        variable, _, _, points, parts = claim.evidence.fields("variable", "side", "quadratics", "points", "parts")
        block, name, x = claim.variable(variable)
        tried = read_points(points, block.body, x, self.ring)
        starts = [start(t, x, name, block.variables, self.ring) for t in tried]
        middle, last = self.parts(context, starts, parts, claim.after)
        if claim.after == TRUE:  # one point alone says so, and the set need not be one
            return self.text.axiom(claim.rule, context, claim.before, claim.after)
        first = self.text.axiom(claim.rule, context, claim.before, middle)
        return self.trans(context, (claim.before, middle, claim.after), first, last)

    # --- terms

    def linear(self, claim: Claim, context: Context) -> str:
        solved, theory = claim.evidence.fields("solved", "theory")
        block, body = claim.block().variables, claim.block().body
        formulas, lemmas = [claim.before], list[str]()
        for entry in solved.items():
            pivot = pivot_of(entry, block, body, claim)
            block = tuple(v for v in block if v != pivot.name)
            if pivot.sign is None:
                raise Unable("a coefficient that may vanish")
            inner = Exists((pivot.name,), body)
            image = substituted(pivot, claim)
            known = outside(context, (*block, pivot.name))
            lemma = self.solved(known, inner, pivot, image, theory)
            if block:
                split, after = Exists(block, inner), exists(block, image)
                lemmas += [self.moved(context, formulas[-1], split)]
                formulas += [split]
                lemmas += [self.at(context, split, after, (0,), inner, image, known, lemma)]
            else:
                after = image
                lemmas += [self.weaker(context, known, inner, image, lemma)]
            formulas.append(after)
            body = image
            block = tuple(v for v in block if v in body.free) if isinstance(after, Exists) else ()
        lemmas.append(self.moved(context, formulas[-1], claim.after))
        return self.chain(context, (*formulas, claim.after), lemmas)

    def weaker(self, context: Context, known: Context, f: Formula, g: Formula, lemma: str) -> str:
        """The lemma under more facts."""
        if known == context:
            return lemma
        return self.at(context, f, g, (), f, g, known, lemma)

    def solved(self, known: Context, inner: Exists, pivot: Pivot, image: Formula, theory: Entry | None) -> str:
        """ex x (a*x + b = 0 and f) <-> f at -b/a."""
        sign = -1 if pivot.sign == -1 else 1
        top, bottom, positive = -pivot.rest * sign, pivot.lead * sign, pivot.sign in (1, -1)
        kept = tuple(p for p in conjuncts(inner.body) if pivot.name not in p.free)
        regular = self.regular((*kept, *known), bottom, positive, theory)
        x = self.text.variable(pivot.name)
        quotient = f"{self.text.poly(top)} {self.text.poly(bottom)}"
        data = f"{x} {quotient} {str(positive).lower()} {self.text.formula(inner.body)}"
        context = self.text.formulas(known)
        first = self.text.lemma(
            f"equiv {context} {self.text.formula(inner)} (subst {data})", f"linear {context} {data} {regular}", 1
        )
        second = self.text.lemma(f"equiv {context} (subst {data}) {self.text.formula(image)}", "same _ _ _", 1)
        return self.lemma(known, inner, image, f"trans _ _ _ _ {first} {second}")

    def regular(self, context: Context, bottom: Poly, positive: bool, theory: Entry | None) -> str:
        """``entails context``: the denominator is positive, or not 0."""
        wanted = atom(bottom, Relation.GT if positive else Relation.NE)
        lemma = self.follows(context, wanted, theory)
        statement = f"entails {self.text.formulas(context)} (regular {self.text.poly(bottom)} {str(positive).lower()})"
        return self.text.lemma(statement, f"entails_same _ _ _ {lemma}", 1)

    def point(self, claim: Claim, context: Context) -> str:
        before, after = existential(claim)
        order, numbers = claim.evidence.fields("order", "values")
        is_rational = all(isinstance(number.value, str) for number in numbers.items())
        if after != TRUE or not isinstance(before, Exists) or not is_rational:
            raise Unable("no rational point")
        values = {v: n.rational() for v, n in zip(order.names(), numbers.items(), strict=True)}
        proof, data = "", self.text.formula(before.body)
        given, blocks = self.text.formulas(context), list[str]()
        for k, name in enumerate(before.variables):
            top, bottom = (self.text.poly(self.ring.constant(c)) for c in values[name].as_integer_ratio())
            rest = "".join(f"Ex {self.text.variable(v)} (" for v in before.variables[k + 1 :])
            blocks.append(f"{self.text.variable(name)} {top} {bottom} true ({rest}{data}{')' * rest.count('(')})")
            data = f"(subst {self.text.variable(name)} {top} {bottom} true {data})"
        proof = f"(entails_same {given} Tr {data} (fun _ _ => I) (eq_refl true))"
        for block in reversed(blocks):
            positive = f"(fun e _ => proj1 (atom_ok e {block.split()[2]} GT) I)"
            proof = f"(witness {given} {block} {positive} {proof} (eq_refl true))"
        lemma = self.lemma(context, before, TRUE, f"entails_equiv _ _ {proof}")
        return self.via(context, claim, before, after, lemma)

    def terms(self, claim: Claim, context: Context) -> str:
        there, back, theory = claim.evidence.fields("there", "back", "theory")
        one, two = existential(claim)
        before, after = block_opened(one), block_opened(two)
        known = outside(context, (*before[0], *after[0]))
        first = self.implied(known, one, two, terms_of(back, after[0], before[0], claim), claim, theory)
        second = self.implied(known, two, one, terms_of(there, before[0], after[0], claim), claim, theory)
        lemma = self.lemma(known, one, two, f"iff_entails _ _ _ {first} {second}")
        return self.via(context, claim, one, two, self.weaker(context, known, one, two, lemma))

    def implied(
        self, known: Context, given: Formula, wanted: Formula, terms: Terms, claim: Claim, theory: Entry
    ) -> str:
        """``entails (given :: known) wanted``: at terms for the variables of the block that is wanted.

        These get numbers that occur nowhere else, so that terms can be put in one after the other.
        """
        (names, body), (others, goal) = block_opened(given), block_opened(wanted)
        index = self.ring.index
        values = {v: terms.get(index[v], (self.ring.gen(index[v]), self.ring.constant(1))) for v in others}
        about = [poly for i, quotient in terms.items() for poly in (self.ring.gen(i), *quotient)]
        nonzero = [f.poly for f in known if isinstance(f, Atom) and 0 not in f.relation.signs]
        divided: list[_Product] = []
        image = normal(mapped(goal, lambda a: atom(_at(a, terms, nonzero, divided), a.relation), about, claim))
        facts = (body, *known)
        context, data = self.text.formulas(facts), self.text.formula(goal)
        numbers = [self.ring.size + 1 + k for k in range(len(others))]
        for v, number in zip(others, numbers, strict=True):
            data = f"(swap {self.text.variable(v)} {number} {data})"
        renamed = "".join(f"Ex {n} (" for n in numbers) + data + ")" * len(numbers)
        blocks = []
        for k, (v, number) in enumerate(zip(others, numbers, strict=True)):
            top, bottom = values[v]
            positive = bottom.is_constant and bottom.constant_value() > 0
            inner = "".join(f"Ex {n} (" for n in numbers[k + 1 :])
            quotient = f"{number} {self.text.poly(top)} {self.text.poly(bottom)} {str(positive).lower()}"
            regular = self.regular(facts, bottom, positive, theory)
            blocks.append((f"{quotient} ({inner}{data}{')' * inner.count('(')})", regular))
            data = f"(subst {quotient} {data})"
        there = self.follows(facts, image, theory, divided)
        proof = self.text.lemma(f"entails {context} {data}", f"entails_same _ _ _ {there}", 1)
        for block, regular in reversed(blocks):
            proof = f"(witness {context} {block} {regular} {proof} (eq_refl true))"
        same = self.text.lemma(f"equiv [] ({renamed}) {self.text.formula(wanted)}", "quantifiers _ _ _", 2)
        lemma = self.text.lemma(self.text.entails(facts, wanted), f"entails_by _ ({renamed}) _ {proof} {same}")
        for v in reversed(names):
            body = exists([v], body)
            lemma = self.text.lemma(self.text.entails((body, *known), wanted), f"opened _ _ _ _ {lemma}", 1)
        return lemma


_Term = tuple[int, tuple[tuple[int, int], ...]]
_Product = tuple[Poly, tuple[tuple[Poly, ...], ...]]
"""A polynomial, and products of which it is the sum."""
_RULES: Mapping[str, Callable[[_Steps, Claim, Context], str]] = {
    **dict.fromkeys(("steps", "virtual substitution", "equations taken apart"), _Steps.steps),
    "converse": _Steps.converse,
    "no exception": _Steps.no_exception,
    "instance": _Steps.point,
    "signs": _Steps.block,
    **dict.fromkeys(
        (
            "quantifiers",
            "renaming",
            "duality",
            "negation normal form",
            "independent parts and miniscoping",
            "nested blocks of one kind gathered",
        ),
        _Steps.quantifiers,
    ),
    "linear equation solved": _Steps.linear,
    "elimination set": _Steps.elimination_set,
    "terms": _Steps.terms,
}


def _at(a: Atom, terms: Terms, nonzero: Sequence[Poly], divided: list[_Product]) -> Poly:
    """The polynomial of a comparison at the terms, as ``subst`` makes it; the kernel divides it by squares."""
    for i, (_, bottom) in terms.items():
        if a.relation in (Relation.EQ, Relation.NE) and a.poly.degree(i) % 2 and not bottom.is_constant:
            raise Unable("an odd power of a denominator in an equation")
    whole, part = multiplied_out(a.poly, terms), at_terms(a.poly, terms, nonzero)
    if whole != part:
        rest, factors = whole.exact_divide(part), [part]
        for p in dict.fromkeys((*nonzero, *(bottom for _, bottom in terms.values()))):
            while not p.is_constant and rest.gcd(p**2) in (p**2, -(p**2)):
                rest, factors = rest.exact_divide(p**2), [*factors, p, p]
        divided.append((whole, ((*factors, rest),)))
    return whole


def _expanded(product: _Product, polys: list[Poly]) -> Identity:
    """The identity that says so, with primitive polynomials, which join those that are listed."""
    whole, parts = product
    terms = list[_Term]()
    for factors in ((-whole.ring.constant(1), whole), *parts):
        c, powers = 1, dict[int, int]()
        for p in factors:
            unit, primitive = (p.constant_value(), None) if p.is_constant else p.normal()
            c *= unit
            if primitive is not None:
                if primitive not in polys:
                    polys.append(primitive)
                powers[polys.index(primitive)] = powers.get(polys.index(primitive), 0) + 1
        if c:
            terms.append((c, tuple(powers.items())))
    return tuple(terms)


def _theory(entry: Entry) -> list[Entry]:
    """Polynomials, lemmas, cases, and what is refuted. Cases are looked for anew: Coq is given a tree."""
    return entry.fields("polynomials", "lemmas", "cases", optional=("refuted",))


def _powers(entry: Entry) -> tuple[tuple[int, int], ...]:
    pairs = (power.row("polynomial", "exponent") for power in entry.items())
    return tuple((i.integer(), e.integer(1)) for i, e in pairs)


def _term(term: _Term) -> str:
    c, powers = term
    return f"(({c})%Z, [{'; '.join(f'({i}, {e})%nat' for i, e in powers)}])"


def _joined(parts: Sequence[Formula]) -> Formula:
    """The disjunction as it stands: nothing is left out."""
    if len(parts) < 2:
        return parts[0] if parts else FALSE
    return Or(tuple(parts))


def _arranged(formula: Formula, place: Sequence[int], before: Formula) -> tuple[Formula, list[str]]:
    """The formula with ``before`` as one part where it is several, and the way there."""
    match formula:
        case _ if not place and formula == before:
            return formula, []
        case And(args) | Or(args) if not place:
            assert isinstance(before, And | Or)
            rest = tuple(a for a in args if a not in before.args)
            return type(formula)((*rest, before)), ["R_"] * len(rest)
        case And(args) | Or(args):
            k = place[0]
            inner, path = _arranged(args[k], place[1:], before)
            way = [*["R_"] * k, *(["L"] if k < len(args) - 1 else []), *path]
            return type(formula)((*args[:k], inner, *args[k + 1 :])), way
        case Exists(variables, body) | ForAll(variables, body):
            inner, path = _arranged(body, place[1:], before)
            return type(formula)(variables, inner), [*["D_"] * len(variables), *path]
    assert isinstance(formula, Not)
    inner, path = _arranged(formula.arg, place[1:], before)
    return Not(inner), ["D_", *path]
