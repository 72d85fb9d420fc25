"""The page of the gallery: plain HTML without a network."""

import os

from ..html_parts import mark, table, text
from .making import MODELS

STYLE = """
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 70em; padding: 0 1em; color: #222; }
section { border-top: 2px solid #345; margin-top: 2em; } h2 { margin-bottom: 0.2em; }
img { max-width: 100%; border: 1px solid #ddd; margin: 0.3em 0; }
table { border-collapse: collapse; font-size: 13px; margin: 0.6em 0; }
th, td { border-bottom: 1px solid #ddd; padding: 0.2em 0.7em; text-align: left; vertical-align: top; }
th { background: #f2f4f6; } td.number { text-align: right; white-space: nowrap; }
.passed { color: #00693e; font-weight: bold; } .failed { color: #b00020; font-weight: bold; } a { color: #0b5394; }
"""


def page(machines):
    """The text of the page. @param machines  list of Made"""
    failed = [made.name for made in machines if not made.passed]
    verdict = f"Failed: {', '.join(failed)}." if failed else "All checks passed."
    parts = ["<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>Bielle: gallery</title>",
             f"<style>{STYLE}</style></head><body>",
             "<h1>Gallery of machines</h1>", f"<p class='{'failed' if failed else 'passed'}'>{text(verdict)}</p>",
             "<p>Each machine is a complete model. Its checks compare numbers of the run with others that are computed "
             "without Bielle.</p>",
             "<ul>", *(f"<li><a href='#{made.name}'>{text(made.machine.title)}</a></li>" for made in machines), "</ul>",
             *map(section, machines)]
    return "\n".join(parts) + "\n</body></html>\n"


def section(made):
    """The part of the page about one machine."""
    models = dict.fromkeys(words[0] for words in made.machine.runs.values())
    links = [f"<a href='{MODELS}/{text(model)}'>{text(model)}</a>" for model in models]
    if made.page:
        links.insert(0, f"<a href='{text(made.page)}'>the machine in motion</a>")
    return "\n".join([f"<section id='{made.name}'><h2>{text(made.machine.title)} {mark(made.passed)}</h2>",
                      *(f"<img src='{text(picture)}' alt='{text(os.path.basename(picture))}'>"
                        for picture in made.pictures),
                      f"<p>{text(made.machine.teaches)}</p>", f"<p>{', '.join(links)}; {made.seconds:.0f} s</p>",
                      f"<p class='failed'>{text(made.failure)}</p>" if made.failure else "",
                      table_of_checks(made.checks), "</section>"])


def table_of_checks(checks):
    """The checks of a machine; empty without any."""
    if not checks:
        return ""
    lines = [[f"{text(check.quantity)} [{text(check.unit)}]", f"{check.value:.7g}", f"{check.reference:.7g}",
              f"{100 * check.difference:.3g} %",
              f"{100 * check.within:.3g} %: {text(check.reason)}<br>independent: {text(check.formula)}",
              mark(check.passed)] for check in checks]
    return table(["quantity", "run", "independent", "difference", "accepted", ""], lines, numbers=(1, 2, 3))
