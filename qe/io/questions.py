"""Questions in words, and commands of other systems, as formulas: ``for which m does x^2 = m have two solutions?`` is
``exactly two x. x^2 = m``, and ``let a, b be positive reals; prove that f`` is ``all a, b. a, b > 0 -> f``.

What is read is noted for the caller; a text that is not clear stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import combinations

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.relation import Relation
from qe.io.latex_lexer import as_text
from qe.io.lowering import lower_term
from qe.io.parser import TERM, parsed
from qe.io.scripts import last_command
from qe.io.sentence import BEST, COUNT, KINDS, LEAST, LIST, PLACE, SHORT, SIGN, THINGS, VOCABULARY, F, Sentence
from qe.io.surface import FUNCTIONS
from qe.io.text_errors import Failing
from qe.io.text_lexer import CALLS, SIMPLIFIERS
from qe.io.text_parser import TextParser, lexed, products
from qe.io.text_words import LISTED, NO_VARIABLES, SIGNED, Question, split
from qe.spelling import KEYWORDS, WORD, unquoted

LONGEST = 1000
"""Longer texts are no questions in words."""

_STRAY = re.compile(rf"(?<!all )(?<!any )(?<!every )(?<!some )\b{SIGN}\b")
_PROVE = (
    "(?:prove(?: that| whether)?|(?:decide|find|check) (?:that|whether|if)|is it true that)"
    "(?: ?:| inequality(?: that)?)?"
)
_ASKED = re.compile(
    rf"(?:(?P<proved>{_PROVE}) |solve (?:for (?P<for>{F}) ?(?::|in)|{THINGS}|:)? ?"
    rf"|find (?:some |every )?(?P<sought>{F}) (?:in \S+ )?(?:such that|if|with|does|do|is|are|for which) )"
    r"(?P<rest>.*§.*)"
)
"""What is to be shown or solved, or a condition on the variables that are sought."""
_GIVEN = re.compile(
    rf"(?:let|if|suppose(?: that)?|given(?: that)?(?! any)|assume(?: that)?|for(?: all| any| every)?(?! wh)) (.+?)"
    rf"(?: ?[.,:]? (?:then )?{_PROVE}| , is(?: it true that)?) (.+)"
)
_SHOWN = re.compile(rf"(?:(?:if|suppose|assume|given|let)(?: that)? )?(.+?) ?[.,:] {_PROVE} (.+)")
_IF_THEN = re.compile(r"if (.+?) ?,? then (.+)")
_SORTED = re.compile(
    rf"({F}) (?:(?:be|are|is|denote) )?(?:any |two |three |four )*(distinct )?({SIGN}\b)? ?(?:numbers|constant)?"
    rf"(?: (?:with|and) (product|sum) ({F}))?(?! ?§)"
    rf"|({SIGN}) (?:numbers )?({F})|numbers ({F})"
)
"""Variables with what they are: ``a, b be positive numbers``, ``positive numbers a, b``."""
_TRIANGLE = re.compile(
    rf"({F}) (?:be|are) (?:lengths of )?(?:side lengths|sides|lengths of sides) of (?:some )?triangle"
)
_LEAN = re.compile(
    r"(?:theorem\s+\S+|lemma\s+\S+|example)\s*((?:[({][^(){}:]*:(?:[^(){}]|\([^()]*\))*[)}]\s*)*):(?!=)\s*(.+?)\s*(?::=.*)?",
    re.DOTALL,
)
_BINDER = re.compile(r"[({]([^(){}:]*):\s*((?:[^(){}]|\([^()]*\))*)[)}]")
_AND = re.compile(r" ?,? ?\b(?:and )?(?:with|such that|satisfied)\b ?:? ?| ?, and\b ?")

_NOT_REAL = re.compile(
    r"(?i)\b(?:positive|negative|all|any|some|are|be|an|for|the|distinct|of)\s+(integers?|natural\s+numbers?|rationals?)\b"
)
_PART = r"(?:(?<!\S)(?<!, )|(?<=[.:;]))\(?(?:{})\)\s+(?!and\b|or\b|in\b)[a-z]{{2,}}\s"
_PARTS = re.compile(rf"(?is){_PART.format('a|i')}.*{_PART.format('b|ii')}")
"""What a question in two parts has: (a) and (b) with a word behind each."""
_FOR_ALL = rf",? ?for (?:all|any|every) (?:values of )?(?:constant )?({F})"
_EVERY = re.compile(rf"{_FOR_ALL} ?[,:] ?(.+)|(.+?) {_FOR_ALL}")
_UNNAMED = re.compile(r"\bfor (?:all|every|any) values$")
_ROOTS = re.compile(
    rf"(quadratic )?(system )?({F}) (?:to )?has (?:({COUNT}) )?{KINDS}(?:root(s?))"
    rf"(?: (?:(?:which|that) are )?((?:and|{SIGN}| )+?))?(?: for ({F}))?"
    rf"(?: (?:{PLACE}|(?:that are )?of opposite signs))?"
)
_SEPARATED = re.compile(
    rf"(?:quadratic )?({F}) has one root (?:is )?{PLACE} and (?:other|one)(?: root)?(?: is)? {PLACE}"
)
_MEETING = re.compile(
    rf"(?:is |does |do )?({F}) (?:(?:does|do) (not) )?(?:is |are )?(meet|touch|tangent to)(?: with)? ({F})"
    rf"(?: (?:at|in) ({COUNT})(?: distinct)* points)?"
)
_ABOVE = re.compile(
    rf"(?:(?:whole|entire|all)(?: of)? )?({F}) (?:is|lie)(?: (?:entirely|completely|wholly|strictly|always))*"
    rf" (above|below) ({F})"
)
_ALWAYS = re.compile(rf"(is )?({F}) (?:(is|be) )?(always )?({SIGN})(?: (for (?:all|every|any) .*))?")
_CALL = re.compile(
    r"(?:\w+(?:\.|:-))*(?:SolveTools\[)?((?:n|f|lin|nonlin)?solve\w*|reduce_\w+|prove|bool|qepcad|QuantifierElimination|SemiAlgebraic"
    r"|(?<=:-)simplify)\]?\((.*)\)\s*[;:]?",
    re.DOTALL,
)
_PROVED = ("prove", "bool")
_ASSUMES = re.compile(rf"\s*(Assuming|{'|'.join(SIMPLIFIERS)})\[(.*)\]\s*", re.DOTALL)
_WITHIN = re.compile(r"(?:domain\s*=\s*)?Interval(?:\.([LR]?)open)?\(\s*([^,()]+),\s*([^,()]+)\)")
"""An interval of SymPy."""
_DOMAIN = re.compile(r"(?:domain\s*=\s*)?S?\.?Reals|real\b|\w+\s*=\s*(?:True|False|real|Q\.real\(\w+\)|'[^']*')")
_NAMES = re.compile(rf"(?:{LISTED}|[\[({{]\s*(?:{LISTED}(?:\s*,\s*{LISTED})*)?\s*[\])}}])")

_SUBJECT = (
    r" ?,? (?:subject to(?: condition)?(?: that)?|such that|given(?: that)?|under|where|when|for|with|over|on|if) :? ?"
)
_OPTIMUM = re.compile(
    rf"(?:(?:(?:find|what is) )?({BEST})(?: possible)?(?: values)?(?: (?:of|that|which))? ?:? ?(?:{THINGS})? ?)?"
    rf"({F})(?: can take)?((?:{_SUBJECT}.+)?)"
)
_INTERVAL = re.compile(r"\s*[\[(][^()\[\]<>=≤≥]*,[^()\[\]<>=≤≥]*[\])]\s*")
_RELATED = re.compile(r"[<>=≤≥≠∈]")


def plainly(text: str) -> Question:
    """A question in words as a formula. Roots are counted as different values of x, or of the only variable that is not
    sought; what is to be proved holds for all values of its variables."""
    if (command := last_command(text)) != text:
        return plainly(command)
    call = _ASSUMES.fullmatch(text)
    two = [*split(call[2])] if call else []
    if call and len(two) == 2 and "->" not in two[1]:
        condition, body = two if call[1] == "Assuming" else reversed(two)
        if (proved := _CALL.fullmatch(body)) and proved[1] in _PROVED:
            return _called(proved[1], proved[2], condition)
        return plainly(body.replace("$Assumptions", condition))._replace(assumed=condition)
    short = _typed(text.strip()) if len(text) < LONGEST else ""
    if not short:
        return Question(text)
    if (lean := _LEAN.fullmatch(short)) and (stated := _stated(lean[1], lean[2])):
        return Question(stated)
    if call := _CALL.fullmatch(short):
        return _called(call[1], call[2])
    if sort := _NOT_REAL.search(short):
        raise InputError(f"all variables are real, {sort[1]} cannot be asked for")
    if _PARTS.search(short):
        raise InputError("this question has parts (a), (b): ask one part at a time")
    said = Sentence(short)
    question = _read(said, " and ".join(filter(None, (_premise(said, where) for where in said.where))))
    is_clear = question is not None and not _STRAY.search(question.formula)
    return question if question is not None and is_clear else Question(text)


def _read(said: Sentence, known: str) -> Question | None:
    """What a sentence asks under what is ``known``; None where that is not clear."""
    words = said.words
    if (shown := _SHOWN.fullmatch(words)) and (implied := _implied(said, shown[1], shown[2], known)):
        return Question(implied)
    given = _GIVEN.fullmatch(words) or _IF_THEN.fullmatch(words)
    if given and (given.re is _GIVEN or _premise(said, given[1]) != said[given[1]]):
        return Question(_closed(_claim(said[given[2]]), _both(known, _premise(said, given[1]))))
    begins = _ASKED.fullmatch(words)
    rest = begins["rest"] if begins else words
    names = tuple(said.names(begins["for"] or begins["sought"] or "")) if begins else ()
    if unnamed := _UNNAMED.search(rest):
        others = {*_names(said[rest[: unnamed.start()]])}.difference(names)
        if len(others) != 1:
            raise InputError(f"{unnamed[0]}: the name of a variable expected behind it, as in for all real values of x")
        rest = f"{rest[: unnamed.start()]}for all {others.pop()}"
    every = _EVERY.fullmatch(rest) if begins and begins["proved"] else None
    names = tuple(said.names(every[1] or every[4])) if every else names
    formula = _conditions(said, (every[2] or every[3]) if every else rest, names)
    formula = formula or (_premise(said, rest) if _TRIANGLE.match(rest) else None)
    if begins and begins["proved"]:
        return Question(_closed(formula or _claim(said[rest]), known))
    if formula is None and begins:
        formula = said[rest]
    if formula is not None:
        _no_other_variables(known, formula)
    return None if formula is None else Question(_both(known, formula), names)


def _conditions(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """What is said of roots, curves and signs, as a formula; None where a part of it says something else. Behind a name
    that is sought brackets are a factor: ``k(x - 1)``."""
    for name in sought:
        said.formulas[:] = [re.sub(rf"(?<!\w)({re.escape(name)})\(", r"\1*(", one) for one in said.formulas]
    forms = (_separated, _counted, _meeting, _above, _always)
    for parts in ([text], text.split(" and ")):
        claims = [next(filter(None, (form(said, part, sought) for form in forms)), "") for part in parts]
        if all(claims):
            return _both(*claims)
    return None


def _both(*parts: str) -> str:
    return " and ".join(f"({part})" if len([*filter(None, parts)]) > 1 else part for part in parts if part)


# --- what is to be proved ---------------------------------------------------------------------------------
def _closed(claim: str, given: str = "") -> str:
    """A claim for all values of its variables that no quantifier of its own has."""
    _no_other_variables(given, claim)
    whole = f"({given}) -> ({claim})" if given else claim
    bound = _bound(whole)
    names = [name for name in _names(whole) if name not in bound]
    return f"all {', '.join(names)}. {whole}" if names else whole


def _implied(said: Sentence, supposed: str, claim: str, known: str) -> str | None:
    """That a claim holds where something is so of roots or curves: for all values of its variables, which no quantifier
    of what is supposed may bind; None otherwise."""
    whole = _claim(said[claim])
    names = {*_names(whole)} - _bound(whole)
    condition = _conditions(said, supposed, tuple(names))
    made = products(f"({condition}) -> ({whole})")
    letters = {letter for name in names if name in made for letter in name}  # "kx" may mean k*x
    if condition is None or (names | letters) & _bound(condition):
        return None
    _no_other_variables(known, condition)
    return _closed(_claim(said[claim]), _both(known, condition))


def _bound(text: str) -> set[str]:
    return lexed(text).bound


def _no_other_variables(given: str, claim: str) -> None:
    """Raises ``InputError`` for a variable of a condition that a quantifier behind it binds again: the condition says
    nothing of that one, whatever the text means."""
    if hidden := {*_names(given)} & _bound(claim) - _bound(given):
        raise InputError(f"{', '.join(sorted(hidden))}: bound by a quantifier that the condition {given} is outside of")


def _claim(text: str) -> str:
    """What is claimed, with a quantifier behind it in front."""
    text = re.sub(rf"\bfor (?=(?:{SIGN}|numbers) )", "for all ", text)
    return re.sub(r"(?s)^(.+?) (for (?:all|every|any)\b[^:]*)$", r"\2: \1", text)


def _premise(said: Sentence, text: str) -> str:
    """Conditions in words: ``x, y be positive numbers with x + y = 1`` is ``x, y > 0 and x + y = 1``."""

    def sorted_names(match: re.Match[str]) -> str:
        where = match[1] or match[7] or match[8]
        listed, sign = said.names(where), match[3] or match[6]
        if match[0].strip() == match[1]:
            return match[0]
        parts = [f"{', '.join(listed)} {SIGNED[sign]} 0"] if sign else []
        if not LIST.fullmatch(said[where]):
            return f" {said.put(' and '.join((said[where], *parts)))} " if _RELATED.search(said[where]) else match[0]
        parts += [f"{a} /= {b}" for a, b in combinations(listed, 2) if match[2]]
        parts += [f"{said.joined(match[4], match[1])} = {said[match[5]]}"] if match[4] else []
        return f" {said.put(' and '.join(parts))} " if parts else " "

    def triangle(match: re.Match[str]) -> str:
        listed = said.names(match[1])
        a, b, c = listed if len(listed) == 3 else (match[0], "", "")
        return said.put(f"{a}, {b}, {c} > 0 and {a} + {b} > {c} and {b} + {c} > {a} and {c} + {a} > {b}")

    text = _SORTED.sub(sorted_names, _TRIANGLE.sub(triangle, text))
    text = re.sub(r"^\s*and\b|\band\s*$", "", re.sub(r"\band(?: and)+\b", "and", _AND.sub(" and ", text).strip()))
    return said[re.sub(" +", " ", text)].strip(" ,.")


def _stated(binders: str, claim: str) -> str | None:
    """A theorem as Lean states it, ``(x y : ℝ) (h : x + y = 1) : x * y ≤ 1 / 4``; None for one about other types."""
    listed = [(binder[1].split(), binder[2].strip()) for binder in _BINDER.finditer(binders)]
    names = [name for words, kind in listed if kind in ("ℝ", "Real") for name in words]
    if any(re.fullmatch(WORD, kind) for _, kind in listed if kind not in ("ℝ", "Real")):
        return None
    premises = [f"({kind})" for _, kind in listed if kind not in ("ℝ", "Real")]
    whole = " -> ".join((*premises, f"({claim})"))
    whole = re.sub(r"Real\.sqrt\s+(\w+)", r"sqrt(\1)", whole).replace("Real.sqrt", "sqrt")
    whole = re.sub(r"\((\S+)\s*:\s*ℝ\)", r"\1", whole)
    return f"all {', '.join(names)}. {whole}" if names else whole


def _names(text: str) -> tuple[str, ...]:
    """The variables of a formula in text, in their order; letters side by side that are a product each by itself."""
    no_names = {*KEYWORDS, *FUNCTIONS, *CALLS, *NO_VARIABLES, *VOCABULARY, *SHORT.split()}
    words = [word for word in re.findall(LISTED, text) if word not in no_names]
    made = products(text)
    return tuple(dict.fromkeys(name for word in words for name in (word if word in made else [word])))


# --- roots ------------------------------------------------------------------------------------------------
def _equation(text: str, sought: Iterable[str], named: str | None = None) -> tuple[str, str] | None:
    """An equation and the variable that it is to be solved for; None where that is not clear."""
    whole = {*_names(text)}
    others = whole.difference(sought)
    has_x = any(other.endswith("x") for other in others if len(other) < 4)  # x, ax
    name = named or ("x" if has_x else others.pop() if len(others) == 1 else "")
    powers = tuple(f"{one}{power}" for one in (name, *sought) for power in "23")  # mx2 for m*x^2
    meant = {other for other in whole if other.swapcase() in (name, *sought) or other.endswith(powers)}
    if name and meant:
        raise InputError(f"{', '.join(sorted(meant))}: a power is written x^2, and small letters are not capitals")
    if not name or re.search(r"[<>≤≥≠∃∀]|\b(?:and|or|ex|all|for|if)\b", text):
        return None
    return (text if "=" in text else f"{text} = 0"), name


def _difference(equation: str) -> Poly | None:
    """The polynomial that an equation says is zero; None where it has none."""
    left, _, right = equation.partition("=")
    fail = Failing(f"({left}) - ({right})", "<text>")
    try:
        return lower_term(parsed(TextParser, fail.text, fail, TERM), fail).poly
    except InputError:
        return None


def _spelt(text: str, names: str) -> str:
    """The text with the signs of the products that are read in it behind a quantifier of these names."""
    made = products(f"ex {names}. {text}")
    return re.sub(WORD, lambda word: "*".join(word[0]) if word[0] in made else word[0], text)


def _quadratic(equation: str, name: str) -> list[str] | None:
    """That an equation is quadratic in a variable, as a condition: none where it surely is; None where it is not."""
    poly = _difference(_spelt(equation, name))
    if poly is None or name not in poly.ring.index or poly.degree(poly.ring.index[name]) != 2:
        return None
    lead = poly.leading(poly.ring.index[name])
    return [] if lead.is_constant else [str(atom(lead, Relation.NE))]


def _counted(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """``f has two positive roots in [0, 1]``; None for another text."""
    counted = _ROOTS.fullmatch(text)
    if counted is None:
        return None
    is_quadratic, is_system, whose, many, kinds, several, also, named, *place = counted.groups()
    whose, many = said[whose], many or ""
    if place[0] and re.fullmatch(LISTED, said[place[0]]):  # in x
        named, place = place[0], [None] * 5
    if is_system:
        names = [name for name in _names(whose) if name not in sought]
        exists = {"": "ex", "no": "not ex"}.get(many)
        is_plain = not (kinds or also or any(place))
        return f"{exists} {', '.join(names)}. {{{whose}}}" if exists and sought and names and is_plain else None
    solved = _equation(whose, sought, said[named] if named else None)
    if solved is None:
        return None
    equation, name = solved
    signs = [f"{name} {SIGNED[word]} 0" for word in re.findall(SIGN, f"{kinds} {also or ''}")]
    conditions = [condition for condition in (*signs, _place(said, name, place)) if condition]
    many = "both" if not many and several and conditions else many
    is_opposite, is_double = "opposite" in text, "double" in kinds
    if many == "no" and "distinct" in kinds:  # none, or one alone
        return None
    if many == "both" or is_opposite or is_double:
        if (quadratic := _quadratic(equation, name)) is None:
            return None
        if is_opposite:
            quadratic += [f"(ex {name}. {equation} and {name} {side} 0)" for side in "<>"]
        elif is_double:
            quadratic += [f"exactly one {name}. {equation}"]
        else:
            quadratic += [f"(ex {name}. {equation})"]
            quadratic += [f"all {name}. {equation} -> {' and '.join(conditions)}"] if conditions else []
        return " and ".join(quadratic)
    many = "at least two" if not many and "distinct" in kinds else many
    lead = _quadratic(equation, name) if is_quadratic else None
    counting = f"{_many(many)} {name}. {' and '.join((equation, *conditions))}"
    return f"{lead[0]} and ({counting})" if lead else counting


def _many(many: str) -> str:
    """The quantifier for words that say how many."""
    kind = {"": "ex", "no": "not ex", "only one": "exactly one"}.get(many)
    return kind or ("" if " " in many else "exactly ") + many


def _separated(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """``f has one root less than 2 and other greater than 2``; None for another text."""
    two = _SEPARATED.fullmatch(text)
    solved = _equation(said[two[1]], sought) if two else None
    if two is None or solved is None or (quadratic := _quadratic(*solved)) is None:
        return None
    equation, name = solved
    places = (_place(said, name, list(place)) for place in (two.groups()[1:6], two.groups()[6:]))
    return " and ".join([*quadratic, *(f"(ex {name}. {equation} and {place})" for place in places)])


def _meeting(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """``the line y = f meets the curve g in two points``; None for another text. The line is tangent where the equation
    for x has a double root."""
    text = re.sub(rf"^(?:do )?({F}) and ({F}) ((?:do not )?(?:meet|touch))\b", r"\1 \3 \2", text)
    meeting = _MEETING.fullmatch(text)
    if meeting is None or (meeting[2] and (meeting[5] or meeting[3] != "meet")):
        return None
    how, many = meeting[3], "no" if meeting[2] else meeting[5]
    first, second = said[meeting[1]], said[meeting[4]]
    for graph, other in ((first, second), (second, first)):
        y, _, value = (part.strip() for part in graph.partition("="))
        if re.fullmatch(r"[^\W\d_]\d*", y) and y not in _names(value) and "=" in other:
            left, _, right = other.partition("=")
            solved = _equation(f"({left}) - ({right}) + 0*({value})", (*sought, y))
            if solved is None:
                return None
            x = solved[1]
            if how != "meet":
                return None if many else _tangent(y, value, other, x)
            return f"{_many(many)} {x}. ex {y}. {first} and {second}" if many else f"ex {x}, {y}. {first} and {second}"
    is_plain = how == "meet" and many in (None, "no") and not {"x", "y"} & {*sought}
    if is_plain and {"x", "y"} <= {*_names(first)} & {*_names(second)} and all("=" in one for one in (first, second)):
        return f"{'not ' if many else ''}(ex x, y. {first} and {second})"
    return None


def _tangent(y: str, value: str, curve: str, x: str) -> str | None:
    value, _, curve = _spelt(f"{value} = {curve}", f"{x}, {y}").partition("=")
    equation = re.sub(rf"\b{y}\b", lambda _: f"({value})", curve)
    poly = _difference(equation)
    if poly is None or x not in poly.ring.index:
        return None
    return f"ex {x}. {equation} and {atom(poly.derivative(poly.ring.index[x]), Relation.EQ)}"


def _above(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """``the curve y = f lies above the curve y = g``; None for another text."""
    if (above := _ABOVE.fullmatch(text)) is None:
        return None
    (y, f), (z, g) = (said[above[k]].partition("=")[::2] for k in (1, 3))
    solved = _equation(f"({f}) - ({g})", (*sought, "y")) if y.strip() == z.strip() == "y" else None
    if solved is None or "y" in _names(f"{f} - {g}"):
        return None
    return f"all {solved[1]}. {f.strip()} {'>' if above[2] == 'above' else '<'} {g.strip()}"


def _place(said: Sentence, name: str, place: list[str | None]) -> str:
    """Where a root is, as a condition; empty without one."""
    interval, low, high, side, bound = (part and said[part] for part in place)
    if interval:
        return f"{name} in {interval}"
    if low:
        return f"{low} < {name} < {high}"
    return f"{name} {'<' if side == 'less' else '>'} {bound}" if side else ""


def _always(said: Sentence, text: str, sought: tuple[str, ...]) -> str | None:
    """``is f positive for all x``; None for another text."""
    always = _ALWAYS.fullmatch(text)
    if always is None or not (always[1] or always[4] or always[6]):
        return None
    term = said[always[2]]
    if re.search(r"[=<>≤≥≠∃∀]", term):
        return None
    claim = f"{term} {SIGNED[always[5]]} 0"
    if always[6]:
        return f"{said[always[6]]}: {claim}"
    solved = _equation(term, sought) if sought else None
    return None if sought and not solved else f"all {solved[1]}. {claim}" if solved else _closed(claim)


# --- optima -----------------------------------------------------------------------------------------------
def optimum_in_words(text: str) -> tuple[int, str, str] | None:
    """1 or -1 (0 without a word for it), the objective and the conditions of ``minimize f subject to c``, ``f, c``,
    ``given c, find the least value of f``; None for another text."""
    said = Sentence(_typed(text))
    goal = _OPTIMUM.fullmatch(said.words)
    if goal is None or not (goal[1] or goal[3]):
        objective, conditions = _at_comma(text)
        return _optimum(0, objective, conditions) if conditions else None
    objective, behind = _at_comma(said[goal[2]])
    under = [_premise(said, part) for part in (*said.where, *re.split(_SUBJECT, goal[3])) if part]
    sign = 0 if goal[1] is None else 1 if goal[1] in LEAST.split() else -1
    return _optimum(sign, objective, ", ".join(filter(None, (*under[::-1], behind))))


def _optimum(sign: int, objective: str, conditions: str) -> tuple[int, str, str]:
    """An optimum that is asked for; its conditions may be an interval for the only variable."""
    names = {*re.findall(WORD, objective)}.difference(FUNCTIONS)
    if _INTERVAL.fullmatch(conditions) and len(names) == 1:
        conditions = f"{names.pop()} in {conditions}"
    return sign, objective, conditions or "true"


def _at_comma(text: str) -> tuple[str, str]:
    """An objective and the conditions that follow it: ``x + 1/x, x > 0``."""
    first, *rest = split(text)
    is_pair = rest and _RELATED.search(", ".join(rest)) and not _RELATED.search(first)
    return (first, ", ".join(rest)) if is_pair else (text, "")


# --- other systems ----------------------------------------------------------------------------------------
def _called(command: str, inside: str, condition: str = "") -> Question:
    """``solve([f, g], [x, y])`` of SymPy and Maple, ``solve(f, g)`` and ``prove(f)`` of Z3, under a condition."""
    inside = re.sub(
        r"&([AE])\s*\[([\w\s,]*)\]\s*,",
        lambda q: f"{'all' if q[1] == 'A' else 'ex'} {q[2].replace(',', ' ')}.",
        inside,
    )
    given = [re.sub(r"^symbols?\s*=\s*", "", part) for part in split(inside) if not _DOMAIN.fullmatch(part)]
    within = _WITHIN.fullmatch(given[-1]) if len(given) > 2 else None
    given = given[:-1] if within else given
    names: list[str] = []
    while len(given) > 1 and _NAMES.fullmatch(given[-1]):
        listed = re.findall(LISTED, given.pop())
        names = [*(unquoted(name) if name[0] == "`" else name for name in listed), *names]
    formula = given[0] if len(given) == 1 else f"{{{', '.join(given)}}}"
    if within and len(names) == 1:
        left, right = "[" if within[1] in (None, "R") else "(", "]" if within[1] in (None, "L") else ")"
        related = _RELATED.search(formula) or re.match(r"(?:Eq|Ne|[GL][te]|And|Or)\(", formula)
        formula = f"{formula if related else f'{formula} = 0'} and {names[0]} in {left}{within[2]}, {within[3]}{right}"
    return Question(_closed(formula, condition) if command in _PROVED else formula, tuple(names))


def _typed(text: str) -> str:
    """The text without the LaTeX between dollars, if there are words around it: ``for which $a$ is $a^{2} \\ge 1$``."""
    text = re.sub(r"(?<!\\)\\[\[\]()]", "$", text) if re.search(r"[A-Za-z]{2}[^\\]*\\[\[(]", text) else text
    if "$" not in text or not re.search(r"[A-Za-z]", re.sub(r"\$[^$]*\$", "", text)):
        return text
    return re.sub(r"\$+([^$]*?)([\s.,;?]*)\$+", lambda inside: as_text(inside[1]) + inside[2], text)
