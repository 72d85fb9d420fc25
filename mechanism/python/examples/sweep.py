#!/usr/bin/python3
"""A sweep: the same motion for many values of a parameter, several at a time in threads of Python.

    PYTHONPATH=build/release/python mechanism/python/examples/sweep.py [MODEL.yaml PARAMETER FROM TO COUNT]

Sessions compute without Python's global lock, so that threads use all cores; `tools/bielle-study` does the same with
processes and files.
"""

import os
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import bielle

SERVO = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "servo.yaml")


def sweep(model, parameter, values, result, threads=None):
    """Returns result(run) for each value of the parameter, and an Error in place of a run that failed."""

    def one(value):
        try:
            return result(bielle.run(model, parameters={parameter: value}))
        except bielle.Error as error:
            return error

    with ThreadPoolExecutor(threads or len(os.sched_getaffinity(0))) as pool:
        return list(pool.map(one, values))


def main(model=SERVO, parameter="mass", first=1, last=8, count=8):
    values = np.linspace(float(first), float(last), int(count))

    def largest(run):
        joint = next(iter(run.model.entries["joints"]))
        return joint, np.abs(run[f"joints/{joint}/coordinate"]).max()

    for value, found in zip(values, sweep(model, parameter, values, largest)):
        said = found if isinstance(found, bielle.Error) else f"largest coordinate of '{found[0]}': {found[1]:.5g}"
        print(f"{parameter} = {value:.4g}: {said}")


if __name__ == "__main__":
    main(*sys.argv[1:])
