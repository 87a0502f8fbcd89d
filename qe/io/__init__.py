"""Readers and writers, a pair for every format. They say what a text means; no question is answered here."""
