"""The page's template."""
