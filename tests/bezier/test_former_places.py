"""What the documents named before still imports, and is the same thing."""

from __future__ import annotations


def test_names_of_the_documents_at_their_former_places() -> None:
    import bezier.input.task
    import bezier.methods.cubic.existence
    import bezier.methods.single.formula
    from bezier.cubic.existence import existence, sentence, trivial_witness
    from bezier.single.formula import Symbol, eliminate
    from bezier.single.program import Axis, task

    assert (Axis, task) == (bezier.input.task.Axis, bezier.input.task.task)
    assert (Symbol, eliminate) == (bezier.methods.single.formula.Symbol, bezier.methods.single.formula.eliminate)
    moved = bezier.methods.cubic.existence
    assert (existence, sentence, trivial_witness) == (moved.existence, moved.sentence, moved.trivial_witness)


def test_the_command_is_found_at_its_place() -> None:
    from bezier.cli import main
    from bezier.cli.app import COMMANDS

    assert callable(main) and {name for name, *_ in COMMANDS} >= {"plan", "check", "clearance", "compare"}
