"""The copy of the report that is kept with the sources: results of all problems as one page of Markdown."""

from .published import COLLECTIONS
from .page import largest_share, number, orders, processor_time, sorted_by_subject, submitted

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
    return "\n".join(lines + ["", *submissions(sorted_by_subject(results)), "", *coverage(), ""])


def submissions(results):
    """Lines about the problems of the IFToMM library: the largest step with which all tolerances are kept."""
    lines = ["## In the form of the IFToMM library", "",
             "| problem | study | accuracy | tolerance | step [s] | processor time [s] |", "|---|---|---|---|---|---|"]
    for result, study, quantity in submitted(results):
        k = study["kept_from"]
        level = study["levels"][k]
        accuracy = f"{quantity['meaning']}: {number(quantity['errors'][k], 2)} {quantity['error_unit']}"
        lines.append(f"| {result['title']} | {study['title']} | {accuracy} | {number(quantity['tolerance'], 2)} | "
                     f"{level['level']} | {number(level['processor_time'], 2)} |")
    return lines


def coverage():
    """Lines about the collections, each of which is named at its first part."""
    lines = ["## Collections", "", "| collection | part | files | |", "|---|---|---|---|"]
    for collection, parts in COLLECTIONS.items():
        lines += [f"| {'' if k else collection} | {part.name} | "
                  f"{', '.join(f'`{name}`' for name in part.problems) or 'left out'} | {part.remark} |"
                  for k, part in enumerate(parts)]
    return lines
