"""Assembles the page: libraries, sources of the page, packed data."""

import base64
import html
import json
import os
import time
import zlib

import numpy as np

from ..messages import InputError, installation
from ..results.checked_model import check_of
from ..scene import make_scene
from ..scene.marks import marks_of
from ..scene.stress_scale import ANCHORS, hexadecimal
from .facts import events_of, keys_of
from .pack import Pack
from .quantities import quantities
from .scene_data import SceneData
from .sequences import sequences

LIBRARIES = ("/usr/share/javascript/three/three.min.js", "/usr/share/javascript/chart.js/chart.min.js")
SOURCES = ("data.js", "vectors.js", "shaders.js", "tracks.js", "stresses.js", "batch.js", "flexible.js", "arrows.js", "runs.js", "camera.js", "surroundings.js",
           "entries.js", "player.js", "picking.js", "overlay.js", "traces.js", "tree.js", "details.js", "plot.js", "controls.js", "quality.js", "live.js", "main.js")
MOST_NOTES = 12  # on the terminal
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page")


class Report:
    """Sizes, errors and notes of a page that was built. notes, by_lines: as in a Scene."""

    def __init__(self, seconds, size, errors, notes, by_lines, contents):
        self.seconds, self.size, self.errors, self.notes, self.by_lines, self.contents = seconds, size, errors, notes, by_lines, contents

    def lines(self):
        """Sentences for the terminal."""
        e = self.errors
        return [f"{self.contents}; {self.size / 1e6:.1f} MB, built in {self.seconds:.1f} s",
                f"errors by 16-bit numbers: positions {e['position']:.1e} of the size, rotations {e['rotation']:.1e} rad, "
                f"deformations {e['shape']:.1e} of the size, stresses {e['stress']:.1e} of the largest",
                *(f"drawn as lines between its interfaces: {entry}: {reason}" for entry, reason in self.by_lines[:MOST_NOTES]),
                *([f"drawn as lines: {len(self.by_lines) - MOST_NOTES} more, which the page lists"] if len(self.by_lines) > MOST_NOTES else []),
                *(f"not drawn: {entry}: {reason}" for entry, reason in self.notes[:MOST_NOTES]),
                *([f"not drawn: {len(self.notes) - MOST_NOTES} more, which the page lists"] if len(self.notes) > MOST_NOTES else [])]


def build_page(paths, frames=500, superelements=None, analysis=None, live=None):
    """The page of one or more results files as text, and its report. superelements: {element: path}; live: token of a growing run.
    @raises InputError"""
    start, pack = time.monotonic(), Pack()
    data = {"runs": [], "layouts": [], "live": live, "colours": [hexadecimal(colour) for colour in ANCHORS]}
    scenes, opened, notes, by_lines, layouts = None, [], [], [], {}
    try:
        for path in paths:
            found, results = sequences(path, frames, superelements, analysis)
            opened += results
            described = []
            for sequence in found:
                scene = make_scene(sequence.motion, superelements)
                if scenes is None:
                    low, high = scene.low, scene.high
                    scenes = SceneData(pack, (low + high) / 2, scene.size)
                    data.update(centre=scenes.centre.tolist(), size=scene.size, planar=scene.planar, symbol=scene.symbol / scene.size,
                                low=((low - scenes.centre) / scene.size).tolist(), high=((high - scenes.centre) / scene.size).tolist(),
                                gravity=None if scene.gravity is None else scene.gravity.tolist(), title=results[0].title)
                described.append(_described(sequence, scene, scenes, pack, layouts, data["layouts"]))
                notes += [note for note in scene.notes if note not in notes]
                by_lines += [note for note in scene.by_lines if note not in by_lines]
            data["runs"].append({"name": os.path.basename(path), "created_by": results[0].created_by, "keys": keys_of(results[0]), "sequences": described})
    finally:
        for results in opened:
            results.file.close()
    data.update(bodies=scenes.bodies, errors=scenes.errors, notes=notes[:500], by_lines=by_lines[:500])
    text = _page(data, pack)
    contents = ", ".join(f"{run['name']}: " + ", ".join(s["title"] for s in run["sequences"][:6]) + (", .." if len(run["sequences"]) > 6 else "")
                         for run in data["runs"])
    return text, Report(time.monotonic() - start, len(text), scenes.errors, notes, by_lines, contents)


def _described(sequence, scene, scenes, pack, layouts, listed):
    """A sequence for the page."""
    plain = sequence.kind != "mode"
    drawn = scenes.described(scene, sequence.rows, arrows=plain)  # amplitudes of modes have no scale of force or velocity
    check = check_of(sequence.motion)
    layout = {key: drawn.pop(key) for key in ("batch", "parts", "anchors")}
    key = json.dumps(layout)
    if key not in layouts:
        layouts[key] = len(listed)
        listed.append(layout)
    return {"title": sequence.title, "kind": sequence.kind, "times": pack.add(sequence.times, "f4"), "rows": len(sequence.rows), "layout": layouts[key],
            "scene": drawn, "marks": marks_of(scene, sequence.rows if plain else sequence.rows[-1:]),
            "said": check.sentences if check else [], "failed": bool(check and not check.assembled), "events": events_of(sequence.motion) if plain else [],
            "quantities": quantities(sequence.motion, pack) if plain else {"times": pack.add([], "f4"), "list": [], "left_out": 0}, **sequence.facts}


def _page(data, pack):
    libraries = []
    for path in LIBRARIES:
        if not os.path.isfile(path):
            raise InputError(f"'{path}' is missing (Debian packages libjs-three and libjs-chart.js): run "
                             + installation("libjs-three", "libjs-chart.js"))
        libraries.append(_file(path))
    sources = "\n".join(_file(os.path.join(FOLDER, name)) for name in SOURCES)
    description = base64.b64encode(zlib.compress(json.dumps(_finite(data)).encode(), 6)).decode()
    parts = {"TITLE": html.escape(data["title"]), "STYLE": _file(os.path.join(FOLDER, "page.css")),
             "LIBRARIES": "\n".join(f"<script>{_harmless(text)}</script>" for text in libraries), "DESCRIPTION": description,
             "ARRAYS": pack.text(), "SOURCES": '"use strict";\n(() => {\n' + _harmless(sources) + "\n})();",
             "CONNECT": "'self'" if data["live"] else "'none'"}
    page = _file(os.path.join(FOLDER, "page.html"))
    pieces = page.split("{{")
    return pieces[0] + "".join(parts[piece.partition("}}")[0]] + piece.partition("}}")[2] for piece in pieces[1:])


def _finite(value):
    """JSON has no numbers that are not finite."""
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _file(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def _harmless(script):
    """Replaces end tags in a script, which would end its element early."""
    return script.replace("</script", "<\\/script")
