"""What is read off an elimination: formulas, regions, witnesses, optima."""
