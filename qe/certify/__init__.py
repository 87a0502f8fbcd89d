"""The independent checker: certificates verified by code that produces no answers."""
