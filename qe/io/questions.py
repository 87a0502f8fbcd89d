"""Questions in words, and commands of other systems, as formulas: ``for which m does x^2 = m have two solutions?`` is
``exactly two x. x^2 = m``, and ``let a, b be positive reals; prove that f`` is ``all a, b. a, b > 0 -> f``.

What is read is noted for the caller; a text that is not clear stays as it is.
"""

from __future__ import annotations

import re
from itertools import combinations

from qe.errors import InputError
from qe.exact.ring import Poly
from qe.formula.build import atom
from qe.formula.relation import Relation
from qe.io.parser import TERM, parsed
from qe.io.scripts import last_command
from qe.io.surface import FUNCTIONS
from qe.io.text_errors import Failing
from qe.io.text_words import COUNTS, LISTED, NO_VARIABLES, QUANTITY, SIGNED, THERE, Question, split
from qe.spelling import KEYWORDS, WORD, unquoted

NO_NAMES = {*NO_VARIABLES, "for", "every", "any", "reals", "numbers", "such", "that", "with", "there", "is", "are"}
"""Words of sentences that are no variables."""

LONGEST = 1000
"""Longer texts are no questions in words."""

_LIST = rf"{LISTED}(?:\s*(?:,|and)\s*{LISTED})*"
_SHOW = r"(?:(?:prove|show|verify|check|decide|determine)\s+(?:that|whether|if)|is\s+it\s+true\s+that)"
_PROVE = r"(?:prove|show|verify)(?:\s+that)?"
_VALUES = (
    r"(?:(?:(?:two|all|exact|possible|real|the|set|range|values?|constants?|that|of)\s+)*(?:values?|range|constants?)\s+"
    r"(?:(?:of|for|that|the|constant)\s+)*)"
)
_SIGN = rf"(?:{'|'.join(SIGNED)})"
_STOCK = (
    (r"(?:prove\s+or\s+disprove|true\s+or\s+false|prove|show|verify)\s*:\s*", "prove that "),
    (r"(?:(?:when\s+)?do(?:es)?|under\s+(?:what|which)\s+conditions?(?:\s+on\s+.+?)?\s+do(?:es)?)\s+", ""),
    (
        r"(?:find|determine|give)\s+(?:the\s+)?conditions?(?:\s+on\s+.+?)?\s+(?:(?:so|such)\s+that|(?:for|under)\s+which|for)\s+",
        "",
    ),
    (
        rf"(?:(?:if|given|suppose)(?:\s+that)?\s+)?(?!find|determine|for\b)(.+?)[,.]?\s+(?:find|determine)\s+(?:the\s+)?{_VALUES}?"
        rf"({LISTED})(?:\s+(?:may|can)\s+(?:have|take))?$",
        r"find \2 such that \1",
    ),
    (rf"(?:(?:find|determine|what\s+(?:is|are))\s+)?(?:the\s+)?{_VALUES}(?={LISTED}\s+(?:for|such|so)\b)", "find "),
    (r"find\s+what\s+values", "for what values"),
    (r"(?:solve\s+)?the\s+system(?:\s+of\s+equations)?:?\s+(?!.*\b(?:has|have)\b)(?=.*=)", "solve: "),
    (
        rf"find\s+({LISTED})\s+for\s+(?!which\b|what\b|all\b|every\b|any\b)(.+?)\s+with\s+(?=.*(?:root|solution))",
        r"find \1 such that \2 has ",
    ),
    (rf"solve\s+(.+)\s+for\s+({_LIST})$", r"solve for \2: \1"),
    (
        r"((?:prove|show)\s+that\s+)for\s+(?!all\b|any\b|every\b|some\b)(.+?),?\s+(?:we\s+have|it\s+holds(?:\s+that)?)\s+",
        r"\1if \2 then ",
    ),
    (r"(.*?)both\s+(?:the\s+)?roots\s+of\s+(.+?)\s+are\s+(.+)$", r"\1\2 has both roots that are \3"),
    (r"(.*?)\s+has\s+(?:all\s+(?:its\s+)?roots\s+real|only\s+real\s+roots)$", r"\1 has both roots"),
    (rf"({_LIST}\s+are\s+[^,]+),\s+({_PROVE}\s)", r"let \1. \2"),
    (rf"({_PROVE}.*?)(?:,?\s+where|\.\s+(?:note:|here))\s+({_LIST}\s+(?:are|is)\s+.+)$", r"let \2. \1"),
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
_DISTINCT = r"(?:unequal|distinct|different)"
_SORTED = re.compile(
    rf"({_LIST})\s+(?:be|are|is|denote)\s+(?:an?\s+|any\s+)?(?:real\s+)?({_DISTINCT}\s+)?({_SIGN})?\s*(?:reals?\b)?\s*(?:(?:numbers?|quantities)\b)?"
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

_NOT_REAL = re.compile(
    r"(?i)\b(?:positive|negative|all|any|some|are|be|an|for|the|distinct|of)\s+(integers?|natural\s+numbers?|rationals?)\b"
)
_UNNAMED = re.compile(r"\bfor\s+(?:all|every)\s+(?:real\s+)?values?$")
_KINDS = rf"((?:(?:distinct|different|real|equal|double|repeated|{_SIGN}|and)\s+)*)"
_PLACE = (
    r"(?:(?:that\s+are|lying|lie)\s+)?"
    r"(?:(?:in|on|inside)\s+(?:the\s+(?:open\s+|closed\s+)?interval\s+)?([\[(][^\[\]()]+[\])])"
    r"|between\s+(\S+)\s+and\s+(\S+)|(greater|larger|bigger|less|smaller)\s+than\s+(\S+))"
)
_COUNTED = re.compile(
    r"(?:[Tt]he\s+)?(?:(?:quadratic|cubic)\s+)?(?:(?:equation|polynomial|function|(system)(?:\s+of\s+equations)?)\s+)?(?:f\s*\(\w\)\s*=)?(.+?)"
    rf"\s+(?:has|have|to\s+have)\s+(an?\b|no\b|only\s+one|both|{QUANTITY}|{'|'.join(COUNTS)}|[2-6]|)\s*(?:its\s+)?"
    rf"{_KINDS}(?:root|solution|zero)(s?)(?:\s+(?:which|that)\s+are\s+((?:real|and|{_SIGN}|\s)+))?(?:\s+(?:in|for)\s+({LISTED}))?"
    rf"(?:\s+(?:{_PLACE}|of\s+(opposite)\s+signs?))?",
    re.DOTALL,
)
_SEPARATED = re.compile(
    rf"(?:the\s+)?(?:equation\s+)?(.+?)\s+(?:has|have)\s+one\s+root\s+{_PLACE}\s+and\s+(?:the\s+other|one)(?:\s+root)?\s+{_PLACE}",
    re.DOTALL,
)
_SOLVABLE = re.compile(
    r"(?=.*\bboth\b)(?:the\s+)?(?:equations\s+)?(.+=.+?)\s+and\s+(.+=.+?)\s+(?:are\s+)?both\s+(?:solvable|have\s+(?:a\s+)?(?:real\s+)?(?:solution|root)s?)"
)
_CURVE = (
    r"(?:an?\s+|the\s+)?(?:straight\s+)?(?:(?:line|curve|circle|parabola|ellipse|hyperbola|graph)\s+)?"
    r"(?:of\s+|with\s+equation\s+)?"
)
_MEETING = re.compile(
    rf"(?=.*\b(?:meet|intersect|cut|touch|tangent))(?:is\s+)?{_CURVE}(.+?=.+?)\s+(?:is\s+)?(?:an?\s+(?=tangent))?(meets?|intersects?|cuts?|touch(?:es)?|tangent\s+to)\s+{_CURVE}(.+?=.+?)"
    rf"(?:\s+(?:at|in)\s+(no|only\s+one|{QUANTITY}|{'|'.join(COUNTS)})(?:\s+(?:distinct|different|real))*\s+points?)?"
)
_ALWAYS = re.compile(
    rf"(?:is\s+)?(?:the\s+(?:expression|function|quantity|polynomial)\s+)?(.+?)\s+(?:(?:is|be|will\s+be)\s+)?(?:always\s+)?({_SIGN})(?:\s+(for\s+(?:all|every|any)\b.*))?",
    re.DOTALL,
)
_BOUND = re.compile(
    rf"(?:[∃∀]|\b(?:[Ff]or\s+(?:all|every|any|some)|{THERE}|ex|all|exists|forall|Ex|All|Exists|ForAll)\b)"
    rf"[\s(\[{{]*(?:(?:reals?|numbers?|an?|some|{_SIGN})\s+)*({_LIST})"
)
"""The variables of a quantifier."""
_CALL = re.compile(
    r"(?:\w+(?:\.|:-))*(?:SolveTools\[)?((?:n|f|lin|nonlin)?solve\w*|reduce_\w+|prove|bool|qepcad|QuantifierElimination|SemiAlgebraic"
    r"|(?<=:-)simplify)\]?\((.*)\)\s*[;:]?",
    re.DOTALL,
)
_ASSUMES = re.compile(r"\s*(Assuming|(?:Full)?Simplify|Refine)\[(.*)\]\s*", re.DOTALL)
_WITHIN = re.compile(r"(?:domain\s*=\s*)?Interval(?:\.([LR]?)open)?\(\s*([^,()]+),\s*([^,()]+)\)")
"""An interval of SymPy."""
_DOMAIN = re.compile(r"(?:domain\s*=\s*)?S?\.?Reals|real\b|\w+\s*=\s*(?:True|False|real|Q\.real\(\w+\)|'[^']*')")
_NAMES = re.compile(rf"(?:{LISTED}|[\[({{]\s*(?:{LISTED}(?:\s*,\s*{LISTED})*)?\s*[\])}}])")

_GOAL = re.compile(
    r"(?i)\s*(?:(?:find|what\s+is|determine)\s+)?(?:the\s+)?(?:(min|max)(?:imum|imi[sz]e|imal|(?=:?\s+[-\w|]))"
    r"(?:\s+(?:possible\s+)?value)?(?:\s+of)?|(least|smallest|lowest|greatest|largest|highest)\s+(?:possible\s+)?value\s+of):?\s+(?:f\s*\([\w\s,]*\)\s*=\s*)?"
)
_EXTREME = re.compile(
    rf"(?i)\s*(?:find|determine)\s+(?:the\s+)?(?:numbers?\s+)?{_LIST}\s+(?:satisfying\s+(?:the\s+equation\s+)?(?P<given>.+?)\s+)?"
    r"(?:such|so)\s+that\s+(?P<goal>.+?)\s+is\s+(?:an?\s+|as\s+)?(?:(?P<max>max|large)|min|small)(?:imum|imal|imi[sz]ed)?"
    r"(?:\s+as\s+possible)?(?P<rest>\s.+)?"
)
"""Variables that are sought where something is greatest or least."""
_FIRST = re.compile(
    r"(?is)\s*(?:given|if|let|suppose|for)\s+(?:that\s+)?(.+?)[,.;]?\s+(?:then\s+)?((?:find|what\s+is|determine|minimi[sz]e|maximi[sz]e)\s.+)"
)
"""What is given in front of an optimum that is asked for."""
_SUBJECT = re.compile(
    r"(?is)(.+?),?\s+(?:subject\s+to(?:\s+the\s+(?:constraints?|conditions?))?(?:\s+that)?|s\.\s?t\.|such\s+that|given|where|when|for|with|over|on|if(?!.*\bthen\b)):?\s+(.+)"
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
    short = short.rstrip(" ?.")
    for pattern, put in _STOCK:
        short = re.sub(rf"^{pattern}", put, short, flags=re.IGNORECASE)
    given = _GIVEN.fullmatch(short) or _IF_THEN.fullmatch(short)
    if given and (given.re is _GIVEN or premise(given[1]) != given[1]):
        return Question(_closed(_claim(given[2]), premise(given[1])))
    begins = _ASKED.match(short)
    rest, listed = (short[begins.end() :], begins[2] or begins[3] or "") if begins else (short, "")
    names = tuple(re.findall(rf"\b(?!and\b){LISTED}", listed))
    for name in names:
        rest = re.sub(rf"(?<!\w)({re.escape(name)})\(", r"\1*(", rest)
    if unnamed := _UNNAMED.search(rest):
        others = {*_names(rest[: unnamed.start()])}.difference(names)
        if len(others) != 1:
            raise InputError(f"{unnamed[0]}: the name of a variable expected behind it, as in for all real values of x")
        rest = f"{rest} of {others.pop()}"
    formula = _separated(rest, names) or _counted(rest, names) or _solvable(rest, names) or _meeting(rest, names)
    formula = formula or _always(rest)
    if formula is None and _TRIANGLE.match(rest):
        formula = premise(rest)
    if formula is None and begins:
        formula = re.sub(r"\s*\bholds?$", "", rest)
        formula = _closed(_claim(formula)) if begins[1] else formula
    return Question(text) if formula is None else Question(formula, names)


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
    text = re.sub(rf"\bfor\s+(?=(?:{_SIGN}|reals?)\s)", "for all ", text)
    return re.sub(r"(?s)^(.+?)\s+(for\s+(?:all|every|any)\b[^:]*)$", r"\2: \1", text)


def premise(text: str) -> str:
    """Conditions in words: ``x, y be positive reals with x + y = 1`` is ``x, y > 0 and x + y = 1``."""

    def sorted_names(match: re.Match[str]) -> str:
        listed, sign = match[1] or match[5] or match[6], match[3] or match[4]
        names = re.findall(rf"\b(?!and\b){LISTED}", listed)
        said = [f"{', '.join(names)} {SIGNED[sign]} 0 "] if sign else []
        return " and ".join([*said, *(f"{a} /= {b} " for a, b in combinations(names, 2) if match[2])])

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
    whole = re.sub(r"Real\.sqrt\s+(\w+)", r"sqrt(\1)", whole).replace("Real.sqrt", "sqrt")
    whole = re.sub(r"\((\S+)\s*:\s*ℝ\)", r"\1", whole)
    return f"all {', '.join(names)}. {whole}" if names else whole


def _names(text: str) -> tuple[str, ...]:
    """The variables of a formula in text, in their order; letters side by side that are a product each by itself."""
    from qe.io.text_lexer import CALLS
    from qe.io.text_parser import products

    words = [word for word in re.findall(LISTED, text) if not {word} & {*KEYWORDS, *FUNCTIONS, *CALLS, *NO_NAMES}]
    made = products(text)
    return tuple(dict.fromkeys(name for word in words for name in (word if word in made else [word])))


# --- roots ------------------------------------------------------------------------------------------------
def _equation(text: str, sought: tuple[str, ...], named: str | None = None) -> tuple[str, str] | None:
    """An equation and the variable that it is to be solved for; None where that is not clear."""
    whole = {*_names(text)}
    others = whole.difference(sought)
    has_x = any(other.endswith("x") for other in others if len(other) < 4)  # x, ax
    name = named or ("x" if has_x else others.pop() if len(others) == 1 else "")
    powers = tuple(f"{one}{power}" for one in (name, *sought) for power in "23")  # mx2 for m*x^2
    if name and (meant := {other for other in whole if other.swapcase() in (name, *sought) or other.endswith(powers)}):
        raise InputError(f"{', '.join(sorted(meant))}: a power is written x^2, and small letters are not capitals")
    if not name or re.search(r"[<>≤≥≠∃∀]|\b(?:and|or|ex|all|for|if)\b", text):
        return None
    return (text if "=" in text else f"{text} = 0"), name


def _difference(equation: str) -> Poly | None:
    """The polynomial that an equation says is zero; None where it has none."""
    from qe.io.lowering import lower_term
    from qe.io.text_parser import TextParser

    left, _, right = equation.partition("=")
    fail = Failing(f"({left}) - ({right})", "<text>")
    try:
        return lower_term(parsed(TextParser, fail.text, fail, TERM), fail).poly
    except InputError:
        return None


def _spelt(text: str, names: str) -> str:
    """The text with the signs of the products that are read in it behind a quantifier of these names."""
    from qe.io.text_parser import products

    made = products(f"ex {names}. {text}")
    return re.sub(WORD, lambda word: "*".join(word[0]) if word[0] in made else word[0], text)


def _quadratic(equation: str, name: str) -> list[str] | None:
    """That an equation is quadratic in a variable, as a condition: none where it surely is; None where it is not."""
    poly = _difference(_spelt(equation, name))
    if poly is None or name not in poly.ring.index or poly.degree(poly.ring.index[name]) != 2:
        return None
    lead = poly.leading(poly.ring.index[name])
    return [] if lead.is_constant else [str(atom(lead, Relation.NE))]


def _counted(text: str, sought: tuple[str, ...]) -> str | None:
    """``f has two positive roots in [0, 1]``; None for another text."""
    counted = _COUNTED.fullmatch(text)
    if counted is None or re.search(r"\bno\s+(?:real\s+)?(?:distinct|different)", text):  # none, or one alone
        return None
    is_system, whose, many, kinds, several, also, named, *place, opposite = counted.groups()
    if is_system:
        names = [name for name in _names(whose) if name not in sought]
        exists = {"": "ex", "a": "ex", "an": "ex", "no": "not ex"}.get(many)
        return f"{exists} {', '.join(names)}. {{{whose}}}" if exists and sought and names else None
    solved = _equation(whose, sought, named)
    if solved is None:
        return None
    equation, name = solved
    signs = [f"{name} {SIGNED[word]} 0" for word in re.findall(_SIGN, f"{kinds} {also or ''}")]
    conditions = [condition for condition in (*signs, _place(name, place)) if condition]
    many = "both" if not many and several and conditions else many
    is_double = re.search("equal|double|repeated", kinds)
    if many == "both" or opposite or is_double:
        if (said := _quadratic(equation, name)) is None:
            return None
        if opposite:
            said += [f"(ex {name}. {equation} and {name} {side} 0)" for side in "<>"]
        elif is_double:
            said += [f"exactly one {name}. {equation}"]
        else:
            said += [f"(ex {name}. {equation})"]
            said += [f"all {name}. {equation} -> {' and '.join(conditions)}"] if conditions else []
        return " and ".join(said)
    many = "at least two" if not many and re.search("distinct|different", kinds) else many
    lead = _quadratic(equation, name) if re.match(r"(?:[Tt]he\s+)?quadratic\b", text) else None
    counting = f"{_many(many)} {name}. {' and '.join((equation, *conditions))}"
    return f"{lead[0]} and ({counting})" if lead else counting


def _many(said: str) -> str:
    """The quantifier for words that say how many."""
    said = " ".join(said.split())
    kind = {"": "ex", "a": "ex", "an": "ex", "no": "not ex", "only one": "exactly one"}.get(said)
    return kind or ("" if " " in said else "exactly ") + said


def _separated(text: str, sought: tuple[str, ...]) -> str | None:
    """``f has one root smaller than 2 and the other greater than 2``; None for another text."""
    two = _SEPARATED.fullmatch(text)
    solved = _equation(two[1], sought) if two else None
    if two is None or solved is None or (said := _quadratic(*solved)) is None:
        return None
    equation, name = solved
    places = (_place(name, list(place)) for place in (two.groups()[1:6], two.groups()[6:]))
    return " and ".join([*said, *(f"(ex {name}. {equation} and {place})" for place in places)])


def _solvable(text: str, sought: tuple[str, ...]) -> str | None:
    """``f and g are both solvable``; None for another text."""
    both = _SOLVABLE.fullmatch(text)
    solved = [_equation(one, sought) for one in both.groups()] if both else []
    listed = [f"(ex {one[1]}. {one[0]})" for one in solved if one]
    return " and ".join(listed) if len(listed) == 2 else None


def _meeting(text: str, sought: tuple[str, ...]) -> str | None:
    """``the line y = f meets the curve g in two points``; None for another text. The line is tangent where the equation
    for x has a double root."""
    meeting = _MEETING.fullmatch(re.sub(r"^(.*=.*)\s+and\s+(.*=.*)\s+(meet|touch|intersect)\b", r"\1 \3s \2", text))
    if meeting is None:
        return None
    first, how, second, many = meeting.groups()
    for graph, other in ((first, second), (second, first)):
        y, _, value = (part.strip() for part in graph.partition("="))
        if re.fullmatch(WORD, y) and y not in _names(value):
            left, _, right = other.partition("=")
            solved = _equation(f"({left}) - ({right}) + 0*({value})", (*sought, y))
            if solved is None:
                return None
            x = solved[1]
            if how.startswith(("touch", "tangent")):
                return None if many else _tangent(y, value, other, x)
            return f"{_many(many)} {x}. ex {y}. {first} and {second}" if many else f"ex {x}, {y}. {first} and {second}"
    return None


def _tangent(y: str, value: str, curve: str, x: str) -> str | None:
    value, _, curve = _spelt(f"{value} = {curve}", f"{x}, {y}").partition("=")
    equation = re.sub(rf"\b{y}\b", lambda _: f"({value})", curve)
    poly = _difference(equation)
    if poly is None or x not in poly.ring.index:
        return None
    return f"ex {x}. {equation} and {atom(poly.derivative(poly.ring.index[x]), Relation.EQ)}"


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
    text = re.sub(r"(?i)\bthe\s+product\s+of\s+(\w+)\s+and\s+(\w+)", r"\1 * \2", _typed(text).rstrip(" ?."))
    text = re.sub(r"(?i)\bthe\s+sum\s+of\s+(\w+)\s+and\s+(\w+)", r"\1 + \2", text)
    if extreme := _EXTREME.fullmatch(text):
        wanted = f"{'maximum' if extreme['max'] else 'minimum'} of {extreme['goal']}{extreme['rest'] or ''}"
        text = wanted + (f" subject to {extreme['given']}" if extreme["given"] else "")
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
    first, *rest = split(text)
    is_pair = rest and _RELATED.search(", ".join(rest)) and not _RELATED.search(first)
    return (first, ", ".join(rest)) if is_pair else (text, "true")


# --- other systems ----------------------------------------------------------------------------------------
def _called(command: str, inside: str) -> Question:
    """``solve([f, g], [x, y])`` of SymPy and Maple, ``solve(f, g)`` and ``prove(f)`` of Z3."""
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
    return Question(_closed(formula) if command in ("prove", "bool") else formula, tuple(names))


def _typed(text: str) -> str:
    """The text without the LaTeX between dollars, if there are words around it: ``for which $a$ is $a^{2} \\ge 1$``."""
    text = re.sub(r"(?<!\\)\\[()]", "$", text) if re.search(r"[A-Za-z]{3}[^\\]*\\\(", text) else text
    if "$" not in text or not re.search(r"[A-Za-z]", re.sub(r"\$[^$]*\$", "", text)):
        return text
    from qe.io.latex_lexer import as_text

    return re.sub(r"\$+([^$]*)\$+", lambda inside: as_text(inside[1]), text)
