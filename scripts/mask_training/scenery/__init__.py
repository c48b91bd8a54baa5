"""Scenery: what a painted scene is put together of, from leaves to the camera; knows no network."""
