"""Trajectories that others made, proved or refuted for all t: polynomials between exact times."""
