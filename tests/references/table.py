"""Tables of reference values: a script of this folder computes them, and a test reads them by name.

A row is `name,value,within,meaning`; `within` is the largest possible error of the value, in its unit.
"""
import argparse
import csv
import math
import os
import sys

COLUMNS = ["name", "value", "within", "meaning"]


class Table:
    """Rows in the order in which they are added."""

    def __init__(self):
        self.rows = {}

    def add(self, name, value, within, meaning=""):
        """Adds one number. The meaning names its unit and has no comma."""
        value, within = float(value), float(within)
        if name in self.rows or "," in name + meaning:
            raise ValueError(f"the row '{name}' stands twice, or has a comma")
        if not (math.isfinite(value) and within > 0):
            raise ValueError(f"the row '{name}' has no finite value that is known to some amount")
        self.rows[name] = (value, within, meaning)

    def add_vector(self, name, values, within, meaning="", components="xyz"):
        """Adds `name.x` and so on, one row per component."""
        for component, value in zip(components, values, strict=True):
            self.add(f"{name}.{component}", value, within, meaning)

    def write(self, path):
        """Writes two digits more than the claimed accuracy."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n", quoting=csv.QUOTE_NONE)
            writer.writerow(COLUMNS)
            for name, (value, within, meaning) in self.rows.items():
                writer.writerow([name, text_of(value, within), f"{within:g}", meaning])


def text_of(value, within):
    """Returns the value with two digits beyond the accuracy `within`."""
    last = math.floor(math.log10(within)) - 2
    leading = math.floor(math.log10(abs(value))) if value else last
    return f"{value:.{min(max(leading - last, 1), 16)}e}" if leading < -3 or last > 0 else f"{value:.{-last}f}"


def read(path):
    """Returns the table in a file."""
    table = Table()
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.reader(file)
        if next(reader, None) != COLUMNS:
            raise ValueError(f"{path} does not begin with {','.join(COLUMNS)}")
        for row in reader:
            table.add(*row)
    return table


def differences(old, new):
    """Returns a sentence for each number that changed by more than its claimed accuracy."""
    found = [f"'{name}' is no longer computed" for name in old.rows if name not in new.rows]
    found += [f"'{name}' does not stand in the table" for name in new.rows if name not in old.rows]
    for name, (value, within, _) in new.rows.items():
        if name not in old.rows:
            continue
        before, claimed, _ = old.rows[name]
        if abs(value - before) > within:
            found.append(f"'{name}' is {text_of(value, within)}, was {text_of(before, within)}: claimed to {within:g}")
        if not math.isclose(claimed, within, rel_tol=1e-4):
            found.append(f"'{name}' is claimed to {within:g}, was claimed to {claimed:g}")
    return found


def run(fill, script):
    """Runs the command of a script, which writes its table or compares with it (--check). @param fill  adds rows to a
    table"""
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
    parser.add_argument("--check", action="store_true", help="compare with the table, and change nothing")
    check = parser.parse_args().check
    path = os.path.splitext(os.path.abspath(script))[0] + ".csv"
    new = Table()
    fill(new)
    old = read(path) if os.path.exists(path) else Table()
    changed = differences(old, new)
    for sentence in changed:
        print(sentence)
    if check:
        print(f"{len(new.rows)} values computed anew, {len(changed)} differ")
        sys.exit(1 if changed or not new.rows else 0)
    new.write(path)
    print(f"{len(new.rows)} values written to {path}")
