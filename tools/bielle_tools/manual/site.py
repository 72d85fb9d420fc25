"""The manual as a site: all pages of the repository, with a search, by Sphinx (MyST reads the pages, furo is the theme)."""

import glob
import os
import re
import shutil
import subprocess

from ..messages import InputError
from .pages import BLOCK
from .pictures import CURVE
from .source_messages import explained, list_of_messages

CONTENTS = {  # page that leads a part, and the pages of the part, in order
    "First steps": ["README.md", "mechanism/manual/README.md", "mechanism/manual/features.md", "mechanism/manual/getting_started/*.md", "mechanism/manual/how_do_i/README.md", "mechanism/manual/how_do_i/[a-z]*.md", "mechanism/manual/examples.md", "mechanism/manual/gallery.md",
                    "mechanism/manual/messages/README.md", "mechanism/manual/messages/[a-z]*.md"],
    "Mechanisms": ["mechanism/README.md", "mechanism/manual/reference/*/*.md", "mechanism/language/*.md",
                   "reduce/common/README.md", "mechanism/io/*.md", "mechanism/python/*.md", "mechanism/glossary*.md", "mechanism/keys.md"],
    "Bodies": ["reduce/README.md", "reduce/manual/*.md", "reduce/matrices/README.md", "reduce/superelement/*.md", "reduce/distributed/README.md", "meshes/README.md",
               "reduce/keys.md"],
    "Tools": ["tools/README.md", "tools/guide/*.md"],
    "Theory and proof": ["mechanism/manual/theory/*.md", "mechanism/solvers/README.md", "reduce/reduction/README.md", "tests/*/README.md"],
    "Development": ["CONTRIBUTING.md", "CHANGELOG.md", "LICENSES.md"],
}
ALL_MESSAGES = "mechanism/manual/messages/all_messages.md"  # page of the site alone, written from the sources
CONFIGURATION = """project = "Bielle"
extensions = ["myst_parser"]
html_theme = "furo"
html_title = "Bielle"
html_show_copyright = False
myst_heading_anchors = 4
suppress_warnings = ["myst.header", "misc.highlighting_failure"]
"""
ALT = re.compile(r"[\[\]\\`*_<>]")  # letters with a meaning in the text of an image
EXAMPLES = "Examples"  # title of the part with pages of the site alone
PLACE = "<!-- pictures -->"
LINK = re.compile(r"\]\(([^)\s]+)\)")
SHOWS = re.compile(r"^<!-- shows: (\S+)(?: (machine|curve))? -->$", re.MULTILINE)  # the picture of another page


def pages_of(repository):
    """The pages of each part of the site: {title: paths relative to the repository}. @raises InputError if a page is missing"""
    parts = {}
    for title, patterns in CONTENTS.items():
        parts[title] = []
        for pattern in patterns:
            found = sorted(glob.glob(os.path.join(repository, pattern)))
            if not found:
                raise InputError(f"{os.path.join(repository, pattern)} does not exist")
            parts[title] += [os.path.relpath(path, repository) for path in found]
    return parts


def write_sources(repository, folder, gathered=None, own=None):
    """Copies the pages, and the files that they link to, into the folder of Sphinx's sources; adds configuration and contents.
    gathered: a Gathered, whose pictures are put into the pages; own: {page: path} of pages of the site alone"""
    parts = pages_of(repository)
    if own:
        parts[EXAMPLES] = list(own)
    pages = {page for part in parts.values() for page in part}
    for page in pages:
        target = os.path.join(folder, page)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open((own or {}).get(page, os.path.join(repository, page)), encoding="utf-8") as file:
            text = file.read()
        if gathered and page in gathered.pictures:
            text = _with_pictures(text, gathered.pictures[page])
            for picture in gathered.pictures[page]:
                shutil.copy(os.path.join(gathered.folders[page], picture.name), os.path.dirname(target))
        if gathered:
            text = SHOWS.sub(lambda match: _shown(match, page, gathered), text)
        with open(target, "w", encoding="utf-8") as file:
            file.write(LINK.sub(lambda match: _link(match, repository, page, pages, folder), text))
    _write_all_messages(repository, folder)
    parts["First steps"].append(ALL_MESSAGES)
    with open(os.path.join(folder, "conf.py"), "w", encoding="utf-8") as file:
        file.write(CONFIGURATION)
    with open(os.path.join(folder, "index.md"), "w", encoding="utf-8") as file:
        file.write("# Bielle\n\nFlexible mechanisms by finite elements.\n")
        for title, part in parts.items():
            lines = "\n".join(page[:-3] for page in part)
            file.write(f"\n```{{toctree}}\n:caption: {title}\n:maxdepth: 1\n\n{lines}\n```\n")


def _write_all_messages(repository, folder):
    explanations = {}
    for path in sorted(glob.glob(os.path.join(repository, os.path.dirname(ALL_MESSAGES), "[a-z]*.md"))):
        with open(path, encoding="utf-8") as file:
            explanations[os.path.basename(path)] = explained(file.read())
    with open(os.path.join(folder, ALL_MESSAGES), "w", encoding="utf-8") as file:
        file.write(list_of_messages(repository, explanations))


def _with_pictures(text, pictures):
    """A page with its pictures after the blocks to which they belong, or all at one place."""
    ends = [match.end() for match in BLOCK.finditer(text)]
    if PLACE in text:
        images = "\n\n".join(_image(picture) for picture in pictures if picture.after is not None)
        return text.replace(PLACE, images, 1)
    for picture in sorted((each for each in pictures if each.after is not None), key=lambda each: each.after, reverse=True):
        place = ends[picture.after]
        text = f"{text[:place]}\n\n{_image(picture)}\n{text[place:]}"
    return text


def shown_pages(text, page):
    """Pages, relative to the repository, whose pictures a page shows: [(page, line of the comment)]."""
    return [(_relative(match.group(1), page), text.count("\n", 0, match.start()) + 1) for match in SHOWS.finditer(text)]


def _relative(target, page):
    return os.path.normpath(os.path.join(os.path.dirname(page), target))


def _shown(match, page, gathered):
    """The first machine or curve of another page, with a link to it. @raises InputError if that page has none"""
    other, wanted = _relative(match.group(1), page), match.group(2) or "machine"
    picture = next((each for each in gathered.pictures.get(other, [])
                    if each.after is not None and each.name.endswith(CURVE) == (wanted == "curve")), None)
    if picture is None:
        raise InputError(f"{page}: '{match.group(0)}': the page '{other}' has no {wanted}")
    place = os.path.relpath(os.path.join(os.path.dirname(other), picture.name), os.path.dirname(page) or ".")
    return f"[![{ALT.sub(' ', picture.alt)}]({place})]({match.group(1)})"


def _image(picture):
    return f"![{ALT.sub(' ', picture.alt)}]({picture.name})"


def _link(match, repository, page, pages, folder):
    """A link of a page. One to a file that is no page leads to a copy of the file; one to a folder becomes plain text."""
    target, _, heading = match.group(1).partition("#")
    if re.match(r"\w+:", target) or not target:
        return match.group(0)
    path = os.path.normpath(os.path.join(os.path.dirname(page), target))
    source = os.path.join(repository, path)
    if path in pages or not os.path.isfile(source):
        return match.group(0)
    name = path + ".txt" if path.endswith(".md") else path
    copy = os.path.join(folder, name)
    os.makedirs(os.path.dirname(copy), exist_ok=True)
    shutil.copy(source, copy)
    return f"]({os.path.relpath(name, os.path.dirname(page) or '.')})"


def build(sources, target):
    """Builds the site. @raises InputError with Sphinx's warnings, a link that leads nowhere among them"""
    done = subprocess.run(["/usr/bin/python3", "-m", "sphinx", "-q", "-j", "auto", "-b", "html", sources, target], capture_output=True, text=True)
    if done.returncode:
        raise InputError(f"Sphinx ended with status {done.returncode}: {done.stderr.strip()}")
    return done.stderr.strip()
