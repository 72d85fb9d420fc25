"""Tests of sessions: reading, saving, recording, and refusals."""

import os
import tempfile
import unittest

import h5py
import numpy as np

import bielle
from samples import BEAM, PENDULUM, WHEEL


class Sessions(unittest.TestCase):
    def refusal(self, call, kind=bielle.InputError):
        with self.assertRaises(kind) as caught:
            call()
        return str(caught.exception)

    def test_names_that_are_not_there_get_the_nearest(self):
        session = bielle.read(PENDULUM).session()
        wheel = bielle.read(WHEEL).session()
        said = {
            "there is no dataset 'joints/elbow/cordinate'; did you mean 'joints/elbow/coordinate'?":
                lambda: session["joints/elbow/cordinate"],
            "there is no node 'uper'; did you mean 'upper'?": lambda: session.node("uper"),
            "'elbow' has no 'angel'; did you mean 'angle'?": lambda: session.measure("elbow.angel"),
            "there is no measure, joint, node or element 'elbo'; did you mean 'elbow'?": lambda: session.measure("elbo.angle"),
            "there is no measure, joint, node or element 'reech'; did you mean 'reach'?": lambda: session.measure("reech"),
            "there is no input 'torqe'; did you mean 'torque'?": lambda: wheel.set_input("torqe", 1),
        }
        for sentence, call in said.items():
            self.assertEqual(self.refusal(call), sentence)
        self.assertEqual(self.refusal(lambda: wheel.inputs["torqe"]), "there is no input 'torqe'; did you mean 'torque'?")
        for value in (np.nan, np.inf):
            self.assertEqual(self.refusal(lambda: wheel.set_input("torque", value)),
                             f"input 'torque': expected a finite number, found {value}")
        self.assertEqual(self.refusal(lambda: session.inputs["x"]), "there is no input 'x'")
        self.assertIn("'elbow' alone is no measure; expected one of 'angle'", self.refusal(lambda: session.measure("elbow")))
        self.assertIn("reported", self.refusal(lambda: session.run({"type": "reported"})))

    def test_wrong_keys_of_analyses(self):
        session = bielle.read(PENDULUM).session()
        self.assertEqual(self.refusal(lambda: session.dynamics(duration=-1, step=1)),
                         "Session.dynamics: duration: expected a number greater than 0, found -1")
        self.assertEqual(self.refusal(lambda: session.dynamics(duration=1)), "Session.dynamics: the key 'step' is missing")
        self.assertEqual(self.refusal(lambda: session.dynamics(1, 0.1, scheme="newmrk")),
                         "Session.dynamics: scheme: 'newmrk' is not a scheme; did you mean 'newmark'?")
        self.assertEqual(self.refusal(lambda: session.run({"type": "static", "stepps": 3})),
                         "analysis static: 'stepps' is not a key of the analysis 'static'; did you mean 'steps'?")
        self.assertIn("did you mean 'static'?", self.refusal(lambda: session.run({"type": "statik"})))
        self.assertIn("there is no number 3", self.refusal(lambda: session.run(3)))

    def test_formulas_of_parameters_in_analyses(self):
        motion = bielle.read(PENDULUM).session().dynamics(duration="0.1*mass", step="mass*1e-2")
        self.assertAlmostEqual(motion.end, 0.2)

    def test_measures_of_everything(self):
        session = bielle.read(PENDULUM).session()
        session.dynamics(0.3, 1e-3).finish()
        angle = session["joints/shoulder/coordinate"][0]
        self.assertEqual(session.measure("shoulder.angle"), angle)
        self.assertEqual(session.measure("shoulder.angle.rate"), session["joints/shoulder/rate"][0])
        self.assertEqual(session.measure("elbow.reaction.x"), session["joints/elbow/reaction"][0])
        self.assertEqual(session.measure("lower.position.x"), session["nodes/lower/position"][0])
        self.assertEqual(session.measure("lower.velocity.z"), session["nodes/lower/velocity"][2])
        self.assertEqual(session.measure("reach"), np.linalg.norm(session.node("lower").position))

    def test_a_model_without_a_measure_of_the_name(self):
        """No formula reads the angle of the wheel."""
        session = bielle.read(WHEEL).session()
        session.inputs["torque"] = 4
        session.dynamics(0.5, 1e-2).finish()
        self.assertAlmostEqual(session.measure("axle.angle"), 0.25, places=12)
        self.assertAlmostEqual(session.measure("axle.angle.rate"), 1, places=12)
        self.assertEqual((session.inputs["torque"], session.measure("torque"), dict(session.inputs)), (4, 4, {"torque": 4}))
        self.assertEqual(session["measures/torque"], 4)

    def test_numbers_and_arrays(self):
        session = bielle.read(PENDULUM).session()
        self.assertIsInstance(session["energy/kinetic"], float)
        self.assertIsInstance(session["time"], float)
        self.assertEqual(session["nodes/upper/position"].shape, (3,))
        self.assertEqual(session["joints/elbow/coordinate"].shape, (1,))
        beam = bielle.read(BEAM).session()
        self.assertEqual(beam["elements/beam/position"].shape, (7, 3))
        self.assertEqual(beam.datasets["elements/beam/position"][:2], ((7, 3), "m"))
        self.assertEqual(session.datasets["measures/reach"].units, "m")

    def test_results_are_views_that_are_not_written(self):
        results = bielle.read(PENDULUM).run()[0]
        one, other = results["nodes/upper/position"], results["nodes/upper/position"]
        self.assertTrue(np.shares_memory(one, other))
        with self.assertRaises(ValueError):
            one[0, 0] = 1
        kept = one[-1].copy()
        del results, other
        np.testing.assert_array_equal(one[-1], kept)  # the view keeps the array alive
        self.assertEqual(self.refusal(lambda: bielle.read(PENDULUM).run()["nodes/uper/position"]),
                         "nothing was recorded as 'nodes/uper/position'; did you mean 'nodes/upper/position'?")

    def test_results_as_a_mapping(self):
        run = bielle.read(BEAM).run()
        self.assertEqual([results.type for results in run], ["static", "dynamic"])
        self.assertIn("nodes/tip/position", run[0])
        self.assertNotIn("nodes/top/position", run[0])
        self.assertEqual(list(run[0])[0], "time")
        self.assertEqual(len(run[0]), len(list(run[0])))
        np.testing.assert_array_equal(run[0].time, [0.25, 0.5, 0.75, 1])
        self.assertEqual(run[0].numbers["load_factor"], [1])
        self.assertIn("static, 4 load steps", run.summary)
        self.assertIn("dynamic, generalised-alpha", run.summary)
        np.testing.assert_array_equal(run["nodes/tip/position"], run[1]["nodes/tip/position"])

    def test_rows_in_a_file_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.h5")
            run = bielle.read(BEAM).run(path, memory=False)
            self.assertEqual([results.type for results in run], ["static", "dynamic"])
            self.assertEqual(run[1].numbers["steps"], [100])
            self.assertIn("not kept in memory", self.refusal(lambda: run["nodes/tip/position"]))
            session = bielle.read(BEAM).session()
            with session.record(os.path.join(folder, "session.h5"), memory=False) as recording:
                session.statics(steps=4, record=False)
                session.dynamics(0.1, 1e-3).finish()
            self.assertEqual(len(recording), 0)
            with h5py.File(path) as one, h5py.File(os.path.join(folder, "session.h5")) as other:
                for name in ("analysis_1/nodes/tip/position", "analysis_2/nodes/tip/position"):
                    np.testing.assert_array_equal(one[name][:], other[name][:])

    def test_results_of_one_analysis(self):
        session = bielle.read(BEAM).session()
        results = session.statics(steps=2)
        np.testing.assert_array_equal(results.time, [0.5, 1])
        np.testing.assert_array_equal(results["nodes/tip/position"][-1], session.node("tip").position)
        bare = session.statics(record=False)
        self.assertIn("1 load step", bare.summary)
        self.assertIn("not kept in memory", self.refusal(lambda: bare["time"]))
        assembled = bielle.read(PENDULUM).session().assemble()
        self.assertEqual((assembled.type, len(assembled.time)), ("assembly", 1))

    def test_saving_and_restoring_to_the_last_bit(self):
        session = bielle.read(PENDULUM).session()
        motion = session.dynamics(1, 1e-3)
        motion.advance_to(0.4)
        saved = session.save()
        motion.finish()
        end = session.state
        session.restore(saved)
        self.assertEqual(motion.time, 0.4)
        motion.finish()
        np.testing.assert_array_equal(session.state.positions, end.positions)
        # The saved motion continues in another session with another copy of the model.
        other = bielle.read(PENDULUM).session()
        self.assertIn("no motion is under way", self.refusal(lambda: other.restore(saved)))
        other.dynamics(1, 1e-3, saved=saved).finish()
        np.testing.assert_array_equal(other.state.velocities, end.velocities)
        self.assertIn("not saved by a session of this model", self.refusal(lambda: bielle.read(BEAM).session().restore(saved)))
        self.assertIn("not saved", self.refusal(lambda: session.restore(saved[:10])))

    def test_states_are_copies_that_can_be_set(self):
        session = bielle.read(WHEEL).session()
        session.assemble()
        state = session.state
        angle = 0.3
        state.axes[1] = [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
        self.assertEqual(session.measure("axle.angle"), 0)
        session.state = state
        self.assertAlmostEqual(session.measure("axle.angle"), angle, places=14)
        velocities = bielle.State(state)
        velocities.angular_velocities[1, 2] = 2
        session.state = velocities
        session.dynamics(0.5, 1e-2).finish()
        self.assertAlmostEqual(session.measure("axle.angle"), angle + 1, places=12)
        positions = session.state.positions  # the object outlives its state
        self.assertEqual(positions.shape, (2, 3))
        with self.assertRaisesRegex(bielle.InputError, "another model"):
            bielle.read(BEAM).session().state = state
        np.testing.assert_array_equal(session.node("wheel").axes, session.state.axes[1])

    def test_energy(self):
        session = bielle.read(PENDULUM).session()
        session.dynamics(0.5, 1e-4).finish()
        energy = session.energy
        self.assertGreater(energy["dissipated"], 0)
        self.assertAlmostEqual(energy["kinetic"] + energy["gravity"] + energy["dissipated"], session.balance, places=9)
        self.assertLess(abs(session.balance), 1e-3 * energy["kinetic"])

    def test_recording_some_rows(self):
        session = bielle.read(PENDULUM).session()
        with session.record(every=10) as recording:
            session.dynamics(0.1, 1e-3).finish()
        np.testing.assert_allclose(recording[0].time, np.arange(11) * 0.01, atol=1e-15)
        with session.record(times=[0.15, 0.16]) as recording:
            session.dynamics(0.1, 1e-3).finish()
        np.testing.assert_allclose(recording[0].time, [0.1, 0.15, 0.16], atol=1e-15)
        self.assertIn("every 1, 2", self.refusal(lambda: session.record(every=0).__enter__()))
        self.assertIn("ascending", self.refusal(lambda: session.record(times=[2, 1]).__enter__()))

    def test_recording_from_the_middle_of_a_motion(self):
        session = bielle.read(PENDULUM).session()
        motion = session.dynamics(0.1, 1e-3)
        motion.advance_to(0.05)
        with session.record() as outer:
            motion.advance_to(0.06)
            growing = outer[0].time
            with session.record() as inner:
                motion.advance_to(0.08)
            motion.advance_to(0.09)
        motion.finish()
        np.testing.assert_allclose(growing, np.arange(51, 61) * 1e-3)
        np.testing.assert_allclose(inner[0].time, np.arange(61, 81) * 1e-3)
        np.testing.assert_allclose(np.concatenate([each.time for each in outer]), np.arange(51, 91) * 1e-3)
        with self.assertRaisesRegex(bielle.Error, "made once"):
            inner.__enter__()

    def test_what_ends_early_is_recorded_so_far(self):
        session = bielle.read(PENDULUM).session()

        @session.on_step
        def give_up(at):
            if at.time > 0.05:
                raise RuntimeError("enough")

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "part.h5")
            with self.assertRaisesRegex(RuntimeError, "enough"), session.record(path) as recording:
                session.run(0)
            with h5py.File(path) as file:
                rows = len(file["time"])
        self.assertEqual((rows, len(recording[0].time)), (27, 27))
        session.remove_callback(give_up)
        self.assertEqual(len(session.run(0).time), 601)  # the motion continues from there

    def test_notes(self):
        session = bielle.read(PENDULUM).session()
        for _ in range(3):
            session.dynamics(1, 0.3)
        self.assertEqual(len(session.notes), 1)
        self.assertIn("step 0.25 s in place of 0.3 s", session.notes[0])
        session.forget_notes()
        self.assertEqual(session.notes, [])

    def test_mobility_and_redundancy(self):
        session = bielle.read(PENDULUM).session()
        self.assertEqual(session.mobility["degrees"], 2)
        self.assertEqual(session.redundant, [])


if __name__ == "__main__":
    unittest.main()
