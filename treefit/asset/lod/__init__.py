"""Levels of detail of one plant, down to crossed cards."""
