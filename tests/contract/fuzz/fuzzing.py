"""Runs the programs on files that a seed has damaged. For any file, a program ends by itself with status 0, 1 or 2, and
reports the error in a sentence written for it.

BIELLE_FUZZ_SEED chooses the damage (default 0), BIELLE_FUZZ_CASES multiplies the number of cases (default 1), and
BIELLE_FUZZ_PATIENCE the time that a program may take (default 1; sanitizers need more). A failure names the case, and
its file is kept under BIELLE_FUZZ_KEEP if that is set.
"""

import math
import os
import random
import shutil
import signal
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "programs"))
sys.path.insert(0, os.path.join(HERE, "..", "tools"))
from command import PROGRAMS, InFolder  # noqa: E402

SEED = int(os.environ.get("BIELLE_FUZZ_SEED", "0"))
TIMES = float(os.environ.get("BIELLE_FUZZ_CASES", "1"))
PATIENCE = float(os.environ.get("BIELLE_FUZZ_PATIENCE", "1"))
KEEP = os.environ.get("BIELLE_FUZZ_KEEP")
NEVER = ("unforeseen", "Traceback", "AddressSanitizer", "runtime error:", "terminate called", "Assertion")


def ended(run, processor_seconds=20, seconds=200):
    """Tells whether a process ends within this processor time; the elapsed time on a busy machine may be many times
    longer."""
    clock = os.sysconf("SC_CLK_TCK")
    until = time.monotonic() + PATIENCE * seconds
    while time.monotonic() < until:
        try:
            run.wait(timeout=2)
            return True
        except subprocess.TimeoutExpired:
            with open(f"/proc/{run.pid}/stat", encoding="utf-8") as file:
                used = file.read().rsplit(")", 1)[1].split()[11:15]
            if sum(map(int, used)) > PATIENCE * processor_seconds * clock:
                return False
    return False


class FuzzTest(InFolder):
    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data.encode() if isinstance(data, str) else data)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def cases(self, number):
        """Yields the numbers of cases, each with its own random generator, so that a case does not depend on previous
        ones."""
        for case in range(math.ceil(number * TIMES)):
            yield case, random.Random(f"{SEED} {self.id().rsplit('.', 1)[1]} {case}")

    def judge(self, note, keep, program, *arguments):
        """Runs a program. A long run must be a valid computation, which ends at a signal."""
        with open(self.path("said"), "w+", encoding="utf-8", errors="replace") as errors_file:
            run = subprocess.Popen([os.path.join(PROGRAMS, program), *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=errors_file,
                                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
            asked = not ended(run)
            if asked:
                run.send_signal(signal.SIGINT)
                if not ended(run):
                    run.kill()
                    run.wait()
            errors_file.seek(0)
            said = errors_file.read()
        errors = [line for line in said.splitlines() if ": error: " in line]
        faults = [word for word in NEVER if word in said]
        fine = run.returncode in (0, 1, 2) and not faults and (run.returncode == 0 or len(errors) == 1)
        if asked and program != "bielle-mechanism":
            fine = False
        if not fine and KEEP:
            os.makedirs(KEEP, exist_ok=True)
            for name in keep:
                if os.path.exists(self.path(name)):
                    shutil.copy(self.path(name), os.path.join(KEEP, f"{self.id().rsplit('.', 1)[1]}_{note.split()[0]}_{name}"))
        with self.subTest(case=note):
            self.assertTrue(fine, f"{program}: case {note}: status {run.returncode}{' after long' if asked else ''}: "
                                  f"{said[-600:]}")
        return run.returncode


def damaged_bytes(rng, data):
    """@returns the data with one damage of a kind that occurs on disks and in transfers, and its name."""
    data = bytearray(data)
    place = rng.randrange(len(data))
    kind = rng.choice(["cut", "bit", "bytes", "head", "ones", "zeros"])
    if kind == "cut":
        del data[place:]
    elif kind == "bit":
        data[place] ^= 1 << rng.randrange(8)
    elif kind == "bytes":
        for _ in range(50):
            data[rng.randrange(len(data))] = rng.randrange(256)
    elif kind == "head":
        place = rng.randrange(min(len(data), 4096))
        data[place] = rng.choice([0, 255, rng.randrange(256)])
    else:
        length = min(rng.randrange(1, 4096), len(data) - place)
        data[place:place + length] = (b"\xff" if kind == "ones" else b"\0") * length
    return bytes(data), f"{kind} at {place}"
