"""The project's problem corpus: data only, read by ``experiments.suites.corpus``; README.md explains the keys."""
