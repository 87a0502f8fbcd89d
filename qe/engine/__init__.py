"""The loop from a formula to an answer, and the choice of methods."""
