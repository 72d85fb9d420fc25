"""Tests of bielle-reduce-mpi: the result of several ranks equals that of one machine; its errors, and its end if a
process ends."""

import os
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy

from command import PROGRAMS, CommandTest
from equal_runs import datasets
from symmetric_bar import symmetric_bar
from test_reduce import BAR, BODY

PROGRAM = os.path.join(PROGRAMS, "bielle-reduce-mpi")
WHY_NOT = ("bielle-reduce-mpi is not built" if not os.path.exists(PROGRAM) else
           "there is no mpirun" if not shutil.which("mpirun") else "")

# The body has ends with different ties, one of which lets the bar rotate, loads and points with residual vectors,
# damping and masses.
RICH = BODY.replace("left: {surface: left, tie: rigid}", "left: {surface: left, tie: rigid, directions: [x, y, z, rx, rz]}").replace(
    "right: {surface: right, tie: rigid}", "right: {surface: right, tie: average}") + """\
damping: {ratio: [0.01, 0.02]}
loads:
  weight: {surface: bottom, force: [0, 0, -1], residual: true}
  wind: {surface: bottom, pressure: 1000}
points:
  sensor: {at: [0.1, 0.01, 0.02], residual: [x, z]}
masses:
  motor: {surface: bottom, mass: 0.3, position: [0.1, 0, 0.1], inertia: [1e-3, 2e-3, 2e-3]}
  bolt: {at: [0.1, 0.01, 0.02], mass: 0.1}
  paint: {surface: bottom, per_area: 2}
"""
PAIRS = """\
body: pairs
geometry: pairs.msh
materials: {steel: {young: 210e9, poisson: 0.3, density: 7850}}
regions: {bar: steel}
interfaces: {left: {surface: left}, right: {surface: right}}
modes: {count: COUNT}
"""


def descendants(pid):
    """Returns the processes that a process has started, directly or indirectly."""
    found = []
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="utf-8") as file:
                if int(file.read().rsplit(")", 1)[1].split()[1]) == pid:
                    found += [int(name), *descendants(int(name))]
        except OSError:
            pass
    return found


def command_of(pid):
    try:
        return os.path.basename(os.readlink(f"/proc/{pid}/exe"))
    except OSError:
        return ""


def values_in(path):
    with h5py.File(path) as file:
        return {name: item[()] for name, item in datasets(file).items()}


@unittest.skipIf(WHY_NOT, WHY_NOT)
class Distributed(CommandTest):
    program = "bielle-reduce"

    def start(self, ranks, *arguments):
        environment = dict(os.environ, OMPI_MCA_rmaps_base_oversubscribe="1", OPENBLAS_NUM_THREADS="1",
                           OMPI_MCA_mpi_yield_when_idle="1")  # waiting ranks yield the cores to others
        if os.geteuid() == 0:
            environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        return subprocess.Popen(["mpirun", "-n", str(ranks), PROGRAM, *arguments], cwd=self.folder, env=environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def distribute(self, ranks, *arguments):
        """Returns the status and the standard error."""
        run = self.start(ranks, *arguments)
        said = run.communicate(timeout=300)[1]
        return run.returncode, said

    def both(self, body, ranks=2):
        """Returns the files of one machine and of several ranks for a body."""
        self.write("body.yaml", body)
        alone = self.run_program("body.yaml", "-o", "alone.h5", "--quiet")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        status, said = self.distribute(ranks, "body.yaml", "-o", "shared.h5", "--quiet")
        self.assertEqual(status, 0, said)
        inspected = self.run_program("--inspect", "shared.h5")
        self.assertEqual(inspected.returncode, 0, inspected.stderr)
        return values_in(self.path("alone.h5")), values_in(self.path("shared.h5"))

    def expect_same(self, alone, shared):
        """Compares the files except for the checks, which are rounding errors. Signs of modes are unique, since their
        largest component is positive."""
        self.assertEqual(set(alone), set(shared))
        for name, values in alone.items():
            if "checks/" in name or name.endswith("checks"):
                continue
            if getattr(values, "dtype", numpy.dtype("O")).kind != "f":
                numpy.testing.assert_array_equal(values, shared[name], name)
            elif values.size > 0:
                error = numpy.abs(values - shared[name]).max()
                self.assertLessEqual(error, 1e-7 * numpy.abs(values).max(), name)

    def test_one_rank_and_two_write_what_one_machine_does(self):
        self.write("bar.geo", BAR)
        for ranks in (1, 2):
            alone, shared = self.both(RICH, ranks)
            self.expect_same(alone, shared)
            numpy.testing.assert_allclose(shared["modes/frequencies"], alone["modes/frequencies"], rtol=1e-9)

    def test_modes_below_a_frequency_and_bodies_in_pieces(self):
        self.write("bar.geo", BAR)
        below = BODY.replace("modes: {count: 4}", "modes: {below: 12000}")
        alone, shared = self.both(below, 3)
        self.assertGreater(len(shared["modes/frequencies"]), 4)
        numpy.testing.assert_allclose(shared["modes/frequencies"], alone["modes/frequencies"], rtol=1e-9)
        alone, shared = self.both(BODY + "inertia_relief: true\n")
        self.assertEqual(len(shared["modes/frequencies"]), 4 + 12)
        numpy.testing.assert_allclose(shared["modes/frequencies"], alone["modes/frequencies"], rtol=1e-6)
        answers = [numpy.abs(file["reduced/inertia_answer/missing"]).max() / numpy.abs(file["reduced/inertia_answer/whole"]).max()
                   for file in (alone, shared)]
        self.assertLess(max(answers), 1e-9)
        alone, shared = self.both(BODY + "pieces: {planes: {axis: x, at: 0.1}}\n")
        for piece in ("pieces/1", "pieces/2"):
            numpy.testing.assert_allclose(shared[piece + "/modes/frequencies"], alone[piece + "/modes/frequencies"], rtol=1e-9)

    def test_repeated_frequencies_are_found_as_often_as_they_are_there(self):
        self.write("pairs.msh", symmetric_bar(16, 2))
        alone, shared = self.both(PAIRS.replace("COUNT", "9"))
        frequencies = shared["modes/frequencies"]
        numpy.testing.assert_allclose(frequencies, alone["modes/frequencies"], rtol=1e-9)
        pairs = numpy.isclose(frequencies[1:], frequencies[:-1], rtol=1e-9)
        self.assertEqual(pairs.sum(), 3)
        # Modes of a pair may be rotated, which does not affect their products with the remaining mass and stiffness.
        kept = len(shared["reduced/mass"]) - len(frequencies)
        for name in ("reduced/mass", "reduced/stiffness"):
            a, b = alone[name], shared[name]
            scale = numpy.abs(a).max()
            numpy.testing.assert_allclose(a[:kept, :kept], b[:kept, :kept], atol=1e-9 * scale)
        ends = numpy.flatnonzero(numpy.append(~pairs, True)) + 1
        starts = numpy.append(0, ends[:-1])
        for start, end in zip(starts, ends):
            a, b = (file["reduced/mass"][:kept, kept + start:kept + end] for file in (alone, shared))
            numpy.testing.assert_allclose(a @ a.T, b @ b.T, atol=1e-8 * numpy.abs(alone["reduced/mass"]).max() ** 2)

    def test_the_lowest_pair_alone_is_found(self):
        self.write("pairs.msh", symmetric_bar(16, 2))
        alone, shared = self.both(PAIRS.replace("COUNT", "2"))
        numpy.testing.assert_allclose(shared["modes/frequencies"], alone["modes/frequencies"], rtol=1e-9)
        self.assertAlmostEqual(shared["modes/frequencies"][1] / shared["modes/frequencies"][0], 1, 9)

    def test_errors_are_one_sentence_with_the_status_of_bielle_reduce(self):
        self.write("bar.geo", BAR)
        for body, status, says in ((BODY.replace("count: 4", "cuont: 4"), 1, "body.yaml:11: modes: 'cuont' is not a key"),
                                   (BODY.replace("count: 4", "count: 100000"), 1, "are asked for"),
                                   (BODY.replace("count: 4", "count: 4, method: arpack"), 1, "on ranks SLEPc finds the modes"),
                                   (BODY.replace("tie: rigid}", "directions: [x]}"), 1, "the body can still")):
            self.write("body.yaml", body)
            got, said = self.distribute(2, "body.yaml")
            lines = [line for line in said.splitlines() if ": error: " in line]
            self.assertEqual((got, len(lines)), (status, 1), said)
            self.assertIn(says, lines[0])
            self.assertFalse(os.path.exists(self.path("body.h5")))

    def test_a_part_that_hangs_by_an_edge(self):
        mesh = symmetric_bar(8, 1)
        lines = mesh.split("\n")
        # One more tetrahedron is outside of the bar and shares one edge of its rim.
        count = lines.index("$Nodes") + 1
        total = int(lines[count])
        where = {line.split()[0]: numpy.array(line.split()[1:], float) for line in lines[count + 1:count + 1 + total]}
        a, b = (next(name for name, point in where.items() if numpy.allclose(point, [x, 0.01, 0.01])) for x in (0.03, 0.04))
        tips = numpy.array([[0.035, 0.05, 0.03], [0.035, 0.03, 0.05]])
        for k, tip in enumerate(tips):
            lines.insert(count + 1 + total + k, f"{total + 1 + k} {tip[0]} {tip[1]} {tip[2]}")
        lines[count] = str(total + 2)
        elements = lines.index("$Elements") + 1
        number = int(lines[elements]) + 1
        volume = numpy.dot(numpy.cross(where[b] - where[a], tips[0] - where[a]), tips[1] - where[a])
        nodes = [a, b, total + 1, total + 2] if volume > 0 else [b, a, total + 1, total + 2]
        lines.insert(elements + number, f"{number} 4 2 3 3 " + " ".join(map(str, nodes)))
        lines[elements] = str(number)
        self.write("pairs.msh", "\n".join(lines))
        self.write("body.yaml", PAIRS.replace("COUNT", "2"))
        alone = self.run_program("body.yaml")
        status, said = self.distribute(2, "body.yaml")
        self.assertEqual((status, alone.returncode), (2, 2), said + alone.stderr)
        self.assertIn("a point or an edge only", said)

    def expect_all_to_end(self, end):
        self.write("bar.geo", BAR)
        self.write("body.yaml", BODY.replace("size: 0.02", "size: 0.003"))
        run = self.start(2, "body.yaml")
        deadline = time.time() + 60
        while True:
            started = descendants(run.pid)
            ranks = [pid for pid in started if command_of(pid) == "bielle-reduce-mpi"]
            if len(ranks) == 2 and any(command_of(pid) == "bielle-reduce" for pid in started):
                break
            self.assertLess(time.time(), deadline)
            time.sleep(0.05)
        time.sleep(1)
        end(run, ranks)
        run.communicate(timeout=60)
        self.assertNotEqual(run.returncode, 0)
        deadline = time.time() + 10
        while any(command_of(pid).startswith("bielle-reduce") for pid in started) and time.time() < deadline:
            time.sleep(0.1)
        self.assertEqual([command_of(pid) for pid in started if command_of(pid).startswith("bielle-reduce")], [])
        self.assertFalse(os.path.exists(self.path("body.h5")))

    def test_a_rank_that_dies_ends_all(self):
        self.expect_all_to_end(lambda run, ranks: os.kill(max(ranks), signal.SIGKILL))
        self.expect_all_to_end(lambda run, ranks: os.kill(min(ranks), signal.SIGKILL))

    def test_an_interrupt_ends_all(self):
        self.expect_all_to_end(lambda run, ranks: run.send_signal(signal.SIGINT))

    def test_one_hdf5_in_each_process(self):
        for program, kind in ((PROGRAM, "serial"), (os.path.join(PROGRAMS, "bielle-reduce"), "openmpi")):
            libraries = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
            self.assertNotIn(f"libhdf5_{kind}", libraries)


if __name__ == "__main__":
    unittest.main()
