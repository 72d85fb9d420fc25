"""Makes a machine of the gallery: its bodies, runs, pictures, page and checks, in a folder."""

import dataclasses
import os
import shutil
import subprocess
import time

from ..programs import find_program

TOOLS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REPOSITORY = os.path.dirname(TOOLS)
LONGEST = 900  # [s] for one command
MODELS = "models"


class Failure(Exception):
    """A step of a machine that failed, in one sentence."""


@dataclasses.dataclass
class Made:
    """A machine with its outputs.

    checks: list of Check; failure: a sentence, empty if all commands succeeded; pictures, page: paths relative to the
    folder of the gallery.
    """

    name: str
    machine: object
    checks: list = dataclasses.field(default_factory=list)
    failure: str = ""
    pictures: list = dataclasses.field(default_factory=list)
    page: str = ""
    seconds: float = 0.0

    @property
    def passed(self):
        """Tells whether nothing failed and every check passed."""
        return not self.failure and bool(self.checks) and all(check.passed for check in self.checks)


def copy_models(folder):
    """Copies the models and their tables, which name bodies next to them, to the folder of the gallery."""
    target = os.path.join(folder, MODELS)
    os.makedirs(target, exist_ok=True)
    source = os.path.join(REPOSITORY, "mechanism", "examples")
    for name in os.listdir(source):
        if name.endswith((".yaml", ".csv")):
            shutil.copy(os.path.join(source, name), target)


def make(name, machine, folder):
    """Makes one machine. A step that fails ends it, with the failure in the result."""
    made, start = Made(name, machine), time.monotonic()
    os.makedirs(os.path.join(folder, name), exist_ok=True)
    try:
        for body in machine.bodies:
            reduce_body(body, folder)
        paths = {run: run_model(run, words, name, folder) for run, words in machine.runs.items()}
        made.pictures = [draw(picture, number, paths[picture.run], name, folder)
                         for number, picture in enumerate(machine.pictures, 1)]
        target = os.path.join(name, "machine.html")
        command([os.path.join(TOOLS, "bielle-view"), paths[machine.page], "-o", os.path.join(folder, target)])
        made.page = target
        made.checks = machine.check(paths)
    except Failure as error:
        made.failure = str(error)
    except Exception as error:  # pylint: disable=broad-except
        made.failure = f"its check failed: {type(error).__name__}: {error}"
    made.seconds = time.monotonic() - start
    return made


def reduce_body(body, folder):
    """Reduces a body next to the models."""
    command([find_program("bielle-reduce"), os.path.join(REPOSITORY, "meshes", body + ".yaml"), "--quiet", "-o",
             os.path.join(folder, MODELS, body + ".h5")])


def run_model(run, words, name, folder):
    """Runs a model and returns the path of its results."""
    target = os.path.join(folder, name, run + ".h5")
    command([find_program("bielle-mechanism"), os.path.join(folder, MODELS, words[0]), *words[1:], "--quiet", "-o",
             target])
    return target


def draw(picture, number, results, name, folder):
    """Draws a picture and returns its path relative to the folder."""
    target = os.path.join(name, f"picture_{number}.png")
    tool = os.path.join(TOOLS, picture.tool)
    if picture.figure:
        figures = os.path.join(folder, name, "figures")
        command([tool, results, "-o", figures, *picture.options])
        shutil.copy(os.path.join(figures, picture.figure), os.path.join(folder, target))
    else:
        command([tool, results, "-o", os.path.join(folder, target), *picture.options])
    return target


def command(words):
    """Runs a command with one thread. @raises Failure with its last line"""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}
    name = os.path.basename(words[0])
    try:
        done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=LONGEST,
                              env=environment, check=False)
    except subprocess.TimeoutExpired:
        raise Failure(f"{name} did not end within {LONGEST} s") from None
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        raise Failure(f"{name} failed: {lines[-1] if lines else f'exit status {done.returncode}'}")
