"""Files that a command writes whole or not at all."""

import contextlib
import os


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
