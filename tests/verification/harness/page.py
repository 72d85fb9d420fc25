"""The report as one HTML page."""

import math
import re

from bielle_tools.html_parts import document, mark, table, text

from .published import COLLECTIONS

SUBJECTS = ["Rigid mechanisms", "Beams at rest", "Beams in motion", "Solids and superelements",
            "Hydraulics and friction", "Integration in time"]


def page(results, facts, quick):
    """The text of the page. @param results  of runs.run_all @param facts  of machine.described"""
    failed = [result for result in results.values() if not result["passed"]]
    names = ", ".join(result["name"] for result in failed)
    verdict = f"All {len(results)} problems passed"
    if failed:
        verdict = f"{len(failed)} of {len(results)} problems failed: {names}"
    results = sorted_by_subject(results)
    subjects = list(dict.fromkeys(result["subject"] for result in results.values()))
    parts = ["<h1>Verification of Bielle</h1>", f"<p class='{'failed' if failed else 'passed'}'>{text(verdict)}.</p>",
             "<p>Each problem has an exact or published reference. Models were computed for this page, at several "
             "steps or meshes; errors, observed orders and processor times "
             "are those of this run. A problem passes if the error of the last level is within the stated tolerance "
             "and the order is the expected one. "
             "No reference comes from Bielle.</p>",
             "<p>Quick selection: run without <code>--quick</code> for all problems.</p>" if quick else "",
             table(["", ""], [[text(what), text(value)] for what, value in facts]), "<h2>Summary</h2>",
             summary(results), submissions(results), collections(results)]
    for subject in subjects:
        parts.append(f"<h2>{text(subject or 'Problems')}</h2>")
        parts += [section(result) for result in results.values() if result["subject"] == subject]
    return document("Bielle: verification", list(filter(None, parts)))


def sorted_by_subject(results):
    """The results in the order of the page."""
    return dict(sorted(results.items(), key=lambda item: (place(item[1]["subject"]), item[1]["title"])))


def place(subject):
    """Place of a subject among the others; unknown ones come last."""
    return (SUBJECTS.index(subject), "") if subject in SUBJECTS else (len(SUBJECTS), subject)


def summary(results):
    """The table on top: a line for each problem."""
    lines = [[f"<a href='#{text(result['name'])}'>{text(result['title'])}</a>", mark(result["passed"]),
              number(largest_share(result), 2), text(orders(result)), number(processor_time(result), 3)]
             for result in results.values()]
    return table(["problem", "", "largest error / tolerance", "observed order (expected)", "processor time [s]"],
                 lines, numbers=(2, 4))


def quantities_of(result):
    """The quantities of all studies of a problem."""
    return [quantity for study in result["studies"] for quantity in study["quantities"]]


def orders(result):
    """Observed orders, with the expected ones, as a text."""
    found = [f"{float(quantity['order']):.2f} ({quantity['expected_order']:g})" for quantity in quantities_of(result)
             if quantity["expected_order"] is not None]
    return ", ".join(dict.fromkeys(found)) or "-"


def largest_share(result):
    """The largest error at the last level over its tolerance; not a number if there is none."""
    shares = [float(quantity["errors"][-1]) / quantity["tolerance"] for quantity in quantities_of(result)]
    return math.nan if any(map(math.isnan, shares)) else max(shares, default=math.nan)


def submitted(results):
    """The studies that have an accuracy, each with its problem and the quantity of the accuracy."""
    return [(result, study, next(each for each in study["quantities"] if each["name"] == study["accuracy"]))
            for result in results.values() for study in result["studies"] if study["accuracy"]]


def submissions(results):
    """The problems of the IFToMM library in the form of its submissions: accuracy and processor time at each step."""
    lines = [[text(result["title"]), text(study["title"]), text(quantity["meaning"]), text(f"{level['level']}"),
              f"{number(error, 2)} {text(quantity['error_unit'])}", number(level["processor_time"], 2)]
             for result, study, quantity in submitted(results)
             for level, error in zip(study["levels"], quantity["errors"])]
    if not lines:
        return ""
    return "<h2>In the form of the IFToMM library</h2>\n" + table(
        ["problem", "study", "accuracy", "step [s]", "", "processor time [s]"], lines, numbers=(3, 5))


def collections(results):
    """Table of the published collections, with parts that are left out; none if no problem of them was computed."""
    if not any(name in results for parts in COLLECTIONS.values() for part in parts for name in part.problems):
        return ""
    lines = []
    for collection, parts in COLLECTIONS.items():
        for part in parts:
            links = [f"<a href='#{text(name)}'>{text(name)}</a>" if name in results else text(name)
                     for name in part.problems]
            lines.append([text(collection), text(part.name), ", ".join(links) or "left out", text(part.remark)])
    return "<h2>Collections</h2>\n" + table(["collection", "part", "problems", ""], lines)


def processor_time(result):
    """Processor time of all levels of a problem [s]."""
    return sum(level["processor_time"] for study in result["studies"] for level in study["levels"])


def section(result):
    """The part of the page about a problem."""
    parts = [f"<h3 id='{text(result['name'])}'>{text(result['title'])} {mark(result['passed'])}</h3>",
             f"<p class='quiet'>{text(result['source'])} <br>file <code>{text(result['name'])}.py</code></p>",
             f"<p>{text(result['model'])}</p>"]
    if result["failures"]:
        parts.append(f"<div class='failures'>{'<br>'.join(map(text, result['failures']))}</div>")
    for study in result["studies"]:
        parts += [f"<h4>{text(study['title'])}</h4>", quantities_table(study), errors_table(study), precision(study),
                  study.get("figure", "")]
    return "\n".join(filter(None, parts))


def quantities_table(study):
    """References, tolerances and orders of the quantities of a study."""
    lines = []
    for quantity in study["quantities"]:
        order = expected = "-"
        if quantity["expected_order"] is not None:
            order = f"{float(quantity['order']):.2f}"
            least = "at least " if quantity["order_at_least"] else ""
            expected = f"{least}{quantity['expected_order']:g} &plusmn; {quantity['order_within']:g}"
        tolerance = f"{number(quantity['tolerance'], 2)} ({text(quantity['error_unit'])}): {text(quantity['reason'])}"
        remark = f"<br><span class='quiet'>{text(quantity['order_reason'])}</span>" if quantity["order_reason"] else ""
        lines.append([f"{text(quantity['meaning'])} [{text(quantity['unit'])}]", values(quantity["reference"]),
                      values(quantity["values"][-1]), text(quantity["source"]),
                      tolerance, order, expected + remark, mark(quantity["passed"])])
    return table(["quantity", "reference",
                  f"computed, {text(study['parameter'])} {text(study['levels'][-1]['level'])}",
                  "source of the reference", "tolerance and its reason", "observed order", "expected", ""], lines)


def errors_table(study):
    """Errors and processor times of the levels of a study."""
    heads = [study["parameter"],
             *(f"error: {quantity['meaning']} [{quantity['error_unit']}]" for quantity in study["quantities"]),
             "processor time [s]"]
    lines = [[text(f"{level['level']}"), *(number(quantity["errors"][k], 3) for quantity in study["quantities"]),
              number(level["processor_time"], 3)]
             for k, level in enumerate(study["levels"])]
    return table([text(head) for head in heads], lines, numbers=range(len(heads)))


def precision(study):
    """The sentence with which a benchmark is submitted: the coarsest level that is accurate enough, and its processor
    time."""
    if study["kept_from"] is None or len(study["levels"]) < 2:
        return ""
    level = study["levels"][study["kept_from"]]
    return (f"<p class='quiet'>All tolerances are kept from {text(study['parameter'])} = {text(level['level'])} on, "
            f"with {number(level['processor_time'], 2)} s of processor time.</p>")


def number(value, digits):
    """A number for people; infinite and undefined ones as texts."""
    value = float(value)
    return re.sub(r"e([+-])0*(\d+)$", lambda match: f"e{match[1].strip('+')}{match[2]}", f"{value:.{digits}g}")


def values(reference):
    """One or several numbers, as texts or lists of a result."""
    if not isinstance(reference, list):
        return f"{float(reference):.9g}"
    if any(isinstance(line, list) for line in reference):
        return "<br>".join(map(values, reference))
    return ", ".join(f"{float(value):.9g}" for value in reference) or "no numbers"
