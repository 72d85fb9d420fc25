"""Runs problems in processes of their own, several at a time."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor

LONGEST = 280  # [s] for one problem
CHILD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "child.py")


def run_all(entries, programs, package, jobs, report):
    """Results of all entries, in their order. @param report  called with (entry, result) when one has ended"""
    running, given_up = set(), threading.Event()

    def one(entry):
        result = run_one(entry, programs, package, running)
        if not given_up.is_set():
            report(entry, result)
        return entry.name, result

    ordered = sorted(entries, key=lambda entry: not entry["long"])
    with ThreadPoolExecutor(max_workers=jobs) as pool:
        try:
            results = dict(pool.map(one, ordered))
        except BaseException:  # Ctrl-C reaches this process alone
            given_up.set()
            pool.shutdown(wait=False, cancel_futures=True)
            for child in list(running):
                kill(child)
            raise
    return {entry.name: results[entry.name] for entry in entries}


def kill(child):
    """Ends a child with all programs that it runs."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child.pid, signal.SIGKILL)


def run_one(entry, programs, package, running):
    """The result of a problem; one that crashes or does not end has failed, with its message. @param running the
    children, while they run"""
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="verify.") as folder:
        output = os.path.join(folder, "result.json")
        environment = {**os.environ, "PYTHONPATH": package, "BIELLE_BIN": programs, "TMPDIR": folder,
                       "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive",
                       "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1", "PYTHONDONTWRITEBYTECODE": "1"}
        child = subprocess.Popen([sys.executable, CHILD, entry.path, output], cwd=folder, env=environment, text=True,
                                 errors="replace",
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)
        running.add(child)
        try:
            errors = child.communicate(timeout=LONGEST)[1]
            failure = failure_of(child.returncode, errors)
        except subprocess.TimeoutExpired:
            kill(child)
            child.communicate()
            failure = f"it did not end within {LONGEST} s"
        finally:
            running.discard(child)
        if not failure and not os.path.exists(output):
            failure = "the program ended without a result"
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
