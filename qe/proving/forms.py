"""A polynomial that gets a name, in steps of the kernel: linear forms, values of a form on a sphere or ball."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from qe.exact.ring import Poly, Ring
from qe.formula.build import conj, exists
from qe.formula.syntax import Atom, Exists, Formula, Relation
from qe.formula.traverse import conjuncts
from qe.kernel.statements import theorem
from qe.kernel.step import only
from qe.kernel.theorem import theorem_goals
from qe.proof.entry import Json, formula_from_json, poly_to_text
from qe.proving.lemma_list import Term, identities
from qe.proving.made import Made, equal

EQ = Relation.EQ


def named(made: Made, after: Formula) -> None:
    """Conditions on a form become conditions on its name, by the equations beside them."""
    numbers = [entry.rational() for entry in only(made.claim, "scales")[0].items()]
    before, ring = made.current, made.ring
    if not isinstance(before, Exists) or not isinstance(after, Exists):
        raise made.claim.fail("two blocks expected")
    name = after.variables[0]
    outer = [part for part in conjuncts(after.body) if isinstance(part, Atom)]
    inner = next((part for part in conjuncts(after.body) if isinstance(part, Exists)), None)
    parts = () if inner is None else conjuncts(inner.body)
    naming = next((part for part in parts if isinstance(part, Atom) and name in part.free), None)
    if inner is None or naming is None:
        raise made.claim.fail("one block next to the others, with an equation that names the form, expected")
    beside = [part for part in conjuncts(inner.body) if part != naming]
    given = [part for part in conjuncts(before.body) if part not in beside]
    y = ring.index[name]
    rest, lead = naming.poly.coefficients(y)
    form, lines = rest * -lead.constant_value(), [f.poly for f in beside if isinstance(f, Atom) and f.relation is EQ]
    listed: list[list[Term]] = []
    for p, q, number in zip(given, outer, numbers, strict=True):
        assert isinstance(p, Atom)
        terms: list[Term] = [(number.numerator, ((p.poly, 1),))]
        for sign in (1, -1):
            difference = p.poly * number.numerator - q.poly.compose({y: form}) * (number.denominator * sign)
            line = next((f for f in lines if difference and difference.gcd(f) in (f, -f)), None)
            if line is not None or not difference:
                change = (q.poly - q.poly.compose({y: form})).exact_divide(ring.gen(y) - form)
                times = -number.denominator * sign
                lead_sign = lead.constant_value()
                terms += [(times, ((q.poly, 1),)), (-times * lead_sign, ((change, 1), (naming.poly, 1)))]
                terms += [(-1, ((difference.exact_divide(line), 1), (line, 1)))] if line is not None else []
                break
        listed.append(terms)
    names = (name, *before.variables)
    whole = exists(names, conj((naming, before.body)))
    moved = exists(names, conj((naming, *beside, *outer)))
    made.named(before, whole, name, naming)
    made.signs(whole, moved, identities(listed, ring))


def seen_along(made: Made, after: Formula) -> None:
    """The form gets a name, and a theorem says which values it has on the sphere or ball."""
    given, listed, entry = only(made.claim, "sphere", "variables", "form")
    before, names, ring = made.claim.block(), listed.names(), made.ring
    part, form = formula_from_json(given, ring), entry.polynomial(ring)
    if not isinstance(part, Atom) or not isinstance(after, Exists) or not {*names} <= {*before.variables}:
        raise given.fail("a comparison expected, and variables of the block")
    t = made.fresh()
    letters, relation = _letters(part, form, [ring.index[v] for v in names], ring.var(t))
    strict = relation is Relation.LT
    words = (str(len(names)),) if strict else (str(len(names)), relation.value)
    used = theorem(f"a form takes a value on {'an open' if strict else 'a sphere or'} ball", words)
    if used is None:
        raise given.fail("a sphere or ball expected")
    variables = {f"x{k}": name for k, name in enumerate(names)}
    inner, answer = (used.formula(side, letters, variables, ring) for side in ("block", "answer"))
    naming = equal(ring.var(t), form)
    final = made.put(after.body, {names[0]: ring.var(t)})
    rest = [f for f in conjuncts(final) if f not in conjuncts(answer)]
    whole = exists((t, *before.variables), conj((naming, before.body)))
    seen = exists((t, *before.variables), conj((part, naming, *rest)))
    outer = tuple(t if v == names[0] else v for v in after.variables)
    values = exists(outer, conj((answer, *rest)))
    made.named(before, whole, t, naming)
    made.simplified(whole, seen)
    made.moved(seen, exists(outer, conj((inner, *rest))))
    texts: Json = {v: poly_to_text(p) for v, p in letters.items()}
    evidence: dict[str, Json] = {"theorem": used.name, "words": list(words), "letters": texts}
    made.by_lemmas("theorem", theorem_goals, inner, answer, {**evidence, "variables": dict(variables)})
    if not {*conjuncts(answer)} <= {*conjuncts(final)}:  # the radius follows
        made.signs(values, exists(outer, final), _radius(letters, len(names), ring))


def _letters(part: Atom, form: Poly, indices: Sequence[int], value: Poly) -> tuple[dict[str, Poly], Relation]:
    """The polynomials of the theorem, and the relation where the squares have a positive coefficient."""
    square, ring = part.poly.derivative(indices[0]).derivative(indices[0]), part.poly.ring
    sign = 1 if square.is_constant and square.constant_value() > 0 else -1
    poly, origin = part.poly * sign, {i: ring.constant(0) for i in indices}
    slopes = {f"b{k}": poly.derivative(i).compose(origin) for k, i in enumerate(indices)}
    directions = {f"l{k}": form.derivative(i) for k, i in enumerate(indices)}
    number = ring.constant(square.constant_value() * sign // 2) if square.is_constant else square
    relation = part.relation if sign > 0 else part.relation.flipped
    return {"c": number, "e": poly.compose(origin), "t": value, **slopes, **directions}, relation


def _radius(letters: Mapping[str, Poly], size: int, ring: Ring) -> Json:
    """(2*c*t + l.b)^2 - |l|^2*R, in terms of the square and of R."""
    zero, c, span = ring.constant(0), letters["c"], range(size)
    b, slopes = [letters[f"b{k}"] for k in span], [letters[f"l{k}"] for k in span]
    root = c * letters["t"] * 2 + sum((p * q for p, q in zip(slopes, b, strict=True)), zero)
    length, radicand = sum((p * p for p in slopes), zero), sum((p * p for p in b), zero) - c * letters["e"] * 4
    terms: list[Term] = [(1, ((root * root - length * radicand, 1),)), (-1, ((root, 2),))]
    return identities([[*terms, (1, ((length, 1), (radicand, 1)))]], ring)
