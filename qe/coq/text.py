"""Formulas as data of ``primitives.v``, each polynomial and formula defined once, and in the language of Coq."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence

from qe.errors import Unable
from qe.exact.ring import Poly, Ring
from qe.formula.relation import Relation
from qe.formula.syntax import And, Atom, Constant, Exists, ForAll, Formula, Not, Or

_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9]*", re.ASCII)
RELATION = {relation: relation.value for relation in Relation} | {Relation.NE: "<>"}


def identifiers(names: Sequence[str]) -> list[str]:
    """Different words of Coq for names of any kind."""
    return [f"v_{name}" if _PLAIN.fullmatch(name) else f"v{k}" for k, name in enumerate(names)]


class Text:
    """The lines of a file, as they come. ``prefix`` begins all names in it.

    A variable has the number by which the order of terms is that of the ring: the last one is 1.
    """

    def __init__(self, ring: Ring, prefix: str) -> None:
        self.ring, self.prefix = ring, prefix
        self.words = dict(zip(ring.names, identifiers(ring.names), strict=True))
        self.lines: list[str] = []
        self.axioms: list[str] = []
        self._names: dict[str, str] = {}
        self._formulas: dict[Formula, str] = {}
        self._count = 0

    def variable(self, name: str) -> int:
        """Its number."""
        return self.ring.size - self.ring.index[name]

    def name(self, kind: str) -> str:
        """A new name."""
        self._count += 1
        return f"{self.prefix}_{kind}{self._count}"

    def _defined(self, kind: str, of: str, value: str) -> str:
        if value not in self._names:
            self._names[value] = name = self.name(kind)
            self.lines.append(f"Definition {name} : {of} := {value}.")
        return self._names[value]

    def poly(self, p: Poly) -> str:
        """The name of a polynomial."""
        n, terms = self.ring.size, []
        for powers, c in p.sparse_terms():
            monomial = "; ".join(f"xp {n - i} {k}" for i, k in sorted(powers, reverse=True))
            terms.append(f"tm ({c}) [{monomial}]")
        return self._defined("p", "poly", f"[{'; '.join(terms)}]")

    def formula(self, f: Formula) -> str:
        """The name of a formula, as it stands."""
        if f not in self._formulas:
            self._formulas[f] = self._defined("f", "form", self._value(f))
        return self._formulas[f]

    def _value(self, f: Formula) -> str:
        match f:
            case Constant(value):
                return "Tr" if value else "Fa"
            case Atom(poly, relation):
                return f"At {self.poly(poly)} {relation.name}"
            case Not(arg):
                return f"No {self.formula(arg)}"
            case And(args) | Or(args):
                kind = "An" if isinstance(f, And) else "Ou"
                parts = [self.formula(a) for a in args]
                return "".join(f"{kind} {part} (" for part in parts[:-1]) + parts[-1] + ")" * (len(parts) - 1)
            case Exists(variables, body) | ForAll(variables, body):
                kind = "Ex" if isinstance(f, Exists) else "Al"
                inner = self.formula(body)
                return "".join(f"{kind} {self.variable(v)} (" for v in variables) + inner + ")" * len(variables)
        raise Unable("root atoms cannot be written for Coq")

    def formulas(self, fs: Iterable[Formula]) -> str:
        """A list of them."""
        return f"[{'; '.join(self.formula(f) for f in fs)}]"

    def lemma(self, statement: str, proof: str, conditions: int = 0) -> str:
        """The name of a lemma, the proof of which leaves so many conditions that are computed."""
        name = self.name("s")
        computed = f"{' _' * conditions}); vm_cast_no_check (eq_refl true)" if conditions else ")"
        self.lines.append(f"Lemma {name} : {statement}.\nProof. refine ({proof}{computed}. Qed.")
        return name

    def equiv(self, context: Iterable[Formula], f: Formula, g: Formula) -> str:
        """The statement of an equivalence."""
        return f"equiv {self.formulas(context)} {self.formula(f)} {self.formula(g)}"

    def entails(self, context: Iterable[Formula], f: Formula) -> str:
        """The statement that one formula follows from others."""
        return f"entails {self.formulas(context)} {self.formula(f)}"

    def axiom(self, rule: str, context: Sequence[Formula], f: Formula, g: Formula) -> str:
        """The name of an equivalence that is believed, as an instance of the theorem of a rule."""
        name = f"{self.name('axiom')}_{re.sub('[^A-Za-z0-9]+', '_', rule).strip('_')}"
        free = {v for part in (*context, f, g) for v in part.free}
        names = [v for v in self.ring.names if v in free]
        every = f"forall {' '.join(self.words[v] for v in names)} : R, " if names else ""
        given = "".join(f"({self.said(c)}) -> " for c in context)
        self.lines.append(f"Axiom {name} : {every}{given}(({self.said(f)}) <-> ({self.said(g)})).")
        self.axioms.append(name)
        values = "".join(f" (e {self.variable(v)}%positive)" for v in names)
        data = f"{self.formulas(context)} {self.formula(f)} {self.formula(g)}"
        return self.lemma(self.equiv(context, f, g), f"believed {data} (fun e => {name}{values})")

    def said(self, f: Formula) -> str:
        """The formula in the language of Coq, such that ``says`` computes to it."""
        return _said(f, self.words.__getitem__)


def _said(f: Formula, word: Callable[[str], str]) -> str:
    match f:
        case Constant(value):
            return "True" if value else "False"
        case Atom(poly, relation):
            return f"{terms(poly, word)} {RELATION[relation]} 0"
        case Not(arg):
            return f"~ ({_said(arg, word)})"
        case And(args) | Or(args):
            sign = " /\\ " if isinstance(f, And) else " \\/ "
            return sign.join(f"({_said(a, word)})" for a in args)
        case Exists(variables, body) | ForAll(variables, body):
            kind = "exists" if isinstance(f, Exists) else "forall"
            return f"{kind} {' '.join(map(word, variables))} : R, {_said(body, word)}"
    raise Unable("root atoms cannot be written for Coq")


def terms(poly: Poly, word: Callable[[str], str]) -> str:
    """A sum that is bracketed to the right."""
    parts = [_term(powers, c, poly.ring.names, word) for powers, c in poly.sparse_terms()]
    return " + (".join(parts) + ")" * (len(parts) - 1)


def _term(powers: Sequence[tuple[int, int]], c: int, names: Sequence[str], word: Callable[[str], str]) -> str:
    factors = [word(names[i]) + (f" ^ {k}" if k > 1 else "") for i, k in sorted(powers, reverse=True)]
    number = [str(c) if c > 0 else f"({c})"] if c != 1 or not factors else []
    return " * ".join([*number, *factors])
