"""Fits parameters of procedural plant generators to one picture of a tree."""
