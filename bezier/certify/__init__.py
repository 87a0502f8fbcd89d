"""Checkers of the certificates about curves and arms, apart from whatever makes them: containment, clearance, branches,
joint positions. They read rational data only; how a curve or an arm is planned or solved belongs elsewhere."""
