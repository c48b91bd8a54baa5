"""WeberPennGen, the model of Weber and Penn 1995 (sec. 6)."""

from generators.weberpenn.generator import WeberPennGen

__all__ = ["WeberPennGen"]
