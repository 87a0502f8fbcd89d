"""The arithmetic of the checkers, which share none with the producers of answers."""
