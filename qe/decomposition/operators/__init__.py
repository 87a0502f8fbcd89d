"""Projection operators: what one is, each as a value in a file of its own, and the table of them by name.

How sets are projected, cells lifted and tables proved by what such a value says stands elsewhere, and names none."""
