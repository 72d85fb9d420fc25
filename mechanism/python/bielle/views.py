"""The page of bielle-view in a notebook."""

from __future__ import annotations

import html
import os

from . import _core


class View:
    """The page of one or more results files; a notebook shows it as the value of a cell."""

    def __init__(self, page: str, height: int):
        self.page: str = page
        self.height: int = height

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.page)}" style="width: 100%; height: {int(self.height)}px; border: 0"></iframe>'

    def save(self, path: str | os.PathLike) -> str:
        """Writes the page, which any browser opens. Returns the path."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.page)
        return os.fspath(path)

    def __repr__(self) -> str:
        return f"<bielle.View, {len(self.page) / 1e6:.1f} MB>"


def view(*results: str | os.PathLike, height: int = 640, frames: int = 500) -> View:
    """The page of results files; more than one are drawn over each other. height: in a notebook [pixels]; frames: largest number of
    times. Raises Error if a file cannot be shown."""
    for name, number in (("height", height), ("frames", frames)):
        if number < 1:
            raise _core.InputError(f"view: {name}: expected a number from 1 on, found {number}")
    try:
        from bielle_tools.messages import InputError
        from bielle_tools.view import build_page
    except ImportError as error:
        raise _core.Error(f"view: {error}; it needs python3-h5py, python3-scipy, python3-yaml and the folder bielle_tools") from None
    try:
        page, _ = build_page([os.fspath(path) for path in results], frames)
    except InputError as error:
        raise _core.InputError(f"view: {error}") from None
    return View(page, height)
