"""Sentences: words of a small vocabulary with formulas between them, said for short in a few forms.

A word that is not in the vocabulary belongs to a formula, which cannot be read then.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from qe.io.latex_lexer import LETTERS, as_text, is_latex
from qe.io.surface import FUNCTIONS
from qe.io.text_words import COUNTS, LISTED, QUANTITY, SIGNED
from qe.io.tokens import kinds
from qe.spelling import QUOTED, is_product, unquoted

LEAST = "minimum minimize minimise minimal minimized minimised min least smallest lowest small"
GREATEST = "maximum maximize maximise maximal maximized maximised max greatest largest highest large"
_NOUNS = (
    "equation equations polynomial function expression quantity inequality inequalities cubic line curve circle"
    " parabola ellipse hyperbola graph"
)
VOCABULARY = kinds("""
find find determine calculate compute
prove prove show verify
has has have having
root root solution zero
roots roots zeros zeroes solutions
meet meet meets intersect intersects cut cuts cross crosses
touch touch touches
give give gives make makes
points point points
greater greater larger bigger
less less smaller
lie lie lies lying
in in inside
distinct distinct different unequal
double double equal repeated
numbers number numbers reals quantity quantities
positive positives
constant constant constants
be be been
such such so
satisfy satisfy satisfies satisfying
condition condition conditions constraint constraints
sides sides sidelengths
signs sign signs
values value values
exists exist exists
holds hold holds
, the an its real also following your
""")
"""Words that several say, or the comma for those that say nothing: all variables are real."""
SHORT = (
    "and or not for all any if let are it of on at to is as by be do in has two one no we min max every such that with"
    " there"
)
"""Words of sentences that are short, or may stand in formulas."""
BEST = rf"(?:{'|'.join(f'{LEAST} {GREATEST}'.split())})"
_DESCRIBED = "|".join((*SIGNED, *f"{_NOUNS} {LEAST} {GREATEST}".split()))
_PIECE = re.compile(
    r"(?P<ARTICLE>[aA](?=\s+(?:real|roots?|solutions?|zero|double|repeated|tangent|constant|straight|triangle|quadratic|non"
    rf"|unique|{_DESCRIBED})\b))|(?P<WORD>(?<![\\\w])[^\W\d_]{{2,}}(?![\w(\[^_']))|{QUOTED}|\w+|\s+|.",
    re.DOTALL,
)
_NUMERALS = {number: word for word, number in COUNTS.items()}
_TYPED: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\b([Nn])on[-\s]+(?=negative|zero|positive)", r"\1on"),
    (r"\bs\.\s?t\.", "such that"),
    (r"\+ve\b", "positive"),
    (r",\s*a(?=\s+tangent\s+to\b)", ""),
    (r"\bx\s*-\s*axis\b", "y = 0"),
    (r"(?i)\bprove\s*/\s*disprove\b", "prove"),
    (r",?\s*\(\s*\w+\s*(?:∈|\bin\b)\s*(?:R|ℝ)\s*\)", ""),
    (r"[^\S\n]{2,}\(\d\)[^\S\n]*$", ""),  # the number of an equation
    (r"\b([1-6])(?=\s+(?:real|distinct|different|roots?|solutions?|points?)\b)", lambda count: _NUMERALS[count[1]]),
)
"""What is typed in several ways, before the words are looked at."""
F = r"§\d+"
"""A formula between the words. What follows are parts of sentences."""
SIGN = rf"(?:{'|'.join(SIGNED)})"
COUNT = rf"{QUANTITY}|{'|'.join(COUNTS)}|no|only one|both"
KINDS = rf"((?:(?:distinct|double|and|{SIGN}) )*)"
PLACE = (
    rf"(?:that )?(?:lie )?(?:in (?:(?:open|closed) )?(?:interval )?({F})|(?:in )?between ({F}) and ({F})"
    rf"|(greater|less) than ({F}))"
)
_VALUES = r"(?:(?:all|set|range|possible|exact|two|distinct|values|constant|numbers|of|that|for|on|which|condition) )*"
THINGS = rf"(?:straight )?(?:{'|'.join(_NOUNS.split())}|constant|condition)(?: of)? :?"
_FOUND = rf"(?:quadratic )?{F}"
_NOUN = rf"(?:straight )?(?P<noun>{_NOUNS.replace(' ', '|')})"
_GIVEN = r"(?:(?:it is )?given(?: (?:also |instead )?that)?|let|consider|suppose(?: that)?|if|for)"
_DEFINED = (
    rf"(?:{_GIVEN} )?equation of {_NOUN}(?: (?P<name>{F}))? is (?P<means>{F})",
    rf"(?:{_GIVEN} )?{_NOUN}(?: (?P<name>{F}))? has equation (?P<means>{F})",
    rf"{_GIVEN} (?P<means>{F}) be (?P<lead>quadratic )?{_NOUN}",
    rf"{_GIVEN} (?P<lead>quadratic )?{_NOUN} (?P<means>{F})",
)
"""Sentences that say what a curve, an equation or a name is, which is meant by them in what follows."""
_NAMED = re.compile(rf"{_NOUN}(?: (?P<name>{F}))? with equation(?: (?P<means>{F}))")
_MEANT = re.compile(
    rf"\b(?:(?:given|this|same) )?(?P<lead>quadratic )?{_NOUN}(?: below| above)?(?! {F}| of| :| with| be)\b"
    rf"|\bit(?= has| meet| touch| lie| is always)|(?:(?<=such that )|(?<=for which ))(?=(?:{COUNT}) roots?\b)"
    rf"|(?:{_NOUN.replace('noun', 'called')} )?(?P<name>{F})"
)
_FUNCTION = re.compile(r"([fgFP])\s*\(\s*(\w(?:\s*,\s*\w)*)\s*\)\s*=(.*)", re.DOTALL)
_WHERE = re.compile(
    rf" ?[.,]? (?:where|with|note :?|here) ({F} (?:is|are)(?: (?:{SIGN}|distinct|constant|numbers))+)(?: ,)?"
)
_CONDITION = rf"\b(?:{SIGN}|not|no|all|any|every|assume|suppose|such|that|distinct|if|when|triangle)\b"
_LEAD = rf"(?:in ,|(?:by|using|hence|thus|therefore|please)\b)(?:(?!{_CONDITION})[^§.])*?"
"""Words in front of a question that say how, not what."""
_RULES = (
    (rf"^{_LEAD},? ?(?=(?:find|prove|solve|for (?:what|which))\b)", ""),
    (r"^(?:true or false|prove or disprove) :", "prove"),
    (r"\b(?:may|must|will|can) be\b|\bbe always\b", "is"),
    (r" [.,] giving answers? in .*? form| to §\d+ decimal places", ""),
    (rf"\b{THINGS} ?(?={F})", ""),
    (rf"({F}) , (?=has\b)", r"\1 "),
    (rf" ?,? (?:if|when|then) values? of ({F}) (?:is|are)$", r" find \1"),
    (r"^find what values", "for what values"),
    (rf"^(?:for|at) (?:which|what) {_VALUES}({F}) ,? ?(?:(?:does|do|is|are|will|can)\b)?", r"find \1 such that "),
    (rf"^find condition (?:on {F} )?(?:(?:so|such) that|for|(?:for|under) which) ", ""),
    (r"^(?:(?:when )?does|when do|under (?:what|which) condition(?: on §\d+)? (?:does|do)) ", ""),
    (rf"\bfind condition (?:that is satisfied by|on) ({F})", r"find \1"),
    (rf" (?:that|which) give (?={_FOUND} (?:{COUNT}) )", " for which give "),
    (rf"\bgive ({_FOUND}) (?={COUNT})", r"\1 has "),
    (rf",? ?(?:where|if) {F} (?:is|are)$|^to (?={BEST})", ""),
    (rf"^(find {_VALUES}{F}) , (?=such that|for which)", r"\1 "),
    (r"\bmeet or (?:meet|touch)\b", "meet"),
    (r"\bgiven (?:also|instead) that\b", "given that"),
    (r"(?<=[.,] )(?:hence|thus|therefore)(?: or otherwise)? ,? ?(?=(?:find|prove)\b)", ""),
    (
        rf"({_FOUND}) has one ({SIGN}) root and (?:one|other|another) ({SIGN})(?: root)?",
        r"\1 has one \2 root and \1 has one \3 root",
    ),
    (rf"(?<!all )\broots? of ({_FOUND}) are(?= for\b| [.,]|$)", r"\1 has both roots"),
    (rf"\bthen ({BEST} (?:possible )?(?:values )?of .+?) is$", r"find \1"),
    (r"\b(?:so that|in order that|(?<=\d )for which|satisfy)\b", "such that"),
    (rf"^(?:find )?{_VALUES}({F}) such that (.+) (?:is|are) ?:?$", r"find \1 such that \2"),
    (rf"^(?:(?:what is|find) |(?=range|set|values)){_VALUES}(?={F} (?:such that|for|if|with|does|is)\b)", "find "),
    (rf"\b(?:find|what) {_VALUES}({F})(?: (?:can|may|are) (?:possible|take|has))?(?= [.]?$|$)", r"find \1"),
    (rf"^find ({F}) for ({F}) with (?=.*root)", r"find \1 such that \2 has "),
    (
        rf"^(?:(?:if|given|suppose)(?: that)? )?(?!find|for\b)(.+?) ?[.,]? (?:then )?find ({F})$",
        r"find \2 such that \1",
    ),
    (
        rf"^(?:for )?({_FOUND}) [.,] find {_VALUES}({F}) such that (?:it |{THINGS})?(?=is|has)",
        r"find \2 such that \1 ",
    ),
    (rf"(?:({COUNT}) )?(?:of )?\b(roots?) of ({_FOUND}) (?:is|are|(?=lie))", r"\3 has \1 \2 that are "),
    ("that are +(?=lie|in|between|greater|less)", "that "),
    (r" has (?:(?:all|both) roots|only roots|all its roots)(?: real)?$", " has both roots"),
    (r"\bholds?$|\b(?:is|are) (?:valid|true)(?= for\b)", ""),
    (rf"(?:(?:is|are) )?({F}) and ({F}) (?:are )?both (?:solvable|has roots?)", r"\1 has root and \2 has root"),
    (rf"^(?:solve )?system(?: of)? :? ?({F})$", r"solve : \1"),
    (rf"^(?:solve )({F}) for ({F})$", r"solve for \2 : \1"),
    (rf"^({F} are [^,.:]+) , (?=prove )", r"let \1 . "),
    (
        rf"^find (?:numbers )?{F} (?:such that ({F}) )?such that ({F}) is (?:as )?({BEST})(?: as possible)?",
        r"\3 of \2 under \1",
    ),
    (r" under (?=subject)| under $", " "),
    (
        rf"^(?:(?:given|if|let|suppose|for|know)(?: that)? )?(.+?) ?[.,]? (?:then )?((?:find|what is) {BEST}.*)$",
        r"\2 under \1",
    ),
    (r"^prove (?:that )?for (?!all|any|every|some)(.+?) ,? ?(?:we has|it holds)(?: that)? ", r"prove if \1 then "),
)
"""What is said for short in place of what people say, in this order."""


LIST = re.compile(rf"{LISTED}(?:\s*,\s*{LISTED})*")
_OF_TWO = re.compile(rf"\b(product|sum) of ({F})")
_OPERATOR = re.compile(r"[-+*/^=<>(,]\s*$")


class Sentence:
    """The words of a text, §0, §1, … where its formulas stand."""

    def __init__(self, text: str) -> None:
        self.formulas: list[str] = []
        self.where: list[str] = []
        self.functions: dict[str, tuple[str, str, str]] = {}
        self.is_applied = False
        self.letters = {*re.findall(r"(?<![^\W\d_])[^\W\d_](?![^\W\d_])", text)}
        words: list[str] = []
        segment = ""
        for typed, meant in _TYPED:
            text = re.sub(typed, meant, text, flags=re.MULTILINE)
        for piece in _PIECE.finditer(text):
            word = (piece["WORD"] or "").lower()
            is_word = (
                word in VOCABULARY
                or word in SHORT.split()
                or (len(word) > 2 and word.isalpha() and not self._is_formula(word))
            )
            if is_word or (piece["ARTICLE"] and not _OPERATOR.search(segment)):
                words += [*self._segment(segment), VOCABULARY.get(word, word).strip(",")]
                segment = ""
            else:
                segment += piece[0]
        words += self._segment(segment)
        self._apply()
        self.words = re.sub(r"(?:[ .]*\.)?$", "", " ".join(filter(None, words)))
        at = 0
        while two := re.compile(rf"({F}) (?:, )?and ({F})").search(self.words, at):
            left, right = (self.formulas[int(one[1:])] for one in two.groups())
            at = two.start() + 1
            if LIST.fullmatch(left) and LIST.fullmatch(right):
                at -= 1
                self.words = f"{self.words[:at]}{self.put(f'{left}, {right}')}{self.words[two.end() :]}"
        self.words = _OF_TWO.sub(lambda two: self.put(f"({self.joined(two[1], two[2])})"), self.words)
        self.words = _WHERE.sub(lambda where: self.where.append(where[1]) or "", self.words).strip()  # type: ignore[func-returns-value]
        self.words = self._with_meanings(self.words)
        for pattern, said in _RULES:
            self.words = re.sub(" +", " ", re.sub(pattern, said, self.words)).strip()

    def _with_meanings(self, words: str) -> str:
        """The words with what a name or a noun was defined to mean in its place, without the definitions; as they are
        where nothing is defined, one is not used, or what is meant is not clear."""
        meanings: list[tuple[str, bool, str]] = []
        unused: set[str] = set()

        def defined(at: re.Match[str]) -> str:
            parts = {"name": None, "lead": None, **at.groupdict()}
            means = f"{parts['lead'] or ''}{at['means']}"
            meanings.append((self[parts["name"] or ""], at["noun"] == "line", means))
            unused.update(() if at.re is _NAMED else (means,))
            return f"{at['noun']} {means}" if at.re is _NAMED else ""

        def meant(at: re.Match[str]) -> str:
            name, is_line = self[at["name"] or ""], at["noun"] == "line"
            those = {m for n, line, m in meanings if (n == name if name else line is is_line or not at["noun"])}
            if len(those) != 1:
                return at[0]
            unused.discard(means := those.pop())
            return (at["lead"] or "") + means.removeprefix(at["lead"] or "") + ("" if at[0] else " has ")

        words = shorter = _NAMED.sub(defined, words)
        for means, _, _ in self.functions.values():
            shorter = re.sub(rf"({_GIVEN}) (?:function )?({means})\b", r"\1 function \2", shorter)
        for pattern in _DEFINED:
            whole = rf"(?:^|(?<=[.,] )|(?<=and )){pattern}(?: [.,]| and|$)(?: (?:and|then)\b)? ?"
            shorter = re.sub(whole, defined, shorter)
        behind = re.fullmatch(rf"(.*) [.:] ({F})", shorter)
        if behind and not meanings and sum(at["noun"] is not None for at in _MEANT.finditer(behind[1])) == 1:
            shorter, meanings = behind[1], [("", False, behind[2])]
        replaced = _MEANT.sub(meant, shorter)
        unused -= {means for means, _, _ in self.functions.values() if self.is_applied}
        return words if unused or (replaced == shorter and not self.is_applied) else replaced.strip()

    def _apply(self) -> None:
        """Puts the values of the functions that are defined in the place of their applications."""
        for name, (means, names, body) in self.functions.items():
            applied = re.compile(rf"(?<!\w){name}\s*\*?\s*\(\s*{names}\s*\)")
            for at, formula in enumerate(self.formulas):
                if f"§{at}" != means:
                    self.formulas[at] = body if formula == name else f"({body})".join(applied.split(formula))
                    self.is_applied |= self.formulas[at] != formula

    def _is_formula(self, word: str) -> bool:
        """Whether a word can stand in a formula: a function, a product, a Greek letter."""
        return word in FUNCTIONS or is_product(word, self.letters) or LETTERS.fullmatch(word) is not None

    def _segment(self, text: str) -> list[str]:
        """A formula between two words, and the signs of punctuation around it."""
        before, inside, behind = re.fullmatch(r"([\s.,:;?]*)(.*?)([\s.,:;?]*)", text, re.DOTALL).groups()  # type: ignore[union-attr]
        marks = [[mark if mark in ",:" else "." for mark in part if mark in ".,:;?"] for part in (before, behind)]
        inside = re.sub(r"^'(\w+)'$", r"\1", inside.replace("–", "-"))
        if inside and is_latex(inside):
            inside = as_text(inside)
        if (function := _FUNCTION.fullmatch(inside)) and function[1] not in self.functions:
            inside = function[3].strip()
            if not re.search(r"[<>=≤≥]", inside):
                names = r"\s*,\s*".join(re.findall(r"\w", function[2]))
                self.functions[function[1]] = (f"§{len(self.formulas)}", names, inside)
        if said := re.fullmatch(rf"({LIST.pattern})\s*([.:])\s+(.+)", inside, re.DOTALL):  # for x: f
            return [*marks[0], self.put(said[1]), said[2], *self._segment(said[3]), *marks[1]]
        return [*marks[0], *([self.put(inside)] if inside else []), *marks[1]]

    def put(self, formula: str) -> str:
        """The sign for a formula."""
        self.formulas.append(formula.strip())
        return f"§{len(self.formulas) - 1}"

    def __getitem__(self, part: str) -> str:
        """The text of a part of the sentence."""
        text = re.sub(r"§(\d+)", lambda at: self.formulas[int(at[1])], part)
        return re.sub(r" (?=[,.:])", "", text).strip()

    def names(self, part: str) -> list[str]:
        """The names in a list."""
        return [unquoted(name) if name[0] == "`" else name for name in re.findall(LISTED, self[part])]

    def joined(self, how: str, listed: str) -> str:
        """The product or the sum of the variables in a list."""
        return (" * " if how == "product" else " + ").join(self.names(listed))
