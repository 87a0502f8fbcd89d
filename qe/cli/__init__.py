"""The command ``qe``."""
