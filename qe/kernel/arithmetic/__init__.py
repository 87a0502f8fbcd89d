"""The arithmetic of the kernel, which shares none with the producers of answers: Sturm sequences, points, fibres. Only
facts about polynomials belong here, no judgement.
"""
