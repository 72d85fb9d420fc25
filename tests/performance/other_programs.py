"""Runs of single programs for compare_reduction and race, and the rod of compare_reduction with its matrices in
files."""

import glob
import os
import subprocess
import time

import numpy as np

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
BODY = """body: rod
geometry: {root}/meshes/conrod.geo
length_unit: mm
mesh: {{size: {size}e-3, order: 2}}
materials:
  steel: {{young: 210e9, poisson: 0.3, density: 7850}}
regions: {{rod: steel}}
interfaces:
  big_end: {{surface: bore_big, tie: rigid}}
  small_end: {{surface: bore_small, tie: rigid}}
modes: {{count: {modes}}}
damping: {{ratio: 0.01}}
recovery: {{displacement: all, stress: surface}}
"""


class Run:
    """One run of a program, with output, elapsed and processor time [s], and the largest total memory of its processes
    [GB]."""

    def __init__(self, command, folder, processes=1, **environment):
        variables = {k: v for k, v in os.environ.items() if not k.startswith("OPENBLAS_")}
        log = os.path.join(folder, "log.txt")
        with open(log, "w", encoding="utf-8") as file:
            start = time.monotonic()
            process = subprocess.Popen(command, cwd=folder, env=variables | environment, stdout=file, stderr=file)
            _, status, usage = os.wait4(process.pid, 0)
            self.seconds = time.monotonic() - start
        self.processor_seconds = usage.ru_utime + usage.ru_stime
        process.returncode = os.waitstatus_to_exitcode(status)
        with open(log, encoding="utf-8") as file:
            self.text = file.read()
        if process.returncode != 0:
            raise RuntimeError(f"{command[0]} failed:\n{self.text[-300:]}")
        self.gigabytes = usage.ru_maxrss * 1024e-9 * processes


def petsc_path(package):
    """Folder in which Debian puts the Python packages of PETSc and SLEPc, which is not on Python's path; empty:
    `package` ("petsc" or "slepc") is not installed."""
    places = sorted(glob.glob("/usr/lib/petscdir/*/*real*/lib/python3/dist-packages")
                    + glob.glob("/usr/lib/slepcdir/*/*real*/lib/python3/dist-packages"))
    return os.pathsep.join(places) if any(package + "dir" in place for place in places) else ""


def on_ranks(command, processes):
    """Returns the command for a number of MPI ranks."""
    if processes == 1:
        return command
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(processes)] + command


def read_symmetric(folder, name):
    """Reads a matrix with both triangles, as scipy's CSR."""
    import scipy.sparse

    starts = np.fromfile(os.path.join(folder, name + ".starts"), dtype=np.int64)
    rows = np.fromfile(os.path.join(folder, name + ".rows"), dtype=np.int64)
    values = np.fromfile(os.path.join(folder, name + ".values"))
    lower = scipy.sparse.csc_matrix((values, rows, starts), shape=(len(starts) - 1,) * 2)
    return (lower + scipy.sparse.tril(lower, -1).T).tocsr()


def petsc_matrix(folder, name):
    """Makes a positive definite matrix of PETSc from the rows of each rank."""
    from petsc4py import PETSc

    whole = read_symmetric(folder, name)
    layout = PETSc.Mat().create(PETSc.COMM_WORLD)
    layout.setSizes(whole.shape)
    layout.setType("aij")
    layout.setUp()
    first, last = layout.getOwnershipRange()
    own = whole[first:last] if PETSc.COMM_WORLD.getSize() > 1 else whole
    matrix = PETSc.Mat().createAIJ(size=whole.shape, csr=(own.indptr.astype(np.int32), own.indices.astype(np.int32),
                                                          own.data), comm=PETSc.COMM_WORLD)
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    return matrix
