"""Tests of messages of `bielle-mechanism` about modes: instability, states that are not stationary, impossible
computations."""

import os
import re
import unittest

import h5py

from command import CommandTest

PENDULUM = """\
gravity: [0, 0, -9.81]
nodes: {{rod: {{position: [{x}, 0, {z}]}}}}
elements: {{rod: {{type: rigid_body, node: rod, mass: 2, inertia: [0.1, 0.1, 0.1]}}}}
joints: {{pivot: {{type: hinge, nodes: [ground, rod], position: [0, 0, 0], axis: [0, 1, 0]}}}}
analysis: {analysis}
"""
EIGEN = "[{type: eigen}]"


class Modes(CommandTest):
    program = "bielle-mechanism"

    def test_a_hanging_pendulum_swings(self):
        text = self.summary(PENDULUM.format(x=0, z=-1, analysis=EIGEN))
        self.assertIn("eigen, 1 mode about the state at t = 0 s", text)
        self.assertIn("oscillating", text)
        self.assertIn("these are all modes of the mechanism", text)
        for word in ("UNSTABLE", "not in equilibrium", "rigid", "not steady"):
            self.assertNotIn(word, text)

    def test_a_standing_pendulum_is_unstable(self):
        text = self.summary(PENDULUM.format(x=0, z=1, analysis=EIGEN))
        # A deviation grows with s = sqrt(2 g / 2.1) and doubles within ln 2 / s.
        self.assertRegex(text, r"UNSTABLE: mode [12] grows, the fastest to twice its size within 0\.227 s")
        self.assertNotIn("not in equilibrium", text)

    def test_a_state_at_rest_that_does_not_stay_is_told(self):
        text = self.summary(PENDULUM.format(x=1, z=0, analysis=EIGEN))
        self.assertIn("the state is at rest but not in equilibrium: the residual of moment y at node 'rod'", text)

    def test_the_state_and_earlier_results_stay(self):
        text = self.summary(PENDULUM.format(x=0, z=-1, analysis="[{type: dynamic, duration: 0.1, step: 0.01}, {type: eigen}, "
                                                                "{type: dynamic, duration: 0.1, step: 0.01}, {type: eigen, shapes: false}]"))
        self.assertEqual(text.count("eigen, 1 mode"), 2)
        with h5py.File(os.path.join(self.folder, "model.h5")) as file:
            self.assertEqual(file.attrs["complete"], 1)
            self.assertAlmostEqual(file["/time"][-1], 0.2)            # end of the previous motion
            self.assertAlmostEqual(file["/eigen/frequency"][0], (2 * 9.81 / 2.1)**0.5 / 6.283185307179586, places=9)
            self.assertIn("displacement", file["/analysis_2/eigen"])
            self.assertNotIn("displacement", file["/eigen"])
            self.assertNotIn("time", file["/analysis_2"])

    def test_an_equilibrium_at_the_origin_turns_although_it_is_found_but_for_rounding(self):
        # In rotating axes w^2 = k/m - W^2, with k = 500 N/m at rest, m = 1 kg, W = 6 rad/s.
        for start in ("1e-5", "1e-3", "0.01"):
            for rotation in ("{joint: axle, rate: 6}", "{joint: axle, rate: 6, state: mean}"):
                with self.subTest(start=start, rotation=rotation):
                    text = self.summary(f"""\
nodes: {{hub: {{}}, mass: {{}}}}
elements:
  hub: {{type: rigid_body, node: hub, mass: 1, inertia: [0.01, 0.01, 0.02]}}
  mass: {{type: rigid_body, node: mass, mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints:
  axle: {{type: hinge, nodes: [ground, hub], axis: [0, 0, 1]}}
  rail: {{type: prismatic, nodes: [hub, mass], axis: [1, 0, 0], start: {start}, stiffness: "10*(exp(50*q) - 1)"}}
drives: {{motor: {{joint: axle, rate: 6}}}}
analysis: [{{type: static}}, {{type: eigen, rotation: {rotation}}}]
""")
                    self.assertIn("3.4283 Hz", text)                  # (500 - 36)**0.5/(2 pi)

    def test_elements_too_long_for_the_tension_of_a_rotation_are_told(self):
        blade = """\
nodes: {{hub: {{position: [0.1, 0, 0], fixed: true}}, tip: {{position: [1.1, 0, 0]}}}}
elements: {{blade: {{type: beam, nodes: [hub, tip], elements: {elements}, orientation: [0, 0, 1],
  section: {{rectangle: [0.03, 0.005], young: 7e10, poisson: 0.3, density: 2700}}}}}}
analysis: [{{type: eigen, count: 2, rotation: {{rate: 200, axis: [0, 0, 1]}}}}]
"""
        self.assertIn("warning: under its tension beam 'blade' bends within 0.0",
                      self.summary(blade.format(elements=2)))
        self.assertNotIn("warning:", self.summary(blade.format(elements=8)))

    def test_what_nothing_determines_is_named(self):
        # Forces on a node without mass, stiffness or constraint.
        self.write("model.yaml", """\
nodes: {m: {position: [1, 0, 0], fixed: [rx, ry, rz]}, lost: {position: [2, 0, 0], fixed: [x, y, rx, ry, rz]}}
elements: {m: {type: point_mass, node: m, mass: 1}, s: {type: spring_damper, nodes: [m, lost], stiffness: 1}}
analysis: [{type: eigen}]
""")
        self.expect_refusal(2, "model.yaml", says=("displacement z of node 'lost'",))

    def test_a_rotation_that_supports_do_not_allow_is_refused(self):
        self.write("model.yaml", PENDULUM.format(
            x=0, z=-1, analysis="[{type: eigen, rotation: {rate: 3, axis: [0, 0, 1]}}]"))
        self.expect_refusal(2, "model.yaml", says=("cannot turn as a whole", "joint 'pivot'"))

    def test_a_rotation_behind_a_joint_is_told_with_its_axes(self):
        analysis = "[{type: eigen, rotation: {joint: pivot, rate: 3, state: mean}}]"
        text = self.summary(PENDULUM.format(x=0, z=-1, analysis=analysis))
        self.assertIn("what is behind joint 'pivot' turns at 3 rad/s, the rest stands still", text)
        self.assertIn("constant in axes that turn with it", text)
        with h5py.File(os.path.join(self.folder, "model.h5")) as file:
            self.assertEqual([name.decode() for name in file["/eigen/name"]], ["rod across the axis, rigid"])

    def test_frequencies_of_what_turns_and_of_what_stands_are_told_apart(self):
        # The shaft is round. The mass on a film does not rotate, and its motion does not appear at the shaft.
        text = self.summary("""\
nodes: {shaft: {position: [0, 0, 0]}, body: {position: [0, 0, 0], fixed: [z, rx, ry, rz]}}
elements:
  shaft: {type: rigid_body, node: shaft, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
  body: {type: point_mass, node: body, mass: 2}
joints:
  main: {type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}
  seal: {type: bushing, nodes: [ground, body], axis: [0, 0, 1], stiffness: [6e4, 6e4, 0, 0, 0, 0]}
analysis: [{type: eigen, rotation: {joint: main, rate: 200}}]
""")
        self.assertIn("frequencies of its motions are those seen from there, of all others those seen from what stands "
                      "still", text)

    def test_a_motion_of_many_harmonics_has_modes(self):
        # An unbalanced rotor shakes a mass on a spring whose force grows with the ninth power, so that the stiffness
        # has several times as many harmonics as the motion. The exponents of this degree of freedom add up to
        # -damping/mass for any stiffness (Liouville).
        text = self.summary("""\
gravity: [0, 0, 0]
nodes: {tower: {position: [0, 0, 0], fixed: [x, z, rx, ry, rz]}, hub: {position: [0, 0, 0]}}
elements:
  tower: {type: point_mass, node: tower, mass: 4}
  hub: {type: rigid_body, node: hub, mass: 1, centre: [0, 0.3, 0], inertia: [0.1, 0.1, 0.1]}
joints:
  base: {type: prismatic, nodes: [ground, tower], axis: [0, 1, 0], stiffness: "2000*q + 1e16*q^9", damping: 5}
  shaft: {type: hinge, nodes: [tower, hub], axis: [1, 0, 0]}
drives: {turn: {joint: shaft, rate: 10}}
analysis: [{type: eigen, rotation: {joint: shaft, rate: 10}}]
""")
        self.assertGreater(int(re.search(r"\((\d+) harmonics\)", text)[1]), 14)
        with h5py.File(os.path.join(self.folder, "model.h5")) as file:
            exponents = file["/eigen/eigenvalue"][:]  # (modes, real and imaginary part)
        self.assertEqual(len(exponents), 2)  # the first one is the rotation of the shaft
        self.assertGreater(exponents[1, 1], 0)
        self.assertAlmostEqual(2 * exponents[1, 0], -5 / 5, delta=1e-6)

    def test_wrong_keys_are_refused(self):
        for analysis, says in (("{type: eigen, cuont: 3}", ("'cuont'", "did you mean 'count'")),
                               ("{type: eigen, near: -3}", ("analysis[1].near",)),
                               ("{type: eigen, near: 3, below: 4}", ("either `near`",)),
                               ("{type: eigen, rotation: 3}", ("rotation",)),
                               ("{type: eigen, rotation: {joint: pivto, rate: 3}}", ("'pivto'", "did you mean 'pivot'")),
                               ("{type: eigen, rotation: {joint: pivot}}", ("rate",)),
                               ("{type: eigen, rotation: {joint: pivot, rate: 0}}", ("other than 0",)),
                               ("{type: eigen, rotation: {joint: pivot, rate: 3, state: means}}", ("'means'",)),
                               ("{type: eigen, rotation: {joint: pivot, rate: 3, state: 2}}", ("periodic",)),
                               ("{type: eigen, rotation: {joint: pivot, rate: .nan}}", ("rate",)),
                               ("{type: eigen, rotation: {joint: pivot, rate: 3, axis: [0, 0, 1]}}", ("'axis'",)),
                               ("{type: campbell, rotation: {joint: pivot}, speeds: {to: 3}, node: rod}",
                                ("leave `node` out",))):
            self.write("model.yaml", PENDULUM.format(x=0, z=-1, analysis=f"[{analysis}]"))
            self.expect_refusal(1, "model.yaml", says=("model.yaml:5", *says))

    def test_a_rotation_behind_a_joint_without_one_angle_is_refused_with_its_line(self):
        for joint, says in (("prismatic, axis: [0, 1, 0]", "has no angle"), ("spherical", "turns about several axes")):
            for analysis in ("{type: eigen, rotation: {joint: pivot, rate: 3}}", "{type: campbell, rotation: {joint: pivot}, speeds: {to: 3}}"):
                text = PENDULUM.replace("hinge", joint).replace("position: [0, 0, 0], axis: [0, 1, 0]", "position: [0, 0, 0]")
                self.write("model.yaml", text.format(x=0, z=-1, analysis=f"[{analysis}]"))
                self.expect_refusal(1, "model.yaml", says=("model.yaml:5: analysis[1].rotation.joint: joint 'pivot'", says))


if __name__ == "__main__":
    unittest.main()
