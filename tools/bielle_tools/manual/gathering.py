"""The pictures of all pages of the manual, kept by what they depend on so that they are made once.

A kept folder is named after a digest of the files and commands of its pages, of the files of the repository that these use, of
the programs, and of the tools. Pages of `CHAIN` use files of the pages before them and are run in one folder.
"""

import glob
import hashlib
import json
import os
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from ..messages import InputError
from .examples import examples_of, images_of, repository_files
from .pages import blocks, run_page
from .pictures import Artist, Picture

CHAIN = "mechanism/manual/getting_started"
LIST = "pictures.json"
TOOLS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


@dataclass
class Gathered:
    """pictures: {page: list of Picture}; folders: {page: folder with them}; made, kept: numbers of runs of pages."""

    pictures: dict
    folders: dict
    made: int = 0
    kept: int = 0


def runnable(pages):
    """Lists of pages that are run together, those that run a file of their own. pages: {page: path}"""
    found = [page for page, path in pages.items() if examples_of(path)]
    chain = [page for page in found if os.path.dirname(page) == CHAIN]
    return ([chain] if chain else []) + [[page] for page in found if page not in chain]


def gather(repository, pages, programs, environment, folder, jobs, tell):
    """Runs the pages that changed, draws their pictures into subfolders of `folder`, and removes those that no page has any more.
    pages: {page relative to the repository: path}; programs: folder of the programs; jobs: number of pages that run at once; tell(sentence). @raises InputError naming the page"""
    os.makedirs(folder, exist_ok=True)
    groups, common = runnable(pages), _digest_of_programs(programs)
    found = Gathered({}, {})

    def one(group):
        place = os.path.join(folder, _digest(repository, group, pages, common))
        made = not os.path.isfile(os.path.join(place, LIST))
        if made:
            _make(group, pages, environment, place)
            tell(", ".join(group))
        return group, place, made

    with ThreadPoolExecutor(max_workers=jobs) as pool:
        done = list(pool.map(one, groups))
    for group, place, made in done:
        with open(os.path.join(place, LIST), encoding="utf-8") as file:
            listed = json.load(file)
        for page in group:
            found.pictures[page] = [Picture(**each) for each in listed.get(page, [])]
            found.folders[page] = place
        found.made, found.kept = found.made + made, found.kept + (not made)
    for name in set(os.listdir(folder)) - {os.path.basename(place) for _, place, _ in done}:
        shutil.rmtree(os.path.join(folder, name), ignore_errors=True)
    return found


def _make(group, pages, environment, place):
    """Runs a group of pages and draws their pictures; the folder appears when it is complete."""
    with tempfile.TemporaryDirectory() as work, tempfile.TemporaryDirectory(dir=os.path.dirname(place), prefix="part_") as target:
        artist, listed = Artist(TOOLS, environment), {}
        for page in group:
            path = pages[page]
            run_page(path, work, environment)
            shown = [name for name in images_of(path) if os.path.isfile(os.path.join(work, name))]
            for name in shown:
                shutil.copy(os.path.join(work, name), target)
            pictures = [Picture(name, "", None) for name in shown]
            try:
                for example in examples_of(path):
                    pictures += artist.draw(example, os.path.splitext(os.path.basename(page))[0], work, target)
            except InputError as error:
                raise InputError(f"{page}: {error}") from None
            listed[page] = [picture.described() for picture in pictures]
        with open(os.path.join(target, LIST), "w", encoding="utf-8") as file:
            json.dump(listed, file, indent=1)
        shutil.copytree(target, place + ".part", dirs_exist_ok=True)
        os.replace(place + ".part", place)


def _digest(repository, group, pages, common):
    digest = hashlib.sha256(common)
    for page in group:
        path = pages[page]
        digest.update(page.encode())
        for block in blocks(path):
            if block.language != "text":
                digest.update(f"{block.language}\n{block.text}\0".encode())
        digest.update(repr([(example.chosen, example.ended) for example in examples_of(path)] + images_of(path)).encode())
        for name in repository_files(path):  # a body file names geometries next to it
            neighbours = glob.glob(os.path.join(repository, os.path.dirname(name), "*")) if name.startswith("meshes/") else []
            for used in sorted(neighbours or [os.path.join(repository, name)]):
                _add(digest, used)
    return digest.hexdigest()[:24]


def _digest_of_programs(programs):
    digest = hashlib.sha256()
    paths = [os.path.join(programs, name) for name in ("bielle-mechanism", "bielle-reduce")]
    paths += glob.glob(os.path.join(os.path.dirname(programs), "python", "bielle", "*.*"))
    paths += [path for path in glob.glob(os.path.join(TOOLS, "bielle_tools", "**", "*.py"), recursive=True)]
    for path in sorted(paths + glob.glob(os.path.join(TOOLS, "bielle-*"))):
        _add(digest, path)
    return digest.digest()


def _add(digest, path):
    if os.path.isfile(path):
        with open(path, "rb") as file:
            digest.update(hashlib.sha256(file.read()).digest())
