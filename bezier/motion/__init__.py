"""Motion along a path in time, with limits that hold at all times."""
