"""Every public function, with arguments with which it works."""

import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace

import qe
from qe.io import formats
from tests.wrong_values import WRONG

NUMBERS = {"int", "huge", "negative", "zero"}
REGION = qe.region("x^2 + y^2 <= 1")
CONVEX = qe.region("ex w. x^2 + y^2 + z^2 + u^2 + w^2 <= 1")
SOLVED = qe.eliminate("ex x. x^2 = 2")
WITNESS = qe.parametric_witnesses("ex x. x > a and x < b")[0]
SQUARE_ROOT = qe.RealAlgebraic.from_root([-2, 0, 1], 1, 2)
SYSTEM = qe.comprehensive_groebner(["a*x - 1"], "x", "a")
COUNTED = qe.real_root_classification(["a*x - 1"], "x", "a")
(X,) = qe.variables("x y")[:1]

HOLDS = SimpleNamespace(assertions=(), to_smt2=lambda: "(declare-const x Real)(assert (> x 0))")
"""What a solver of z3 tells of itself."""


@dataclass(frozen=True)
class Door:
    """A public function, arguments with which it works, and by argument which of the values above are no mistake."""

    call: Callable[..., object]
    given: Mapping[str, object]
    fine: Mapping[str, set[str]] = field(default_factory=dict)
    around: Mapping[str, Callable[[object], object]] = field(default_factory=dict)


EVERYWHERE = {
    "timeout": {"int", "float", "none"},
    "memory": {"none"},
    **{
        name: {"bool"}
        for name in ("root_atoms", "explain", "check", "process", "total_division", "anytime", "core", "generic")
    },
    **{name: {"bytes"} for name in ("formula", "left", "right", "other")},
    "assuming": {"none", "list", "bytes"},
    "order": {"none", "list"},
    "without": {"list", "dict"},
    "race": {"list", "dict"},
    "workers": {"int", "zero"},
    "cluster": {"none"},
}
"""What is no mistake for an argument of this name, unless a door says otherwise."""

BETWEEN = {"lo": {"negative", "zero", "float"}, "hi": {"int", "digits", "huge"}}
BOUND = {"assuming": {"none", "list"}}
"""The others speak of x, which is bound there."""

POINT = {"x": 0, "y": 0}
GOAL = {"objective": {*NUMBERS, "digits", "float"}, "constraints": {"list", "bytes"}, "parameters": {"none", "list"}}

TERMS = GOAL["objective"]
GOALS = qe.Solver()
GOALS.add("x > 0")
LEAST = GOALS.minimize("x")
GOALS.check()

DOORS = {
    "eliminate": Door(qe.eliminate, {"formula": "ex x. x^2 = a"}, BOUND),
    "decide": Door(qe.decide, {"formula": "ex x. x^2 = 2"}, {"formula": set(), **BOUND}),
    "find_instance": Door(qe.find_instance, {"formula": "x^2 = 2"}),
    "equivalent": Door(qe.equivalent, {"left": "x > 0", "right": "x > 0"}),
    "check_witness": Door(
        qe.check_witness, {"sentence": "ex x. x > 0", "witness": {"x": "1"}}, {"witness": {"dict"}, **BOUND}
    ),
    "check_witness term": Door(
        qe.check_witness,
        {"sentence": "ex x. x > 0", "witness": "1"},
        {"witness": {*NUMBERS, "digits", "float"}, **BOUND},
        {"witness": lambda value: {"x": value}},
    ),
    "parametric_witnesses": Door(qe.parametric_witnesses, {"formula": "ex x. x > a"}, {"formula": set(), **BOUND}),
    "comprehensive_groebner": Door(
        qe.comprehensive_groebner,
        {"polys": ["a*x - 1"], "variables": "x", "parameters": "a", "constants": {}},
        {
            "parameters": {"none"},
            "constants": {"none", "dict"},
            "order": set(),
            "faithful": {"bool"},
            "assuming": {"none", "list"},
            **{name: {"list"} for name in ("equal", "nonzero")},
        },
    ),
    "real_root_classification": Door(
        qe.real_root_classification,
        {"polys": ["a*x - 1"], "variables": "x", "parameters": "a", "constants": {}},
        {
            "parameters": {"none"},
            "constants": {"none", "dict"},
            "assuming": {"none", "list"},
            **{name: {"list"} for name in ("equal", "nonzero", "positive")},
        },
    ),
    "exists": Door(qe.exists, {"variables": "x", "body": "x > y"}, {"variables": {"text", "digits"}}),
    "forall": Door(qe.forall, {"variables": "x", "body": "x > y"}, {"variables": {"text", "digits"}}),
    "variables": Door(qe.variables, {"names": "x y"}, {"names": {"text", "digits"}}),
    "from_z3": Door(qe.from_z3, {"given": HOLDS}),
    "region": Door(qe.region, {"formula": "x > 0"}, {"order": {"none"}}),
    "region order": Door(
        qe.region, {"formula": "x > 0", "order": "y"}, {"order": {"text", "digits"}}, {"order": lambda v: ["x", v]}
    ),
    "minimize": Door(qe.minimize, {"objective": "x"}, GOAL),
    "maximize": Door(qe.maximize, {"objective": "-x"}, GOAL),
    "minimize list": Door(
        qe.minimize,
        {"objective": "x", "constraints": "x > 0"},
        {"constraints": {"bytes"}},
        {"constraints": lambda value: ["x > 1", value]},
    ),
    "verify": Door(
        qe.verify, {"certificate": SOLVED.certificate}, {"formula": {"none", "bytes"}, "assuming": set(WRONG)}
    ),
    "Exists": Door(qe.Exists, {"variables": "x", "body": REGION.formula}, {"variables": {"text", "digits"}}),
    "ForAll": Door(qe.ForAll, {"variables": ["x"], "body": REGION.formula}, {"variables": {"text", "digits"}}),
    "Certificate.from_json": Door(qe.Certificate.from_json, {"text": SOLVED.certificate.to_json()}),
    "Certificate.to_json": Door(SOLVED.certificate.to_json, {"indent": 1}, {"indent": {"int", "zero", "none"}}),
    "Region.from_json": Door(qe.Region.from_json, {"text": REGION.to_json()}),
    "Region.contains": Door(REGION.contains, {"point": POINT}),
    "Region.contains value": Door(
        REGION.contains, {"point": 0}, {"point": {*NUMBERS, "float", "digits"}}, {"point": lambda v: {"x": v, "y": 0}}
    ),
    "Region.fibre": Door(REGION.fibre, {"prefix": [0]}, {"prefix": {"list", "dict"}}),
    "Region.fibre value": Door(
        REGION.fibre, {"prefix": 0}, {"prefix": {*NUMBERS, "float", "digits"}}, {"prefix": lambda v: [v]}
    ),
    "Region.bounds": Door(REGION.bounds, {"variable": "x"}),
    "Region.sample_points": Door(REGION.sample_points, {}),
    "Region.is_subset": Door(REGION.is_subset, {"other": "x < 2"}),
    "Region.complement": Door(REGION.complement, {}),
    "Region.closure": Door(REGION.closure, {}),
    "Region.components": Door(REGION.components, {}),
    "Region.bounding_box": Door(REGION.bounding_box, {}),
    "Region.project": Door(REGION.project, {"variables": "y"}),
    "Region.section": Door(REGION.section, {"values": {"x": 0}}, {"values": {"dict"}}),
    "Region.section value": Door(
        REGION.section, {"values": 0}, {"values": {*NUMBERS, "float", "digits"}}, {"values": lambda v: {"x": v}}
    ),
    "Region.distance": Door(REGION.distance, {"point": POINT}),
    "Region.distance value": Door(
        REGION.distance,
        {"point": 0},
        {"point": {*NUMBERS, "float", "digits"}},
        {"point": lambda v: [min(v, 10**9) if type(v) is int else v, 0]},
    ),
    "Region.exact_volume": Door(REGION.exact_volume, {}),
    "Region.sample": Door(REGION.sample, {"seed": 1}, {"seed": NUMBERS}),
    "Region.find_instances": Door(REGION.find_instances, {"n": 2, "seed": 1}, {"n": {"int", "zero"}, "seed": NUMBERS}),
    "Region.interior": Door(REGION.interior, {}),
    "Region.boundary": Door(REGION.boundary, {}),
    "Region.equals": Door(REGION.equals, {"other": "x < 2"}),
    "Region.is_disjoint": Door(REGION.is_disjoint, {"other": "x < 2"}),
    "find": Door(qe.find, {"formula": "x > y", "n": 2, "seed": 1}, {"n": {"int", "zero"}, "seed": NUMBERS}),
    "witnesses": Door(qe.witnesses, {"formula": "ex x. x > a"}, {"formula": set(), **BOUND}),
    "optimum": Door(qe.optimum, {"objective": "x"}, GOAL),
    "Solver": Door(qe.Solver, {}),
    "Solver.add": Door(lambda formula: qe.Solver().add(formula), {"formula": "x > 0"}),
    "Solver.assert_and_track": Door(
        qe.Solver().assert_and_track, {"formula": "x > 0", "name": "n"}, {"name": {"text", "digits", "empty"}}
    ),
    "Solver.check": Door(lambda formula: qe.Solver().check(formula), {"formula": "x > 0"}),
    "Solver.minimize": Door(lambda term: qe.Solver().minimize(term), {"term": "x"}, {"term": TERMS}),
    "Solver.maximize": Door(lambda term: qe.Solver().maximize(term), {"term": "x"}, {"term": TERMS}),
    "Solver.lower": Door(GOALS.lower, {"objective": LEAST}),
    "Solver.upper": Door(GOALS.upper, {"objective": LEAST}),
    "Solver.pop": Door(qe.Solver().pop, {"num": 0}, {"num": {"zero"}}),
    "simplify": Door(qe.simplify, {"formula": "x > 0 or x > y"}),
    "reduce": Door(qe.reduce, {"formula": "x > y"}, {"variables": {"none", "text", "digits", "list"}}),
    "solve": Door(qe.solve, {"formula": "x > y", "variables": "y"}, {"variables": {"none", "text", "digits", "list"}}),
    "find_instances": Door(
        qe.find_instances, {"formula": "x > y", "n": 2, "seed": 1}, {"n": {"int", "zero"}, "seed": NUMBERS}
    ),
    "Answer.plot": Door(
        qe.eliminate("x^2 < a").plot,
        {"path": os.path.join(tempfile.gettempdir(), "answer-of-a-test.png")},
        {"path": {"none"}, "ax": {"none"}, "order": {"none"}},
    ),
    "ParametricOptimum.at": Door(qe.minimize("x^2 + a*x", parameters="a").at, {"parameters": {"a": 1}}),
    "ParametricOptimum.to_json": Door(
        qe.minimize("x^2 + a*x", parameters="a").to_json, {"indent": 2}, {"indent": {"int", "zero", "none"}}
    ),
    "Region.within": Door(REGION.within, {"condition": REGION.formula}),
    "Region.volume": Door(REGION.volume, {"rel_error": 0.5}, {"rel_error": {"float"}}),
    "Region.plot": Door(
        REGION.plot,
        {"path": os.path.join(tempfile.gettempdir(), "region-of-a-test.png")},
        {"path": {"none"}, "ax": {"none"}},
    ),
    "ConvexRegion.contains": Door(CONVEX.contains, {"point": dict.fromkeys("xyzu", 0)}),
    "ConvexRegion.fibre": Door(CONVEX.fibre, {"prefix": [0]}, {"prefix": {"list", "dict"}}),
    "ConvexRegion.bounds": Door(CONVEX.bounds, {"variable": "x"}),
    "ParametricWitness.at": Door(WITNESS.at, {"parameters": {"a": 0, "b": 1}}),
    "ParametricWitness.at value": Door(
        WITNESS.at,
        {"parameters": 1},
        {"parameters": {"int", "negative", "zero", "float", "digits"}},
        {"parameters": lambda v: {"a": v, "b": 11}},
    ),
    "RealAlgebraic.from_root": Door(
        qe.RealAlgebraic.from_root, {"coefficients": [-2, 0, 1], "lo": 1, "hi": 2}, BETWEEN
    ),
    "RealAlgebraic.from_root coefficient": Door(
        qe.RealAlgebraic.from_root,
        {"coefficients": -1, "lo": 0, "hi": 1},
        {"coefficients": {"negative", "zero"}},
        {"coefficients": lambda value: [value, 1]},
    ),
    "RealAlgebraic.rational": Door(
        qe.RealAlgebraic.rational, {"value": 1}, {"value": {*NUMBERS, "float", "digits", "bool"}}
    ),
    "RealAlgebraic.interval": Door(SQUARE_ROOT.interval, {"bits": 8}, {"bits": {"int", "zero"}}),
    "ComprehensiveGroebnerSystem.at": Door(SYSTEM.at, {"point": {"a": 2}}),
    "ComprehensiveGroebnerSystem.basis_at": Door(SYSTEM.basis_at, {"point": {"a": 2}}),
    "ComprehensiveGroebnerSystem.certificate_at": Door(
        SYSTEM.certificate_at, {"point": {"a": 2}, "positive": []}, {"positive": {"list"}}
    ),
    "ComprehensiveGroebnerSystem.condition": Door(SYSTEM.condition, {"segment": SYSTEM.at({"a": 2})}),
    "ComprehensiveGroebnerSystem.contains": Door(
        SYSTEM.contains, {"poly": SYSTEM.basis_at({"a": 2})[0], "point": {"a": 2}}, {"poly": {"digits"}}
    ),
    "ComprehensiveGroebnerSystem.from_json": Door(qe.ComprehensiveGroebnerSystem.from_json, {"text": SYSTEM.to_json()}),
    "ComprehensiveGroebnerSystem.place": Door(SYSTEM.place, {"point": {"a": 2}}),
    "ComprehensiveGroebnerSystem.place value": Door(
        SYSTEM.place, {"point": 2}, {"point": {*NUMBERS, "float", "digits"}}, {"point": lambda v: {"a": v}}
    ),
    "ComprehensiveGroebnerSystem.solutions_at": Door(SYSTEM.solutions_at, {"point": {"a": 2}}),
    "ComprehensiveGroebnerSystem.to_json": Door(SYSTEM.to_json, {"indent": 1}, {"indent": {"int", "zero", "none"}}),
    "RealRootClassification.from_json": Door(qe.RealRootClassification.from_json, {"text": COUNTED.to_json()}),
    "RealRootClassification.to_json": Door(COUNTED.to_json, {"indent": 1}, {"indent": {"int", "zero", "none"}}),
    "RealRootClassification.at": Door(COUNTED.at, {"point": {"a": 2}}),
    "RealRootClassification.certificate_at": Door(COUNTED.certificate_at, {"point": {"a": 2}}),
    "RealRootClassification.condition": Door(COUNTED.condition, {"count": 1}, {"count": {"zero"}}),
    "Expression.equals": Door(X.equals, {"other": 1}, {"other": {*NUMBERS, "float", "digits"}}),
    "Expression.differs": Door(X.differs, {"other": 1}, {"other": {*NUMBERS, "float", "digits"}}),
    "Statement.substitute": Door((X > 0).substitute, {"values": {"x": 1}}, {"values": {"dict"}}),
    "Statement.substitute value": Door(
        (X > 0).substitute,
        {"values": 1},
        {"values": {*NUMBERS, "float", "digits"}},
        {"values": lambda value: {"x": value}},
    ),
    "formats.read": Door(formats.read, {"text": "x > 0"}, {"total_division": {"bool"}}),
    "formats.write": Door(formats.write, {"formula": REGION.formula}, {"formula": set()}),
}
