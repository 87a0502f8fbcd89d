"""Virtual substitution: elimination of existential blocks of degree at most 2 (after factoring), with answers."""
