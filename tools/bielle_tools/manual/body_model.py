"""A model by which a body of a page is drawn: the superelement alone, free, with its vibrations."""

import json
import os

import h5py

RIGID_MODES = 6
SHOWN = RIGID_MODES + 1  # the first mode that deforms the body


def body_model(path):
    """The text of the model of a superelement file in the folder of the model; empty for another file, and for one without a mesh."""
    with h5py.File(path, "r") as file:
        kind, title = file.attrs.get("format", ""), str(file.attrs.get("name", "")) or os.path.basename(path)
        if kind != "bielle cut body" and (kind != "bielle superelement" or "recovery/displacement" not in file):
            return ""
    body = {"type": "superelement", "file": os.path.basename(path), "position": [0, 0, 0]}
    return json.dumps({"mechanism": title, "elements": {"body": body}, "analysis": [{"type": "assembly"}, {"type": "eigen", "count": SHOWN}]})
