"""Pages of the site about the models of mechanism/examples, one each: the commands, pictures, and the commented model."""

import glob
import os
import re

FOLDER = "mechanism/examples"
TITLE = re.compile(r"^mechanism: (.+)$", re.MULTILINE)
TABLE = re.compile(r"\b[\w-]+\.csv\b")
BODY = re.compile(r"\bfile: ([\w-]+)\.h5\b")


def write_pages(repository, folder):
    """Writes the pages into a folder. @returns {page relative to the repository: path}"""
    found = {}
    for path in sorted(glob.glob(os.path.join(repository, FOLDER, "*.yaml"))):
        page = os.path.join(FOLDER, os.path.basename(path)[:-5] + ".md")
        found[page] = os.path.join(folder, os.path.basename(page))
        with open(path, encoding="utf-8") as file:
            text = page_of(repository, os.path.basename(path), file.read())
        with open(found[page], "w", encoding="utf-8") as file:
            file.write(text)
    return found


def page_of(repository, name, model):
    """The text of the page about a model."""
    tables = sorted(each for each in set(TABLE.findall(model)) if os.path.isfile(os.path.join(repository, FOLDER, each)))
    bodies = sorted(each for each in set(BODY.findall(model)) if os.path.isfile(os.path.join(repository, "meshes", each + ".yaml")))
    before = [f'cp "$BIELLE/{FOLDER}/{each}" .' for each in tables] + [f'bielle-reduce "$BIELLE/meshes/{each}.yaml" -o {each}.h5' for each in bodies]
    title = TITLE.search(model)
    title = title.group(1).strip("\"' ") if title else name[:-5].replace("_", " ")
    commands = f"```sh\nbielle-mechanism {name}\n```\n"
    return (f"# {title[:1].upper()}{title[1:]}\n\nThe model is [`{name}`]({name}); `$BIELLE` is the folder of Bielle.\n\n<!-- pictures -->\n\n"
            + ("```sh\n" + "\n".join(before) + "\n```\n" if before else "") + f"```yaml\n# {name}\n{model.rstrip()}\n```\n{commands}")
