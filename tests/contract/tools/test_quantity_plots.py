"""Tests of bielle-plot --quantity: curves, spectra, densities, orders and envelopes of signals known in closed form,
studies and gaps."""

import csv
import os
import subprocess
import unittest

import h5py
import matplotlib.pyplot  # noqa: F401  (loaded once for all runs of the tool)
import numpy as np

from box_mesh import REPOSITORY, InFolder
from python_tool import import_tools, prepare_figures, run_python_tool  # box_mesh sets the path
from study_stand_in import STUDY, WithStandIn

from bielle_tools.messages import InputError
from bielle_tools.quantities import spectra
from bielle_tools.quantities.curves import density, envelope
from shares import share_of_tests as load_tests  # noqa: E402,F401

TOOL = os.path.join(REPOSITORY, "tools", "bielle-plot")


def write_signals(path, time, kind="", **signals):
    """Writes a results file with measures over time. `kind` is the type of its analysis."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "bielle results", "version": 1, "complete": True})
        group = file.create_group("analysis_1")
        group.attrs["type"] = kind or "dynamic"
        group["time"] = time
        for name, (values, unit) in signals.items():
            group[f"measures/{name}"] = values
            group[f"measures/{name}"].attrs["units"] = unit
        for name in group:
            file[name] = h5py.SoftLink(f"/analysis_1/{name}")


def table(path):
    """Returns {header: numbers} of a CSV file, without empty cells."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {head: np.array([float(row[k]) for row in rows[1:] if row[k] != ""]) for k, head in enumerate(rows[0])}


class Spectra(unittest.TestCase):
    TIME = np.linspace(0, 2, 2001)

    def test_a_sine_shows_its_amplitude_wherever_it_is_between_the_lines(self):
        for frequency in (10.0, 10.1, 10.25, 10.37, 99.9):
            found = spectra.amplitude_spectrum(self.TIME, 3 + 2 * np.sin(2 * np.pi * frequency * self.TIME + 1), "s")
            self.assertAlmostEqual(found.values.max(), 2, delta=2e-3)  # scalloping of the flat-top window is 0.01 dB
            self.assertAlmostEqual(found.x[found.values.argmax()], frequency, delta=found.resolution / 2)
            self.assertEqual(found.remarks, [])

    def test_the_highest_line_and_the_mean_are_scaled_as_well(self):
        found = spectra.amplitudes(np.array([1.0, -1.0] * 32))
        self.assertAlmostEqual(found[-1], 1, delta=1e-12)
        np.testing.assert_allclose(spectra.amplitudes(np.full(64, 5.0)), 0, atol=1e-12)

    def test_uneven_times_are_resampled_and_this_is_said(self):
        rng = np.random.default_rng(3)
        time = np.cumsum(rng.uniform(0.5e-3, 1.5e-3, 2000))
        found = spectra.amplitude_spectrum(time, 2 * np.sin(2 * np.pi * 10.3 * time), "s")
        self.assertAlmostEqual(found.values.max(), 2, delta=4e-3)
        self.assertIn("resampled from steps of", found.remarks[0])

    def test_the_integral_of_the_density_is_the_variance(self):
        time = np.arange(8192) * 1e-3
        # Each piece has 32 periods, so that the sum over the lines is exact.
        sine = 5 + 2 * np.sin(2 * np.pi * 31.25 * time)
        found = spectra.power_density(time, sine, "s")
        self.assertAlmostEqual(found.values.sum() * found.x[1], 2, delta=1e-12)
        # 1 % is about three standard deviations of the sum over 1600 lines and 16 pieces.
        noise = np.random.default_rng(1).normal(size=200000)
        found = spectra.power_density(np.arange(len(noise)) * 0.01, noise, "n")
        self.assertAlmostEqual(found.values.sum() * found.x[1] / noise.var(), 1, delta=0.015)
        # White noise has its variance over half the sampling rate.
        np.testing.assert_allclose(found.values[10:-10].mean(), 2 * 0.01, rtol=0.02)

    def test_orders_are_sharp_while_the_speed_rises(self):
        time = np.linspace(0, 10, 40001)
        speed, angle = 2 * np.pi * (5 + 2 * time), 2 * np.pi * (5 * time + time ** 2)
        for sign in (1, -1):
            found = spectra.order_analysis(time, 1.5 * np.sin(3 * angle) + 0.2 * np.sin(4.5 * angle + 1) + 7, sign * speed, "o")
            for order, amplitude in ((3, 1.5), (4.5, 0.2), (2, 0)):
                np.testing.assert_allclose(found.amplitude[:, np.argmin(abs(found.order - order))], amplitude, atol=1e-4)
            self.assertTrue(np.all(np.diff(found.speed) > 0))
            self.assertGreater(found.speed[0], speed[0])
            self.assertLess(found.speed[-1], speed[-1])

    def test_what_is_above_the_orders_at_a_low_speed_does_not_come_back_as_lower_ones(self):
        time = np.linspace(0, 10, 40001)  # 160 rows per revolution at the highest speed give orders up to 80
        found = spectra.order_analysis(time, np.sin(2 * np.pi * 1500 * time), 2 * np.pi * (5 + 2 * time), "o")
        self.assertEqual(found.order[-1], 80)
        slow = found.speed < 2 * np.pi * 15  # 1500 Hz is above order 100 at this speed
        self.assertGreater(slow.sum(), 3)
        self.assertLess(found.amplitude[slow].max(), 0.02)
        tone = np.abs(found.order[None] * found.speed[:, None] / 2 / np.pi - 1500) < 150
        self.assertGreater(found.amplitude[tone & ~slow[:, None]].max(), 0.1)

    def test_what_has_no_spectrum_is_told(self):
        time = np.linspace(0, 1, 50)
        back = np.concatenate([time, time])
        for arguments, part in (((time[:2], time[:2], "two"), "needs 16 rows without a gap; there are 2"), ((time[:0], time[:0], "none"), "there are 0"),
                                ((time, time * np.nan, "nan"), "there are 0"), ((back, back, "back"), "after 1 comes 0")):
            with self.assertRaises(InputError) as caught:
                spectra.amplitude_spectrum(*arguments)
            self.assertIn(part, str(caught.exception))
        for speed, part in ((np.cos(time * 9), "keeps its sign"), (time * 0 + 1, "needs 4"), (time * 0 + 2000, "rows per revolution")):
            with self.assertRaises(InputError) as caught:
                spectra.order_analysis(time, time, speed, "o")
            self.assertIn(part, str(caught.exception))


class Envelopes(unittest.TestCase):
    def test_it_holds_every_polygon_and_touches_them(self):
        x = np.linspace(0, 1, 5000)
        middle, least, largest = envelope([(x, np.sin(400 * x)), (x[::100], 2 * x[::100])])
        self.assertTrue(np.all(largest >= 2 * middle - 0.05) and np.all(least <= -0.99 + (middle < 0.05) * 2))
        self.assertEqual((least.min(), largest.max()), (np.sin(400 * x).min(), 2 * x[::100].max()))

    def test_gaps_and_nothing(self):
        middle, least, largest = envelope([(np.array([0, 1, np.nan, 3.0]), np.array([1, 2, 3, np.nan]))])
        self.assertEqual((least.tolist(), largest.tolist()), ([1.0], [2.0]))
        self.assertEqual(len(envelope([(np.array([np.nan]), np.array([1.0]))])[0]), 0)


class Command(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        import_tools()
        prepare_figures()

    def run_tool(self, *arguments):
        return run_python_tool(TOOL, arguments, self.folder, {**os.environ, "DISPLAY": ""})

    def succeed(self, *arguments):
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, arguments, part, status=1):
        done = self.run_tool(*arguments)
        self.assertEqual((done.returncode, len([line for line in done.stderr.splitlines() if not line.startswith("note:")])), (status, 1), done.stderr)
        self.assertIn(part, done.stderr.splitlines()[-1])

    def setUp(self):
        super().setUp()
        self.time = np.linspace(0, 4, 4001)
        angle = 2 * np.pi * (10 * self.time + self.time ** 2)
        self.speed = 2 * np.pi * (10 + 2 * self.time)
        self.signal = 3 * np.sin(2 * angle)
        write_signals(self.path("a.h5"), self.time, s=(self.signal, "N"), speed=(self.speed, "rad/s"), angle=(angle, "rad"), flat=(self.time * 0 + 7, "m"))
        write_signals(self.path("b.h5"), self.time[:2001], s=(2 * self.signal[:2001], "N"), speed=(self.speed[:2001], "rad/s"))

    def test_files_are_overlaid_and_their_numbers_written(self):
        done = self.succeed("a.h5", "b.h5", "--quantity", "s, speed", "--csv", "out.csv", "-o", "plots")
        self.assertEqual(done.stdout.split(), ["plots/s+speed-and-b.png", "out.csv"])
        found = table(self.path("out.csv"))
        np.testing.assert_array_equal(found["s, a [N]"], self.signal)
        np.testing.assert_array_equal(found["s, b [N]"], 2 * self.signal[:2001])
        np.testing.assert_array_equal(found["speed, b [rad/s]"], self.speed[:2001])

    def test_figures_of_other_requests_have_other_names(self):
        requests = [("s",), ("s", "--spectrum"), ("s", "--psd"), ("s", "--orders", "speed"), ("s", "--envelope"), ("s", "--against", "speed"), ("s", "--against", "angle"), ("s,angle",),
                    ("s, speed",), ("measures/s",), (", ".join(["s"] * 60),), (", ".join(["s"] * 61),)]
        paths = [self.succeed("a.h5", "--quantity", *request).stdout.strip() for request in requests]
        paths.append(self.succeed("a.h5", "b.h5", "--quantity", "s").stdout.strip())
        self.assertEqual(len(set(paths)), len(requests) + 1, paths)
        self.assertTrue(all(os.path.dirname(path) == "a-plots" and len(path) < 130 and os.path.getsize(self.path(path)) for path in paths), paths)
        self.assertEqual(paths[0], self.succeed("a.h5", "--quantity", "s").stdout.strip())

    def test_units_of_densities(self):
        for unit, expected in (("m", "m^2/Hz"), ("Pa", "Pa^2/Hz"), ("m/s", "(m/s)^2/Hz"), ("N m", "(N m)^2/Hz"), ("-", "1/Hz"), ("", "1/Hz"), ("1", "1/Hz"), ("m^2", "(m^2)^2/Hz")):
            self.assertEqual(density(unit), expected)

    def test_against_another_quantity(self):
        self.succeed("a.h5", "--quantity", "s", "--against", "angle", "--csv", "out.csv", "--span", "1:2", "--every", "10")
        found = table(self.path("out.csv"))
        with h5py.File(self.path("a.h5")) as file:
            np.testing.assert_array_equal(found["angle [rad]"], file["measures/angle"][1000:2001:10])
        np.testing.assert_array_equal(found["s [N]"], self.signal[1000:2001:10])
        self.assertTrue(os.path.exists(self.path("a-plots/s-over-angle.png")))

    def test_spectra_and_orders_by_the_command(self):
        write_signals(self.path("sine.h5"), self.time, s=(3 * np.sin(2 * np.pi * 25 * self.time), "N"))
        done = self.succeed("sine.h5", "--quantity", "s", "--spectrum", "--csv", "out.csv")
        found = table(self.path("out.csv"))
        self.assertAlmostEqual(found["s [N]"].max(), 3, delta=3e-3)
        self.assertAlmostEqual(found["frequency [Hz]"][found["s [N]"].argmax()], 25, delta=0.5)
        self.assertIn("resolution 0.942", done.stderr)  # 3.77/4 s
        self.succeed("sine.h5", "--quantity", "s", "--psd", "--csv", "psd.csv")
        found = table(self.path("psd.csv"))
        self.assertAlmostEqual(found["s [N^2/Hz]"].sum() * found["frequency [Hz]"][1], 4.5, delta=0.05)
        self.succeed("a.h5", "--quantity", "s", "--orders", "speed", "--csv", "orders.csv")
        found = table(self.path("orders.csv"))
        np.testing.assert_allclose(found["amplitude of s [N]"][found["order"] == 2], 3, rtol=2e-3)
        write_signals(self.path("steady.h5"), self.time, s=(np.sin(60 * self.time), "N"), speed=(self.time * 0 + 30, "rad/s"))
        self.succeed("steady.h5", "--quantity", "s", "--orders", "speed", "--csv", "orders.csv")
        found = table(self.path("orders.csv"))
        np.testing.assert_allclose(found["amplitude of s [N]"][found["order"] == 2], 1, rtol=2e-3)
        self.succeed("a.h5", "b.h5", "--quantity", "s", "--envelope", "--csv", "-")

    def test_gaps_stay_gaps(self):
        values = self.signal.copy()
        values[100:200] = np.nan
        write_signals(self.path("gap.h5"), self.time, s=(values, "N"), none=(values * np.nan, "N"))
        self.succeed("gap.h5", "--quantity", "s, none", "--csv", "out.csv")
        self.assertEqual(len(table(self.path("out.csv"))["s [N]"]), 3901)
        done = self.succeed("gap.h5", "--quantity", "s", "--spectrum")
        self.assertIn("of 4001 rows the longest part without a gap: 3801 from 0.2 to 4", done.stderr)
        self.refuse(("gap.h5", "--quantity", "none", "--spectrum"), "there are 0")
        self.succeed("gap.h5", "--quantity", "none")

    def test_few_rows_and_times_that_go_back(self):
        for rows in (1, 2):
            write_signals(self.path("few.h5"), self.time[:rows], s=(self.signal[:rows], "N"))
            self.succeed("few.h5", "--quantity", "s", "--csv", "out.csv")
            self.assertEqual(len(table(self.path("out.csv"))["s [N]"]), rows)
            self.succeed("few.h5", "--quantity", "s", "--envelope")
            self.refuse(("few.h5", "--quantity", "s", "--psd"), f"there are {rows}")
        write_signals(self.path("back.h5"), np.concatenate([self.time, self.time]), s=(np.concatenate([self.signal] * 2), "N"))
        self.succeed("back.h5", "--quantity", "s")
        self.refuse(("back.h5", "--quantity", "s", "--spectrum"), "times that increase: after 4 comes 0")
        write_signals(self.path("static.h5"), self.time, "static", s=(self.signal, "N"))
        self.refuse(("static.h5", "--quantity", "s", "--spectrum"), "is over the load factor")

    def test_a_figure_without_a_curve_says_so(self):
        write_signals(self.path("nan.h5"), self.time, s=(np.full(len(self.time), np.nan), "N"))
        self.assertIn("note: s: there is nothing to draw: it has no value that is a number\n", self.succeed("nan.h5", "--quantity", "s").stderr)
        self.assertEqual(self.succeed("a.h5", "--quantity", "s").stderr, "")

    def test_a_constant_has_no_spectrum_but_a_figure(self):
        self.assertIn("flat does not change: its spectrum is zero", self.succeed("a.h5", "--quantity", "flat", "--spectrum").stderr)

    def test_runs_of_a_study_are_named_by_what_differs_and_failed_ones_left_out(self):
        with h5py.File(self.path("study.h5"), "w") as study:
            study.attrs["format"] = "bielle study"
            study["status"] = [0, 2, 0]
            for name, texts in (("mass", ["1", "2", "3"]), ("length", ["5", "5", "5"])):
                study.create_dataset(f"parameters/{name}", data=texts, dtype=h5py.string_dtype())
            for run in (1, 3):
                group = study.create_group(f"runs/{run}")
                group.attrs.update({"format": "bielle results", "complete": True})
                group["time"], group["measures/s"] = self.time, run * self.signal
        done = self.succeed("study.h5", "--quantity", "s", "--csv", "out.csv")
        found = table(self.path("out.csv"))
        self.assertEqual(list(found), ["time [s]", "mass = 1", "mass = 3"])
        np.testing.assert_array_equal(found["mass = 3"], 3 * self.signal)
        self.assertIn("run 2 (mass = 2) was not completed", done.stderr)

    def test_slips_are_answered_with_one_sentence(self):
        self.write("model.yaml", "nodes: {a: {position: [0, 0, 0]}}\n")
        self.write("empty.h5", "")
        for arguments, part in ((("a.h5", "--quantity", "sped"), "did you mean 'speed'?"), (("a.h5", "b.h5"), "drawn over each other by --quantity"),
                                (("a.h5", "--spectrum"), "--spectrum goes with --quantity"), (("a.h5", "--csv", ""), "--csv goes with --quantity"),
                                (("a.h5", "--every", "0"), "--every goes with --quantity"), (("a.h5", "--quantity", "s", "--psd", "--spectrum"), "does not go with"),
                                (("a.h5", "--quantity", "s", "--orders", "angle"), "an angular speed [rad/s] is expected"), (("a.h5", "--quantity", "s,"), "is missing"),
                                (("a.h5", "--quantity", "s", "--span", "5:6"), "has no time from 5 to 6 s"), (("a.h5", "--quantity", "s", "--span", "5"), "A:B"),
                                (("a.h5", "--quantity", "s", "--every", "0"), "from 1 on"), (("a.h5", "--quantity", "s", "--csv", "a.h5"), "is an input"),
                                (("a.h5", "--quantity", "s", "--csv", "b.h5"), "is an HDF5 file"), (("a.h5", "--quantity", "s", "--csv", "."), "it is a folder"),
                                (("a.h5", "--quantity", "s", "--csv", "no/x.csv"), "cannot write 'no/x.csv'"), (("empty.h5", "--quantity", "s"), "it is empty"),
                                (("none.h5", "--quantity", "s"), "does not exist"), (("model.yaml", "--quantity", "s"), "a mechanism file"),
                                (("a.h5", "--quantity", "s", "--nodes", "x"), "does not go with --quantity")):
            with self.subTest(arguments=arguments):
                self.refuse(arguments, part)
        self.refuse(("a.h5", "--quantity", "s", "--csv", "/dev/full"), "No space left on device", 2)


class InStudies(WithStandIn):
    def test_a_study_gathers_quantities_and_its_runs_are_overlaid(self):
        done = self.study("speed,mass\n1,2\n3,2\n", "--gather", "top=max main.rate", "--gather", "far=max hub.position.norm", "--gather", "all=absmax nodes/hub/position",
                          "--gather", "when=time_of_max nodes/hub/position", "--gather", "p=max power", "--gather", "z=last hub.position.z", "--keep", "joints")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with h5py.File(self.path("study.h5")) as study:
            found = {name: study[f"gathered/{name}"][:].tolist() for name in study["gathered"]}
        self.assertEqual(found, {"top": [2, 6], "far": [5 ** 0.5, 37 ** 0.5], "all": [2, 6], "when": [1, 1], "p": [1, 1], "z": [2, 6]})
        done = run_python_tool(TOOL, ["study.h5", "--quantity", "main.rate", "--csv", "-"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines(), ["time [s],speed = 1,speed = 3", "0.0,0.0,0.0", "1.0,2.0,6.0"])
        self.assertTrue(os.path.exists(self.path("study-plots/main.rate.png")))

    def test_a_wrong_quantity_ends_the_study_early(self):
        done = self.study("speed,mass\n1,2\n3,2\n", "--gather", "top=max main.rtae")
        self.assertEqual(done.returncode, 1)
        self.assertIn("did you mean 'main.rate'?", done.stderr)
        done = subprocess.run([STUDY, "model.yaml", "table.csv", "-o", "study.h5", "--gather", "top=max"], cwd=self.folder, capture_output=True, text=True, timeout=60,
                              env={**os.environ, "BIELLE_BIN": self.folder})
        self.assertIn("names no dataset", done.stderr)


if __name__ == "__main__":
    unittest.main()
