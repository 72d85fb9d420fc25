"""The copy of the report that is kept with the sources: results of all problems as one page of Markdown."""

from .collections import COLLECTIONS
from .page import largest_share, number, orders, processor_time, sorted_by_subject

KEPT = ("program", "commit", "date", "processor", "cores")  # facts of the machine that are stated


def released(results, facts):
    """The text of the page. @param results  of runs.run_all @param facts  of machine.described"""
    lines = ["# Verification results", "",
             "`tools/verify --release` writes this page; [README.md](README.md) explains the report, which has the "
             "references, tolerances with their reasons, errors at all steps or meshes, and figures.", "",
             *(f"- {what}: {text}" for what, text in facts if what in KEPT), "",
             "Errors are those of the last step or mesh, relative to the tolerance. A problem passes below 1, if the "
             "order of convergence is the expected one (in parentheses)."]
    subject = None
    for result in sorted_by_subject(results).values():
        if result["subject"] != subject:
            subject = result["subject"]
            lines += ["", f"## {subject}", "",
                      "| file | problem | | largest error / tolerance | observed order | processor time [s] |",
                      "|---|---|---|---|---|---|"]
        lines.append(f"| `{result['name']}` | {result['title']} | {'passed' if result['passed'] else 'failed'} | "
                     f"{number(largest_share(result), 2)} | {orders(result)} | {number(processor_time(result), 2)} |")
    return "\n".join(lines + ["", *coverage(), ""])


def coverage():
    """Lines about the collections."""
    lines = ["## Collections", "", "| collection | part | files | |", "|---|---|---|---|"]
    for collection, parts in COLLECTIONS.items():
        lines += [f"| {collection} | {part.name} | {', '.join(f'`{name}`' for name in part.problems) or 'left out'} | "
                  f"{part.remark} |" for part in parts]
    return lines
