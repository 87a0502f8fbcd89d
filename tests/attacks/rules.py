"""One row for each rule and each method: questions on the way to whose answers it fires (``questions.Row``).

A new rule brings one: its steps are then attacked by all near misses, and a test counts how often it fires.
"""

from __future__ import annotations

from qe.options import Method, Stage
from tests.attacks.questions import Row, row

FORM = "a*(1 - x)^3 + b*x*(1 - x)^2 + {c|1|0}*x^2*(1 - x) + {p}*x^3"
CIRCLES = "(x - a)^2 + {y^2|(y - b)^2} {<} {p}"

BETWEEN = "0 <= x and x <= 1 and 0 <= y and y <= 1 and 0 <= z and z <= 1 and 0 <= u and u <= 1"

RULES: dict[str, Row] = {
    "renaming": row(
        "(ex x. {s}*x + {L} {O} 0 and x {R} b) and (ex x. x^2 {O} {L})",
        "(all x. x^2 + a*x {O} {n}) or (ex x. x {R} {L} and x {O} b)",
    ),
    "roots counted": row(
        "x {R} root({1|2|-1}, x^2 - {p}*y + {n})",
        "a {R} root({1|-1}, a^3 - b*a + {n}) or b {O} {n}",
        "not (x {R} root({1|2}, {s}*x^2 + y*x + {n})) and y {R} {n}",
    ),
    "duality": row("all x. {s}*x^2 + a*x {R} {L}", "all x, y. x {O} a or {s}*x + y {R} {L} or y {O} x"),
    "negation normal form": row(
        "not (ex x. x^3 {R} a and x {R} {L})",
        "a {R} {n} {and|or} not (ex x. {s}*x^2 {R} b and x {O} a)",
    ),
    "simplification": row(
        "ex x, y. a*x = y + {n} and x + y {O} {n} and y {O} {L}", "ex x. {s}*x^2 + a*x {O} b and x {O} {n}"
    ),
    "standard simplification": row(
        "ex x. a^2*(x^3 + b) {O} 0 and x^5 {O} {L}",
        "ex x. x {O} {n} and x^3 {O} {L} and x {O} {n} and (x {O} {n} or a {R} {n})",
        "ex x, y. {s}*x^2 + {p}*y^2 + {p} {O} 0 and x {O} a or x*y {O} b and x^2 {O} {L}",
    ),
    "case split on factors": row(
        "ex x. (x - a)*(x + {L}) = 0 and x^3 {R} {n} and {Q}",
        "ex x. (x - a)*(a*x - b) = 0 and x {R} {n} and x^2 {O} {L}",
    ),
    "boundary apart": row(
        "ex x. {s}*x^2 {<=|>=} {L} and b*x /= {n}",
        "ex x, y. x^2 + {s}*y {<=|>=} a and b*x + y /= {n}",
        "ex x. x^2 {<=|>=} {L} and b*x + a /= 0 and x {<=|>=} b",
    ),
    "signs by sums of squares": row(
        "ex x, y, z. x^4 + y^4 + z^4 + {2|3} {O} 4*x*y*z and x*y*z = a and x {O} b",
        "ex x, y, z. x^4 + y^4 + z^4 + 1 {<=|>} 4*x*y*z and x*y = a and a {O} {L}",
        "ex x. x >= 0 and a >= 0 and x^3 + a^3 + {1|2} {O} 3*x*a and x + a {=|O} b",
    ),
    "Groebner basis of the equations": row(
        "ex x. x^2 = a and x /= 0 and x^4 {R} {p}*b",
        "ex x, y. x^2 + y^2 = a and (x^2 + y^2)^2 {R} b",
        "ex x, y. x^2 + y = a and x*y = {p} and x {O} {n}",
    ),
    "multiple of an equation subtracted": row(
        "ex x, y. x^{2|3} + {L}*x = {p} and y^2 + {n} {R} b and y {O} x",
        "ex x, y. x^3 + a*x = b and y^3 + a*y {R} b {and|or} y {O} x",
        "ex x, z. x^2 + a*x + b^2 = 0 and {p}*(z^2 + a*z + b^2) {R} 0 and z {R} {L}",
    ),
    "two balls": row(
        f"ex x, y. {CIRCLES} and x^2 + y^2 {{<}} {{p}}",
        f"b {{>}} 0 and ex x, y. {CIRCLES} and x^2 + y^2 {{<}} b^2",
        "ex x. (x - {L})^2 {<} {p} and x^2 + {n}*x {<} b",
        "ex x, y. {p}*(x^2 + y^2) - x {<} a and x^2 + y^2 {<} b",
    ),
    "sphere seen along a form": row(
        "ex x, y. x^2 + y^2 {=|<=|<} a and {b*x + y|x + 2*y|b*x + c*y} {O} {n}",
        "ex x, y. x^2 + y^2 = a and x^2 + y^2 + {s}*x + {s}*y {O} b",
        "all x, y. x^2 + y^2 /= {a|1} or (x - b)^2 + y^2 {O} {p}",
    ),
    "roots in a half-plane": row(
        "ex x, y. x^2 - y^2 + {a|{s}}*x + b = 0 and 2*x*y + {a|{s}}*y = 0 and x >= {c|{n}}",
        "ex x, y. x^2 - y^2 + a*x + b = 0 and 2*x*y + a*y = 0 and {x|2*x} {>} {c|b|0|1}",
        "all x, y. x^2 - y^2 + a*x + {p}*b = 0 and 2*x*y + a*y = 0 -> x {<} {c|0|1}",
    ),
    "quadric in a quadric": row(
        "a > 0 and ex x, y. x^2 + y^2 = {p} and a*x^2 + b*y > {c|1|2}",
        "ex x, y. x^2 + {p}*y^2 {<=|=} {p} and a*x^2 + {s}*y^2 + b*x > {p}",
        "ex x, y. (x - a)^2 + y^2 <= {p} and x^2 + {2|3}*y^2 {>|>} {b|2}",
    ),
    "cubic on an interval": row(
        f"ex x. x >= 0 and x <= 1 and {FORM} {{O}} 0",
        "ex x. x >= {n} and x <= 3 and x^3 + a*x^2 + b*x + c {<|>} 0",
        "ex x. 2*x >= {n} and a*x^3 + b*x + {c|1} {O} 0",
    ),
    "square of a variable alone": row(
        "ex x, y. {p}*x^2 + a*x + b*y + {c|1} {=|<|<=} 0 and y^2 - a*y {O} {n}",
        "ex x, y. (-1)*x^2 + a*x + y^2 - b*y + {c|2} {=|>|>=} 0 and y - b*y^2 = {n}",
        "ex x, y. {p}*y^2 + a*y + b*x + {c|1} {=|<|<=} 0 and {Q}",
    ),
    "ranges that exclude each other": row(
        "ex x, y, z. x^2 + y^2 + z^2 {<|<=} 1 and x*y*z > {p} and x + a {O} b",
        "ex x, y. x^3 - y >= 8 and y {>} 0 and x + a^2 {<} {1|0} and x {O} b",
        "ex x, y. x^2 + y^2 {<} 2 and x^4*y^2 = {p} + 8 and x {R} {L}",
    ),
    "conditions on zeros that follow": row(
        "ex x, y, z. (x /= 0 or y /= 0) and x*z + y*{a|b} + {p} < 0 and x^3 {O} y^2 + z",
        "ex x, y. (x /= 0 or y /= 0) and a*x + b*y /= 0 and x {O} {L}",
        "ex x, y. (x /= 0 or y /= 0) and x*a + y*b = {p} and x^2 {O} y + {n}",
    ),
    "independent parts and miniscoping": row(
        "ex x, y. x^2 {O} a and y^3 - y = b and y {O} {n}",
        "ex x, y. {s}*x^2 + a*x {O} 1 and y^2 {O} {L} and b {O} {n}",
        "ex x. x^2 {O} {L} and b*x {R} 1 and a {O} b or x {O} a and b {O} {n}",
    ),
    "linear equation solved": row(
        "ex x, y. x = {L}*y + {n} and y {R} b and x^3 {O} {s}*y",
        "a {<|>} {0|{n}} and (ex x. a*x = b and x^3 {R} {n})",
        "ex x. x = {L} and {Q}",
    ),
    "linear equation solved under a guard": row(
        "ex x, y. a*x + {L}*y = {n} and x^3*y {O} {p} and y {O} {n}",
        "ex x. a*x = {L} and x^3 {O} b + {n} and {Q}",
    ),
    "degree shift": row(
        "ex x. x^{4|6|12} {R} {L}",
        "ex x. x /= 0 and x^4 + a*x^2 + b {O} 0",
        "ex x. x^{6|9} + a*x^3 {O} {L}",
        "ex x. x^4 {O} {L} and (all z. z {O} x^2 or a*z {R} b)",
    ),
    "projection": row(
        "ex x, y, z. x + {p}*y {<|<=} a and y - {p}*z {<|<=} b and z - x {<|<=|=} {n} and x + y + z {O} c",
        "ex x, y, z. x + y + z = a and x - {p}*y {<|<=} b and {p}*z - y {O} {n} and x {O} 0 and y {<|<=} z",
        "ex x, y, z. x {>|>=} a and x {>|>=} y + b and x {<|<=} z and y {<|<=} {n} and z {<|<=} c and {p}*x < y + z",
    ),
    "affine coordinates": row(
        "ex x, y. (3*x - y + 1)^2 + {p}*(2*y + 3)^2 {O} a and (3*x - y + 1)*(2*y + 3) {O} {n}",
        "all x, y. (5*x - 1)^{2|3} + (x + 2*y)^3 {R} b or (x + 2*y)^2 {O} (5*x - 1) + a",
        "ex x. (7*x - 2)^4 + a*(7*x - 2) {O} b and (all y. (y + 3)^2*(7*x - 2) {R} b or (y + 3) {O} {n})",
    ),
    "translation of the origin": row(
        "ex x, y. (x - y)^4 + {s}*(x - y) {O} {L}",
        "ex x, y. (x - y)^3 {O} {L} and (all z. z {O} x - y or a*z {R} b)",
        "ex x, y, z. (x - y)*(y - z) {O} a and x - y {O} {s}*(y - z) + {n}",
        without=[Stage.POSITION],
    ),
    "two variables exchanged": row(
        "ex x, y. x^3 + y^3 {=|R} a and x {O} b and y {O} b",
        "ex x, y. x^3 + y^3 - {p}*x*y = {n} and x + y {O} a",
        "ex x, y. x^3 + y^3 = a and (all z. z {O} x*y or a*z {R} b)",
        "ex x, y. x^2 + y^2 {O} {p} and x*y {O} {L} and x + y {R} {n}",
    ),
    "homogeneous scaling": row(
        "ex x, y. x^3 + {s}*y^3 {O} 0 and x^2*y {<|>|=} 0",
        "ex x, y. x^2 + a*x*y {<|>} {s}*y^2 and x {O} {n}*y",
        "ex x, y, z. x^3 + {s}*y^2*z {O} 0 and a*x + y {O} {s}*z",
        "ex x, y. x^3 {O} {s}*y^3 and (all z. z {O} {0|x} or a*z {O} {s}*y)",
    ),
    "rotation of the axes": row(
        "ex x, y. x^2 + y^2 {=|O} a and (x^2 + y^2)^2 {R} {L}",
        "ex x, y. x^2 + y^2 {=|O} a and (all z. z*(x^2 + y^2) {R} b or z {O} a)",
        "{ex|all} x, y, u, v. {x*u + y*v|x*v - y*u} {R} a {and|or} x^2 + y^2 {R} {L} {and|or} u^2 + v^2 {O} {p}",
        "all x, y. x^2 + y^2 {O} a or (ex u, v. u = {2|3}*x and v = {2|3}*y and x*u + y*v {R} b)",
        "ex x, y, u, v. x*u + y*v {O} a and x^2 + y^2 {R} {p} and u^2 + v^2 {=|<=} b",
    ),
    "linear form named": row(
        "ex x, y. (a + b)*x + (a - b)*y = {s} and (a^2 - b^2)*x*y {R} p and x {O} {a|b|1}",
        "ex x, y. (a + b)*x - b*y = s and (a*x + y - b)*(a*x + y + c) {R} b and x {O} a",
        "ex x, y. a*x + (b + 1)*y = c and (a*x + y)^2 + c*(a*x + y) {O} b and x {O} {p}",
    ),
    "mirror images of a convex set": row(
        "ex p, q. all x. x < -1 or x > 1 or (x^3 + p*x + q <= {a|{p}} and x^3 + p*x + q >= -{a|{p}})",
        "ex x, y. x^2 + {p}*y^2 {=|<=} 0 and x*y = a",
        "ex p, q. p + q {O} a and p {<} b and q {<} b",
        "ex p. p {<} {L} and -p {<} {L}",
        "ex p. all x. x^2 {O} a or p*x {<|>} {L} or {p}*x {O} a",
    ),
    "nested blocks of one kind gathered": row(
        "ex x. x {O} a and ex y. x*y = {p} and y {O} {n}",
        "all x. x {O} a or (all y. x*y {O} 1 or y {O} x)",
        "ex x. x^2 {O} {L} and (ex y. y {R} x and y {O} b)",
    ),
    "disjuncts with equations apart": row(
        "ex x, y. x {O} b and (y = {p}*x or x = 2*y + a)",
        "ex x, y. (x = {L} and y {O} x or {p}*y = b and x {O} {n}) and x*y {R} {n}",
    ),
    "value that is taken": row(
        "ex x, y. (a^2 + 1)*x^5 - y*x = b and y^2 {O} {L}",
        "ex x. b {<|>} 0 and b*x^{3|4} + x {O} a",
        "ex x, y. {p}*x^3 + y*x + b {R} 0 and y {O} a",
        "a {<|>} 0 and (ex x. a*x^3 + b*x + {n} {O} 0)",
        "ex x, y. {p}*y^3 + x*y + a {R} 0 and {Q}",
    ),
    "equations taken apart": row(
        "ex x, y. a - {p}*b = 0 and (a + b)*x = c and y {O} x",
        "ex x, y. a - b = 0 and (a + {n})*x = {c|1}",
        "(a + b)*(a - {p}) = 0 and b - {p}*a = 0 and (ex x. a*x = c)",
    ),
    "inequations that remove no interior": row(
        "ex x, y. x*y {<|>} {p} and a*x + b*y /= 0 and x {<|>} y",
        "ex x. a*x^2 + b*x + {L} /= 0 and x /= {n}",
        "ex x. x {<|>} a and b*x + {n} /= 0",
        "ex x, y. x {<|>} a and b*y + x*y /= {n} and (all z. z /= x or a*z {O} b)",
    ),
    "virtual substitution": row("ex x. {L}*x^2 + b*x {O} {n} and x {O} a", "ex x, y. x*y {O} a and {s}*x + y {O} {L}"),
    "critical values": row(
        "ex x, y. (x - a)^2 + (y - {b|1})^2 <= {p} and x^2 + {p}*y^2 <= {4|1}",
        "ex x. (x - a)^2 {<=} {p} and x^2 + {n}*x <= 3 and {a <= 2|a + b <= {p}}",
        "ex x, y. x^2 + y^2 <= {p} and (x - a)^2 + y^2 <= {p} and x + y {<=|>=} {n}",
        method=Method.CRITICAL,
    ),
    "critical values of a universal block": row(
        "all t. 0 <= t and t <= 1 -> (a - t)^2 + (b - {s}*t^2)^2 <= {p}",
        "all t. 0 {<|<=} t and t {<|<=} 1 -> (1 - t)^2*a + {p}*t*(1 - t)*b + t^2 {>=|>} 0",
        "all t. 0 <= t and t <= {p} -> a*t - b <= {p} and b*t - a <= t^2",
        "all t. -1 <= t and t <= {p} -> a*t^2 - {s}*t <= {p}",
        method=Method.CRITICAL,
    ),
    "constant along directions": row(
        "all x. {0|-1} <= x and x <= 1 -> {s}*a + {s}*m + b*x <= x^2 and a*x + {s}*m*x + b <= {p}",
        "all x. -1 <= x and x <= {p} -> -m <= a + b*x + {s}*x^2 and a + b*x + {s}*x^2 <= m",
        method=Method.CRITICAL,
    ),
    "elimination set": row("ex x. a*x^2 + b*x {O} {L} and x {O} {n}", "ex x. {L}*x {O} b and x {O} a and x {R} {n}"),
    "infinity first": row(
        "all x. a*x^3 + b*x + {L} >= 0 or x = {n}",
        "ex x. a*x^{3|4} + b*x + {L} {<|>} 0{| and x {<|>} {n}}",
    ),
    "roots by signs": row(
        "ex x. x^4 + a*x^2 + b*x + {c|{n}} {=|<|<=} 0",
        "ex x. c*x^{3|4} + b*x + a {=|<|<=} 0",
        "ex x. {p}*x^3 + b*x + a {<|<=} 0 and x {>} {c|{n}}",
        "ex x. c*x^4 + b*x + a {=|<|<=} 0 and x {>} {n}",
    ),
    "open block": row(
        "ex x, y. x*y {<|>} {p} and a*x + b*y /= 0 and x {<|>} {s}*y",
        "ex x, y. (x^2 {<|>} a or x*y {<|>} b) and y {<|>} {s}*x + {L}",
    ),
    "instance": row(
        "all x. {p}*x^2 {>} {p} or x {O} {p}",
        "ex x, y. x*y {<|>} {p} and {s}*x + {s}*y /= 0 and x {<|>} y",
    ),
    "cells": row(
        "ex x. x^4 - a*x + {n} {R} 0",
        "ex x, y. x^2 + {p}*y^2 {O} {p} and x^3 {R} {s}*y and x*y {O} {n}",
        method=Method.CAD,
    ),
    "witness in the parameters": row(
        "all a, b. ex x. {p}*(x - a)^2 <= (a - b)^2 and {p}*(x - b)^2 <= (a - b)^2",
        "all a, b. ex x, y. x = a + {n} and y {>} b and x + y {>} {L}",
        "all a, b. ex x. (x - a)*(x - b) {<=} {p} and x {>=} {L}",
    ),
    "shorter": row(
        "ex x. a*x^2 + {s}*b*x + {L} = 0",
        "a^2 + {p}*b^2 {<} 1 and a*b {>} {p}",
        "ex x. x^2 + a*x + b {O} 0 and x {O} {n}",
    ),
    "covering": row(
        "ex x, y. x^2 + {p}*y^2 {O} {p} and x*y {O} {n}",
        "ex x. x^2 + {n}*x {O} {L} and x*b {O} {n}",
        "all x. ex y. x^2 + {s}*y^2 {O} {n} or x {O} y",
        method=Method.COVERINGS,
    ),
    "redundant part": row(
        "a*b {<|>} 0 and {a|b} /= 0 or a = {n} and b = {n}",
        "a^2 + b^2 {<} {p} and {a|b} {<} {p} + 1 and a {O} {n}",
        "a*b {<|>} {n} or a*b {<|>} {n} and b {R} {n}",
    ),
    "signs of factors": row(
        "a > 0 and b > 0 and c > 0 and (a + {p}*b - c)*(a - {p}*b + c)*(a - {p}*b - c) {<} 0",
        "a > 0 and b > 0 and c > 0 and ({p}*a + b - c)*({p}*a - b + c)*({p}*a - b - c) {<} 0",
        "a > {n} and b > 0 and c > 0 and (a - {n} + b - c)*(a - {n} - b + c)*(a - {n} - b - c) {<} 0",
    ),
    "constant": row(
        "a^2 + b^2 {<} {p} and a + b {>} {p} + 2",
        "a^2 + b^2 + c^2 <= 9 and (ex x, y, z. x + a = {4|5} and y + b = 9 and z + c = 9 and x^2 + y^2 + z^2 <= 9)",
        "a^2 + {p} {>} {n} - {p} and (ex x. x + a = b and x^2 + b^2 {>} -{p}) or a {O} {n}",
    ),
    "Boolean search": row(
        "ex x, y. (x > 1 or x*y > 1) and (x > {p} or x*y {<} 0) and (x {<} 0 or y > 2) and (x {<} {0|1} or y^2 {<} 1)",
        "ex x, y, z. "
        + " and ".join(["({x|y|z} {O} {x + y|y - z|x} + {n} or {x|y} {O} {n})"] * 14)
        + " and x*y {O} {n}",
        "ex x, y. " + " and ".join(["(x {O} {n} or {x + y|y} {O} {n})"] * 12),
    ),
    "branch and bound": row(
        "ex x, y, z, u. " + BETWEEN + " and x*y + {p}*z*u {>} {n} + 4 and x - y {O} {n} and x*z {<} {n}",
        "ex x, y, z, u. " + BETWEEN + " and (x*y {>} {n} or z*u^2 {<} {n}) and {s}*x + {s}*y*z {O} {n} and u^2 {>} x*y",
        "all x, y, z, u. " + BETWEEN + " -> x*y - {p}*z*u {<} {p} + {n} or x - z {>} {n}",
    ),
    "exchangeable variables in order": row(
        "ex x, y, z, u. " + BETWEEN + " and (x - y)^2 + (z - u)^2 {>} {n} + 1 and x*z + y*u {O} {n} + 1",
        "ex x, y, z, u. " + BETWEEN + " and x*y*z*u {>} {n} and x + y + z + u {<} {n}",
    ),
    "comprehensive Gröbner system": row(
        "ex x. x^2 + a*x + b = 0 and x {O} {n}",
        "ex x. {a|{s}}*x^2 + b*x + {s} = 0 and x {R} {n}",
        "ex x, y. x^2 + {p}*y^2 = a and {s}*x*y = {p}",
        "ex x. x^3 + a*x + {n} = 0 and x /= {n}",
        method=Method.CGS,
    ),
}
"""The rules, each with questions of its own."""

PRIMITIVES: dict[str, tuple[str, ...]] = {
    "signs": (
        *("simplification", "standard simplification", "case split on factors", "boundary apart"),
        *("signs by sums of squares", "Groebner basis of the equations", "multiple of an equation subtracted"),
    ),
    "quantifiers": ("square of a variable alone", "two variables exchanged", "value that is taken"),
    "steps": ("homogeneous scaling", "witness in the parameters"),
    "converse": ("two variables exchanged",),
    "no exception": ("constant", "redundant part", "signs of factors"),
    "terms": ("translation of the origin", "witness in the parameters"),
    "root": ("value that is taken",),
    "theorem": ("cubic on an interval", "quadric in a quadric", "roots in a half-plane", "two balls"),
}
"""Primitives of the kernel that are no rule of the engine: rules whose steps are made of them."""

STATED = frozenset(("classification", "multipliers", "parts", "solutions"))
"""Rules whose evidence says what stands before and after: ``tests/certificates`` has false claims of them."""

METHODS: dict[str, Row] = {
    "vs": RULES["virtual substitution"],
    "vs, cubic": row(
        "ex x. x^3 + a*x^2 + b*x {O} c and x {O} d and d*x {O} {s}",
        "ex x, y. x^3 + a*x + b {O} y and c*x {O} y and y {O} d",
    ),
    "cad": RULES["cells"],
    "critical": RULES["critical values"],
    "convex": row(
        "all x, y, z, u. x^2 + y^2 + {p}*z^2 + u^2 {>|>=} {n} - {p}",
        "ex x, y, z, u. x^2 + y^2 + z^2 + {p}*u^2 + {s}*x {<} {n}",
        "ex x, y. x^2 + {p}*y^2 {<} {p} and x + y {O} {p}",
        method=Method.CONVEX,
    ),
    "witness": RULES["witness in the parameters"],
    "samples": row(
        "all x, y. x^2 + {p}*y^2 {>} {n}",
        "ex x, y, z, u. x*y {>} {p} and z*u {<} x and x {>} {n} and y + u {<} {p}",
        "ex x, y, z, u. x*y {>} z^2 + {p} and z*u {>} {p} and x + y {<} 5 + {p} and (u^2 {<} x*y or x {>} 100)",
    ),
    "search": RULES["Boolean search"],
    "branching": RULES["branch and bound"],
    "cgs": RULES["comprehensive Gröbner system"],
    "coverings": RULES["covering"],
    "infinity first": RULES["infinity first"],
    "roots by signs": RULES["roots by signs"],
    "linear form named": RULES["linear form named"],
    "projection": RULES["projection"],
}
"""The methods, by the names that a log has for them."""
