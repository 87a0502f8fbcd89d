"""Derivations on paper and on screen: what each rule says, and the steps as LaTeX and as a page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from qe.exact.ring import Poly, format_poly
from qe.formula.syntax import TRUE, Formula
from qe.io import latex as tex
from qe.io import mathml
from qe.proof.certificate import Certificate
from qe.proof.run_log import RunLog
from qe.proof.step import Step
from qe.services import Service, service

RULES: Mapping[str, str] = {
    "renaming": "Bound variables get names of their own.",
    "roots counted": "A comparison with the k-th root of a polynomial is one of numbers of roots.",
    "duality": "Something holds everywhere if and only if its negation holds nowhere.",
    "negation normal form": "Negations go inside, down to the atoms.",
    "standard simplification": "Both sides have the same truth for all signs that are possible (Dolzmann, Sturm 1997).",
    "independent parts and miniscoping": "Conditions that share no variable of a block are quantified apart.",
    "linear equation solved": "A linear equation with a nonzero coefficient gives its variable (Gauss).",
    "linear equation solved under a guard": "The coefficient of a linear equation vanishes, or gives its variable.",
    "degree shift": "All exponents share a divisor: the power becomes the variable.",
    "value that is taken": "A polynomial of odd degree takes every value, one of even degree has a sign far out.",
    "inequations that remove no interior": "A nonempty open set lies in no hypersurface.",
    "boundary apart": "A weak inequality is a strict one or an equation.",
    "translation of the origin": "All polynomials are constant along a direction: one coordinate may be zero.",
    "nested blocks of one kind gathered": "A quantifier may also stand before conditions without its variables.",
    "rotation of the axes": "All polynomials are constant along a rotation: one coordinate may be zero.",
    "affine coordinates": "Invertible linear forms in the variables of a block take all values as these do.",
    "linear form named": "Conditions that look at one linear form are conditions on a new variable.",
    "sphere seen along a form": "On a sphere l.v takes the values of a segment (Cauchy's inequality).",
    "mirror images of a convex set": "With a point a convex set contains the middle between it and its mirror image.",
    "disjuncts with equations apart": "A disjunction holds somewhere if and only if one of its members does.",
    "homogeneous scaling": "All polynomials are homogeneous: one coordinate may be -1, 0 or 1.",
    "Groebner basis of the equations": "The equations have the same common zeros as others (Buchberger 1965).",
    "multiple of an equation subtracted": "Where q = 0, the polynomials p and p - c q have the same sign.",
    "ranges that exclude each other": "Conditions bound variables one after the other; within these one cannot hold.",
    "case split on factors": "A product is zero if and only if a factor is.",
    "signs by sums of squares": "A sum of squares, or of products of them with what is not negative, is not negative.",
    "simplification": "Both sides have the same truth for all signs of the polynomials that are possible.",
    "elimination set": "A block holds somewhere if and only if it holds at one of finitely many test points "
    "(Loos, Weispfenning 1993; Weispfenning 1997).",
    "roots by signs": "The signs of Hermite's forms, and Descartes' rule, say how the roots of a polynomial lie.",
    "infinity first": "Solutions near infinity follow from leading terms; elsewhere a leading coefficient is zero.",
    "comprehensive Gröbner system": "Signatures of trace forms count the real solutions of equations.",
    "theorem": "An instance of a theorem that is listed as such, proved or believed by name.",
    "closed form": "An instance of a theorem that is listed as such, proved or believed by name.",
    "roots in a half-plane": "All roots have negative real parts where the determinants of Hurwitz are positive "
    "(Liénard, Chipart 1914; Gantmacher 1959, chapter XV).",
    "cells": "On every cell of a cylindrical algebraic decomposition the formula has one truth value "
    "(Collins 1975; Collins, Hong 1991).",
    "critical values": "The truth of a block over bounded fibres changes only at critical values.",
    "critical values of a universal block": "The parameters form a convex set whose boundary is at critical values.",
    "constant along directions": "Both sides are constant along a direction of the parameters: one may be zero.",
    "covering": "Intervals on each of which the formula has one truth value cover the line, or one is enough, "
    "over a sample and near it (Ábrahám, Davenport, England, Kremer 2021).",
    "Boolean search": "Every choice of cases contains comparisons that no point satisfies together "
    "(Nieuwenhuis, Oliveras, Tinelli 2006).",
    "branch and bound": "Products of distances from bounds are not negative; piece by piece, a combination of "
    "these and of the conditions is a negative number (Sherali, Adams 1990; Farkas 1902).",
    "exchangeable variables in order": "The least of variables that can change places may be the first of them.",
    "convex": "A convex set has a point, or multipliers combine its conditions to a contradiction.",
    "point or multipliers": "A point decides a sentence, or multipliers of its conditions show that there is none.",
    "witness in the parameters": "Polynomials in the universal variables satisfy the inner blocks.",
    "equations taken apart": "The equations have the same common zeros as others (Buchberger 1965), factor by factor.",
    "shorter": "A decomposition of the space of the free variables shows that the shorter formula is equivalent.",
    "redundant part": "There is no point where this part makes a difference.",
    "signs of factors": "The formulas, of which one speaks of factors of products, differ nowhere.",
    "constant": "The formula holds everywhere, or nowhere.",
}
"""What each rule claims, in a sentence."""


def latex(start: Formula, steps: Sequence[Step]) -> str:
    """An ``align*`` body: the start, then a line for each step."""
    lines = [f"& {tex.write(start)}"]
    for step in steps:
        where = "" if step.context == TRUE else rf",\ {tex.write(step.context)}"
        lines.append(rf"\overset{{\text{{{step.rule}}}{where}}}{{\Longleftrightarrow}}\ & {tex.write(step.after)}")
    return "\\begin{align*}\n" + " \\\\\n".join(lines) + "\n\\end{align*}"


def page(
    start: Formula,
    steps: Sequence[Step],
    answer: Formula,
    *,
    is_complete: bool,
    title: str = "Derivation",
    note: str = "",
) -> str:
    """One self-contained page. ``note``: a sentence below the claim."""
    notes = [*([note] if note else []), *([] if is_complete else ["Some steps are not recorded one by one."])]
    said, name = "".join(f"<p>{escape(text)}</p>" for text in notes), escape(title)
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
        "<meta name=viewport content='width=device-width, initial-scale=1'>"
        f"<style>{STYLE}</style></head>\n<body><h1>{name}</h1>\n"
        f"<p>{_math(start)}</p><p>⟺ {_math(answer)}</p>{said}\n<h2>Steps</h2>\n{_list(steps, 'step-')}\n"
        "</body></html>\n"
    )


def fragment(start: Formula, steps: Sequence[Step], answer: Formula) -> str:
    """The claim and the steps, to stand in another page."""
    return f"<div><p>{_math(start)}</p><p>⟺ {_math(answer)}</p>{_list(steps)}</div>"


STYLE = (
    "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color-scheme:light dark}"
    "li{margin:1.2rem 0}.rule{font-weight:600}.says{opacity:.75}p{overflow-x:auto}"
    "math{width:fit-content;margin-left:0}mtd{text-align:left}"
    "@media print{p{overflow:visible}}"
    "details{margin:.4rem 0}details li{margin:.3rem 0;overflow-wrap:anywhere}summary{cursor:pointer}"
)


def _list(steps: Sequence[Step], prefix: str = "") -> str:
    rows = (_row(step, f' id="{prefix}{k}"' if prefix else "") for k, step in enumerate(steps, start=1))
    return "<ol>\n" + "\n".join(rows) + "\n</ol>"


def _row(step: Step, anchor: str) -> str:
    where = "" if step.context == TRUE else f"<p>where {_math(step.context)}</p>"
    theorem = "".join(f"<p>{escape(text)}</p>" for text in service(Service.THEOREM)(step.rule))
    return (
        f'<li{anchor}><span class="rule">{escape(step.rule)}</span> '
        f'<span class="says">{escape(RULES.get(step.rule, ""))}</span>{_folded("theorem", theorem)}{where}'
        f"<p>{_math(step.before)}</p><p>⟺ {_math(step.after)}</p>{_folded('evidence', _evidence(step))}</li>"
    )


def _folded(title: str, content: str) -> str:
    return f"<details><summary>{title}</summary>{content}</details>" if content else ""


def _evidence(step: Step) -> str:
    """What the rule found, what its checker needs, and the steps of which a step is made.

    Left out are traces of substitutions, from which the evidence is made when a certificate is asked for.
    """
    proof, trace = step.evidence.get("proof"), step.evidence.get("trace")
    given = {k: v for k, v in step.evidence.items() if k not in ("proof", "trace")}
    given |= {str(k): v for k, v in proof.items()} if isinstance(proof, Mapping) else {}
    listed = "".join(f"<li>{escape(k)}: {escape(_shown(v))}</li>" for k, v in given.items())
    return (f"<ul>{listed}</ul>" if listed else "") + (_list(list(trace.steps())) if isinstance(trace, RunLog) else "")


def _shown(value: object) -> str:
    """A piece of evidence as text."""
    match value:
        case Poly():
            return format_poly(value)
        case Certificate():
            return f"a certificate of kind {value.kind.value}"
        case Mapping():
            return "{" + ", ".join(f"{k}: {_shown(v)}" for k, v in value.items()) + "}"
        case list() | tuple():
            return "[" + ", ".join(map(_shown, value)) + "]"
    return "unknown" if value is None else str(value)


def _math(formula: Formula) -> str:
    return mathml.write(formula)
