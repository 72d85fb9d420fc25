"""Tests of the warnings of a run about itself: degrees of freedom, nearly redundant loops, energy, models without
motion."""

import re
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

# The pendulum starts at the bottom with 6 m/s.
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

    def test_a_drive_that_moves_nothing_is_said_although_other_parts_move(self):
        pendulum = ("\nnodes: {{p: {{position: [5, 0, 0]}}, ", "\nelements:\n  p: {{type: rigid_body, node: p, mass: 1, inertia: [1, 1, 1]}}\n",
                    "\njoints:\n  p: {{type: hinge, nodes: [ground, p], axis: [0, 1, 0], position: [4, 0, 0]}}\n")
        model = FOUR_BAR
        for old, new in zip(("\nnodes: {{", "\nelements:\n", "\njoints:\n"), pendulum):
            model = model.replace(old, new)
        for tilt, moves in (("1e-7", False), ("0.09", False), ("0", True)):
            for push in ("5*t", "-3"):
                text = self.summary(model.format(tilt=tilt) + f'drives: {{push: {{joint: h1, torque: "{push}"}}}}\n')
                said = (f"\n  drive 'push' pushes with up to {'0.25' if 't' in push else '3'} N m, and the angle of joint 'h1' stands "
                        "still: something else holds it\n")
                self.assertEqual(said in text, not moves, text)
                self.assertNotIn("nothing moved", text)
        self.assertNotIn("stands still", self.summary(FOUR_BAR.format(tilt="1e-7") + 'drives: {push: {joint: h1, torque: "0*t"}}\n'))

    def test_a_start_in_a_singular_position_is_told_from_drives_that_contradict(self):
        self.write("model.yaml", SLIDER_CRANK)
        self.expect_refusal(2, "model.yaml", says=["drive 'd' looked redundant", "stands in a singular position (links in line"])
        drives = 'drives: {a: {joint: h1, angle: "t"}, b: {joint: h4, angle: "-2*t"}}\n'
        self.write("model.yaml", FOUR_BAR.format(tilt=0) + drives)
        self.expect_refusal(2, "model.yaml", says=["drive 'b' looked redundant", "contradicts the joints, locks and drives"])
        self.summary(FOUR_BAR.format(tilt=0) + drives.replace("-2*t", "t"))

    def test_a_model_without_anything_to_move_ends_in_a_sentence(self):
        held = ("nodes: {a: {position: [1, 0, 0], fixed: true}}\nelements: {m: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}}\n"
                "joints: {g: {type: hinge, nodes: [ground, a], axis: [0, 1, 0]}}\n")
        for analysis in ("dynamic, duration: 0.01, step: 1e-3", "dynamic, duration: 0.01, tolerance: 1e-4, start: equilibrium",
                         "dynamic, duration: 0.01, step: 1e-3, constraints: stabilized", "kinematic, duration: 0.01, step: 1e-3",
                         "inverse_dynamics, duration: 0.01, step: 1e-3"):
            with self.subTest(analysis):
                model = held + f"analysis: [{{type: {analysis}}}]\n"
                self.assertIn("0 degrees of freedom", self.summary(model))
                self.write("model.yaml", model + 'drives: {d: {joint: g, angle: "t"}}\n')
                says = ["drive 'd' stays"] if "dynamics" in analysis or "kin" in analysis else ["drive 'd' looked redundant", "contradicts the joints"]
                self.expect_refusal(2, "model.yaml", says=says)
        for analysis in ("assembly", "static", "eigen"):
            self.summary(held + f"analysis: [{{type: {analysis}}}]\n" + 'drives: {d: {joint: g, angle: "t"}}\n')

    def test_the_gap_in_the_balance_is_explained(self):
        text = self.summary(PENDULUM.format(duration=0.4, step=0.02, rho=1))
        self.assertIn("(gained by errors of the steps; this scheme does not dissipate)", text)
        self.assertNotIn("energy grows", text)
        text = self.summary(PENDULUM.format(duration=0.4, step=0.05, rho=1))
        self.assertIn("\n  energy grows: take smaller steps, or give a `tolerance`\n", text)
        text = self.summary(PENDULUM.format(duration=0.4, step=0.1, rho=1))
        self.assertIn("warning:", text)
        text = self.summary(PENDULUM.format(duration=0.4, step=0.05, rho=1).replace("step: 0.05", "step: 0.05, tolerance: 0.006"))
        self.assertIn("\n  energy grows: give a smaller `tolerance`\n", text)
        falling = PENDULUM.replace("position: [0, 0, -1], velocity: [-6, 0, 0], angular_velocity: [0, 6, 0]",
                                   "position: [1, 0, 0]")
        self.assertIn("(lost by errors of the steps; this scheme does not dissipate)",
                      self.summary(falling.format(duration=0.4, step=0.02, rho=1)))

    def test_the_balance_is_judged_by_what_flows_through(self):
        # A driven damper stores no energy; a brake takes 10 kJ from a drive, and the rotor stores 0.05 J.
        damper = ('nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz], motion: {x: "0.1*sin(2*pi*t)"}}}\n'
                  "elements: {d: {type: spring_damper, nodes: [ground, m], damping: 1000}}\n"
                  "analysis: [{type: dynamic, duration: 2, step: 1e-2}]\n")
        brake = ("nodes: {r: {}}\nelements: {m: {type: rigid_body, node: r, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}\n"
                 "joints: {h: {type: hinge, nodes: [ground, r], axis: [0, 0, 1], damping: 5}}\n"
                 'drives: {d: {joint: h, rate: "10"}}\nanalysis: [{type: dynamic, duration: 20, step: 1e-2}]\n')
        for model in (damper, brake):
            text = self.summary(model)
            self.assertIn(" of what flowed through (", text)
            self.assertNotIn("nothing moved", text)
            self.assertNotIn("warning:", text)
        # A pendulum that its steps do not resolve is reported, even if a brake next to it dissipates more than its
        # energy ..
        def with_rotor(inertia, damping, rate, drive):
            model = PENDULUM.format(duration=0.4, step=0.1, rho=1).replace("nodes: {a:", f"nodes: {{r: {{position: [9, 0, 0]{rate}}}, a:")
            model = model.replace("elements: {", f"elements: {{r: {{type: rigid_body, node: r, mass: 1, inertia: [{inertia}, {inertia}, {inertia}]}}, ")
            return model.replace("joints: {", f"joints: {{h: {{type: hinge, nodes: [ground, r], axis: [0, 0, 1], damping: {damping}}}, ") + drive

        text = self.summary(with_rotor(1e-3, 0.6, "", 'drives: {d: {joint: h, rate: "10"}}\n'))
        self.assertIn(" of what flowed through (", text)
        self.assertIn("warning: such large errors in the balance", text)
        # .. and if its dissipation is small relative to the energy of a heavy flywheel.
        text = self.summary(with_rotor(10, 0.02, ", angular_velocity: [0, 0, 50]", ""))
        self.assertIn(" of the largest energy (", text)
        self.assertRegex(text, r"\n  that is 0\.\d+ of the \S+ J that went in or were dissipated: these are not known more accurately\n")

    def test_dissipation_of_the_scheme_is_told_from_errors_of_the_steps(self):
        def parts(model):
            text = self.summary(model)
            found = re.search(r"balance \S+ J, (\S+) of the largest energy \((\S+) by the scheme's own dissipation, (\S+) by "
                              "errors of the steps\\)", text)
            return [float(number) for number in found.groups()], text

        # An oscillator loses energy by the scheme alone, for any steps.
        spring = ("nodes: {m: {position: [1.2, 0, 0], velocity: [0.1, 0, 0], fixed: [y, z, rx, ry, rz]}}\n"
                  "elements: {m: {type: point_mass, node: m, mass: 1}, s: {type: spring_damper, nodes: [ground, m], "
                  "stiffness: 1, length: 1}}\nanalysis: [{type: dynamic, duration: 60, step: STEP, rho: 0.8}]\n")
        for step, warned in (("0.3", False), ("1", True)):  # losses of 2 % and of all energy
            (gap, scheme, errors), text = parts(spring.replace("STEP", step).replace("duration: 60", "duration: 600"))
            self.assertLess(gap, 0)
            self.assertLess(abs(errors), 0.05 * abs(gap), text)
            self.assertEqual("warning: the scheme's own dissipation took" in text, warned, text)
            self.assertNotIn("energy grows", text)
        # Errors add energy to the pendulum, and the dissipation of the scheme hides a part of it.
        (gap, scheme, errors), text = parts(PENDULUM.format(duration=0.4, step=0.05, rho=0.8))
        self.assertLess(scheme, 0)
        self.assertGreater(errors, 0.01)
        self.assertAlmostEqual(gap, scheme + errors, delta=0.02 * errors)
        self.assertIn("take smaller steps, or give a `tolerance`", text)

    def test_a_motion_that_joints_stop_at_the_start_leaves_rounding_that_is_not_judged(self):
        # Two gears of different ratio stop both wheels: 1 J at 10 rad/s becomes about 1e-30 J.
        text = self.summary("""\
nodes: {a: {position: [0, 0, 0], angular_velocity: [0, 0, 10]}, b: {position: [1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.02, 0.02, 0.02]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.05, 0.05, 0.05]}
joints:
  ha: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  hb: {type: hinge, nodes: [ground, b], position: [1, 0, 0], axis: [0, 0, 1]}
  g1: {type: gear, joints: [ha, hb], ratio: -2}
  g2: {type: gear, joints: [ha, hb], ratio: -3}
events: {e: {when: t, crosses: 0.02, do: [{release: g2}]}}
analysis: [{type: dynamic, duration: 0.06, step: 0.001}]
""")
        self.assertIn("  nothing moved\n", text)
        self.assertNotIn("warning", text)

    def test_a_slow_motion_is_judged(self):
        # A micrometre per second is not rounding.
        text = self.summary("""\
nodes: {a: {position: [0, 0, 0], velocity: [1e-6, 0, 0]}}
elements: {a: {type: point_mass, node: a, mass: 1e-6}}
analysis: [{type: dynamic, duration: 0.06, step: 0.001}]
""")
        self.assertNotIn("nothing moved", text)

    def test_statics_end_at_no_time(self):
        text = self.summary(FOUR_BAR.format(tilt=0.09).replace("type: dynamic, duration: 0.05, step: 1e-3",
                                                               "type: static"))
        self.assertNotIn("until t", text)


if __name__ == "__main__":
    unittest.main()
