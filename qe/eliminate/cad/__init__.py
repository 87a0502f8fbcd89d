"""Cylindrical algebraic decomposition: projection, lifting, and truth values on the cells."""
