"""Frame: the window through which plants and pictures are compared, in units of plant height (sec. 4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from treefit.mask import BRANCH, FOLIAGE, Mask
from treefit.placing import place

WORD = 64  # pixels in a word of a bit row


@dataclass(frozen=True)
class Frame:
    """Window of `height` rows by `words` * 64 columns; the plant fills the height, the trunk base is in the middle."""

    height: int = 128
    words: int = 4

    def __post_init__(self) -> None:
        if not 16 <= self.height <= 2048 or not 1 <= self.words <= 128:
            raise ValueError(f"frame: height must be in [16, 2048], words in [1, 128], got {self.height}, {self.words}")

    @property
    def width(self) -> int:
        """Count of columns."""
        return self.words * WORD

    @property
    def half_width(self) -> float:
        """Half of the width in plant heights."""
        return self.width / (2 * self.height)

    def finer(self, height: int) -> Frame:
        """Return the frame with `height` rows that is at least as wide."""
        return Frame(height, -(-self.width * height // (self.height * WORD)))


def frame_for(mask: Mask, height: int, room: float = 1.5) -> Frame:
    """Frame that holds the tree of a mask and `room` times its reach to both sides."""
    return Frame(height, max(1, int(np.ceil(2 * room * place(mask).reach * height / WORD))))


def sample(mask: Mask, frame: Frame) -> Mask:
    """Mask (frame.height, frame.width) of the tree in `mask` (h, w), read at the centres of the frame's pixels."""
    at = place(mask)
    pixel = (at.bottom - at.top) / frame.height
    rows = (at.top + (np.arange(frame.height) + 0.5) * pixel).astype(int)
    columns = np.floor(at.base + (np.arange(frame.width) + 0.5 - frame.width / 2) * pixel).astype(int)
    inside = (columns >= 0) & (columns < mask.shape[1])
    sampled = mask[np.ix_(rows, np.clip(columns, 0, mask.shape[1] - 1))]
    return np.where(inside, sampled, 0).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class BitMask:
    """A mask as two planes (height, words) uint64 of bit rows; bit 0 of a word is its leftmost pixel."""

    branch: NDArray[np.uint64]
    foliage: NDArray[np.uint64]

    @classmethod
    def pack(cls, mask: Mask) -> BitMask:
        """Bit rows of a mask whose width is a multiple of 64."""
        return cls(_pack(mask == BRANCH), _pack(mask == FOLIAGE))

    def unpack(self) -> Mask:
        """Mask (height, words * 64) uint8."""
        return (_unpack(self.branch) * BRANCH + _unpack(self.foliage) * FOLIAGE).astype(np.uint8)


def _pack(pixels: NDArray[np.bool_]) -> NDArray[np.uint64]:
    if pixels.shape[1] % WORD:
        raise ValueError(f"bit rows: width must be a multiple of {WORD}, got {pixels.shape[1]}")
    packed = np.packbits(pixels, axis=1, bitorder="little")
    return np.ascontiguousarray(packed).view("<u8").astype(np.uint64)


def _unpack(words: NDArray[np.uint64]) -> NDArray[np.uint8]:
    return np.unpackbits(np.ascontiguousarray(words, "<u8").view(np.uint8), axis=1, bitorder="little")
