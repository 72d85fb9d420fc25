"""Runs problems in processes of their own, several at a time."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

LONGEST = 280  # [s] for one problem
CHILD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "child.py")


def run_all(entries, programs, package, jobs, report):
    """Results of all entries, in their order. @param report  called with (entry, result) when one has ended"""
    def one(entry):
        result = run_one(entry, programs, package)
        report(entry, result)
        return entry.name, result

    ordered = sorted(entries, key=lambda entry: not entry["long"])
    with ThreadPoolExecutor(max_workers=jobs) as pool:
        results = dict(pool.map(one, ordered))
    return {entry.name: results[entry.name] for entry in entries}


def run_one(entry, programs, package):
    """The result of a problem; one that crashes or does not end has failed, with its message."""
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="verify.") as folder:
        output = os.path.join(folder, "result.json")
        environment = {**os.environ, "PYTHONPATH": package, "BIELLE_BIN": programs, "TMPDIR": folder,
                       "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive",
                       "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1", "PYTHONDONTWRITEBYTECODE": "1"}
        child = subprocess.Popen([sys.executable, CHILD, entry.path, output], cwd=folder, env=environment, text=True,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)
        try:
            errors = child.communicate(timeout=LONGEST)[1]
            failure = failure_of(child.returncode, errors)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.communicate()
            failure = f"it did not end within {LONGEST} s"
        result = None
        if not failure:
            with open(output, encoding="utf-8") as file:
                result = json.load(file)
    if result is None:
        words = {word: entry[word] for word in ("title", "subject", "source", "model")}
        result = {**words, "studies": [], "failures": [failure], "passed": False}
    return {**result, "name": entry.name, "seconds": time.monotonic() - start}


def failure_of(status, errors):
    """A sentence about a process that failed; empty if it did not."""
    if status == 0:
        return ""
    last = next((line.strip() for line in reversed(errors.splitlines()) if line.strip()), "")
    if status < 0:
        return f"the program crashed: {signal.Signals(-status).name}" + (f" ({last})" if last else "")
    return f"the program failed: {last or f'exit status {status}'}"
