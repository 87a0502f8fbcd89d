"""LaTeX for printed pages: ``\\exists x\\; a x^{2} + b x + c = 0``; long conjunctions and disjunctions in lines."""

from __future__ import annotations

import re

from qe.exact.ring import Poly
from qe.formula.comparison import ranges
from qe.formula.notation import Level, Notation, monomials, polynomial, positive
from qe.formula.syntax import And, Exists, ForAll, Formula, Or, Relation
from qe.spelling import PI, WORDS_FOR_PI, visible

WIDTH = 90
"""Characters of source after which a formula is broken at its outermost operator."""

GREEK = frozenset(
    (
        *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu"),
        *("nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega"),
    )
)
_NAME = re.compile(r"([^\W\d_]+)(?:(\d+)|_([A-Za-z0-9]+))?('*)")
_CAPITALS = frozenset(["Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega"])
"""The capitals that LaTeX has commands for; the others look like Latin ones."""
_SAID = frozenset(("and", "or", "not", "implies", "iff", "if"))
"""Words that most write upright for a connective."""
_MORE = {"^": r"\char94 ", "\\": r"\backslash ", "|": r"\vert ", " ": r"\ "}
_ESCAPES = {"_": r"\_", "#": r"\#", "$": r"\$", "%": r"\%", "&": r"\&", "{": r"\{", "}": r"\}", "~": r"\sim ", **_MORE}
RELATIONS = {Relation.NE: r"\neq", Relation.LE: r"\leq", Relation.GE: r"\geq"}


def read(text: str, *, source: str = "<text>") -> Formula:
    """The formula that a source means; see ``qe.io.latex_lexer``. Raises ``ParseError`` with line and column."""
    from qe.io.lowering import lower
    from qe.io.parser import parsed
    from qe.io.text_errors import Failing
    from qe.io.text_parser import LatexParser

    fail = Failing(text, source)
    return lower(parsed(LatexParser, text, fail), fail)


def write(formula: Formula) -> str:
    """Source for math mode, without dollar signs."""
    text = formula.written(_NOTATION)
    if len(text) <= WIDTH:
        return text
    prefix, body = "", formula
    while isinstance(body, Exists | ForAll):
        prefix += _quantifier(isinstance(body, ForAll), body.variables)
        body = body.body
    if not isinstance(body, And | Or):
        return text
    level, operator = (Level.AND, _NOTATION.conjunction) if isinstance(body, And) else (Level.OR, _NOTATION.disjunction)
    joined = (r" \\" + f"\n{operator.strip()}\\; & ").join(
        arg.written(_NOTATION, level, last=False) for arg in (ranges(body.args) if level is Level.AND else body.args)
    )
    return f"{prefix}\\begin{{array}}{{rl}}\n& {joined}\n\\end{{array}}"


def name(variable: str) -> str:
    """A variable: ``x1`` and ``x_ij`` as x with an index, Greek letters by name, long words upright. The index of
    ``x_1`` looks like that of ``x1``, but is another text."""
    if variable == PI:
        return r"\pi"
    parts = None if variable in WORDS_FOR_PI else _NAME.fullmatch(variable)
    if parts is None:
        plain = variable.rstrip("'") or variable
        upright = "".join(_ESCAPES.get(c, c) for c in visible(plain))
        return rf"\mathrm{{{upright}}}{variable[len(plain) :]}"
    letters, number, below, primes = parts.groups()
    if letters in _CAPITALS or (letters in GREEK and letters.islower()):
        base = "\\" + letters
    else:
        font = "mathit" if letters in _SAID else "mathrm"
        base = letters if len(letters) == 1 else rf"\{font}{{{letters}}}"
    if below is not None:
        number = rf"\mathrm{{{below}}}" if below.isdigit() else below
    return base + (f"_{{{number}}}" if number else "") + primes


def term(poly: Poly) -> str:
    """A polynomial."""
    return polynomial(monomials(poly), _NOTATION)


def _quantifier(universal: bool, variables: tuple[str, ...]) -> str:
    symbol = r"\forall" if universal else r"\exists"
    return f"{symbol} {', '.join(map(name, variables))}\\colon "


def _root(variable: str, relation: Relation, poly: Poly, k: int) -> str:
    inside = polynomial(positive(poly), _NOTATION)
    return rf"{name(variable)} {_NOTATION.relation(relation)} \operatorname{{root}}_{{{k}}}\left({inside}\right)"


_NOTATION = Notation(
    name=name,
    relation=lambda relation: RELATIONS.get(relation, relation.value),
    quantifier=_quantifier,
    root=_root,
    conjunction=r" \land ",
    disjunction=r" \lor ",
    negation=r"\lnot ",
    true=r"\top",
    false=r"\bot",
    times=r"\,",
    power=lambda base, k: f"{{{base}}}^{{{k}}}" if base.endswith("'") else f"{base}^{{{k}}}",
    brackets=(r"\left(", r"\right)"),
    quotient=r"\frac{{{}}}{{{}}}".format,
    customary=True,
)
