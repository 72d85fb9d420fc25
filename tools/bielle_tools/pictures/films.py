"""Files of pictures: sheets of stills (PNG, PDF, SVG) and films (GIF, MP4)."""

import base64
import io
import os
import shutil
import subprocess
import tempfile
import zlib

import numpy as np
from PIL import Image

from ..messages import InputError
from ..output_file import opened
from ..results.results_file import Results, modes_to_show
from .frames import drawn
from .page import side_by_side, stacked
from .shot import Shot

STILLS, FILMS = (".png", ".pdf", ".svg"), (".gif", ".mp4")
COLUMNS = 3
SHORTEST = 20  # [ms] time of a picture in a GIF: browsers show shorter ones slowly
SAMPLES = 4    # pictures from which the colours of a GIF are chosen


def sheet(results, path, look, pictures=6):
    """Writes about `pictures` moments of the motion side by side. look: a Look"""
    shot = _prepared(results, look, pictures, sheet=True)
    with opened(path) as file:
        whole = side_by_side(list(drawn(shot)), COLUMNS)
        if shot.sheet:
            whole = stacked([shot.paper.heading(whole.width, shot.title, ""), whole, *shot.bar(whole.width)])
        kind = os.path.splitext(path)[1].lower()
        if kind == ".svg":
            file.write(_svg(whole))
        else:
            whole.save(file, kind[1:].upper())


def film(results, path, look, pictures=60, seconds=6.0):
    """Writes a film of about `pictures` pictures that plays for `seconds`, as the ending of the path says: GIF or MP4."""
    moving = os.path.splitext(path)[1].lower() == ".mp4"
    if moving and not shutil.which("ffmpeg"):
        raise InputError(f"'{path}': films in MP4 need the program ffmpeg (Debian package ffmpeg); a GIF does not")
    shot = _prepared(results, look, pictures, sheet=False)
    with opened(path) as file:
        (_write_mp4 if moving else _write_gif)(shot, file, seconds)


def _prepared(results, look, pictures, sheet):
    if isinstance(results, Results) and len(results.time) < (1 if sheet else 2):
        still = ": it has one position, which -o FILE.png draws" if len(results.time) else ""
        raise InputError(f"'{results.path}' holds no motion to show" + (modes_to_show(results) or still))
    return Shot(results, look, pictures, sheet)


def _write_gif(shot, file, seconds):
    count = len(shot.rows)
    pictures = list(drawn(shot, _packed))
    chosen = np.unique(np.linspace(0, count - 1, SAMPLES).astype(int))
    palette = stacked([_unpacked(pictures[k]) for k in chosen]).quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few_colours = (_unpacked(each).quantize(palette=palette, dither=Image.Dither.NONE) for each in pictures)
    next(few_colours).save(file, "GIF", save_all=True, append_images=few_colours, loop=0,
                           duration=max(SHORTEST, 10 * round(100 * seconds / count)))


def _packed(picture):
    """Compresses a picture to about a hundredth of its memory. @returns its data and its size"""
    return zlib.compress(picture.tobytes(), 1), picture.size


def _unpacked(packed):
    return Image.frombytes("RGB", packed[1], zlib.decompress(packed[0]))


def _write_mp4(shot, file, seconds):
    """ffmpeg writes into a file of its own, since it goes back in it."""
    rate = f"{len(shot.rows) / seconds:.6f}"
    with tempfile.TemporaryDirectory() as folder:
        target, encoder = os.path.join(folder, "film.mp4"), None
        try:
            for pixels, size in drawn(shot, _pixels):
                encoder = encoder or _encoder(size, rate, target)
                encoder.stdin.write(pixels)
        except BrokenPipeError:
            pass  # its message tells why
        except BaseException:
            if encoder:
                encoder.kill()
            raise
        _, said = encoder.communicate()
        if encoder.returncode:
            raise InputError(f"'{file.name}': ffmpeg failed: {said.decode(errors='replace').strip()[-300:]}")
        with open(target, "rb") as made:
            shutil.copyfileobj(made, file)


def _encoder(size, rate, target):
    """ffmpeg, which takes pixels of pictures. H.264 of most players has even numbers of pixels."""
    return subprocess.Popen(
        ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}", "-r", rate, "-i", "-",
         "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart",
         target], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def _pixels(picture):
    return picture.tobytes(), picture.size


def _svg(picture):
    """Returns the pixels as an SVG file, which programs for vector graphics open."""
    png = io.BytesIO()
    picture.save(png, "PNG")
    width, height = picture.size
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
            f'<image width="{width}" height="{height}" href="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"/></svg>\n'
            ).encode()
