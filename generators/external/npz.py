"""Npz: the arrays of a foreign tree are read with as few copies as can be, and none before its header was looked at."""

from __future__ import annotations

import io
import re
import struct
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from generators.external.arrays import FIELDS
from generators.external.faults import TooLarge

_LOCAL = struct.Struct("<26x2H")
"""What stands before each member of a zip file; the two numbers are the lengths of its name and of its extra."""

_PLAIN = re.compile(
    rb"\{'descr': '([<|][fiub]\d)', 'fortran_order': (False|True), 'shape': \((\d*),? ?(\d*),?\), \}\s*"
)
"""Header of an array as nearly all are written: ten times as fast as to let Python evaluate it."""

_LONGEST_HEADER = 2**12


def read_npz(file: Path, most: int) -> dict[str, NDArray[Any]]:
    """Arrays under the names of a Plant's fields in `file`; TooLarge when a header tells of more than `most` rows.

    What is not compressed is a view of the bytes of the file: they are neither copied nor summed up. ValueError or
    another of those of a damaged file when it is none of its kind; objects are never loaded.
    """
    content, found = file.read_bytes(), {}
    with zipfile.ZipFile(io.BytesIO(content)) as members:
        for member in members.infolist():
            name = member.filename.removesuffix(".npy")
            if name not in FIELDS or name in found:
                continue
            if member.compress_type == zipfile.ZIP_STORED:
                start = member.header_offset + _LOCAL.size + sum(_LOCAL.unpack_from(content, member.header_offset))
                shape, fortran, kind, header = _header(name, content[start : start + _LONGEST_HEADER], most)
                data = memoryview(content)[start + header : start + member.file_size]
            else:
                with members.open(member) as stream:
                    begin = stream.read(_LONGEST_HEADER)
                    shape, fortran, kind, header = _header(name, begin, most)
                    data = memoryview(begin[header:] + stream.read(int(np.prod(shape)) * kind.itemsize))
            count = int(np.prod(shape))
            if len(data) < count * kind.itemsize:
                raise ValueError(f"tree: {name} is cut: {len(data)} of {count * kind.itemsize} bytes")
            found[name] = np.frombuffer(data, kind, count).reshape(shape, order="F" if fortran else "C")
    return found


def _header(name: str, begin: bytes, most: int) -> tuple[tuple[int, ...], bool, np.dtype[Any], int]:
    """Shape, order, kind of number and length of the header that the array `name` has at the `begin` of its file."""
    stream = io.BytesIO(begin)
    version = npy.read_magic(stream)
    length = struct.unpack_from("<H", begin, 8)[0]
    plain = _PLAIN.fullmatch(begin, 10, 10 + length) if version == (1, 0) else None
    if plain is not None:
        shape = tuple(int(one) for one in plain.groups()[2:] if one)
        fortran, kind, end = plain[2] == b"True", np.dtype(plain[1].decode()), 10 + length
    else:
        shape, fortran, kind = (npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0)(stream)
        end = stream.tell()
    if shape and shape[0] > most:
        raise TooLarge(f"{name} has {shape[0]:,} rows, over generator.max_vertices={most}")
    if kind.hasobject or len(shape) > 2 or (len(shape) == 2 and shape[1] > 3):
        raise ValueError(f"tree: {name} must be numbers of shape (v,) or (v, 3), is {kind} {shape}")
    return shape, fortran, kind, end
