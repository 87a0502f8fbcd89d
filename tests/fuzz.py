"""Every reader against damaged texts, for as long as wanted: ``python -m tests.fuzz --seconds 60``.

A reader answers with a value or with one line that says what is wrong (``InputError``, ``Unable``,
``CertificateRejected``). Anything else is a finding: the text is printed before the traceback, the exit status is 1.
With ``--guided`` atheris, where it is installed, chooses the texts by what they cover; otherwise seeds are cut, joined
and changed at random, the same for the same ``--seed``.
"""

from __future__ import annotations

import argparse
import importlib.util
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random

import qe
from bezier.arm.reader import read_arm, read_route
from qe import arguments
from qe.cli.prompt import is_open
from qe.cli.smt import Solver
from qe.errors import CertificateRejected, InputError, Unable
from qe.io import formats
from qe.regions.region import Region

QUESTION = "ex x. all y. a*x^2 + b*x + c >= 0 and not (x = y or x/3 > sqrt(y) - |x|) -> x < root(2, x^2 - y)"
SEEDS = {
    "text": [
        QUESTION,
        "ForAll[{x, y}, x > 0 && y ∈ Reals, Implies[x² >= y, Abs[x] != 2]]",
        "∃x∀y: 2x³ ≤ y ∨ ¬(x = .5) # note",
        "(if x > 0 then min(x, y) else max(1e-3, `a b`)) = sign(x)^(1/2) and x in [0, oo)",
        "(∀x∈R)(∃ positive y) y > x; if x > 1 then at most two z: z^2 = x for all real x and y",
        "(E x, y)(A z)[ x > z => y not in [0, 1) ∪ {2} ]. for all x, there exists y such that x =< ∛y;",
        r"\exists x\, \forall y\colon x^{2} \geq \frac{1}{2} \land 4ac \neq 0",
    ],
    "smtlib": [
        "(set-logic NRA)(declare-fun x () Real)(define-fun f ((y Real)) Real (/ y x))(push 1)"
        "(assert (! (forall ((z Real)) (=> (> z 0) (let ((w (* z z))) (ite (= w x) true (< (f w) 1.5)))))"
        " :named |a b|))"
        "(check-sat)(get-model)(pop 1)(exit)"
    ],
    "qepcad": [
        "[example]\n(a,b,x)\n2\n(E x)[ a x^2 + b x + 1 = 0 /\\ [ x > 0 ==> b /= 3/4 ] ].\nassume [ a > 0 ].\nfinish"
    ],
    "redlog": ["ex({x,y}, a*x**2 + b*x + c = 0 and (x > 0 impl y <> 1) or all(z, z >= y equiv true));"],
    "latex": [r"\forall x \left( x^{2} + y_{ij} \leq \sqrt{2} \lor \lnot \mathrm{abc} = \frac{a}{b} \right)"],
    "arm": [
        'name = "n"\nconvention = "modified"\n[[row]]\njoint = "q"\nd = 131.22\nalpha = "-pi/2"\nlimits = ["-3", 3]\n'
        '[[row]]\nkind = "prismatic"\njoint = "p"\ntheta = {cos = "3/5", sin = "4/5"}\na = "1/3"\nmax_velocity = 2\n'
    ],
    "path": ['[[curve]]\npoints = [[10, 40.5, "1/3"], [40, 100, 20], [1, 2, 3]]\nname = "a"\nspline = true\n'],
}
DOORS: dict[str, Callable[[str], object]] = {
    **{f.value: (lambda text, f=f: formats.read(text, f)) for f in formats.Format if f.readable},  # type: ignore[misc]
    "total division": lambda text: formats.read(text, total_division=True),
    "certificate": lambda text: qe.verify(qe.Certificate.from_json(text), timeout=1),
    "region": Region.from_json,
    "names": lambda text: arguments.names(text, "order"),
    "number": lambda text: arguments.rational(text, "number"),
    "prompt": is_open,
    "solver": lambda text: Solver(len, len).run(text.replace("check-sat", "echo").splitlines(keepends=True), "<fuzz>"),
    "arm": read_arm,
    "path": read_route,
}
LONGEST = 2000
SOLVER = (
    "(declare-fun f (Int Real) Real)(declare-const n Int)(define-fun g ((a Real) (b Bool)) Real (ite b a (f n a)))\n"
    "(assert (> (g (tanh 1) true) (to_int (f 1 2))))(push 2)(declare-const |a b| Real)"
    "(assert (! (= |a b| 1.) :named q))"
    "(pop)(get-assertions)(get-info :version)(set-option :print-success true)(reset-assertions)(get-value ((+ 1 2)))"
)


def seeds(door: str) -> list[str]:
    """Texts that the door reads."""
    if door in ("certificate", "region"):
        return [qe.region("x^2 + y^2 <= 1").to_json(), qe.eliminate("ex x. x^2 = 2").certificate.to_json()]
    if door == "json":
        return [formats.write(formats.read(QUESTION.partition(" - |x|")[0] + ")"), "json")]
    if door == "solver":
        return [*SEEDS["smtlib"], SOLVER]
    return SEEDS.get(door, [*SEEDS["text"], "x, `y z` y", "-1.5e-3", "3/4"])


def damaged(text: str, others: list[str], random: Random) -> str:
    """The text with a few things cut, doubled, exchanged or put in."""
    for _ in range(random.randint(1, 4)):
        start = random.randint(0, len(text))
        stop = min(len(text), start + random.randint(0, 8))
        other = random.choice(others)
        at = random.randint(0, len(other))
        new = random.choice(
            [
                "",
                text[start:stop] * 2,
                other[at : at + 12],
                chr(random.choice([0, 10, 34, 92, 96, 124, 178, 0x2203, 0xD7FF])),
            ]
            + ["(", ")", "[", "{", "9" * 30, "-", "/0", "^999", " ", "root(", "\\", "e", "true"]
        )
        text = (text[:start] + new + text[stop:])[:LONGEST]
    return text


def examine(door: str, text: str) -> None:
    """Read the text at a door; whatever is raised is a finding."""
    try:
        DOORS[door](text)
    except (InputError, Unable, CertificateRejected) as error:
        assert "\n" not in str(error), "an error of several lines"


def texts(seed: int) -> Iterator[tuple[str, str]]:
    """Doors and texts without end."""
    random = Random(seed)
    known = {door: seeds(door) for door in DOORS}
    doors = list(DOORS)
    while True:
        door = random.choice(doors)
        yield door, damaged(random.choice(known[door]), known[door], random)


def guided(seconds: float) -> None:
    """Let atheris choose the texts, beginning with the seeds; the modules of the readers are loaded instrumented."""
    import atheris  # type: ignore[import-not-found,unused-ignore]

    doors = list(DOORS)

    def one(data: bytes) -> None:
        if data:
            examine(doors[data[0] % len(doors)], data[1:].decode(errors="ignore"))

    with tempfile.TemporaryDirectory() as corpus:
        for k, door in enumerate(doors):
            for j, text in enumerate(seeds(door)):
                (Path(corpus) / f"{k}-{j}").write_bytes(bytes([k]) + text.encode())
        limits = [f"-max_total_time={seconds:.0f}", f"-max_len={LONGEST}", "-verbosity=0", "-print_final_stats=1"]
        atheris.Setup([sys.argv[0], *limits, corpus], one)
        atheris.Fuzz()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--inputs", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--guided", action="store_true", help="by atheris")
    asked = parser.parse_args()
    if asked.guided and importlib.util.find_spec("atheris") is not None:
        return subprocess.run([sys.executable, "-m", "tests.guided_fuzz", str(asked.seconds)], check=False).returncode
    end, count = time.monotonic() + asked.seconds, 0
    for door, text in texts(asked.seed):
        fine = False
        try:
            examine(door, text)
            fine = True
        finally:
            if not fine:
                print(f"{door}: {text!r}")
        count += 1
        if count >= asked.inputs or time.monotonic() > end:
            break
    print(f"{count} texts read")
    return 0


if __name__ == "__main__":
    sys.exit(main())
