"""RPC III files of MTS, which test rigs and programs for fatigue read: channels at even steps in single precision.

A header of 128-byte parameters (32 bytes for the name, 96 for the value) in blocks of 512 bytes; then groups, in each
of them the points of channel 1, of channel 2, and so on. Here a group is one frame. The last frame is filled up with
the last values of the channels.
Reference: MTS Systems, RPC III file format (parameters FORMAT, NUM_HEADER_BLOCKS .. PART.NCHAN_1).
"""

import numpy as np

FRAME = 1024  # points


def write_rpc(file, step, names, units, values):
    """Writes values (n, channels) at even steps [s] to an open binary file. @returns the number of points that fill up
    the last frame"""
    points, channels = values.shape
    frames = -(-points // FRAME)
    filled = np.concatenate([values, np.repeat(values[-1:], frames * FRAME - points, axis=0)]).astype("<f4")
    file.write(_header(step, names, units, values, frames))
    file.write(np.ascontiguousarray(filled.reshape(frames, FRAME, channels).transpose(0, 2, 1)).tobytes())
    return frames * FRAME - points


def _header(step, names, units, values, frames):
    words = {"FORMAT": "BINARY_IEEE_LITTLE_END", "NUM_HEADER_BLOCKS": "", "NUM_PARAMS": "", "FILE_TYPE": "TIME_HISTORY",
             "TIME_TYPE": "RESPONSE", "DELTA_T": repr(float(step)), "CHANNELS": len(names), "PTS_PER_FRAME": FRAME,
             "PTS_PER_GROUP": FRAME, "FRAMES": frames, "REPEATS": 1, "HALF_FRAMES": 0, "DATA_TYPE": "FLOATING_POINT",
             "INT_FULL_SCALE": 32768, "PARTITIONS": 1, "PART.NCHAN_1": len(names), "OPERATION": "BIELLE"}
    for number, (name, unit, column) in enumerate(zip(names, units, values.T), start=1):
        words.update({f"DESC.CHAN_{number}": name, f"UNITS.CHAN_{number}": unit, f"SCALE.CHAN_{number}": 1.0,
                      f"LOWER_LIMIT.CHAN_{number}": repr(float(column.min())),
                      f"UPPER_LIMIT.CHAN_{number}": repr(float(column.max())),
                      f"PART.CHAN_{number}": 1, f"MAP.CHAN_{number}": number})
    blocks = -(-len(words) // 4)
    words.update({"NUM_HEADER_BLOCKS": blocks, "NUM_PARAMS": len(words)})
    cells = [_cell(name, 32) + _cell(str(value), 96) for name, value in words.items()]
    return b"".join(cells).ljust(512 * blocks, b"\0")


def _cell(text, width):
    """Text in a field that ends with a zero; characters beyond Latin-1 become `?`."""
    return text.encode("latin-1", "replace")[:width - 1].ljust(width, b"\0")
