"""What has to be believed: few primitive inferences, each with its theorem. What makes proofs belongs elsewhere.

One judgement: where the facts of a place hold, A <-> B over the real numbers.
"""
