"""Questions in words, and commands of other systems, as formulas: ``for which m does x^2 = m have two solutions?`` is
``exactly two x. x^2 = m``, and ``let a, b be positive reals; prove that f`` is ``all a, b. a, b > 0 -> f``.

What is read is noted for the caller; a text that is not clear stays as it is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from qe.io.surface import FUNCTIONS
from qe.io.text_words import COUNTS, LISTED, NO_VARIABLES, QUANTITY, SIGNED, THERE
from qe.spelling import KEYWORDS, WORD

NO_NAMES = {*NO_VARIABLES, "for", "every", "any", "reals", "numbers", "such", "that", "with", "there", "is", "are"}
"""Words of sentences that are no variables."""

LONGEST = 1000
"""Longer texts are no questions in words."""

_LIST = rf"{LISTED}(?:\s*(?:,|and)\s*{LISTED})*"
_SHOW = r"(?:(?:prove|show|verify|check|decide|determine)\s+(?:that|whether|if)|is\s+it\s+true\s+that)"
_PROVE = r"(?:prove|show|verify)(?:\s+that)?"
_STOCK = (
    (r"(?:prove\s+or\s+disprove|true\s+or\s+false|prove|show|verify)\s*:\s*", "prove that "),
    (r"(?:(?:when\s+)?do(?:es)?|under\s+(?:what|which)\s+conditions?(?:\s+on\s+.+?)?\s+do(?:es)?)\s+", ""),
    (
        r"(?:find|determine|give)\s+(?:the\s+)?conditions?(?:\s+on\s+.+?)?\s+(?:(?:so|such)\s+that|(?:for|under)\s+which|for)\s+",
        "",
    ),
    (rf"if\s+(.+),\s*(?:find|determine)\s+({LISTED})", r"find \2 such that \1"),
    (r"(find\s+)(?:the\s+)?(?:set|range)\s+of\s+", r"\1"),
)
"""Beginnings of questions, and what is said for short."""
_ASKED = re.compile(
    rf"(?:({_SHOW}|(?:prove|show)(?::|(?=\s+[\w(|`√]))(?!\s+(?:in|and|or)\b))"
    rf"|solve(?:\s+for\s+({_LIST})\s*(?::|in\b)|\s+the\s+(?:in)?equalit(?:y|ies)|\s+the\s+equations?|:|"
    r"(?=\s+[\w(|`√])(?!\s+(?:in|and|or|for|the)\b))"
    r"|(?:for\s+(?:which|what)|(?:find|determine)(?:\s+(?:all|every|the|some))?)\s+(?:range\s+of\s+)?(?:real\s+)?"
    rf"(?:(?:values?\s+(?:of\s+)?|numbers?\s+))?(?!values?\b)({_LIST})\s*(?:(?:∈|in\b)\s*(?:ℝ|Reals|R\b)\s*)?"
    r"(?:(?:such|so)\s+that|for\s+which|satisfying|with|if|does|do|is|are))\s+",
    re.IGNORECASE,
)
"""Words in front of what is to be shown or solved, or of a condition on the variables that are sought."""
_GIVEN = re.compile(
    r"(?:let|if|suppose(?:\s+that)?|given(?:\s+that)?(?!\s+any\b)|assume(?:\s+that)?|for(?:\s+(?:all|any|every))?(?!\s+wh))\s+(.+?)"
    rf"(?:[.,;:]?\s+(?:then\s+)?{_PROVE}|,\s+is(?:\s+it\s+true\s+that)?)\s+(.+)",
    re.IGNORECASE | re.DOTALL,
)
_IF_THEN = re.compile(r"if\s+(.+?),?\s+then\s+(.+)", re.IGNORECASE | re.DOTALL)
_SIGN = rf"(?:{'|'.join(SIGNED)})"
_SORTED = re.compile(
    rf"({_LIST})\s+(?:be|are|is|denote)\s+(?:an?\s+|any\s+)?(?:real\s+)?({_SIGN})?\s*(?:reals?\b)?\s*(?:numbers?\b)?"
    rf"|({_SIGN})\s+(?:reals?\s+)?(?:numbers?\s+)?({_LIST})|reals?\s+(?:numbers?\s+)?({_LIST})"
)
"""Variables with what they are: ``a, b be positive real numbers``, ``positive reals a, b``."""
_TRIANGLE = re.compile(
    rf"({LISTED})\s*,\s*({LISTED})\s*(?:,\s*and|,|and)\s*({LISTED})\s+(?:be|are)\s+(?:the\s+)?(?:lengths\s+of\s+)?(?:the\s+)?"
    r"(?:side\s*lengths|sides|lengths\s+of\s+the\s+sides)\s+of\s+(?:a|some)\s+triangle"
)
_LEAN = re.compile(
    r"(?:theorem\s+\S+|lemma\s+\S+|example)\s*((?:[({][^(){}:]*:(?:[^(){}]|\([^()]*\))*[)}]\s*)*):(?!=)\s*(.+?)\s*(?::=.*)?",
    re.DOTALL,
)
_BINDER = re.compile(r"[({]([^(){}:]*):\s*((?:[^(){}]|\([^()]*\))*)[)}]")
_AND = re.compile(r"\s*,?\s*\b(?:(?:and\s+)?(?:with|such\s+that|satisfying|satisfy)|,\s*and)\b\s*")

_KINDS = rf"((?:(?:distinct|different|real|equal|double|repeated|{_SIGN}|and)\s+)*)"
_PLACE = (
    r"(?:(?:lying\s+|lie\s+)?(?:in|on|inside)\s+(?:the\s+(?:open\s+|closed\s+)?interval\s+)?([\[(][^\[\]()]+[\])])"
    r"|(?:lying\s+|lie\s+)?between\s+(\S+)\s+and\s+(\S+)"
    r"|(?:that\s+are\s+)?(greater|larger|bigger|less|smaller)\s+than\s+(\S+))"
)
_COUNTED = re.compile(
    r"(?:[Tt]he\s+)?(?:(?:quadratic|cubic)\s+)?(?:(?:equation|polynomial|(system)(?:\s+of\s+equations)?)\s+)?(.+?)"
    rf"\s+(?:has|have|to\s+have)\s+(an?\b|no\b|only\s+one|both|{QUANTITY}|{'|'.join(COUNTS)}|[2-6]|)\s*(?:its\s+)?"
    rf"{_KINDS}(?:roots?|solutions?|zeros?)(?:\s+(?:in|for)\s+({LISTED}))?(?:\s+(?:{_PLACE}|of\s+(opposite)\s+signs?))?",
    re.DOTALL,
)
_SEPARATED = re.compile(
    rf"(?:the\s+)?(?:equation\s+)?(.+?)\s+(?:has|have)\s+one\s+root\s+{_PLACE}\s+and\s+(?:the\s+other|one)(?:\s+root)?\s+{_PLACE}",
    re.DOTALL,
)
_ALWAYS = re.compile(
    rf"(?:is\s+)?(.+?)\s+(?:is\s+)?(?:always\s+)?({_SIGN})(?:\s+(for\s+(?:all|every|any)\b.*))?", re.DOTALL
)
_BOUND = re.compile(
    rf"(?:[∃∀]|\b(?:[Ff]or\s+(?:all|every|any|some)|{THERE}|ex|all|exists|forall|Ex|All|Exists|ForAll)\b)"
    rf"[\s(\[{{]*(?:(?:reals?|numbers?|an?|some|{_SIGN})\s+)*({_LIST})"
)
"""The variables of a quantifier."""
_CALL = re.compile(
    r"(?:\w+\.)?(n?solve\w*|reduce_\w+|prove|QuantifierElimination|SemiAlgebraic)\((.*)\)\s*[;:]?", re.DOTALL
)
_DOMAIN = re.compile(r"(?:domain\s*=\s*)?S?\.?Reals|real\b|\w+\s*=\s*(?:True|False|real)")
_NAMES = re.compile(rf"(?:{WORD}|[\[({{]\s*(?:{WORD}(?:\s*,\s*{WORD})*)?\s*[\])}}])")

_GOAL = re.compile(
    r"(?i)\s*(?:(?:find|what\s+is|determine)\s+)?(?:the\s+)?(?:(min|max)(?:imum|imi[sz]e|imal|(?=:?\s+[-\w|]))"
    r"(?:\s+(?:possible\s+)?value)?(?:\s+of)?|(least|smallest|lowest|greatest|largest|highest)\s+(?:possible\s+)?value\s+of):?\s+"
)
_FIRST = re.compile(
    r"(?is)\s*(?:given|if|let|suppose|for)\s+(?:that\s+)?(.+?)[,.;]?\s+(?:then\s+)?((?:find|what\s+is|determine|minimi[sz]e|maximi[sz]e)\s.+)"
)
"""What is given in front of an optimum that is asked for."""
_SUBJECT = re.compile(
    r"(?is)(.+?),?\s+(?:subject\s+to|s\.\s?t\.|such\s+that|given|where|when|for|with|over|on|if(?!.*\bthen\b)):?\s+(.+)"
)
_INTERVAL = re.compile(r"\s*[\[(][^()\[\]<>=≤≥]*,[^()\[\]<>=≤≥]*[\])]\s*")
_RELATED = re.compile(r"[<>=≤≥≠∈]")


@dataclass(frozen=True, slots=True)
class Question:
    """What a text asks, as a formula, the variables that are sought."""

    formula: str
    names: tuple[str, ...] = ()


def plainly(text: str) -> Question:
    """A question in words as a formula. Roots are counted as different values of x, or of the only variable that is not
    sought; what is to be proved holds for all values of its variables."""
    short = _typed(text.strip()) if len(text) < LONGEST else ""
    if not short:
        return Question(text)
    if (lean := _LEAN.fullmatch(short)) and (stated := _stated(lean[1], lean[2])):
        return Question(stated)
    if call := _CALL.fullmatch(short):
        return _called(call[1], call[2])
    short = short.rstrip(" ?.")
    for pattern, put in _STOCK:
        short = re.sub(rf"^{pattern}", put, short, flags=re.IGNORECASE)
    given = _GIVEN.fullmatch(short) or _IF_THEN.fullmatch(short)
    if given and (given.re is _GIVEN or premise(given[1]) != given[1]):
        return Question(_closed(_claim(given[2]), premise(given[1])))
    begins = _ASKED.match(short)
    rest, listed = (short[begins.end() :], begins[2] or begins[3] or "") if begins else (short, "")
    names = tuple(re.findall(rf"\b(?!and\b){LISTED}", listed))
    formula = _separated(rest, names) or _counted(rest, names) or _always(rest)
    if formula is None and begins:
        formula = re.sub(r"\s*\bholds?$", "", rest)
        formula = _closed(formula) if begins[1] else formula
    return Question(text) if formula is None else Question(formula, names)


def parts(text: str) -> list[str]:
    """What stands between the commas outside of brackets."""
    depth, listed = 0, [""]
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        listed[-1:] = [listed[-1], ""] if character == "," and not depth else [listed[-1] + character]
    return [part.strip() for part in listed]


# --- what is to be proved ---------------------------------------------------------------------------------
def _closed(claim: str, given: str = "") -> str:
    """A claim for all values of its variables that no quantifier of its own has."""
    whole = f"({given}) -> ({claim})" if given else claim
    bound = {name for match in _BOUND.finditer(whole) for name in re.findall(LISTED, match[1])}
    names = [name for name in _names(whole) if name not in bound]
    return f"all {', '.join(names)}. {whole}" if names else whole


def _claim(text: str) -> str:
    """What is claimed, with a quantifier behind it in front."""
    text = re.sub(r"^\s*(?:that|the inequality)\s+", "", text)
    return re.sub(r"(?s)^(.+?)\s+(for\s+(?:all|every|any)\b[^:]*)$", r"\2: \1", text)


def premise(text: str) -> str:
    """Conditions in words: ``x, y be positive reals with x + y = 1`` is ``x, y > 0 and x + y = 1``."""

    def sorted_names(match: re.Match[str]) -> str:
        listed, sign = match[1] or match[4] or match[5], match[2] or match[3]
        names = ", ".join(re.findall(rf"\b(?!and\b){LISTED}", listed))
        return f"{names} {SIGNED[sign]} 0 " if sign else ""

    text = _TRIANGLE.sub(r"\1, \2, \3 > 0 and \1 + \2 > \3 and \2 + \3 > \1 and \3 + \1 > \2", text)
    return re.sub(r"^\s*and\b|\band\s*$", "", _AND.sub(" and ", _SORTED.sub(sorted_names, text))).strip(" ,")


def _stated(binders: str, claim: str) -> str | None:
    """A theorem as Lean states it, ``(x y : ℝ) (h : x + y = 1) : x * y ≤ 1 / 4``; None for one about other types."""
    listed = [(binder[1].split(), binder[2].strip()) for binder in _BINDER.finditer(binders)]
    names = [name for words, kind in listed if kind in ("ℝ", "Real") for name in words]
    if any(re.fullmatch(WORD, kind) for _, kind in listed if kind not in ("ℝ", "Real")):
        return None
    premises = [f"({kind})" for _, kind in listed if kind not in ("ℝ", "Real")]
    whole = " -> ".join((*premises, f"({claim})"))
    for pattern, put in (
        (r"Real\.sqrt\s*\(", "sqrt("),
        (r"Real\.sqrt\s+(\w+)", r"sqrt(\1)"),
        (r"\((\S+)\s*:\s*ℝ\)", r"\1"),
    ):
        whole = re.sub(pattern, put, whole)
    return f"all {', '.join(names)}. {whole}" if names else whole


def _names(text: str) -> tuple[str, ...]:
    """The variables of a formula in text, in their order; letters side by side that are a product each by itself."""
    from qe.io.text_lexer import CALLS
    from qe.io.text_parser import products

    words = [word for word in re.findall(LISTED, text) if not {word} & {*KEYWORDS, *FUNCTIONS, *CALLS, *NO_NAMES}]
    made = products(text)
    return tuple(dict.fromkeys(name for word in words for name in (word if word in made else [word])))


# --- roots ------------------------------------------------------------------------------------------------
def _equation(text: str, sought: tuple[str, ...], named: str | None) -> tuple[str, str] | None:
    """An equation and the variable that it is to be solved for; None where that is not clear."""
    others = {*_names(text)}.difference(sought)
    has_x = any(other.endswith("x") for other in others if len(other) < 4)  # x, ax
    name = named or ("x" if has_x else others.pop() if len(others) == 1 else "")
    if not name or re.search(r"[<>≤≥≠∃∀]|\b(?:and|or|ex|all|for|if)\b", text):
        return None
    return (text if "=" in text else f"{text} = 0"), name


def _powers(equation: str, name: str) -> set[str]:
    """The exponents of the variable, as they stand there."""
    return {*re.findall(rf"{name}\s*(?:\^|\*\*)\s*\(?(\d+)", equation)}


def _counted(text: str, sought: tuple[str, ...]) -> str | None:
    """``f has two positive roots in [0, 1]``; None for another text."""
    counted = _COUNTED.fullmatch(text)
    if counted is None:
        return None
    is_system, whose, many, kinds, named, *place, opposite = counted.groups()
    if is_system:
        names = [name for name in _names(whose) if name not in sought]
        exists = {"": "ex", "a": "ex", "an": "ex", "no": "not ex"}.get(many)
        return f"{exists} {', '.join(names)}. {{{whose}}}" if exists and sought and names else None
    solved = _equation(whose, sought, named)
    if solved is None:
        return None
    equation, name = solved
    degrees = _powers(equation, name)
    if (many == "both" or opposite) and not degrees <= {"2"}:
        return None
    if opposite:
        return f"(ex {name}. {equation} and {name} < 0) and (ex {name}. {equation} and {name} > 0)"
    if re.search("equal|double|repeated", kinds):  # of a quadratic polynomial
        return f"exactly one {name}. {equation}" if degrees == {"2"} else None
    signs = [f"{name} {SIGNED[word]} 0" for word in re.findall(_SIGN, kinds)]
    conditions = [condition for condition in (*signs, _place(name, place)) if condition]
    if many == "both":
        every = f" and all {name}. {equation} -> {' and '.join(conditions)}" if conditions else ""
        return f"(ex {name}. {equation}){every}"
    many = "at least two" if not many and re.search("distinct|different", kinds) else many
    kind = {"": "ex", "a": "ex", "an": "ex", "no": "not ex", "only one": "exactly one"}.get(" ".join(many.split()))
    kind = kind or ("" if " " in many else "exactly ") + many
    return f"{kind} {name}. {' and '.join((equation, *conditions))}"


def _separated(text: str, sought: tuple[str, ...]) -> str | None:
    """``f has one root smaller than 2 and the other greater than 2``; None for another text."""
    two = _SEPARATED.fullmatch(text)
    solved = _equation(two[1], sought, None) if two else None
    if two is None or solved is None or not _powers(*solved) <= {"2"}:
        return None
    equation, name = solved
    places = _place(name, list(two.groups()[1:6])), _place(name, list(two.groups()[6:]))
    return " and ".join(f"(ex {name}. {equation} and {place})" for place in places)


def _place(name: str, place: list[str | None]) -> str:
    """Where a root is, as a condition; empty without one."""
    interval, low, high, side, bound = place
    if interval:
        return f"{name} in {interval}"
    if low:
        return f"{low} < {name} < {high}"
    return f"{name} {'<' if side in ('less', 'smaller') else '>'} {bound}" if side else ""


def _always(text: str) -> str | None:
    """``is f positive for all x``; None for another text."""
    always = _ALWAYS.fullmatch(text)
    if always is None or not (always[3] or re.match(r"is\b|.*\balways\b", text, re.DOTALL)):
        return None
    if re.search(r"[=<>≤≥≠∃∀]|\b(?:and|or|ex|all|for|if|is|are|there)\b", always[1]):
        return None
    claim = f"{always[1]} {SIGNED[always[2]]} 0"
    return f"{always[3]}: {claim}" if always[3] else _closed(claim)


# --- optima -----------------------------------------------------------------------------------------------
def optimum_in_words(text: str) -> tuple[int, str, str] | None:
    """1 or -1 (0 without a word for it), the objective and the conditions of ``minimize f subject to c``, ``f, c``,
    ``given c, find the least value of f``; None for another text."""
    text = text.rstrip(" ?.")
    if (given := _FIRST.fullmatch(text)) and (inner := optimum_in_words(given[2])):
        sign, objective, conditions = inner
        return sign, objective, ", ".join((premise(given[1]), *([conditions] * (conditions != "true"))))
    goal = _GOAL.match(text)
    said = _SUBJECT.fullmatch(text, goal.end() if goal else 0)
    whole = text[goal.end() :] if goal else text
    objective, conditions = (said[1], premise(said[2])) if said else _at_comma(whole)
    if not goal and objective == whole:
        return None
    names = {*re.findall(WORD, objective)}.difference(FUNCTIONS)
    if _INTERVAL.fullmatch(conditions) and len(names) == 1:
        conditions = f"{names.pop()} in {conditions}"
    word = (goal[1] or goal[2]).lower() if goal else ""
    sign = (word in ("min", "least", "smallest", "lowest")) - (word in ("max", "greatest", "largest", "highest"))
    return sign, objective, conditions


def _at_comma(text: str) -> tuple[str, str]:
    """An objective and the conditions that follow it: ``x + 1/x, x > 0``."""
    first, *rest = parts(text)
    is_pair = rest and _RELATED.search(", ".join(rest)) and not _RELATED.search(first)
    return (first, ", ".join(rest)) if is_pair else (text, "true")


# --- other systems ----------------------------------------------------------------------------------------
def _called(command: str, inside: str) -> Question:
    """``solve([f, g], [x, y])`` of SymPy and Maple, ``solve(f, g)`` and ``prove(f)`` of Z3."""
    given = [part for part in parts(inside) if not _DOMAIN.fullmatch(part)]
    names: list[str] = []
    while len(given) > 1 and _NAMES.fullmatch(given[-1]):
        names = [*re.findall(WORD, given.pop()), *names]
    formula = given[0] if len(given) == 1 else f"{{{', '.join(given)}}}"
    return Question(_closed(formula) if command == "prove" else formula, tuple(names))


def _typed(text: str) -> str:
    """The text without the LaTeX between dollars, if there are words around it: ``for which $a$ is $a^{2} \\ge 1$``."""
    if "$" not in text or not re.search(r"[A-Za-z]", re.sub(r"\$[^$]*\$", "", text)):
        return text
    from qe.io.latex_lexer import as_text

    return re.sub(r"\$+([^$]*)\$+", lambda inside: as_text(inside[1]), text)
