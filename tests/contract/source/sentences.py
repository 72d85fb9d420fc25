"""Finds sentences of comments and documents that begin with What, Where, Of or Who.

CONTRIBUTING.md states the rule in "How comments are written".
"""

import ast
import io
import os
import re
import tokenize

OPENERS = r"(?:what|where|of|who)\b"
# First word of a text, after marks of lists and tables and the tags of documented parameters.
FIRST = re.compile(rf"[\W_]*(?:@t?param\s+\S+\s+|@(?!t?param)\w+\s+)?[\W_]*({OPENERS})", re.IGNORECASE)
# Capital letter after the end of a sentence; initials and abbreviations of one letter are not ends.
LATER = re.compile(r"(?<![\s.(][A-Z])[.!?]['\")]*\s+['\"(*]*(What|Where|Of|Who)\b")
# Comments, and literals of C++, in which // begins no comment.
CPP = re.compile(r'R"(?P<d>[^(\s]*)\((?:.|\n)*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|\b\d[\w\'.]*|\'(?:\\.|[^\'\\\n])*\''
                 r"|(?P<line>//[^\n]*)|/\*(?P<block>(?:.|\n)*?)\*/")
# Cell of a table that quotes a sentence as an example.
QUOTED = re.compile(r'\s*".*"\s*')
MARKDOWN = (".md",)
HASHES = (".cmake", ".txt", ".yaml", ".yml", ".in")
SCRIPTS = ("bash", "sh", "python3")


def openers(text):
    """Returns the opening words of the sentences of a text, a comment or a paragraph."""
    first = FIRST.match(text)
    return ([first.group(1)] if first else []) + LATER.findall(text)


def joined(lines):
    """Returns [line, text] of comments that are given as (line, column, text).

    Comments in successive lines of one column are one text, which ends at tags and entries of lists.
    """
    texts, last = [], None
    for number, column, text in lines:
        tag = re.match(r"\s*(@|- |\d+\. )", text)
        if last and last == (number - 1, column) and text.strip() and not tag:
            texts[-1][1] += " " + text.strip()
        else:
            texts.append([number, text.strip()])
        last = (number, column) if text.strip() else None
    return texts


def cpp_texts(source):
    lines, starts, blocks = [], [0], []
    for line in source.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    number = 0
    for token in CPP.finditer(source):
        if token.group("line") is None and token.group("block") is None:
            continue
        while starts[number + 1] <= token.start():
            number += 1
        if token.group("block") is not None:
            blocks.append([number + 1, " ".join(token.group("block").split())])
        else:
            lines.append((number + 1, token.start() - starts[number], re.sub(r"^//[/!]?<? ?", "", token.group("line"))))
    return joined(lines) + blocks


def python_texts(source):
    lines = []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT and not token.string.startswith("#!"):
            lines.append((*token.start, token.string.lstrip("# ")))
    texts = joined(lines)
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            first = node.body[0].lineno
            texts += joined((first + k, 0, line) for k, line in enumerate(ast.get_docstring(node).split("\n")))
    return texts


def hash_texts(source):
    """Returns the comments of CMake, YAML and shells."""
    lines = []
    for number, line in enumerate(source.split("\n"), 1):
        comment = re.search(r"(?:^|\s)#(?: |$)", line)
        if comment:
            lines.append((number, comment.start(), line[comment.end():]))
    return joined(lines)


def markdown_texts(source):
    """Returns paragraphs, entries of lists, cells of tables, and comments of examples; headings may be questions."""
    lines, texts, fenced = [], [], False
    for number, line in enumerate(source.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif fenced:
            texts += [[number, text] for _, text in hash_texts(line)]
        elif line.startswith("|"):
            texts += [[number, cell] for cell in re.split(r"(?<!\\)\|", line) if not QUOTED.fullmatch(cell)]
        elif not line.startswith("#"):
            lines.append((number, 0, line))
    return joined(lines) + texts


def texts_of(path, source):
    """Returns [line, text] of the comments of a file, or None for a file of another kind."""
    shebang = re.match(r"#!.*[/ ](\w+)", source)
    script = shebang.group(1) if shebang and shebang.group(1) in SCRIPTS else None
    if path.endswith((".cpp", ".hpp", ".geo")):
        return cpp_texts(source)
    if path.endswith((".py", ".pyi")) or script == "python3":
        return python_texts(source)
    if path.endswith(MARKDOWN):
        return markdown_texts(source)
    return hash_texts(source) if path.endswith(HASHES) or script else None


def area_of(path):
    """Returns the part of the project to which a file belongs."""
    first = path.split(os.sep)[0]
    if first == "mechanism" and path.endswith((".cpp", ".hpp")):
        return "mechanism (C++)"
    return first if os.sep in path else "."


def faults(root):
    """Returns {area: [`file:line: opener: text`]} of all sources and documents."""
    found = {}
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(name for name in folders if name not in ("build", ".git"))
        for name in sorted(files):
            path = os.path.relpath(os.path.join(folder, name), root)
            try:
                with open(os.path.join(root, path), encoding="utf-8") as file:
                    texts = texts_of(path, file.read())
            except UnicodeDecodeError:
                continue
            if texts is None:
                continue
            entries = found.setdefault(area_of(path), [])
            for line, text in texts:
                entries += [f"{path}:{line}: {opener}: {text[:90]}" for opener in openers(text)]
    return found
