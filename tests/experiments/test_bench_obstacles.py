"""The clearance benchmark: proofs agree with sampling where sampling can see, and see what it cannot."""

from __future__ import annotations

from bezier.obstacles.clearance import Contact, examine
from experiments.bench_obstacles import hidden_contacts, many_pairs, sampled_contact


def test_sampling_misses_the_contacts_that_were_hidden_from_it() -> None:
    for near in hidden_contacts():
        assert isinstance(examine(near.curve, near.obstacle), Contact), near.what
        assert not sampled_contact(near.curve, near.obstacle), near.what


def test_proofs_agree_with_sampling_on_random_pairs() -> None:
    row, pairs = many_pairs(curves=12, obstacles=10)
    assert len(pairs) == 120 and row.note.endswith("of 120 pairs meet")
    assert any(not clear for *_, clear in pairs)
    for curve, obstacle, clear in pairs:
        if sampled_contact(curve, obstacle):
            assert not clear
