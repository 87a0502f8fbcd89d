"""The page's template. No text is computed here."""
