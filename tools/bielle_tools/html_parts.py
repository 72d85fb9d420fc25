"""Parts of reports as HTML pages: texts, tables, verdicts."""

import html


def text(words):
    """Words in HTML."""
    return html.escape(str(words))


def table(heads, lines, numbers=()):
    """A table of HTML cells. @param numbers  columns that are aligned to the right"""
    head = "<tr>" + "".join(f"<th>{each}</th>" for each in heads) + "</tr>" if any(heads) else ""
    kinds = [" class='number'" if k in numbers else "" for k in range(len(heads))]
    rows = ["<tr>" + "".join(f"<td{kind}>{cell}</td>" for kind, cell in zip(kinds, line)) + "</tr>" for line in lines]
    return f"<table>{head}{''.join(rows)}</table>"


def mark(passed):
    """The word of a verdict."""
    return "<span class='passed'>passed</span>" if passed else "<span class='failed'>FAILED</span>"
