"""Tests that Python reproduces runs of bielle-mechanism to the last bit, by each of its interfaces."""

import os
import subprocess
import unittest

import h5py
import numpy as np

import bielle
from samples import BEAM, PENDULUM, WithModel

from equal_runs import expect_equal_values, valid_values  # noqa: E402 (samples leads to its folder)

PROGRAM = os.path.join(os.environ["BIELLE_PROGRAMS"], "bielle-mechanism")
EXAMPLES = os.path.abspath(os.path.join(os.path.dirname(__file__), *[os.pardir] * 3, "mechanism", "examples"))


def recorded(group):
    """Returns the datasets of an analysis in a results file, except the events, which Python does not have."""
    return {name: values for name, values in valid_values(group).items() if not name.startswith("events/")}


class AgainstTheProgram(WithModel):
    def run_program(self, model, *arguments):
        output = os.path.join(self.folder, "program.h5")
        subprocess.run([PROGRAM, model, "-o", output, "--quiet", *arguments], check=True, stdin=subprocess.DEVNULL)
        return output

    def expect_equal(self, expected, results):
        """Checks that the results contain the same datasets as an analysis in a results file, and no others."""
        expected = recorded(expected)
        self.assertEqual(set(expected), {"time", *results.datasets})
        self.assertEqual({values.dtype for values in expected.values()}, {np.dtype(float)})
        expect_equal_values({name: results[name] for name in expected}, expected)

    def expect_same_run(self, model):
        """Runs a model in memory, with a file, and by single analyses in a session, and compares the results."""
        written = os.path.join(self.folder, "python.h5")
        whole, with_file = bielle.run(model), bielle.run(model, written)
        session = bielle.load(model).session()
        with h5py.File(self.run_program(model)) as program, h5py.File(written) as python:
            self.assertEqual(python.attrs["complete"], 1)
            for k, type_ in enumerate(bielle.load(model).analyses):
                group = program[f"analysis_{k + 1}"]
                self.assertGreater(len(group["time"]), 1)
                self.assertEqual(whole[k].type, type_)
                for results in whole[k], with_file[k], session.run(k):
                    self.expect_equal(group, results)
                    events = group["events/time"][:] if "events" in group else []
                    self.assertEqual([event.time for event in results.events], list(events))
                expect_equal_values(valid_values(python[f"analysis_{k + 1}"]), valid_values(group), f"analysis {k + 1}")

    def test_fixed_steps(self):
        self.expect_same_run(self.write_model(PENDULUM))

    def test_adaptive_steps(self):
        self.expect_same_run(self.write_model(PENDULUM.replace("step: 2e-3", "tolerance: 1e-6")))

    def test_statics_and_dynamics_of_a_beam(self):
        self.expect_same_run(self.write_model(BEAM))

    def test_states_events_and_equilibrium_of_an_example(self):
        self.expect_same_run(os.path.join(EXAMPLES, "servo.yaml"))

    def test_a_path_past_limit_points(self):
        self.expect_same_run(os.path.join(EXAMPLES, "snap_through.yaml"))

    def test_modes(self):
        model = os.path.join(EXAMPLES, "rotor.yaml")
        results = bielle.load(model).session().modes(count=8)
        self.assertEqual(results.type, "eigen")
        compared = 0
        with h5py.File(self.run_program(model)) as program:
            for name, dataset in program["analysis_1/eigen"].items():
                text = h5py.check_string_dtype(dataset.dtype)
                expected = dataset.asstr()[:].tolist() if text else dataset[()]
                self.assertEqual(tuple(results.datasets[f"eigen/{name}"].shape), dataset.shape)
                np.testing.assert_array_equal(results[f"eigen/{name}"], expected, name)
                self.assertIsInstance(results[f"eigen/{name}"], list if text else np.ndarray)
                compared += 1
        self.assertGreater(compared, 12)
        head = results["eigen/displacement"][2, results["eigen/nodes"].index("head")] @ [1, 1j]
        self.assertGreater(np.abs(head).max(), 0.5)  # the lowest bending mode moves the head
        with self.assertRaisesRegex(bielle.InputError, "did you mean 'eigen/kind'"):
            results["eigen/kinds"]

    def test_a_campbell_diagram(self):
        """This is the example's analysis, from keys; both the program and Python create the model again for each
        speed."""
        model = os.path.join(EXAMPLES, "rotor.yaml")
        found = bielle.load(model).session().campbell({"from": 0, "to": 120, "count": 25}, parameter="speed", modes=5)
        with h5py.File(self.run_program(model)) as program:
            for name, dataset in program["analysis_2/campbell"].items():
                text = h5py.check_string_dtype(dataset.dtype)
                np.testing.assert_array_equal(found[f"campbell/{name}"], dataset.asstr()[:].tolist() if text else dataset[()], name)
        self.assertEqual(found["campbell/damped_frequency"].shape, (25, 5))

    def test_contacts(self):
        self.expect_same_run(os.path.join(EXAMPLES, "contacts.yaml"))

    def test_kinematics_and_inverse_dynamics(self):
        drives = """\
drives: {one: {joint: shoulder, angle: "0.3*sin(2*t)"}, two: {joint: elbow, angle: "0.5*t^2"}}
analysis:
  - {type: kinematic, duration: 0.5, step: 0.01}
  - {type: inverse_dynamics, duration: 0.5, step: 0.01}
"""
        model = self.write_model(PENDULUM.partition("analysis:")[0] + drives)
        self.expect_same_run(model)
        session = bielle.load(model).session()
        session.kinematics(0.5, 0.01)
        results = session.inverse_dynamics(0.5, 0.01)
        with h5py.File(self.run_program(model)) as program:
            self.expect_equal(program["analysis_2"], results)

    def test_a_motion_step_by_step(self):
        model = self.write_model(PENDULUM)
        session = bielle.load(model).session()
        names = ("nodes/lower/position", "nodes/lower/rotation", "joints/elbow/coordinate", "joints/elbow/reaction",
                 "measures/reach", "energy/kinetic", "solver/newton_iterations")
        motion = session.dynamics(duration=1.2, step=2e-3)
        rows = {name: [session[name]] for name in names}
        measured = [session.measure("reach")]
        for _ in motion:
            for name in names:
                rows[name].append(session[name])
            measured.append(session.measure("reach"))
        with h5py.File(self.run_program(model)) as program:
            expected = recorded(program["analysis_1"])
        self.assertTrue(np.array_equal(expected["measures/reach"], measured))
        for name in names:
            # A single quaternion has w >= 0; a quaternion in a row is continuous with the previous row.
            signs = np.where(expected[name][:, :1] < 0, -1, 1) if name.endswith("rotation") else 1
            self.assertTrue(np.array_equal(expected[name] * signs, np.array(rows[name])), name)

    def test_a_motion_that_is_recorded(self):
        model, output = self.write_model(PENDULUM), os.path.join(self.folder, "motion.h5")
        session = bielle.load(model).session()
        with session.record(output) as recording:
            motion = session.dynamics(duration=1.2, step=2e-3)
            for motion in motion:
                if motion.time > 0.5:
                    break
            self.assertTrue(motion.finish())
        self.assertEqual(len(recording), 1)
        with h5py.File(self.run_program(model)) as program, h5py.File(output) as written:
            self.expect_equal(program["analysis_1"], recording[0])
            self.expect_equal(written["analysis_1"], recording[0])
            self.assertEqual(written.attrs["complete"], 1)
            self.assertEqual(written["input"][()], program["input"][()])

    def test_a_dictionary_is_the_same_model(self):
        third = 1 / 3
        keys = {
            "gravity": (0, 0, -9.81),
            "nodes": {"arm": {"position": np.array([third, 0, 0])}},
            "elements": {"arm": {"type": "rigid_body", "node": "arm", "mass": np.float64(2.1), "inertia": [0.1, 0.1, 0.1]}},
            "joints": {"main": {"type": "hinge", "nodes": ["ground", "arm"], "position": [0, 0, 0], "axis": [0, 1, 0],
                                "damping": 0.1}},
            "drives": {"motor": {"joint": "main", "torque": "sin(3*t)"}},
            "analysis": [{"type": "dynamic", "duration": 0.5, "step": 1e-3}],
        }
        text = f"""\
gravity: [0, 0, -9.81]
nodes: {{arm: {{position: [{third!r}, 0, 0]}}}}
elements: {{arm: {{type: rigid_body, node: arm, mass: 2.1, inertia: [0.1, 0.1, 0.1]}}}}
joints: {{main: {{type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0], damping: 0.1}}}}
drives: {{motor: {{joint: main, torque: "sin(3*t)"}}}}
analysis: [{{type: dynamic, duration: 0.5, step: 1e-3}}]
"""
        with h5py.File(self.run_program(self.write_model(text))) as program:
            self.expect_equal(program["analysis_1"], bielle.read(keys).run()[0])
            self.expect_equal(program["analysis_1"], bielle.read(text).run()[0])
        # The text of the dictionary is a file.
        with h5py.File(self.run_program(self.write_model(bielle.read(keys).text))) as program:
            self.expect_equal(program["analysis_1"], bielle.run(keys)[0])

    def test_a_sweep_equals_single_runs(self):
        model = self.write_model(PENDULUM.replace("duration: 1.2", "duration: 0.2"))
        ends = set()
        for mass in np.linspace(0.5, 4, 20):
            run = bielle.run(model, parameters={"mass": mass})
            with h5py.File(self.run_program(model, "--set", f"mass={float(mass)!r}")) as program:
                self.expect_equal(program["analysis_1"], run[0])
            ends.add(run["joints/elbow/coordinate"][-1, 0])
        self.assertEqual(len(ends), 20)

    def test_a_restarted_run_goes_on(self):
        model = self.write_model(PENDULUM + "output: {checkpoint: 100}\n")
        whole = bielle.run(model)
        first = self.write_model(PENDULUM.replace("duration: 1.2", "duration: 0.6") + "output: {checkpoint: 100}\n", "first.yaml")
        output, rest = os.path.join(self.folder, "first.h5"), os.path.join(self.folder, "rest.h5")
        bielle.run(first, output)
        run = bielle.run(model, rest, restart=output)
        with h5py.File(rest) as file:
            self.expect_equal(file["analysis_1"], whole[0])
        np.testing.assert_array_equal(run["joints/elbow/coordinate"], whole["joints/elbow/coordinate"][301:])


if __name__ == "__main__":
    unittest.main()
