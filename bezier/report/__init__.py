"""The page of a plan. It shows what was decided, and decides nothing."""
