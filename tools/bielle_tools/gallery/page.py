"""The page of the gallery: plain HTML without a network."""

import os

from ..html_parts import document, mark, table, text
from .making import MODELS


def page(machines, program):
    """The text of the page. @param machines  list of Made; program: name, version and commit of what computed them"""
    failed = [made.name for made in machines if not made.passed]
    verdict = f"Failed: {', '.join(failed)}." if failed else "All checks passed."
    parts = ["<h1>Gallery of machines</h1>", f"<p class='{'failed' if failed else 'passed'}'>{text(verdict)}</p>",
             "<p>Each machine is a complete model. Its checks compare numbers of the run with others that are computed "
             "without Bielle.</p>", f"<p class='quiet'>Computed by {text(program)}.</p>",
             "<ul>", *(f"<li><a href='#{made.name}'>{text(made.machine.title)}</a></li>" for made in machines), "</ul>",
             *map(section, machines)]
    return document("Bielle: gallery", parts)


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
