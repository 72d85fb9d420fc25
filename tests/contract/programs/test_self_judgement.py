"""What a run says of its own trustworthiness: freedom, loops that are nearly exact, energy, motions that stand still."""

import unittest

from command import CommandTest

FOUR_BAR = """\
gravity: [1, 0, -9.81]
nodes: {{c: {{position: [0, 0, 0.1]}}, k: {{position: [0.5, 0, 0.2]}}, r: {{position: [1, 0, 0.1]}}}}
elements:
  c: {{type: rigid_body, node: c, mass: 1, inertia: [0.1, 0.1, 0.1]}}
  k: {{type: rigid_body, node: k, mass: 1, inertia: [0.1, 0.1, 0.1]}}
  r: {{type: rigid_body, node: r, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  h1: {{type: hinge, nodes: [ground, c], axis: [0, 1, 0], position: [0, 0, 0]}}
  h2: {{type: hinge, nodes: [c, k], axis: [0, 1, 0], position: [0, 0, 0.2]}}
  h3: {{type: hinge, nodes: [k, r], axis: [{tilt}, 1, 0], position: [1, 0, 0.2]}}
  h4: {{type: hinge, nodes: [ground, r], axis: [0, 1, 0], position: [1, 0, 0]}}
analysis: [{{type: dynamic, duration: 0.05, step: 1e-3}}]
"""

# Starts at the bottom with 6 m/s.
PENDULUM = """\
gravity: [0, 0, -9.81]
nodes: {{a: {{position: [0, 0, -1], velocity: [-6, 0, 0], angular_velocity: [0, 6, 0]}}}}
elements: {{m: {{type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01]}}}}
joints: {{g: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0], position: [0, 0, 0]}}}}
analysis: [{{type: dynamic, duration: {duration}, step: {step}, rho: {rho}}}]
"""


SLIDER_CRANK = """\
nodes: {c: {position: [0.5, 0, 0]}, k: {position: [1.5, 0, 0]}, p: {position: [2, 0, 0]}}
elements:
  c: {type: rigid_body, node: c, mass: 1, inertia: [0.1, 0.1, 0.1]}
  k: {type: rigid_body, node: k, mass: 1, inertia: [0.1, 0.1, 0.1]}
  p: {type: rigid_body, node: p, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  h1: {type: hinge, nodes: [ground, c], axis: [0, 1, 0], position: [0, 0, 0]}
  h2: {type: hinge, nodes: [c, k], axis: [0, 1, 0], position: [1, 0, 0]}
  h3: {type: spherical, nodes: [k, p], position: [2, 0, 0]}
  s: {type: prismatic, nodes: [ground, p], axis: [1, 0, 0]}
drives: {d: {joint: s, displacement: "-0.5*t"}}
analysis: [{type: dynamic, duration: 0.1, step: 1e-3}]
"""


class SelfJudgement(CommandTest):
    program = "bielle-mechanism"

    def test_a_loop_that_is_exact_moves(self):
        text = self.summary(FOUR_BAR.format(tilt=0))
        self.assertIn("\n  1 degree of freedom\n", text)
        self.assertNotIn("nearly redundant", text)
        self.assertNotIn("nothing moved", text)

    def test_a_loop_that_is_nearly_exact_stands_still_and_says_why(self):
        for tilt in ("1e-7", "1e-4"):
            text = self.summary(FOUR_BAR.format(tilt=tilt))
            self.assertIn("\n  0 degrees of freedom: nothing moves but by drives and prescribed motions\n", text)
            self.assertIn("nearly redundant: ", text)
            self.assertIn(" of joint 'h4' differs from what others hold by less than a thousandth", text)
            self.assertIn("\n  nothing moved\n", text)
            self.write("model.yaml", FOUR_BAR.format(tilt=tilt))
            self.assertIn("nearly       redundant: ", self.run_program("model.yaml", "--check").stdout)

    def test_a_loop_that_is_far_from_exact_is_a_frame(self):
        text = self.summary(FOUR_BAR.format(tilt=0.09))
        self.assertIn("\n  0 degrees of freedom", text)
        self.assertNotIn("nearly redundant", text)

    def test_a_start_in_a_singular_position_is_told_from_drives_that_contradict(self):
        self.write("model.yaml", SLIDER_CRANK)
        self.expect_refusal(2, "model.yaml", says=["drive 'd' looked redundant", "stands in a singular position (links in line"])
        drives = 'drives: {a: {joint: h1, angle: "t"}, b: {joint: h4, angle: "-2*t"}}\n'
        self.write("model.yaml", FOUR_BAR.format(tilt=0) + drives)
        self.expect_refusal(2, "model.yaml", says=["drive 'b' looked redundant", "contradicts the joints, locks and drives"])
        self.summary(FOUR_BAR.format(tilt=0) + drives.replace("-2*t", "t"))

    def test_the_gap_in_the_balance_is_explained(self):
        text = self.summary(PENDULUM.format(duration=0.4, step=0.02, rho=1))
        self.assertIn("(gained by errors of the steps)", text)
        self.assertNotIn("energy grows", text)
        text = self.summary(PENDULUM.format(duration=0.4, step=0.05, rho=1))
        self.assertIn("\n  energy grows: take smaller steps, or give a `tolerance`\n", text)
        text = self.summary(PENDULUM.format(duration=0.4, step=0.1, rho=1))
        self.assertIn("DOUBTFUL", text)
        falling = PENDULUM.replace("position: [0, 0, -1], velocity: [-6, 0, 0], angular_velocity: [0, 6, 0]",
                                   "position: [1, 0, 0]")
        self.assertIn("this scheme does not dissipate", self.summary(falling.format(duration=0.4, step=0.02, rho=1)))
        self.assertIn("lost to numerical dissipation and errors of the steps",
                      self.summary(falling.format(duration=0.4, step=0.02, rho=0.8)))

    def test_statics_end_at_no_time(self):
        text = self.summary(FOUR_BAR.format(tilt=0.09).replace("type: dynamic, duration: 0.05, step: 1e-3",
                                                               "type: static"))
        self.assertNotIn("until t", text)


if __name__ == "__main__":
    unittest.main()
