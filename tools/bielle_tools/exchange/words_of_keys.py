"""Sentences of bielle-exchange in the words of a body file: `nodes: FILE` in place of --nodes FILE.

`bielle-reduce` calls the tool, and its users know the keys of `matrices` in a body file, not the options of the tool.
"""

import re

KEYS = {"mass": "mass", "nodes": "nodes", "unknowns": "unknowns", "names": "names", "quantities": "quantities", "from": "format",
        "units": "units", "interfaces": "interfaces"}
OPTION = re.compile(r"--(" + "|".join(KEYS) + r")\b(?:[ ]((?:FILE|DECK)\b|'[^']*'|[\w.-]+=[\w.:,-]+|[A-Za-z]+-[\w-]+|\d+(?:,\d+)*))?")


def in_words_of_keys(text, units_are_an_option):
    """A sentence with the keys of `matrices` in place of options. @param units_are_an_option: whether the user gives --units to bielle-reduce"""
    def key(match):
        option, value = match[1], (match[2] or "").strip("'")
        if option == "units" and units_are_an_option:
            return match[0]
        name, separator, rest = value.partition("=")
        inside = f": {{{name}: {rest}}}" if separator else f": {value}" if value else ""
        keys = f"{KEYS[option]}{inside}"
        return f"`{keys}`" if option == "interfaces" or not units_are_an_option else f"`matrices: {{.., {keys}}}` of a body file"

    return OPTION.sub(key, text)
