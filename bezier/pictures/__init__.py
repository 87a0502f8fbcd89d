"""Pictures, in floating point, for the eye only. No statement about a path rests on one."""
