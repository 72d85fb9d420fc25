"""Lines of text files from other programs."""

from .messages import InputError


def lines_of(path, told=""):
    """@param told: text before the sentence, such as a place in another file. @raises InputError if it cannot be
    read"""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read().splitlines()
    except OSError as error:
        raise InputError(f"{told}cannot read '{path}': {error.strerror}") from None
