"""Reading a cell table: formulas, extended formulas, pieces, fibres, truth."""
