"""Pictures, in floating point, for the eye only."""
