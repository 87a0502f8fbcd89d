"""Work in processes: under hard limits, side by side, raced."""
