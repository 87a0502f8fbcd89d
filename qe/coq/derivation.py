"""Derivations for Coq, whole: every step as an equivalence, and what they lead to.

What ``primitives.v`` proves is applied there: congruence at a place, quantifiers, signs, linear equations, terms,
points. A step by a theorem that is not proved there (virtual substitution, theorems of ``qe.theorems``, Sturm's, ...),
and one for which no proof was found, is an axiom with the name of its rule that says what the step says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
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
from qe.kernel.elimination_set import block_of, start
from qe.kernel.linear_equation import Pivot, pivot_of, substituted
from qe.kernel.lowered_degree import lowered
from qe.kernel.negation import negation, normal
from qe.kernel.signs import Line, read_lemma, read_polynomials
from qe.kernel.step import Claim, Context, outside
from qe.kernel.substitution import mapped
from qe.kernel.terms import Terms, at_terms, block_opened, terms_of
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

    def trees(self, theory: Entry | None, goals: Iterable[Sequence[Formula]], more: Sequence[_Term] = ()) -> list[str]:
        """The polynomials, the identities, and a tree for each goal, as arguments of the theorems about signs."""
        polys, identities = self.theory(theory)
        trees = [Tree(map(normal, goal), polys, identities) for goal in goals]
        texts = [tree.text() for tree in trees]
        for k, tree in enumerate(trees):
            for mark, f in tree.quantified.items():
                texts[k] = texts[k].replace(mark, self.text.formula(f))
        named = "; ".join(self.text.poly(p) for p in polys)
        terms = "; ".join(f"[{'; '.join(map(_term, identity))}]" for identity in identities)
        return [f"[{named}]", f"[{terms}]", *texts]

    def theory(self, entry: Entry | None) -> tuple[list[Poly], list[Identity]]:
        """The polynomials and identities of the evidence."""
        if entry is None:
            return [], []
        listed, lemmas = entry.fields("polynomials", "lemmas")
        polys = list(read_polynomials(listed, self.ring))
        found: list[Identity] = []
        for lemma in lemmas.items():
            if isinstance(lemma.value, dict) and "identity" in lemma.value:
                terms = [term.row("coefficient", "powers") for term in lemma.fields("identity")[0].items()]
                found.append(tuple((int(c.rational()), _powers(powers)) for c, powers in terms))
        return polys, found

    def lines(self, entry: Entry | None) -> list[Formula]:
        """What the lemmas about polynomials in one variable say."""
        if entry is None:
            return []
        listed, lemmas = entry.fields("polynomials", "lemmas")
        polys = read_polynomials(listed, self.ring)
        read = [read_lemma(lemma, polys, self.ring) for lemma in lemmas.items() if "line" in (lemma.value or {})]  # type: ignore[operator]
        return [
            disj(
                conj(atom(polys[i], _SIGNS[s]) for i, s in zip(line.polynomials, cell, strict=True))
                for cell in line.cells
            )
            for line in read
            if isinstance(line, Line)
        ]

    def equal(self, context: Context, f: Formula, g: Formula, theory: Entry | None = None) -> str:
        """By the signs that the lemmas allow."""
        if f == g:
            return self.same(context, f, g)
        cells = self.lines(theory)
        known = (*cells, *context)
        goals = ((negation(g), normal(f), *known), (negation(f), normal(g), *known))
        ps, identities, one, two = self.trees(theory, goals)
        found = self.lemma(known, f, g, f"signs_equiv {ps} {identities} {one} {two} _ _ _", 2)
        for k, cell in enumerate(cells):
            believed = self.text.axiom("Sturm", (), cell, TRUE)
            found = self.lemma(known[k + 1 :], f, g, f"also _ _ _ _ {believed} {found}")
        return found

    def follows(self, context: Context, f: Formula, theory: Entry | None = None) -> str:
        """``entails context f``, by signs."""
        if self.lines(theory):
            raise Unable("a lemma about a line")
        ps, identities, tree = self.trees(theory, [(negation(f), *context)])
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

    def joined(
        self, context: Context, kind: type[And | Or], pairs: Sequence[tuple[Formula, Formula, str]], goal: Formula
    ) -> tuple[Formula, str]:
        """The conjunction (disjunction) of the first formulas, and the lemma that it is the goal."""
        one, two = _joined(kind, [pair[0] for pair in pairs]), _joined(kind, [pair[1] for pair in pairs])
        if not pairs:
            return one, self.same(context, one, goal)
        theorem = "and_both" if kind is And else "or_both"
        proof = "".join(f"({theorem} _ _ _ _ _ {lemma} " for _, _, lemma in pairs[:-1])
        proof += pairs[-1][2] + ")" * (len(pairs) - 1)
        whole = self.lemma(context, one, two, proof)
        return one, self.trans(context, (one, two, goal), whole, self.same(context, two, goal))

    def parts(self, context: Context, starts: Sequence[Formula], parts: Entry, goal: Formula) -> tuple[Formula, str]:
        """The disjunction of the starts, and the lemma that it is the goal."""
        pairs = []
        for first, steps in zip(starts, parts.items(), strict=True):
            lemma, last = self.run(steps, first, context)
            pairs.append((first, last, lemma))
        return self.joined(context, Or, pairs, goal)

    def alternatives(self, claim: Claim, context: Context) -> str:
        pieces, parts = claim.evidence.fields("pieces", "parts")
        block = claim.block()
        bodies = [formula_from_json(piece, self.ring, quantified=True) for piece in pieces.items()]
        starts = [block_of(block.variables, body, self.ring) for body in bodies]
        middle, last = self.parts(context, starts, parts, claim.after)
        first = self.moved(context, claim.before, middle)
        return self.trans(context, (claim.before, middle, claim.after), first, last)

    def independent(self, claim: Claim, context: Context) -> str:
        pieces, block = claim.evidence.fields("pieces")[0], claim.block()
        names, members = set(block.variables), conjuncts(block.body)
        beside = tuple(m for m in members if not names & set(m.free))
        pairs = [(m, m, self.same(context, m, m)) for m in beside]
        listed = set[Formula]()
        for entry in pieces.items():
            body, together, steps = entry.fields("body", "together", "steps")
            piece = formula_from_json(body, self.ring, quantified=True)
            listed |= set(conjuncts(piece))
            first = block_of(names, conj((*(beside if together.truth() else ()), piece)), self.ring)
            lemma, end = self.run(steps, first, context)
            pairs.append((first, end, lemma))
        others = [m for m in members if m not in beside and m not in listed]
        if others:  # a piece is false
            rest = block_of(names, conj(others), self.ring)
            pairs.append((rest, rest, self.same(context, rest, rest)))
        found = _joined(And, [pair[1] for pair in pairs])
        middle, lemma = self.joined(context, And, pairs, found)
        lemmas = (self.moved(context, claim.before, middle), lemma, self.equal(context, found, claim.after))
        return self.chain(context, (claim.before, middle, found, claim.after), lemmas)

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

    def search(self, claim: Claim, context: Context) -> str:
        before, after = existential(claim)
        if not isinstance(before, Exists) or after != FALSE:
            raise claim.fail("expected a sentence of one block, which is false")
        known: list[tuple[Formula, str]] = []
        for entry in claim.evidence.fields("refuted", "learnt")[0].items():
            atoms, steps = entry.fields("atoms", "steps")
            together = conj(formula_from_json(e, self.ring) for e in atoms.items())
            sentence = exists(together.free, together)
            negative = negation(together)
            lemma = self.refuted(sentence, together, self.run(steps, sentence, ())[0])
            positive = self.text.lemma(self.text.entails((), negative), f"entails_same _ _ _ {lemma}", 1)
            known.append((negative, self.lemma((), negative, TRUE, f"entails_equiv _ _ {positive}")))
        facts = tuple(f for f, _ in known)
        ps, identities, one = self.trees(None, [(normal(before.body), *facts)])
        inner = self.lemma(facts, before.body, FALSE, f"signs_equiv {ps} {identities} {one} Clash _ _ _", 2)
        for k, (_, lemma) in enumerate(known):
            inner = self.lemma(facts[k + 1 :], before.body, FALSE, f"also _ _ _ _ {lemma} {inner}")
        whole = self.at(context, before, FALSE, (0,), before.body, FALSE, (), inner)
        return self.via(context, claim, before, after, whole)

    def elimination_set(self, claim: Claim, context: Context) -> str:
        variable, exponent, _, _, points, parts = claim.evidence.fields(
            "variable", "exponent", "side", "quadratics", "points", "parts"
        )
        (block, name, x), shift = claim.variable(variable), exponent.integer(1)
        body = lowered(block.body, x, shift, exponent)
        tried = read_points(points, body, block.body, x, shift, self.ring)
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

    def guarded(self, claim: Claim, context: Context) -> str:
        (entry,) = claim.evidence.fields("solved")[0].row("equation")
        block, body = claim.block().variables, claim.block().body
        pivot = pivot_of(entry, block, body, claim)
        rest = tuple(v for v in block if v != pivot.name)
        guard = atom(pivot.lead, Relation.NE)
        one = conj((guard, body))
        two = conj((atom(pivot.lead, Relation.EQ), atom(pivot.rest, Relation.EQ), pivot.others))
        cases = disj((one, two))
        known = outside(context, block)
        polys = [pivot.equation, self.ring.gen(pivot.x)]
        terms: list[tuple[int, tuple[tuple[int, int], ...]]] = [(-1, ((0, 1),))]
        for p, factors in ((pivot.lead, ((1, 1),)), (pivot.rest, ())):
            unit, primitive = p.normal()
            if p.is_constant:
                if p:
                    terms.append((p.constant_value(), factors))
                continue
            if primitive not in polys:
                polys.append(primitive)
            powers = dict(factors)
            powers[polys.index(primitive)] = powers.get(polys.index(primitive), 0) + 1
            terms.append((unit, tuple(powers.items())))
        goals = ((negation(cases), normal(body), *known), (negation(body), normal(cases), *known))
        trees = [Tree(map(normal, goal), polys, [tuple(terms)]) for goal in goals]
        texts = [tree.text() for tree in trees]
        for k, tree in enumerate(trees):
            for mark, f in tree.quantified.items():
                texts[k] = texts[k].replace(mark, self.text.formula(f))
        named = "; ".join(self.text.poly(p) for p in polys)
        identity = "; ".join(map(_term, terms))
        split = self.lemma(known, body, cases, f"signs_equiv [{named}] [[{identity}]] {' '.join(texts)} _ _ _", 2)
        inner, image = Exists((pivot.name,), one), conj((guard, substituted(pivot, claim)))
        outer = Exists(rest, inner) if rest else inner
        middle, goal = Or((outer, Exists(block, two))), Or((exists(rest, image), Exists(block, two)))
        solved = self.solved(known, inner, pivot, image, None)
        lemmas = [
            self.under(context, block, body, cases, split),
            self.moved(context, exists(block, cases), middle),
            self.at(context, middle, goal, (0, 0) if rest else (0,), inner, image, known, solved),
            self.same(context, goal, claim.after),
        ]
        return self.chain(context, (claim.before, exists(block, cases), middle, goal, claim.after), lemmas)

    def point(self, claim: Claim, context: Context) -> str:
        before, after = existential(claim)
        data: Any = claim.evidence.fields("certificate")[0].value
        if after != TRUE or not isinstance(before, Exists) or data["kind"] != "witness":
            raise Unable("no rational point")
        payload = data["payload"]
        if not all(isinstance(v, str) for v in payload["values"]):
            raise Unable("no rational point")
        values = {v: Fraction(text) for v, text in zip(payload["order"], payload["values"], strict=True)}
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
        image = normal(mapped(goal, lambda a: atom(_at(a, terms), a.relation), about, claim))
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
        there = self.follows(facts, image, theory)
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
_RULES: Mapping[str, Callable[[_Steps, Claim, Context], str]] = {
    **dict.fromkeys(("steps", "virtual substitution", "equations taken apart"), _Steps.steps),
    "converse": _Steps.converse,
    "no exception": _Steps.no_exception,
    **dict.fromkeys(("instance", "convex", "point or multipliers"), _Steps.point),
    **dict.fromkeys(
        (
            "simplification",
            "standard simplification",
            "case split on factors",
            "boundary apart",
            "signs by sums of squares",
            "Groebner basis of the equations",
            "multiple of an equation subtracted",
            "vanishing sum of squares split",
        ),
        _Steps.block,
    ),
    "Boolean search": _Steps.search,
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
    "alternatives": _Steps.alternatives,
    "independent parts": _Steps.independent,
    "linear equation solved": _Steps.linear,
    "linear equation solved under a guard": _Steps.guarded,
    "elimination set": _Steps.elimination_set,
    "terms": _Steps.terms,
}


def _at(a: Atom, terms: Terms) -> Poly:
    """The polynomial of a comparison at the terms, as ``subst`` makes it."""
    for i, (_, bottom) in terms.items():
        if a.relation in (Relation.EQ, Relation.NE) and a.poly.degree(i) % 2 and not bottom.is_constant:
            raise Unable("an odd power of a denominator in an equation")
    return at_terms(a.poly, terms)


def _powers(entry: Entry) -> tuple[tuple[int, int], ...]:
    pairs = (power.row("polynomial", "exponent") for power in entry.items())
    return tuple((i.integer(), e.integer(1)) for i, e in pairs)


def _term(term: _Term) -> str:
    c, powers = term
    return f"(({c})%Z, [{'; '.join(f'({i}, {e})%nat' for i, e in powers)}])"


def _joined(kind: type[And | Or], parts: Sequence[Formula]) -> Formula:
    """As it stands: nothing is left out."""
    if len(parts) < 2:
        return parts[0] if parts else (TRUE if kind is And else FALSE)
    return kind(tuple(parts))


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
