"""Random SMT-LIB scripts from a seed, and the answers of ``qe smt`` and z3 to them, command by command.

Where ``qe smt`` says ``sat`` and has a model, every assertion is evaluated at it too, without z3.
"""

from __future__ import annotations

import random

from qe.cli.smt import Solver
from qe.errors import InputError

NAMES = ("x", "y", "z", "w", "u", "v")
RELATIONS = ("=", "distinct", "<", "<=", ">", ">=")
FUNCTIONS = (
    "(define-fun low ((a Real) (b Real)) Real (ite (<= a b) a b))",
    "(define-fun high ((a Real) (b Real)) Real (ite (<= a b) b a))",
    "(define-fun size ((a Real)) Real (ite (< a 0.0) (- a) a))",
)


def random_term(rng: random.Random, names: tuple[str, ...], depth: int) -> str:
    """A term with division, absolute values, minima, maxima and case distinctions."""
    kind = rng.random()
    if depth == 0 or kind < 0.25:
        return rng.choice((*names, *names, "0.0", "1.0", "2.0", "0.5", "(- 1.0)", "3.0"))
    a, b = (random_term(rng, names, depth - 1) for _ in range(2))
    if kind < 0.60:
        return f"({rng.choice('+-*')} {a} {b})"
    if kind < 0.74:
        return f"(/ {a} {b})"
    if kind < 0.82:
        return f"({rng.choice(('abs', 'size'))} {a})"
    if kind < 0.91:
        return f"({rng.choice(('low', 'high'))} {a} {b})"
    return f"(ite {random_atom(rng, names, 0)} {a} {b})"


def random_atom(rng: random.Random, names: tuple[str, ...], depth: int) -> str:
    """A comparison of two terms."""
    return f"({rng.choice(RELATIONS)} {random_term(rng, names, depth)} {random_term(rng, names, depth)})"


def random_sum(rng: random.Random, names: tuple[str, ...]) -> str:
    """A comparison of a linear form with a number; one in two is a difference of variables."""
    x, y = rng.sample(names, 2)
    if rng.random() < 0.5:
        return f"({rng.choice(RELATIONS)} (- {x} {y}) {_number(rng)})"
    terms = " ".join(f"(* {_number(rng)} {name})" for name in rng.sample(names, min(len(names), rng.randint(2, 3))))
    return f"({rng.choice(RELATIONS)} (+ {terms}) {_number(rng)})"


def _number(rng: random.Random) -> str:
    value = rng.randint(-4, 4)
    return f"(- {-value}.0)" if value < 0 else f"{value}.0"


def _boolean(rng: random.Random, atoms: list[str]) -> str:
    """The atoms under connectives, each of them once."""
    if len(atoms) == 1:
        return f"(not {atoms[0]})" if rng.random() < 0.2 else atoms[0]
    cut = rng.randint(1, len(atoms) - 1)
    parts = f"{_boolean(rng, atoms[:cut])} {_boolean(rng, atoms[cut:])}"
    return f"({rng.choice(('and', 'or', 'or', 'or', 'and', '=', 'xor', '=>'))} {parts})"


def term_script(rng: random.Random) -> str:
    """A few atoms of terms that are not defined everywhere, or by cases."""
    names = NAMES[: rng.randint(1, 2)]
    atoms = [random_atom(rng, names, rng.randint(1, 2)) for _ in range(rng.randint(1, 3))]
    return _script(names, [f"(assert {_boolean(rng, atoms)})", "(check-sat)"])


def linear_script(rng: random.Random) -> str:
    """10 to 30 atoms of linear forms and Boolean symbols."""
    names, symbols = NAMES[: rng.randint(2, 6)], ("p", "q", "r")
    count = rng.randint(10, 30)
    atoms = [rng.choice(symbols) if rng.random() < 0.15 else random_sum(rng, names) for _ in range(count)]
    parts = []
    while atoms:
        size = rng.randint(2, 6)
        parts.append(f"(assert {_boolean(rng, atoms[:size])})")
        atoms = atoms[size:]
    return _script(names, [*(f"(declare-const {p} Bool)" for p in symbols), *parts, "(check-sat)"])


def local_script(rng: random.Random) -> str:
    """12 to 16 case distinctions over a few variables, most with variables of their own or of two of them."""
    shared, own, parts = NAMES[: rng.randint(2, 4)], [f"l{k}" for k in range(12)], []
    for k in range(rng.randint(12, 16)):
        names = (
            *rng.sample(shared, 2),
            own[k % len(own)],
            *([own[k - 1]] if 0 < k < 12 and rng.random() < 0.2 else []),
        )
        cases = [" ".join(random_sum(rng, names) for _ in range(rng.randint(1, 3))) for _ in range(rng.randint(2, 3))]
        parts.append(f"(assert (or {' '.join(f'(and {case})' for case in cases)}))")
    parts += [f"(assert {random_sum(rng, shared)})" for _ in range(rng.randint(0, 4))]
    return _script((*shared, *own), [*parts, "(check-sat)"])


def level_script(rng: random.Random) -> str:
    """Assertions and checks on several levels, and checks under assumptions."""
    names = NAMES[: rng.randint(1, 3)]
    lines, depth = ["(declare-const p Bool)", "(declare-const q Bool)"], 0
    for _ in range(rng.randint(6, 14)):
        kind = rng.random()
        if kind < 0.45:
            atom = random_sum(rng, names) if len(names) > 1 and rng.random() < 0.5 else random_atom(rng, names, 1)
            lines.append(f"(assert (or {atom} {rng.choice(('p', 'q', '(not p)', '(not q)', 'false'))}))")
        elif kind < 0.6:
            lines.append("(push 1)")
            depth += 1
        elif kind < 0.72 and depth:
            count = rng.randint(1, depth)
            lines.append(f"(pop {count})")
            depth -= count
        elif kind < 0.8:
            lines.append(f"(check-sat-assuming ({rng.choice(('p', '(not p)', 'p (not q)', '(not p) q'))}))")
        else:
            lines.append("(check-sat)")
    return _script(names, [*lines, "(check-sat)"])


def sharing_script(rng: random.Random) -> str:
    """Definitions that use those before them again and again: written out, most would have millions of parts."""
    names = NAMES[: rng.randint(1, 3)]
    truths, terms, lines = ["p"], list(names), []
    for k in range(rng.randint(20, 60)):
        a, b, c = (rng.choice(truths[-3:]) for _ in range(3))
        s, t = rng.choice(terms), rng.choice(terms[-2:])
        kind = rng.random()
        if kind < 0.25:
            cased = (f"(ite {a} {s} {t})", f"(low {s} {t})", f"(size {t})", f"(/ {s} {t})")
            lines.append(f"(define-fun t{k} () Real {rng.choice((*cased, f'(+ {t} {t})', f'(- {s} {t} 1.0)'))})")
            terms.append(f"t{k}")
            continue
        other = rng.choice(truths)
        ways = (
            *(f"({rng.choice(RELATIONS)} {t} {value})" for value in (s, _number(rng), _number(rng))),
            *(f"(xor {a} {b} {other})", f"(= {a} {b})", f"(and {a} (or {b} {c}))", f"(=> {a} {other})"),
            *(f"(or (and {a} {b}) (and (not {a}) {c}))", f"(ite {a} {b} (not {c}))"),
        )
        lines.append(f"(define-fun b{k} () Bool {rng.choice(ways)})")
        truths.append(f"b{k}")
    lines += [f"(assert {rng.choice(truths[-4:])})" for _ in range(rng.randint(1, 3))]
    return _script(names, ["(declare-const p Bool)", *lines, "(check-sat)"])


def _script(names: tuple[str, ...], lines: list[str]) -> str:
    return "\n".join([*(f"(declare-const {name} Real)" for name in names), *FUNCTIONS, *lines])


class Checked(Solver):
    """``qe smt`` whose models are checked: ``broken`` lists the assertions that are false at one."""

    def __init__(self, seconds: float) -> None:
        self.answers: list[str] = []
        self.broken: list[object] = []
        super().__init__(self.answers.append, lambda note: None, timeout=seconds, each=True)

    def check(self, *given: object) -> str:
        answer = super().check(*given)  # type: ignore[arg-type]
        if answer == "sat" and self.result is not None and self.result.point is not None:
            evaluation = self.evaluation()
            for assertion in self.script.assertions:
                try:
                    if not evaluation.truth(assertion.node):
                        self.broken.append(assertion.written)
                except InputError:
                    continue
        return answer


def ours(script: str, seconds: float) -> tuple[list[str], bool]:
    """Our answers, and whether all models satisfy all assertions."""
    solver = Checked(seconds)
    solver.run([script], "<script>")
    return solver.answers, not solver.broken


def theirs(script: str, seconds: float) -> list[str]:
    """The answers of z3."""
    import z3

    context = z3.Context()
    text = f"(set-option :timeout {int(1000 * seconds)})\n{script}\n"
    return str(z3.Z3_eval_smtlib2_string(context.ref(), text)).split("\n")[:-1]


def verdict(script: str, *, seconds: float, z3_seconds: float) -> str:
    """What came of a script: agree, wrong, or who has no answer to some command."""
    answers, sound = ours(script, seconds)
    if not sound:
        return "wrong"
    others = theirs(script, z3_seconds)
    known = {"sat", "unsat", "unknown"}
    if len(answers) != len(others) or not known.issuperset((*answers, *others)):
        return "wrong"
    pairs = list(zip(answers, others, strict=True))
    if any({a, b} == {"sat", "unsat"} for a, b in pairs):
        return "wrong"
    if any(a == "unknown" for a, _ in pairs):
        return "engine unable"
    return "z3 unknown" if any(b == "unknown" for _, b in pairs) else "agree"
