"""Reading pictures and mask files: whatever Pillow can decode becomes a Picture or one clear line of error."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps

from treefit.image.picture import Picture
from treefit.mask import PALETTE, Mask, check_mask

PIXEL_LIMIT = 50_000_000
SIXTEEN_BIT_MODES = ("I", "I;16", "I;16B", "I;16L", "I;16N", "F")
INDEX_MODES = ("P", "L", "1")
COLOUR_MODES = ("P", "PA", "RGB", "RGBA", "CMYK", "YCbCr")
PALETTE_TOLERANCE, LEAST_IN_PALETTE = 48, 0.97
"""Greatest distance of a colour to one of PALETTE; share of the pixels that keep it: brushes have soft rims."""

HEIC_BRANDS = (b"heic", b"heix", b"hevc", b"heim", b"heis", b"mif1", b"msf1")


class PictureError(ValueError):
    """The picture cannot be used; the message is one line saying why and what to do instead."""


class NoTreeError(PictureError):
    """The picture can be used, but nothing in it looks like a tree."""


def read_picture(path: Path | str) -> Picture:
    """Picture at `path`, told by its content, upright, 8 bits a channel, composited on white."""
    path = Path(path)
    try:
        with _open(path) as image:
            notes = _notes(image)
            rgba = np.asarray(_eight_bits(ImageOps.exif_transpose(image)).convert("RGBA"))
    except PictureError:
        raise
    except Exception as error:  # Pillow's decoders raise nearly any exception on a damaged file
        raise PictureError(f"{path}: the picture is damaged or cut off ({_one_line(error)}); save it again") from error
    alpha = rgba[..., 3]
    rgb = _on_white(rgba)
    return Picture(rgb, None if (alpha == 255).all() else np.ascontiguousarray(alpha), notes, path)


def read_mask_file(path: Path | str) -> Mask:
    """Mask from an image file: pixel values 0 background, 1 branch, 2 foliage, or nearly the colours of PALETTE."""
    path = Path(path)
    try:
        with _open(path) as image:
            mode, values = image.mode, np.asarray(image)
            mask = _by_palette(image) if mode in COLOUR_MODES else None
    except PictureError:
        raise
    except Exception as error:  # as in read_picture
        raise PictureError(f"{path}: the mask file is damaged or cut off ({_one_line(error)})") from error
    if mask is not None:
        return mask
    if mode not in INDEX_MODES:
        raise PictureError(
            f"{path}: a mask file has pixel values 0 background, 1 branch, 2 foliage, or the colours (r, g, b) "
            f"{', '.join(str(colour) for colour in PALETTE)} of these; this file has mode {mode} and other colours"
        )
    try:
        return check_mask(values.astype(np.uint8))
    except ValueError as error:
        raise PictureError(f"{path}: {error}") from None


def _by_palette(image: Image.Image) -> Mask | None:
    """Mask by the nearest colours of PALETTE, what is transparent being background; None for other colours."""
    rgb = _on_white(np.asarray(image.convert("RGBA")))
    mask, nearest = np.zeros(rgb.shape[:2], np.uint8), np.full(rgb.shape[:2], 2**30, np.int32)
    for kind, colour in enumerate(PALETTE):
        distance = sum((rgb[..., channel].astype(np.int32) - colour[channel]) ** 2 for channel in range(3))
        mask[distance < nearest] = kind
        np.minimum(nearest, distance, out=nearest)
    return mask if (nearest <= PALETTE_TOLERANCE**2).mean() >= LEAST_IN_PALETTE else None


def write_mask(mask: Mask, path: Path | str) -> None:
    """Write `mask` as a palette PNG with pixel values 0, 1, 2, shown in the PALETTE colours."""
    image = Image.fromarray(check_mask(mask), mode="P")
    image.putpalette([channel for colour in PALETTE for channel in colour])
    image.save(Path(path), format="PNG", optimize=True)


def _open(path: Path) -> Image.Image:
    """Image with only its header read; PictureError when it must not or cannot be decoded."""
    if path.is_dir():
        raise PictureError(f"{path}: is a folder, not a picture")
    if not path.is_file():
        raise PictureError(f"{path}: no such file")
    if path.stat().st_size == 0:
        raise PictureError(f"{path}: the file is empty")
    try:
        with warnings.catch_warnings():
            # Pillow only warns above 89 megapixels; the limit below refuses earlier
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(path)
    except Image.DecompressionBombError:
        raise PictureError(_too_large(path, "far more")) from None
    except PermissionError:
        raise PictureError(f"{path}: no permission to read the file") from None
    except Exception as error:  # as in read_picture
        reason = "HEIC is not read" if _is_heic(path) else "not a picture that can be read"
        raise PictureError(f"{path}: {reason}; give a PNG, JPEG or WebP file") from error
    if image.width * image.height > PIXEL_LIMIT:
        image.close()
        raise PictureError(_too_large(path, f"{image.width} x {image.height} = {_millions(image)}"))
    if image.format == "EPS":  # decoding would start a foreign program
        image.close()
        raise PictureError(f"{path}: EPS is not read; save the picture as PNG")
    return image


def _is_heic(path: Path) -> bool:
    with path.open("rb") as file:
        start = file.read(12)
    return start[4:8] == b"ftyp" and start[8:] in HEIC_BRANDS


def _too_large(path: Path, found: str) -> str:
    return f"{path}: {found} megapixels, the limit is {PIXEL_LIMIT // 1_000_000}; make the picture smaller"


def _millions(image: Image.Image) -> str:
    return f"{image.width * image.height / 1e6:.0f}"


def _notes(image: Image.Image) -> tuple[str, ...]:
    frames = int(getattr(image, "n_frames", 1))
    # phones store a preview or a depth map as second picture of an MPO: nothing to tell
    return (f"animated: first of {frames} frames",) if frames > 1 and image.format != "MPO" else ()


def _eight_bits(image: Image.Image) -> Image.Image:
    """`image` with 8 bits a channel: Pillow clips grey values over 255 instead of scaling them."""
    if image.mode not in SIXTEEN_BIT_MODES:
        return image
    values = np.nan_to_num(np.asarray(image, dtype=np.float64))
    # integer grey is 16 bits deep unless it says otherwise; floating point is 0..1 when it fits
    top = max(1.0 if image.mode == "F" else 65535.0, float(values.max()))
    return Image.fromarray(np.clip(np.round(values * (255.0 / top)), 0, 255).astype(np.uint8))


def _on_white(rgba: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w, 3) uint8: colours under alpha 0 are leftovers and must not be seen."""
    image = Image.fromarray(rgba)
    return np.asarray(Image.alpha_composite(Image.new("RGBA", image.size, "white"), image).convert("RGB"))


def _one_line(error: Exception) -> str:
    return str(error).splitlines()[0] if str(error) else type(error).__name__
