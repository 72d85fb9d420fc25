"""Computes and draws one problem in a process of its own: child.py PROBLEM.py RESULT.json."""

import importlib.util
import json
import math
import os
import sys

TESTS = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(TESTS, "verification"), os.path.join(os.path.dirname(TESTS), "tools")]

from harness.judgement import compute_problem  # noqa: E402
from harness.problem import Problem  # noqa: E402


def load(path):
    """The problem that a file defines. @raises ValueError"""
    spec = importlib.util.spec_from_file_location(os.path.splitext(os.path.basename(path))[0], path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    problem = getattr(module, "PROBLEM", None)
    if not isinstance(problem, Problem) or not problem.studies:
        raise ValueError(f"{path} defines no PROBLEM with studies")
    return problem


def plain(value):
    """The value with numbers that JSON has: others become texts."""
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value


def figure(study):
    """The figure of a study; empty if its levels are no refinement. Only others need matplotlib, which is slow to
    load."""
    if not study["by"] or len(study["levels"]) < 2:
        return ""
    from harness.figures import convergence
    return convergence(study)


def main(path, output):
    """Writes the result, with the figure of each study."""
    result = compute_problem(load(path))
    for study in result["studies"]:
        study["figure"] = figure(study)
    with open(output, "w", encoding="utf-8") as file:
        json.dump(plain(result), file, allow_nan=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
