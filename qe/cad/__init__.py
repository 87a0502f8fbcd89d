"""Cylindrical algebraic decomposition, the shared machinery: projection, constraints, order, stacks, lifting."""
