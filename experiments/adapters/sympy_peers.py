"""The peers that work on SymPy expressions: sympy-extras and semialg."""

from __future__ import annotations

import time
from typing import Any

from experiments.adapters.answer import Answer, Limits, NotSupported, OtherForm
from qe.errors import InputError
from qe.formula.build import exists, forall
from qe.formula.normal import Quantifier, prenex, rename, rename_apart
from qe.formula.syntax import And, Exists, ForAll, Formula, Not, Or
from qe.io.names import names_in
from qe.io.sympy import from_sympy, to_sympy
from qe.io.text import write


def sympy_extras(formula: Formula, limits: Limits) -> Answer:
    """sympy-extras: McCallum/Hong CAD and virtual substitution."""
    from sympy_extras.polys.cad import quantifier_elimination

    apart = rename_apart(formula)
    prefix, matrix = prenex(apart)
    symbols = _Symbols(apart)
    body = symbols.quantified(matrix)
    quantifiers = [
        ("exists" if kind is Quantifier.EXISTS else "forall", symbols.table[name])
        for kind, names in prefix
        for name in names
    ]
    start = time.perf_counter()
    result = quantifier_elimination(body, quantifiers)
    seconds = time.perf_counter() - start
    return Answer(symbols.text(result), seconds)


def semialg(formula: Formula, limits: Limits) -> Answer:
    """semialg: complete quantifier elimination on its symbolic quantifiers, of the prenex form."""
    from semialg.solve import reduce_complete_expr

    apart = rename_apart(formula)
    symbols = _Symbols(apart)
    prefix, whole = prenex(apart)
    for kind, names in reversed(prefix):
        whole = (exists if kind is Quantifier.EXISTS else forall)(names, whole)
    expression = symbols.quantified(whole)
    free = [symbols.table[name] for name in apart.free]
    start = time.perf_counter()
    result = reduce_complete_expr(expression, free_variables=free) if free else reduce_complete_expr(expression)
    seconds = time.perf_counter() - start
    return Answer(symbols.text(result), seconds)


class _Symbols:
    """Formulas to SymPy and back, through real symbols v0, v1, ... so that names cannot clash."""

    def __init__(self, formula: Formula) -> None:
        import sympy

        self.sympy = sympy
        self.table = {name: sympy.Symbol(f"v{i}", real=True) for i, name in enumerate(names_in(formula))}

    def quantified(self, formula: Formula) -> Any:
        """The expression, with semialg's quantifiers where there are any."""
        match formula:
            case Exists(names, body) | ForAll(names, body):
                import semialg as peer

                kind = peer.Exists if isinstance(formula, Exists) else peer.ForAll
                result = self.quantified(body)
                for name in reversed(names):
                    result = kind(self.table[name], result)
                return result
            case And(args):
                return self.sympy.And(*map(self.quantified, args))
            case Or(args):
                return self.sympy.Or(*map(self.quantified, args))
            case Not(arg):
                return self.sympy.Not(self.quantified(arg))
        try:
            return to_sympy(formula, symbols=self.table)
        except InputError as error:
            raise NotSupported(str(error)) from None

    def text(self, result: Any) -> str:
        """The answer in the text syntax, with its own names."""
        try:
            plain = self._without_denominators(result)
            return write(rename(from_sympy(plain), {str(s): name for name, s in self.table.items()}))
        except (InputError, AttributeError) as error:
            raise OtherForm(f"answer with {str(result)[:100]}: {error}") from None

    def _without_denominators(self, e: Any) -> Any:
        s = self.sympy
        if isinstance(e, s.And | s.Or | s.Not):
            return e.func(*map(self._without_denominators, e.args))
        if isinstance(e, s.core.relational.Relational):
            top, bottom = s.fraction(s.together(e.lhs - e.rhs))
            if bottom.free_symbols:  # p/q rel 0 iff p*q rel 0, where q is not zero
                return s.And(e.func(top * bottom, 0), s.Ne(bottom, 0))
        return e
