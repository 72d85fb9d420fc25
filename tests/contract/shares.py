"""Divides long sweeps between the everyday tests and the long ones.

A third of the cases is run everyday, another third at the next commit; the long tests run the others. BIELLE_SHARE of a
ctest says which part it is (bielle_python_test with SHARED); without it all cases are run. BIELLE_TURN is the number of
commits (tools/test).
"""

import os
import unittest


def share(items):
    """Returns the items of this ctest."""
    part, turn = os.environ.get("BIELLE_SHARE", "all"), int(os.environ.get("BIELLE_TURN") or 0)
    if part not in ("everyday", "rest", "all"):
        raise ValueError(f"BIELLE_SHARE is '{part}', expected 'everyday', 'rest' or 'all'")
    if part != "all" and len(items) < 3:
        raise ValueError("fewer than three cases have no thirds")
    return [item for k, item in enumerate(items) if part == "all" or (k % 3 == turn % 3) == (part == "everyday")]


def share_of_tests(_loader, tests, _pattern):
    """Gives a module that calls it `load_tests` its share of its test methods, class by class."""
    return unittest.TestSuite(share(list(_each(tests))))


def _each(tests):
    for test in tests:
        if isinstance(test, unittest.TestSuite):
            yield from _each(test)
        else:
            yield test
