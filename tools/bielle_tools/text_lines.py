"""Lines of text files of other programs."""

from .messages import InputError


def lines_of(path, told=""):
    """@param told: what goes before the sentence, a place in another file. @raises InputError where it cannot be read"""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read().splitlines()
    except OSError as error:
        raise InputError(f"{told}cannot read '{path}': {error.strerror}") from None
