"""The description of a study, as a file that each of its processes can read: plan.json in the folder of its runs.

A run is identified by a sum over the model, the files that the model names, the program, and the values of the
parameters. Finished runs with the same identity are not repeated, whatever else has changed in the study.
"""

import dataclasses
import hashlib
import json
import os
import re

from ..messages import InputError
from .gather import read_gather

KEPT = ["joints", "measures", "energy", "events", "peaks", "eigen"]
GROUPS = [*KEPT, "nodes", "elements", "contacts", "supports", "hydraulics", "frequency_response", "solver", "validity", "all"]
PLAN = "plan.json"


@dataclasses.dataclass
class Plan:
    """names, rows: parameters and their values as texts, a row per run; keep: groups of the results; gather: (name, words);
    draw: figures, in words, None: those that suggest themselves, []: none. Paths are absolute."""

    model: str
    output: str
    program: str
    names: list
    rows: list
    keep: list
    gather: list = dataclasses.field(default_factory=list)
    draw: list = None
    figures: str = ""
    identities: list = dataclasses.field(default_factory=list)
    inputs: list = dataclasses.field(default_factory=list)  # files that the study reads, and may not write

    def __post_init__(self):
        self.model, self.output = os.path.abspath(self.model), os.path.abspath(self.output)
        self.program = os.path.abspath(self.program)
        self.wanted = read_gather(self.gather)
        if not self.identities:
            self.inputs = [os.path.abspath(path) for path in dict.fromkeys([self.model, self.program, *self.inputs, *named_files(self.model)])]
            common = _common(self.model, self.program)
            self.identities = [_sum(json.dumps([common, sorted(zip(self.names, row))])) for row in self.rows]

    @property
    def needed(self):
        """Groups and datasets that each run must keep."""
        return list(dict.fromkeys([*self.keep, *filter(None, (each.needs for each in self.wanted))]))

    @property
    def needs_text(self):
        """Tells whether numbers are gathered from the program's output."""
        return any(each.printed is not None for each in self.wanted)

    def values(self, index):
        """`speed = 1, mass = 2`"""
        return ", ".join(f"{name} = {value}" for name, value in zip(self.names, self.rows[index]))

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, PLAN)
        with open(path + ".part", "w", encoding="utf-8", errors="surrogatepass") as file:
            json.dump({"format": "bielle plan", "version": 1, **dataclasses.asdict(self)}, file, indent=1)
        os.replace(path + ".part", path)


def read_plan(folder):
    """@raises InputError if the folder contains none"""
    path = os.path.join(folder, PLAN)
    try:
        with open(path, encoding="utf-8", errors="surrogatepass") as file:
            keys = json.load(file)
        if keys.pop("format") != "bielle plan" or keys.pop("version") != 1:
            raise ValueError
        keys["gather"] = [tuple(each) for each in keys["gather"]]
        return Plan(**keys)
    except OSError as error:
        raise InputError(f"'{folder}' is no folder of a study ('{path}': {error.strerror}); --schedule makes one") from None
    except (AttributeError, KeyError, TypeError, ValueError):
        raise InputError(f"'{path}' is no plan of a study, or it is damaged") from None


def _sum(text):
    data = text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass")
    return hashlib.sha256(data).hexdigest()[:24]


def _common(model, program):
    """The data that all runs share: the model, the program, and the contents of the files that the model names."""
    text = read_model(model)
    folder = os.path.dirname(os.path.abspath(model))
    files = [(word, _file_sum(os.path.join(folder, word))) for word in _words_like_files(text)]
    return [text, _file_sum(program), [each for each in files if each[1]]]


def named_files(model):
    """Paths of the existing files that a model names."""
    folder = os.path.dirname(os.path.abspath(model))
    paths = [os.path.join(folder, word) for word in _words_like_files(read_model(model))]
    return [path for path in paths if os.path.isfile(path)]


def _words_like_files(text):
    return sorted(set(re.findall(r"[^\s\[\]{},:'\"#]+\.\w+", text)) | set(re.findall(r"[\"']([^\"'\n]+\.\w+)[\"']", text)))


def read_model(path):
    """Text of a model. @raises InputError"""
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"'{path}' is no model: it is not text") from None


def _file_sum(path):
    """Checksum of a file's content; empty if there is no such file."""
    if not os.path.isfile(path):
        return None
    total = hashlib.sha256()
    try:
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                total.update(block)
    except OSError:
        return None
    return total.hexdigest()[:24]
