"""The plain reader: the checkers of the kernel with arithmetic of plain Python in the place of FLINT."""
