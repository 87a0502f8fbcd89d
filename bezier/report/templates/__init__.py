"""The pages' templates. No text is computed here."""
