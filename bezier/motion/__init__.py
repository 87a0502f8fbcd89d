"""Motion along a path in time, with limits that hold at all times. The path itself is not changed here."""
