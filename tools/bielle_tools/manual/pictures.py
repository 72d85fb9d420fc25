"""Pictures of the examples of a page: the machine at a telling instant, a mode, a curve. Commands of Bielle draw them."""

import csv
import os
import re
import shutil
import subprocess
from dataclasses import asdict, dataclass, replace

import numpy as np
from PIL import Image

from ..messages import InputError
from ..results.results_file import Results, modes_to_show
from .body_model import SHOWN, body_model
from .moment import telling_moment
from .pages import LONGEST

LEAST_INK = 400         # pixels that differ from white; a picture with fewer shows nothing
HEADING = 40            # [pixels] lines of a picture that hold its title
LEAST_ROWS = 5          # of a curve
LEAST_CHANGE = 1e-6     # of a curve, relative to its largest value
MOST_MEASURES = 3       # number of measures in a plot if the page does not choose any
SIZE = "800x500"
CURVE = "_plot.svg"      # end of the name of a curve
FEW_ROWS = re.compile(r"^output: \{every: \d+\}\n", re.MULTILINE)
FIGURES = {"campbell": "campbell", "frequency_response": "frequency_response"}  # group of the results: figure of bielle-plot


@dataclass
class Picture:
    """name of the file; alt: text in place of it; after: number of the block of the page that it follows, None for one that the page
    itself shows."""

    name: str
    alt: str
    after: int

    def described(self):
        """As plain data."""
        return asdict(self)


class Artist:
    """Draws the examples of pages."""

    def __init__(self, tools, environment):
        """tools: folder of the commands; environment: of them, with the programs on its PATH"""
        self.tools, self.environment = tools, environment

    def draw(self, example, stem, folder, target):
        """The pictures of an example that was run in `folder`, made in the folder `target`: a list of Picture.
        stem: first word of their names"""
        if not os.path.isfile(os.path.join(folder, example.output)):
            return []
        base = f"{stem}_{os.path.splitext(example.name)[0]}"
        if example.kind == "body":
            return self._body(example, base, folder, target)
        example = self._with_all_rows(example, folder)
        with Results(os.path.join(folder, example.output)) as results:
            facts = Facts(results)
        found = []
        machine = self._machine(example, facts, folder, os.path.join(target, base + ".png"))
        if machine:
            found.append(Picture(base + ".png", machine, example.written))
        curve = self._curve(example, facts, folder, os.path.join(target, base + CURVE))
        if curve:
            found.append(Picture(base + CURVE, curve, example.ended))
        return found

    def _body(self, example, base, folder, target):
        """The first vibration of a body that is free; no picture of one without a mesh."""
        model = body_model(os.path.join(folder, example.output))
        if not model or example.chosen.get("picture") == ["none"]:
            return []
        name = f"drawn_{example.output}"
        with open(os.path.join(folder, name + ".yaml"), "w", encoding="utf-8") as file:
            file.write(model)
        self.run(["bielle-mechanism", name + ".yaml", "--quiet", "-o", name], folder)
        path = os.path.join(target, base + ".png")
        options = example.chosen.get("picture") or ["--mode", str(SHOWN)]
        self._animate(os.path.join(folder, name), path, options, folder)
        return [Picture(base + ".png", f"The body of {example.name}: its first vibration without supports", example.written)]

    def _animate(self, results, path, options, folder):
        self.run([os.path.join(self.tools, "bielle-animate"), results, "-o", path, "--frames", "1", "--size", SIZE, *options], folder)
        check_ink(path)

    def _with_all_rows(self, example, folder):
        """The example, or one with all rows if its page records few of them so that it prints few."""
        with open(os.path.join(folder, example.name), encoding="utf-8") as file:
            model = file.read()
        if not FEW_ROWS.search(model):
            return example
        name, output = "all_rows_of_" + example.name, "all_rows_of_" + example.output
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(FEW_ROWS.sub("", model))
        options = [word for word in example.words[2:] if word not in ("-o", example.output)]
        self.run([example.words[0], name, *options, "-o", output], folder)
        return replace(example, output=output)

    def _machine(self, example, facts, folder, path):
        """Draws the machine. @returns its text, empty without a picture"""
        options = example.chosen.get("picture")
        if options == ["none"]:
            return ""
        results = os.path.join(folder, example.output)
        if options is None:
            options = self._options(facts, results)
        if options is None:
            return ""
        self._animate(results, path, ["--labels", *options], folder)
        return f"{facts.title}: the machine of {example.name}, {_view_of(options, facts)}"

    @staticmethod
    def _options(facts, results):
        """Options of bielle-animate, or None if there is nothing to draw."""
        if facts.modes and not facts.moves:
            return ["--mode", str(facts.first_elastic)]
        moment = telling_moment(results)
        if moment is None:
            return ["--mode", str(facts.first_elastic)] if facts.modes else None
        time = repr(moment[0])
        return [f"--from={time}", f"--to={time}", *(["--ghost"] if moment[1] else [])]

    def _curve(self, example, facts, folder, path):
        """Draws a figure of what the page reads from the run, or of what it computes. @returns its text, empty without one"""
        options = example.chosen.get("plot")
        if options == ["none"]:
            return ""
        plot = [os.path.join(self.tools, "bielle-plot"), os.path.join(folder, example.output), "--format", "svg"]
        figures = os.path.splitext(path)[0] + "-figures"
        if not options and facts.figure:
            self.run([*plot, "-o", figures], folder)
            return f"{facts.title}: {facts.figure.replace('_', ' ')}" if _take(figures, facts.figure, path) else ""
        if options and not options[0].startswith("-"):
            options = ["--quantity", " ".join(options)]
        options = options or example.quantities or facts.quantities
        if not options or facts.rows < LEAST_ROWS and "plot" not in example.chosen:
            return ""
        table = os.path.splitext(path)[0] + ".csv"
        self.run([*plot, "-o", figures, *options, "--csv", table], folder)
        changes = _changes(table)
        os.unlink(table)
        taken = _take(figures, "", path) if changes else shutil.rmtree(figures)
        names = [word for option, word in zip(options, options[1:]) if option == "--quantity"]
        over = [word for option, word in zip(options, options[1:]) if option == "--against"]
        return f"{facts.title}: {', '.join(names)} over {over[0] if over else facts.axis}" if taken else ""

    def run(self, words, folder):
        """Runs a command. @raises InputError if it fails"""
        said = " ".join([os.path.basename(words[0]), *words[1:]])
        try:
            done = subprocess.run(words, cwd=folder, env=self.environment, capture_output=True, text=True, timeout=LONGEST, stdin=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            raise InputError(f"'{said}' did not end within {LONGEST} s") from None
        if done.returncode:
            raise InputError(f"'{said}' ended with status {done.returncode}: {done.stderr.strip()}")


class Facts:
    """Facts about results that choose pictures. title; rows: number of times; axis: their meaning; moves: whether there are several;
    modes: whether there are modes; first_elastic: number of the first mode that is no rigid one; figure: one of FIGURES, empty
    without; quantities: words of bielle-plot."""

    def __init__(self, results):
        self.title, self.rows = results.title, len(results.time)
        self.axis = "the load factor" if results.static else "time"
        self.moves = self.rows > 1
        self.modes = bool(modes_to_show(results))
        self.first_elastic = 1
        if self.modes:
            kinds = [kind.decode() if isinstance(kind, bytes) else str(kind) for kind in results.array("eigen/kind")]
            self.first_elastic = next((k for k, kind in enumerate(kinds, 1) if kind != "rigid"), 1)
        self.figure = next((figure for group, figure in FIGURES.items() if results.has(group)), "")
        wanted = results.names("measures")[:MOST_MEASURES] or _coordinate(results)
        self.quantities = ["--quantity", ", ".join(wanted)] if wanted and not results.static else []


def _coordinate(results):
    joints = [f"joints/{name}/coordinate" for name in results.names("joints")]
    return next(([place] for place in joints if results.has(place)), [])


def _view_of(options, facts):
    if "--mode" in options:
        return f"mode {options[options.index('--mode') + 1]} over its state"
    time = next((option.partition("=")[2] for option in options if option.startswith("--from=")), "")
    name, unit = ("load factor", "") if facts.axis != "time" else ("t", " s")
    return (f"at {name} = {float(time):.4g}{unit}" if time else "as chosen") + (", over its first position in grey" if "--ghost" in options else "")


def _changes(table):
    """Whether a column after the first one of a table of numbers changes."""
    with open(table, encoding="utf-8", newline="") as file:
        rows = [[_number(cell) for cell in row] for row in csv.reader(file)]
    values = np.array([row for row in rows if row and not np.isnan(row[0])])
    if len(values) < 2:
        return False
    values = values[:, 1:]
    return bool((np.nanmax(values, axis=0) - np.nanmin(values, axis=0) > LEAST_CHANGE * np.nanmax(np.abs(values), axis=0)).any())


def _number(cell):
    try:
        return float(cell)
    except ValueError:
        return np.nan


def _take(figures, name, path):
    """Moves the figure whose name begins so from the folder to a path, and removes the folder. @returns whether there is one"""
    found = sorted(each for each in os.listdir(figures) if each.startswith(name))
    if found:
        shutil.move(os.path.join(figures, found[0]), path)
    shutil.rmtree(figures)
    return bool(found)


def check_ink(path):
    """@raises InputError for a picture that shows nothing below its title"""
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)[HEADING:]
    count = int((pixels.min(axis=2) < 240).sum())
    if count < LEAST_INK:
        raise InputError(f"'{path}' shows nothing: {count} of its pixels are drawn")
