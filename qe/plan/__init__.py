"""The choice of methods and variable orders; nothing here carries them out."""
