"""What an answer rests on, as plain data."""
