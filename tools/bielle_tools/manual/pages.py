"""Pages of the manual whose files and commands are run.

In such a page a block of code is
- a file, if its first line is a comment with the name of the file: `# pendulum.yaml`, `// bar.geo`, `** bar.inp`;
- commands, one per line, if its language is `sh`. Lines that only set variables of the shell (`export`) are for the reader,
  and so is a block after a comment `<!-- not run: REASON -->`;
- the output of the last command before it, if its language is `text`. A line `...` stands for lines that are left out;
  lines before the first and after the last of the block may be left out as well.
A comment after a block of output, `<!-- closed form: sqrt(3*9.81) -->`, has an independent value of a number in its last
line, a Python expression with the names of `math`; `<!-- closed form within 0.01: .. -->` has its relative tolerance.
"""

import math
import os
import re
import subprocess
from dataclasses import dataclass

from ..messages import InputError

BLOCK = re.compile(r"(?:^<!-- not run: ([^\n]+) -->\n)?^```(\w*)\n(.*?)^```$(?:\n<!-- closed form(?: within (\S+))?: ([^\n]+) -->$)?", re.DOTALL | re.MULTILINE)
FILE_NAME = re.compile(r"(?:#|//|\*\*) ([\w-]+\.\w+)\n")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
LONGEST = 900  # [s] for one command
TOLERANCE = 0.01  # relative, of numbers in output: pages show the digits of one compiler and one BLAS
CLOSED_FORM_TOLERANCE = 1e-3  # relative, of the closed forms of which the page tells no other


@dataclass
class Block:
    """A block of code: its language, its text, and the number of its first line in the page, from 1.

    closed_form: an expression for a number of its last line, or None; within: its relative tolerance
    not_run: the reason why its commands are not run, or None
    """

    language: str
    text: str
    line: int
    closed_form: str | None = None
    within: float = CLOSED_FORM_TOLERANCE
    not_run: str | None = None


def blocks(path):
    """The blocks of a page, in order. @raises InputError if a comment about a block stands apart from it"""
    with open(path, encoding="utf-8") as file:
        page = file.read()
    matches = list(BLOCK.finditer(page))
    for mark, group in (("<!-- not run", 1), ("<!-- closed form", 5)):
        places = [found.start() for found in re.finditer("^" + mark, page, re.MULTILINE)]
        apart = [place for place in places if not any(match.group(group) and match.start() <= place < match.end() for match in matches)]
        if apart:
            line = page.count("\n", 0, apart[0]) + 1
            raise InputError(f"{path}:{line}: '{mark} ..' belongs to no block: expected it next to one, with a colon")
    return [Block(match.group(2), match.group(3), page.count("\n", 0, match.start(3)) + 1, match.group(5),
                  float(match.group(4) or CLOSED_FORM_TOLERANCE), match.group(1)) for match in matches]


def environment_of(repository, programs, tools):
    """The environment of the commands of pages: `$BIELLE` is the repository, programs, tools and the Python package are found."""
    return {**os.environ, "BIELLE": repository, "PATH": os.pathsep.join([programs, tools, os.environ.get("PATH", "")]),
            "PYTHONPATH": os.path.join(os.path.dirname(programs), "python")}


def run_page(path, folder, environment):
    """Writes the files of a page into a folder and runs its commands there.

    environment: of the commands; the programs and tools are on its PATH.
    @raises InputError naming page and line if a command fails, if its output is not that of the page, or if the output differs
        from a closed form
    """
    output = None
    for block in blocks(path):
        name = FILE_NAME.match(block.text)
        if block.not_run:
            output = None
        elif block.language == "sh":
            output = _run_commands(path, block, folder, environment)
        elif block.language == "text":
            last = _compare(path, block, output)
            if block.closed_form:
                _compare_closed_form(path, block, last)
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
    """@returns the line of the output that the last line of the block shows"""
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
    return found[first - 1]


def _compare_closed_form(path, block, line):
    """Compares the closed form with the number of a line that is nearest to it."""
    try:
        wanted = float(eval(block.closed_form, {"__builtins__": {}}, vars(math)))  # a page runs commands as well: it is trusted
    except (SyntaxError, NameError, TypeError, ValueError, ArithmeticError) as error:
        raise InputError(f"{path}:{block.line}: the closed form '{block.closed_form}' has no value: {error}") from error
    found = min(map(float, NUMBER.findall(line)), key=lambda number: abs(number - wanted), default=math.nan)
    if not abs(found - wanted) <= block.within * abs(wanted):
        raise InputError(f"{path}:{block.line}: the closed form {block.closed_form} is {wanted:.6g}, the command prints '{line.strip()}'")


def same_line(wanted, found):
    """Whether two lines have the same words, and numbers that differ by at most TOLERANCE."""
    if " ".join(NUMBER.sub("#", wanted).split()) != " ".join(NUMBER.sub("#", found).split()):
        return False
    pairs = zip(map(float, NUMBER.findall(wanted)), map(float, NUMBER.findall(found)))
    return all(abs(one - other) <= TOLERANCE * max(abs(one), abs(other)) for one, other in pairs)
