"""Files that a command writes whole or not at all."""

import contextlib
import os

from .messages import InputError


@contextlib.contextmanager
def opened(path):
    """The file to write, in bytes. It is removed if that fails."""
    with open(path, "wb") as file:
        try:
            yield file
            file.flush()
        except BaseException:
            if os.path.isfile(path):
                os.unlink(path)
            raise


@contextlib.contextmanager
def replacing(path):
    """The path of a new file that replaces another one when it is complete. @raises InputError if it cannot be made"""
    partial = _new_file(path)
    try:
        yield partial
        os.replace(partial, path)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.remove(partial)
        raise


def _new_file(path):
    for number in range(1000):
        partial = f"{path}.{number}.part" if number else f"{path}.part"
        try:
            os.close(os.open(partial, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            return partial
        except FileExistsError:
            continue
        except OSError as error:
            raise InputError(f"cannot write '{path}': {error.strerror}") from None
    raise InputError(f"cannot write '{path}': there are a thousand files '{path}.*.part' already")
