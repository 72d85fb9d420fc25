"""Writes OUTPUT4 files in every layout of Nastran for tests of readers, without code of the product's writer."""

import struct

import numpy as np

LAYOUTS = ("dense", "big", "short")  # BIGMAT strings, strings with a header of one word


def strings(column):
    """Finds runs of values that are not zero. @returns list of (row from 1, values)"""
    found = []
    for row, value in enumerate(column, 1):
        if value == 0:
            continue
        if found and found[-1][0] + len(found[-1][1]) == row:
            found[-1][1].append(value)
        else:
            found.append((row, [value]))
    return found


def columns(matrix, layout):
    """Yields the number and the strings of each column that is not zero; a dense column has one string."""
    for number, column in enumerate(np.asarray(matrix).T, 1):
        if not column.any():
            continue
        rows = np.flatnonzero(column)
        yield number, [(rows[0] + 1, list(column[rows[0]:rows[-1] + 1]))] if layout == "dense" else strings(column)


def reals(values, kind):
    """Returns values as real numbers, with alternating real and imaginary parts if the type is complex."""
    return [part for value in values for part in ((value.real, value.imag) if kind > 2 else (value,))]


def binary(matrices, layout="dense", order="<", word=4, kind=2, form=6):
    """Returns the bytes of a file. @param matrices:  by name @param word:  bytes of an integer @param kind:  type, 1 to
    4"""
    integer = {4: "i", 8: "q"}[word]
    real = "f" if kind in (1, 3) and word == 4 else "d"
    words = struct.calcsize(real) // word

    def record(content):
        mark = struct.pack(order + "i", len(content))
        return mark + content + mark

    def integers(*numbers):
        return struct.pack(f"{order}{len(numbers)}{integer}", *numbers)

    data = b""
    for name, matrix in matrices.items():
        rows, count = np.shape(matrix)
        text = f"{name:8s}" if word == 4 else f"{name:8s}"[:4] + "    " + f"{name:8s}"[4:] + "    "
        data += record(integers(count, -rows if layout == "big" else rows, form, kind) + text.encode())
        for number, parts in columns(matrix, layout):
            content = b""
            for row, values in parts:
                numbers = reals(values, kind)
                length = words * len(numbers)
                head = {"dense": (), "big": (length + 1, row), "short": (65536 * (length + 1) + row,)}[layout]
                content += integers(*head) + struct.pack(f"{order}{len(numbers)}{real}", *numbers)
            data += record(integers(number, parts[0][0] if layout == "dense" else 0, len(content) // word) + content)
        data += record(integers(count + 1, 1, words) + struct.pack(order + real, 1.0))
    return data


def text(matrices, layout="dense", kind=2, form=6, numbers="1P,3E23.16", wide_header=False):
    """Returns the text of a file. @param numbers:  format of the numbers @param wide_header:  header with integers of
    16 characters"""
    style = numbers.rpartition(",")[2]
    letter = "E" if "E" in style else "D"
    per_line, width, decimals = int(style.split(letter)[0]), int(style.split(letter)[1].split(".")[0]), int(style.split(".")[1])
    words = 1 if kind in (1, 3) else 2

    def lines(values):
        texts = [f"{value:{width}.{decimals}E}".replace("E", letter) for value in values]
        return "".join("".join(texts[k:k + per_line]) + "\n" for k in range(0, len(texts), per_line))

    result = ""
    for name, matrix in matrices.items():
        rows, count = np.shape(matrix)
        size = 16 if wide_header else 8
        result += f"{count:{size}d}{-rows if layout == 'big' else rows:{size}d}{form:8d}{kind:8d}{name:8s}{numbers}{'|I16' if wide_header else ''}\n"
        for number, parts in columns(matrix, layout):
            body, total = "", 0
            for row, values in parts:
                several = reals(values, kind)
                length = words * len(several)
                body += {"dense": "", "big": f"{length + 1:8d}{row:8d}\n", "short": f"{65536 * (length + 1) + row:12d}\n"}[layout] + lines(several)
                total += len(several) if layout == "dense" else length + (2 if layout == "big" else 1)
            result += f"{number:8d}{parts[0][0] if layout == 'dense' else 0:8d}{total:8d}\n" + body
        result += f"{count + 1:8d}{1:8d}{1:8d}\n" + lines([1.0])
    return result
