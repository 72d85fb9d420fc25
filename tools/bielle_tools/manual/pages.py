"""Pages of the manual whose files and commands are run.

In such a page a block of code is
- a file, if its first line is a comment with the name of the file: `# pendulum.yaml`, `// bar.geo`;
- commands, one per line, if its language is `sh`. Lines that only set variables of the shell (`export`) are for the reader;
- the output of the last command before it, if its language is `text`. A line `...` stands for lines that are left out;
  lines before the first and after the last of the block may be left out as well.
"""

import os
import re
import subprocess
from dataclasses import dataclass

from ..messages import InputError

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FILE_NAME = re.compile(r"(?:#|//) ([\w-]+\.\w+)\n")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
LONGEST = 900  # [s] for one command
TOLERANCE = 0.01  # relative, of numbers in output: pages show the digits of one compiler and one BLAS


@dataclass
class Block:
    """A block of code: its language, its text, and the number of its first line in the page, from 1."""

    language: str
    text: str
    line: int


def blocks(path):
    """The blocks of a page, in order."""
    with open(path, encoding="utf-8") as file:
        page = file.read()
    return [Block(match.group(1), match.group(2), page.count("\n", 0, match.start(2)) + 1) for match in BLOCK.finditer(page)]


def environment_of(repository, programs, tools):
    """The environment of the commands of pages: `$BIELLE` is the repository, programs, tools and the Python package are found."""
    return {**os.environ, "BIELLE": repository, "PATH": os.pathsep.join([programs, tools, os.environ.get("PATH", "")]),
            "PYTHONPATH": os.path.join(os.path.dirname(programs), "python")}


def run_page(path, folder, environment):
    """Writes the files of a page into a folder and runs its commands there.

    environment: of the commands; the programs and tools are on its PATH.
    @raises InputError naming page and line if a command fails, or if its output is not that of the page
    """
    output = None
    for block in blocks(path):
        name = FILE_NAME.match(block.text)
        if block.language == "sh":
            output = _run_commands(path, block, folder, environment)
        elif block.language == "text":
            _compare(path, block, output)
        elif name:
            with open(os.path.join(folder, name.group(1)), "w", encoding="utf-8") as file:
                file.write(block.text)


def _run_commands(path, block, folder, environment):
    """Runs the commands of a block. @returns the standard output of the last one"""
    output = ""
    for number, line in enumerate(block.text.splitlines()):
        if line.startswith("export ") or not line.strip():
            continue
        try:
            done = subprocess.run(["bash", "-c", line], cwd=folder, env=environment, capture_output=True, text=True, timeout=LONGEST,
                                  stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            raise InputError(f"{path}:{block.line + number}: '{line}' did not end within {LONGEST} s") from None
        if done.returncode:
            raise InputError(f"{path}:{block.line + number}: '{line}' ended with status {done.returncode}: {done.stderr.strip()}")
        output = done.stdout
    return output


def _compare(path, block, output):
    if output is None:
        raise InputError(f"{path}:{block.line}: output stands here, but no command before it")
    found, first = output.splitlines(), 0
    line = block.line
    for part in re.split(r"^\.\.\.\n", block.text, flags=re.MULTILINE):
        wanted = part.splitlines()
        place = next((i for i in range(first, len(found) - len(wanted) + 1)
                      if all(map(same_line, wanted, found[i:i + len(wanted)]))), None)
        if place is None:
            wrong = next((number for number, text in enumerate(wanted) if not any(same_line(text, other) for other in found)), 0)
            raise InputError(f"{path}:{line + wrong}: the command does not print '{wanted[wrong].strip()}'; it prints\n{output}")
        first = place + len(wanted)
        line += len(wanted) + 1


def same_line(wanted, found):
    """Whether two lines have the same words, and numbers that differ by at most TOLERANCE."""
    if " ".join(NUMBER.sub("#", wanted).split()) != " ".join(NUMBER.sub("#", found).split()):
        return False
    pairs = zip(map(float, NUMBER.findall(wanted)), map(float, NUMBER.findall(found)))
    return all(abs(one - other) <= TOLERANCE * max(abs(one), abs(other)) for one, other in pairs)
