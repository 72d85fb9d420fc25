"""Parts of reports as HTML pages: the page with its style, texts, tables, verdicts."""

import html

STYLE = """
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 70em; padding: 0 1em; color: #222; }
h2 { margin: 2em 0 0.2em; border-bottom: 2px solid #345; } h3 { margin-bottom: 0.2em; } h4 { margin: 1em 0 0.2em; }
table { border-collapse: collapse; font-size: 13px; margin: 0.6em 0 1em; }
th, td { border-bottom: 1px solid #ddd; padding: 0.2em 0.7em; text-align: left; vertical-align: top; }
th { background: #f2f4f6; } td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
img { max-width: 100%; border: 1px solid #ddd; margin: 0.3em 0; } svg { max-width: 100%; height: auto; } a { color: #0b5394; }
.passed { color: #00693e; font-weight: bold; } .failed { color: #b00020; font-weight: bold; }
.failures { background: #fdecee; padding: 0.4em 1em; } .quiet { color: #666; font-size: 13px; }
"""


def document(title, parts):
    """The text of a page without a network: a title, and parts in HTML, of which empty ones are left out."""
    head = f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>{text(title)}</title>\n<style>{STYLE}</style></head><body>"
    return "\n".join([head, *filter(None, parts)]) + "\n</body></html>\n"


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
