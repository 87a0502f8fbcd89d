"""The parts of a disjunction solved one by one, each by steps of its own."""

from typing import Any

from tests.tables import each
from tests.unit.certify.claims import NO_LEMMAS, step, written
from tests.unit.proving.elaborated import refused

RULE = "alternatives"


def solved(piece: str, variable: str, equation: str, sign: int, after: str) -> list[Any]:
    evidence = {"solved": [[variable, equation, sign]], "theory": NO_LEMMAS}
    return [step("linear equation solved", f"ex {variable}. {piece}", after, evidence)]


def by(pieces: list[str], *parts: list[Any]) -> dict[str, Any]:
    return {"pieces": [written(p) for p in pieces], "parts": list(parts)}


TWO = "ex x. x = a and b > 0 or x = c and x > 1"
ONE, OTHER = "x = a and b > 0", "x = c and x > 1"
STEPS = solved(ONE, "x", "-a + x", 1, "b > 0"), solved(OTHER, "x", "-c + x", 1, "c > 1")


def test_the_disjunction_of_what_the_parts_lead_to() -> None:
    assert refused(RULE, TWO, "b > 0 or c > 1", by([ONE, OTHER], *STEPS)) == ""
    left = f"b > 0 or (ex x. {OTHER})"  # no step: the part stays as it is
    assert refused(RULE, TWO, left, by([ONE, OTHER], STEPS[0], [])) == ""


@each(
    (TWO, "b > 0", by([ONE, OTHER], *STEPS), "not the disjunction"),
    (TWO, "b > 0 and c > 1", by([ONE, OTHER], *STEPS), "not the disjunction"),
    (TWO, "b > 0", by([ONE], STEPS[0]), "not the parts"),
    (TWO, "b > 0 or c > 1", by([ONE, OTHER, "b < 0"], *STEPS, []), "not the parts"),
    (TWO, "b > 0 or c > 1", by([ONE, OTHER], STEPS[0]), "lists of steps"),
    (TWO, "b > 0 or c > 1", by([ONE, OTHER], *STEPS, []), "lists of steps"),
    (TWO, "b > 0 or c > 1", by([ONE, OTHER], STEPS[1], STEPS[0]), "does not stand there"),
    (TWO.replace("ex", "all"), "b > 0 or c > 1", by([ONE, OTHER], *STEPS), "existential block"),
)
def test_other_parts(before: str, after: str, evidence: Any, reason: str) -> None:
    assert refused(RULE, before, after, evidence), reason


def test_a_wrong_step_in_a_part_is_named() -> None:
    wrong = solved(OTHER, "x", "-c + x", 1, "c >= 1")
    found = refused(RULE, TWO, "b > 0 or c >= 1", by([ONE, OTHER], STEPS[0], wrong))
    assert found.startswith("evidence.parts[1][0]: linear equation solved")
