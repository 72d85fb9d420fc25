"""Divides long sweeps between the everyday tests and the long ones.

The everyday tests run a third of the cases, another third at the next commit; the long tests run the other cases.
BIELLE_SHARE tells the part of a ctest (bielle_python_test with SHARED); without it all cases are run. BIELLE_TURN is
the number of commits (tools/test).
"""

import os
import unittest


def share(items):
    """Returns the items that belong to this ctest."""
    part, turn = os.environ.get("BIELLE_SHARE", "all"), int(os.environ.get("BIELLE_TURN") or 0)
    if part not in ("everyday", "rest", "all"):
        raise ValueError(f"BIELLE_SHARE is '{part}', expected 'everyday', 'rest' or 'all'")
    if part != "all" and len(items) < 3:
        raise ValueError("fewer than three cases have no thirds")
    return [item for k, item in enumerate(items) if part == "all" or (k % 3 == turn % 3) == (part == "everyday")]


def share_of_tests(_loader, tests, _pattern):
    """Selects the share of test methods of each class, in a module that imports this function as `load_tests`."""
    return unittest.TestSuite(share(list(_each(tests))))


def _each(tests):
    for test in tests:
        if isinstance(test, unittest.TestSuite):
            yield from _each(test)
        else:
            yield test
