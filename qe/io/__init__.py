"""Readers and writers, a pair for every format."""
