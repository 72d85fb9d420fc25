"""Arrays in one compressed container: `pack.add` returns their place, which the page decodes.

The container is one zlib stream of all arrays, in base64; equal arrays are stored once. 16-bit integers may be stored as
differences along the last axis, and all numbers of several bytes are stored byte by byte (first bytes of all numbers, then second
bytes, ..), which halves the compressed size of motions. Browsers since 2023 inflate the stream themselves (DecompressionStream).
"""

import base64
import hashlib
import zlib

import numpy as np

KINDS = {"f4": np.dtype("<f4"), "i4": np.dtype("<i4"), "i2": np.dtype("<i2"), "u2": np.dtype("<u2"), "i1": np.dtype("i1"), "u1": np.dtype("u1")}


class Pack:
    """A container that grows."""

    def __init__(self):
        self._pieces, self._places, self._size = [], {}, 0

    def add(self, values, kind, differences=False):
        """Stores an array as one of KINDS. @returns its place for the page: [offset, count, kind, length of the last axis if differences]"""
        values = np.ascontiguousarray(np.asarray(values).astype(KINDS[kind]))
        length = values.shape[-1] if differences and values.ndim and values.size else 0
        if length:
            first = np.diff(values.view(np.uint16), axis=-1, prepend=np.uint16(0))  # modulo 2^16
            stored = first.astype("<u2")
        else:
            stored = values
        width = values.dtype.itemsize
        data = stored.reshape(-1).view(np.uint8).reshape(-1, width).T.tobytes() if values.size else b""
        key = (hashlib.sha256(data).digest(), kind, length)
        if key not in self._places:
            self._places[key] = [self._size, int(values.size), kind, int(length)]
            self._pieces.append(data)
            self._size += len(data)
        return self._places[key]

    @property
    def size(self):
        """Bytes before compression."""
        return self._size

    def text(self):
        """The container in base64."""
        engine = zlib.compressobj(6)
        packed = b"".join([engine.compress(piece) for piece in self._pieces] + [engine.flush()])
        return base64.b64encode(packed).decode()


def quantised(values, axes):
    """16-bit numbers with a scale and an offset for each of the other axes: (integers, least, step) with value = least + step (integer + 32767).
    axes: those that share a scale. Values that are no numbers must have been replaced."""
    low, high = values.min(axis=axes, keepdims=True), values.max(axis=axes, keepdims=True)
    low = low.astype(np.float32).astype(float)
    step = np.maximum((high - low) / 65534, 0).astype(np.float32).astype(float)
    step = np.where(low + 65534 * step < high, np.nextafter(step.astype(np.float32), np.float32(np.inf)).astype(float), step)
    whole = np.clip(np.round((values - low) / np.where(step > 0, step, 1)), 0, 65534).astype(int) - 32767
    return whole.astype(np.int16), low, step
