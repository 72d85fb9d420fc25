"""The models and bodies that a page of the manual runs, and what is drawn of them.

A comment after a model chooses in place of the defaults: `<!-- plot: crank.angle, rod.von_mises.max -->`, with `--against` and
other options of bielle-plot if needed, or `<!-- plot: none -->`; `<!-- picture: --view x --to 0.3 -->` has options of bielle-animate,
or `none`.
"""

import os
import re
import shlex
from dataclasses import dataclass, field

from ..messages import InputError
from .pages import BLOCK, FILE_NAME, blocks

PROGRAMS = {"bielle-mechanism": "model", "bielle-reduce": "body"}
READERS = ("bielle-table", "bielle-plot")
COMMENT = re.compile(r"^<!-- (plot|picture): (.+?) -->$", re.MULTILINE)
REPOSITORY_FILE = re.compile(r"\$BIELLE/([\w./-]+)")
IMAGE = re.compile(r"!\[[^\]]*\]\(([\w-]+\.(?:png|svg))\)")


@dataclass
class Example:
    """A file of a page and its first run.

    name: of the file; kind: `model` or `body`; words: of the command; output: file that the run writes; written, ended: numbers of the blocks of the
    file and of the last block of its run, from 0; quantities: words of bielle-plot; chosen: {plot, picture: words of a comment}.
    """

    name: str
    kind: str
    words: list
    output: str
    written: int
    ended: int
    quantities: list = field(default_factory=list)
    chosen: dict = field(default_factory=dict)


def examples_of(path):
    """The examples of a page, in order; none if it runs no file of its own."""
    with open(path, encoding="utf-8") as file:
        page = file.read()
    all_blocks, files, found, last = blocks(path), {}, [], None
    for number, block in enumerate(all_blocks):
        name = FILE_NAME.match(block.text)
        if block.language == "sh":
            last = _read_commands(block, number, files, found) or last
        elif block.language == "text":
            if last and last.ended == number - 1:
                last.ended = number
        elif name:
            files[name.group(1)] = number
    for comment in COMMENT.finditer(BLOCK.sub(lambda block: "\n" * block[0].count("\n"), page)):  # blocks may show comments
        line = comment.string.count("\n", 0, comment.start()) + 1
        example = next((each for each in reversed(found) if all_blocks[each.written].line < line), None)
        if example is None:
            raise InputError(f"{path}:{line}: no model that the page runs stands before '{comment.group(0)}'")
        example.chosen[comment.group(1)] = shlex.split(comment.group(2))
    return found


def _read_commands(block, number, files, found):
    """Adds the runs of a block of commands, and the quantities that they read. @returns the last example that they are about"""
    last = None
    for line in block.text.splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        if words[0] in PROGRAMS and len(words) > 1 and words[1] in files:
            last = _add_run(words, number, files, found) or last
        elif words[0] in READERS and len(words) > 1:
            last = next((each for each in found if each.output == words[1]), None) or last
            if last and last.output == words[1]:
                last.ended = number
                last.quantities += [word for option in ("--quantity", "--against") for word in _option(words, option)]
    return last


def _add_run(words, number, files, found):
    """Adds the first run of a file. @returns its example, or None"""
    written = files[words[1]]
    if "--check" in words or any(each.written == written for each in found):
        return None
    output = _option(words, "-o") or ["-o", os.path.splitext(words[1])[0] + ".h5"]
    found.append(Example(words[1], PROGRAMS[words[0]], words, output[1], written, number))
    return found[-1]


def _option(words, name):
    """[name, value] if an option stands among the words."""
    return words[words.index(name):][:2] if name in words[:-1] else []


def repository_files(path):
    """Files of the repository that the commands of a page use, relative to it."""
    return sorted({name for block in blocks(path) for name in REPOSITORY_FILE.findall(block.text)})


def images_of(path):
    """Names of the images that a page shows and its commands make."""
    with open(path, encoding="utf-8") as file:
        return IMAGE.findall(file.read())
