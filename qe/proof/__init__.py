"""What an answer rests on, as plain data: cell tables, multipliers, certificates, the log of a run."""
