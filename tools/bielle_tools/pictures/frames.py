"""Draws the rows of a Shot, by several processes where the machine has several processors."""

import contextlib
import multiprocessing
import os
import threading
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection

from .display import virtual_display
from .window import Window

FEWEST = 4   # pictures per process: fewer are drawn sooner than a process starts
_at_work = []  # a process that draws keeps the Shot, its Window and the function that finishes pictures here


def drawn(shot, finish=None, processes=None):
    """Yields finish(picture) for every row in order: `picture` is a PIL image of the row. The function runs in the process
    that draws; the pictures themselves are yielded without one.

    processes: how many draw, default one for each processor. Memory of the parent is shared with them, and each has a window
    of its own on one display.
    """
    count = len(shot.rows)
    processes = min(processes or len(os.sched_getaffinity(0)), count // FEWEST)
    finish = finish or _unchanged
    with virtual_display():
        if processes <= 1:
            with _open_window(shot) as window:
                for k in range(count):
                    yield finish(_picture(shot, window, k))
            return
        os.environ.setdefault("LP_NUM_THREADS", "0")  # each process draws by itself
        _at_work[:] = [shot, None, finish]
        try:
            with ProcessPoolExecutor(processes, multiprocessing.get_context("fork"), initializer=_end_with_parent) as pool:
                yield from pool.map(_draw, range(count), chunksize=max(1, count // (4 * processes)))
        except BrokenProcessPool:
            raise MemoryError from None  # the system ended one
        finally:
            _at_work.clear()


def drawings(shots):
    """The first row of each shot without texts: PIL images."""
    images = []
    with virtual_display():
        for shot in shots:
            with _open_window(shot) as window:
                images.append(window.image(shot.at(0)))
    return images


@contextlib.contextmanager
def _open_window(shot):
    """A Window that is closed at the end, before its display."""
    window = Window(shot.surfaces, shot.camera)
    try:
        yield window
    finally:
        window.close()


def _end_with_parent():
    """Ends this process when its parent ends, whatever ends it."""
    def watch():
        connection.wait([multiprocessing.parent_process().sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _draw(k):
    """Draws a picture in a process of its own."""
    shot, window, finish = _at_work
    if window is None:
        window = _at_work[1] = Window(shot.surfaces, shot.camera)
    return finish(_picture(shot, window, k))


def _picture(shot, window, k):
    return shot.page(k, window.image(shot.at(k), shot.moved[k]))


def _unchanged(picture):
    return picture
