"""Ways to write files that are no tree, or too much of one; the answer says that it is one."""

import io
import os
import struct
import time
import zipfile
import zlib

import numpy as np
from hostile.call import Call

MANY = 10**8


def no_file(call: Call) -> None:
    """Writes nothing."""
    call.answer()


def cut_file(call: Call) -> None:
    """Writes the first half of the file."""
    call.write(call.tree)
    os.truncate(call.file, call.file.stat().st_size // 2)
    call.answer()


def flipped_file(call: Call) -> None:
    """Writes a file with a few wrong bytes in the middle."""
    call.write(call.tree)
    content = bytearray(call.file.read_bytes())
    middle = len(content) // 2
    content[middle : middle + 64] = bytes(64)
    call.file.write_bytes(content)
    call.answer()


def garbage_file(call: Call) -> None:
    """Writes bytes that are no file of arrays."""
    call.file.write_bytes(bytes(range(256)) * 100)
    call.answer()


def empty_file(call: Call) -> None:
    """Writes a file of 0 bytes."""
    call.file.write_bytes(b"")
    call.answer()


def not_zip(call: Call) -> None:
    """Writes one array in the place of the archive."""
    with call.file.open("wb") as file:
        np.save(file, call.tree["position"])
    call.answer()


def pickle(call: Call) -> None:
    """Writes an array of objects, which makes a file where it is unpickled."""
    call.give(radius=np.array([_Trap(str(call.file.with_name("unpickled")))] * len(call.tree["radius"]), dtype=object))


def pickle_file(call: Call) -> None:
    """Writes a pickle in the place of the archive."""
    import pickle as package

    call.file.write_bytes(package.dumps(_Trap(str(call.file.with_name("unpickled")))))
    call.answer()


class _Trap:
    def __init__(self, path: str) -> None:
        self.path = path

    def __reduce__(self) -> tuple:
        return open, (self.path, "w")


def folder(call: Call) -> None:
    """Makes a folder in the place of the file."""
    call.file.mkdir()
    (call.file / "leaf").write_text("green")
    call.answer()


def fifo(call: Call) -> None:
    """Makes a pipe in the place of the file, which nobody writes to."""
    os.mkfifo(call.file)
    call.answer()


def device(call: Call) -> None:
    """Makes a link to /dev/zero in the place of the file."""
    call.file.symlink_to("/dev/zero")
    call.answer()


def huge_file(call: Call) -> None:
    """Writes a file of 1 TB, most of it holes."""
    call.write(call.tree)
    os.truncate(call.file, 10**12)
    call.answer()


def answer_first(call: Call) -> None:
    """Answers, and writes the tree 50 ms later."""
    call.answer()
    time.sleep(0.05)
    call.write(call.tree)


def many_claimed(call: Call) -> None:
    """Writes arrays whose heads promise 10^8 vertices, and no content."""
    with zipfile.ZipFile(call.file, "w") as archive:
        for name, array in call.tree.items():
            archive.writestr(f"{name}.npy", _head(array))
    call.answer()


def many_sparse(call: Call) -> None:
    """Writes 10^8 vertices at the origin, as holes of a file of 2 GB."""
    with call.file.open("wb") as file:
        _archive(file, {name: _stored(_head(a), _bytes(a)) for name, a in call.tree.items() if "leaf" not in name})
    call.answer()


def many_packed(call: Call) -> None:
    """Writes 10^8 vertices at the origin, packed into 2 MB."""
    with call.file.open("wb") as file:
        _archive(file, {name: _packed(_head(a), _bytes(a)) for name, a in call.tree.items() if "leaf" not in name})
    call.answer()


def _bytes(array: np.ndarray) -> int:
    return MANY * int(np.prod(array.shape[1:], dtype=int)) * array.itemsize


def _head(array: np.ndarray) -> bytes:
    """Return the head of an npy file of `array` with 10^8 rows."""
    head = io.BytesIO()
    shape = (MANY, *array.shape[1:])
    np.lib.format.write_array_header_1_0(head, {"descr": array.dtype.str, "fortran_order": False, "shape": shape})
    return head.getvalue()


def _stored(head: bytes, zeros: int) -> tuple[int, int, list[bytes | int]]:
    """Method and size of a member, and its parts: bytes, or how long a hole is."""
    return 0, len(head) + zeros, [head, zeros]


def _packed(head: bytes, zeros: int) -> tuple[int, int, list[bytes | int]]:
    """Return the same for a packed member: one packed megabyte again and again."""
    packer = zlib.compressobj(wbits=-15)
    start = packer.compress(head) + packer.flush(zlib.Z_FULL_FLUSH)
    block = packer.compress(bytes(1 << 20)) + packer.flush(zlib.Z_FULL_FLUSH)
    whole, rest = divmod(zeros, 1 << 20)
    return 8, len(head) + zeros, [start + block * whole + packer.compress(bytes(rest)) + packer.flush()]


def _archive(file: io.BufferedWriter, members: dict[str, tuple[int, int, list[bytes | int]]]) -> None:
    """Write a zip archive of `members` by name, without checksums: nobody should read so far as to need them."""
    directory = b""
    for name, (method, size, parts) in members.items():
        place, path = file.tell(), f"{name}.npy".encode()
        taken = sum(part if isinstance(part, int) else len(part) for part in parts)
        fields = struct.pack("<HHHHHIIIHH", 20, 0, method, 0, 0x21, 0, taken, size, len(path), 0)
        file.write(b"PK\3\4" + fields + path)
        directory += b"PK\1\2" + struct.pack("<H", 20) + fields + struct.pack("<HHHII", 0, 0, 0, 0, place) + path
        for part in parts:
            file.seek(part, os.SEEK_CUR) if isinstance(part, int) else file.write(part)
    place, count = file.tell(), len(members)
    file.write(directory + b"PK\5\6" + struct.pack("<HHHHIIH", 0, 0, count, count, len(directory), place, 0))
