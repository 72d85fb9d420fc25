"""Computes a problem and judges it: errors, observed orders, processor times, and sentences about failures."""

import math
import resource
import time

import numpy as np

from .problem import numbers


def processor_time():
    """Processor time of this process and of the programs that it has run [s]."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def observed_order(sizes, errors, floor=0.0):
    """The slope of log(error) over log(size) by least squares, over the levels with an error of more than `floor`.

    @returns (slope or nan, number of levels used)
    """
    used = [(math.log(size), math.log(error)) for size, error in zip(sizes, errors)
            if math.isfinite(error) and error > max(floor, 0.0)]
    if len(used) < 2:
        return math.nan, len(used)
    return float(np.polyfit(*np.array(used).T, 1)[0]), len(used)


def compute_study(study):
    """The computed levels of a study, judged, as a dictionary."""
    levels, values = [], []
    for level in study.levels:
        start = processor_time()
        found = study.compute(level)
        levels.append({"level": level, "size": study.size(level), "processor_time": processor_time() - start})
        missing = [quantity.name for quantity in study.quantities if quantity.name not in found]
        if missing:
            raise KeyError(f"'{study.title}' computes no {', '.join(missing)}")
        values.append(found)
    quantities = [judge(study, quantity, [found[quantity.name] for found in values]) for quantity in study.quantities]
    return {"title": study.title, "parameter": study.parameter, "by": study.by, "levels": levels,
            "quantities": quantities, "accuracy": study.accuracy,
            "kept_from": kept_from(quantities, len(levels)) if study.by else None}


def kept_from(quantities, count):
    """Number of the coarsest level from which on all quantities keep their tolerances; None if the last does not."""
    found = None
    for k in reversed(range(count)):
        if not all(quantity["errors"][k] <= quantity["tolerance"] for quantity in quantities):
            break
        found = k
    return found


def judge(study, quantity, values):
    """A quantity at all levels of a study, with its verdict, as a dictionary."""
    errors = [quantity.error(value) for value in values]
    scale = np.linalg.norm(np.asarray(quantity.reference, dtype=float)) if quantity.relative else 1.0
    sizes = [study.size(level) for level in study.levels]
    order, used = observed_order(sizes, errors, 3 * quantity.known_to / scale) if study.by else (math.nan, 0)
    failures = list(wrong_values(study, quantity, errors))
    if quantity.order is not None:
        failures += wrong_order(quantity, order, used)
    return {"name": quantity.name, "meaning": quantity.meaning, "unit": quantity.unit,
            "error_unit": quantity.error_unit,
            "reference": np.asarray(quantity.reference, dtype=float).tolist(), "source": quantity.source,
            "known_to": quantity.known_to, "tolerance": quantity.tolerance, "reason": quantity.reason,
            "values": [numbers(value).tolist() for value in values], "errors": errors, "order": order,
            "levels_in_order": used, "expected_order": quantity.order, "order_within": quantity.order_within,
            "order_at_least": quantity.order_at_least, "order_reason": quantity.order_reason,
            "passed": not failures, "failures": failures}


def wrong_values(study, quantity, errors):
    """A sentence for each level without a number, and for each that has to keep the tolerance and does not."""
    for k, (level, error) in enumerate(zip(study.levels, errors)):
        at = f"{quantity.meaning}, {study.parameter} {level}"
        if not math.isfinite(error):
            yield f"{at}: the result is not a number, or has another size than the reference"
        elif error > quantity.tolerance and (not study.by or k + 1 == len(errors)):
            yield (f"{at}: the error {error:.3g} ({quantity.error_unit}) is larger than the tolerance "
                   f"{quantity.tolerance:.3g}")


def wrong_order(quantity, order, used):
    """A list with a sentence if the observed order is not the expected one."""
    if used < 2:
        return [f"{quantity.meaning}: the order cannot be observed, as errors are within the uncertainty of the "
                f"reference"]
    low = order >= quantity.order - quantity.order_within
    high = quantity.order_at_least or order <= quantity.order + quantity.order_within
    if low and high:
        return []
    wanted = f"at least {quantity.order:g} - {quantity.order_within:g}" if quantity.order_at_least else \
        f"{quantity.order:g} +- {quantity.order_within:g}"
    return [f"{quantity.meaning}: the observed order is {order:.2f}, expected {wanted}"]


def compute_problem(problem):
    """All studies of a problem as a dictionary."""
    studies = [compute_study(study) for study in problem.studies]
    failures = [sentence for study in studies for quantity in study["quantities"] for sentence in quantity["failures"]]
    return {**described(problem), "studies": studies, "failures": failures, "passed": not failures}


def described(problem):
    """The texts of a problem as a dictionary."""
    return {"title": problem.title, "subject": problem.subject, "source": problem.source, "model": problem.model}
