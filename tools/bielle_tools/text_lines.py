"""Lines of text files from other programs."""

from .messages import InputError


def lines_of(path, told=""):
    """Lines without their ends, of Unix, Windows or old Macs, and without the mark of UTF-8; letters of other encodings,
    which stand in comments, are replaced. @param told: text before the sentence, such as a place in another file.
    @raises InputError if it cannot be read"""
    try:
        with open(path, encoding="utf-8-sig", errors="replace") as file:
            return file.read().split("\n")
    except OSError as error:
        raise InputError(f"{told}cannot read '{path}': {error.strerror}") from None
