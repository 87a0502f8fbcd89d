"""From what was found to certificates: evidence for the steps of a derivation. Nothing made here is trusted. What
checks it is in ``qe.kernel`` and imports none of this.
"""
