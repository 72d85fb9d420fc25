"""The messages of the programs, as they are in the sources: literals of C++ in which `..` stands for values.

A message is a literal of a statement that throws an `InputError` or `ComputationError`, refuses a value (`fail`), or warns.
"""

import dataclasses
import os
import re

FOLDERS = ("reduce", "mechanism")
# A raw literal, a literal, a character, or a comment, in which no literal begins.
TOKEN = re.compile(r'R"(?P<d>[^(\s]*)\((?P<raw>.*?)\)(?P=d)"|"(?P<text>(?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/'
                   r"|(?P<end>;)|(?P<call>\b(?:InputError|ComputationError|fail|warn|warnings\.push_back|refuse)\s*\()|\S", re.DOTALL)
ESCAPES = {r"\"": '"', r"\\": "\\", r"\n": " ", r"\t": " "}


@dataclasses.dataclass
class Literal:
    """A literal, joined of its adjacent parts. `message`: it is in a statement that throws or warns."""
    path: str
    line: int
    text: str
    message: bool


def readable(text):
    """The text of a literal as users read it, with `..` in place of fields of {fmt}."""
    text = re.sub(r'\\["\\nt]', lambda found: ESCAPES[found[0]], text)
    text = re.sub(r"(?<!\{)\{[^{}]*\}(?!\})", "..", text)
    return " ".join(text.replace("{{", "{").replace("}}", "}").split())


def literals_of(source, path=""):
    """The literals of one source, in order."""
    found, open_literal, statement, throws = [], None, [], False
    for token in TOKEN.finditer(source):
        text = token["raw"] if token["raw"] is not None else token["text"]
        if text is not None:
            if open_literal is None:
                open_literal = Literal(path, source.count("\n", 0, token.start()) + 1, "", False)
                statement.append(open_literal)
            open_literal.text += text
            continue
        if token[0].startswith(("//", "/*")):
            continue
        open_literal = None
        throws = throws or token["call"] is not None
        if token["end"] or token[0] in "{}":
            for literal in statement:
                literal.text, literal.message = readable(literal.text), throws
            found += statement
            statement, throws = [], False
    return found


def literals(repository):
    """All literals of the C++ sources of the programs."""
    found = []
    for area in FOLDERS:
        for folder, _, files in sorted(os.walk(os.path.join(repository, area))):
            for name in sorted(files):
                if name.endswith((".cpp", ".hpp")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        found += literals_of(file.read(), os.path.relpath(path, repository))
    return found


def explained(page):
    """The explanations of a page: {name: (messages, text)}; see reduce/common/explanations.hpp."""
    found, name = {}, None
    for line in page.split("\n"):
        if line.startswith("## "):
            name = line[3:]
            found[name] = ([], [])
        elif name and line.startswith("> "):
            found[name][0].append(line[4:] if line.startswith("> - ") else line[2:])
        elif name:
            found[name][1].append(line)
    return {name: (messages, "\n".join(text).strip()) for name, (messages, text) in found.items()}


def fixed_texts(message):
    return [" ".join(text.split()) for text in message.split("..") if text.strip()]


def contains(text, message):
    """Whether the fixed texts of a message occur in a text, in order."""
    place = 0
    for fixed in fixed_texts(message):
        place = text.find(fixed, place)
        if place < 0:
            return False
        place += len(fixed)
    return True


def list_of_messages(repository, explanations):
    """A page with all messages by folders. @param explanations  {page relative to the list: {name: (messages, text)}}"""
    lines = ["# All messages", "", "Two dots stand for values and names. Messages are parts of sentences: file, line, key and time come before them.", ""]
    folder, known = None, set()
    for literal in literals(repository):
        if not literal.message or len(re.findall(r"[a-z]{2,}", literal.text)) < 3 or literal.text in known:
            continue
        known.add(literal.text)
        if os.path.dirname(literal.path) != folder:
            folder = os.path.dirname(literal.path)
            lines += ["", f"## {folder}", "", "| message | explanation |", "|---|---|"]
        links = [f"[{name}]({page}#{name})" for page, entries in explanations.items() for name, (messages, _) in entries.items()
                 if any(contains(literal.text, message) for message in messages)]
        text = re.sub(r"([|<>*_`\[\]\\$])", r"\\\1", literal.text)
        lines.append(f"| {text} | {', '.join(links)} |")
    return "\n".join(lines) + "\n"
