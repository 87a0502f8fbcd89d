"""The project's problem corpus: see README.md."""
