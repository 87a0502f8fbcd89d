"""The project's problem corpus: data only, read by ``experiments.suites.corpus``; README.md explains the keys. Problems
under other people's licences are no part of it.
"""
