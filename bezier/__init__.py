"""Path planning with Bézier curves on top of the quantifier elimination engine ``qe``.

The package builds the formulas of Hatakeyama, Terui and Mikawa (SCSS 2024), hands them to ``qe`` and turns
the exact answers into proved paths, reports and pictures. It decides nothing by floating point.
"""
