"""Virtual substitution: elimination of existential blocks of degree at most 3 (after factoring), with answers. Higher
degrees belong to other methods.
"""
