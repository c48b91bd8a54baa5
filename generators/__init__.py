"""Procedural plant generators; they know only treefit.plant."""
