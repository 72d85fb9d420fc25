"""Tests of the assembly of roughly drawn parts: kept parts, moved parts, loops that cannot close, and joints without a
position."""

import unittest

from command import CommandTest

# The links of a four-bar are drawn some centimetres and tens of degrees off.
BAR = """\
gravity: [0, -9.81, 0]
nodes:
  crank: {position: [0.1, 0.08, 0.02], rotation_vector: [0.1, -0.2, 0.9]}
  coupler: {position: [0.55, 0.5, -0.03], rotation_vector: [0.2, 0.1, 0.1]}
  rocker: {position: [1, 0.3, 0.04], rotation_vector: [-0.2, 0.1, 1.8]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.01, 0.02, 0.02]}
  coupler: {type: rigid_body, node: coupler, mass: 1, inertia: [0.01, 0.02, 0.02]}
  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [0.01, 0.02, 0.02]}
joints:
  a: {type: hinge, nodes: [ground, crank], at: [[0, 0, 0], [-0.15, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]]}
  b: {type: hinge, nodes: [crank, coupler], at: [[0.15, 0, 0], [-0.45, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]]}
  c: {type: hinge, nodes: [coupler, rocker], at: [[0.45, 0, 0], [0.35, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]]}
  d: {type: hinge, nodes: [ground, rocker], at: [[1, 0, 0], [-0.35, 0, 0]], axis: [[0, 0, 1], [0, 0, 1]], second_axis: [[1, 0, 0], [1, 0, 0]]}
analysis:
  - {type: assembly}
"""
LAST = "second_axis: [[1, 0, 0], [1, 0, 0]]}\nanalysis"

# Joints without a position.
ARMS = """\
gravity: [0, 0, -9.81]
nodes: {a: {}, b: {position: [0.054, 0, 0]}, c: {position: [0.054, 0, 0]}, d: {position: [0.1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1, 1, 1]}
  c: {type: rigid_body, node: c, mass: 1, inertia: [1, 1, 1]}
  d: {type: rigid_body, node: d, mass: 1, inertia: [1, 1, 1]}
joints:
  first: {type: hinge, nodes: [ground, a], axis: [0, 1, 0]}
  second: {type: hinge, nodes: [a, b], axis: [0, 1, 0]}
  third: {type: hinge, nodes: [b, c], axis: [0, 1, 0]}
  fourth: {type: hinge, nodes: [c, d], axis: [0, 1, 0], position: [0.1, 0, 0]}
analysis: [{type: dynamic, duration: 0.001, step: 1e-3}]
"""


class Assembly(CommandTest):
    program = "bielle-mechanism"

    def output(self, model, *options):
        self.write("model.yaml", model)
        done = self.run_program("model.yaml", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refuse(self, model, *says, status=1):
        self.write("model.yaml", model)
        return self.expect_refusal(status, "model.yaml", says=says)

    def keep(self, what):
        return BAR.replace("{type: assembly}", "{type: assembly, keep: %s}" % what)

    def test_what_moved_is_listed(self):
        text = self.output(BAR)
        self.assertIn("\n  assembly moved node '", text)
        for name in ("crank", "coupler", "rocker"):
            self.assertRegex(text, r"\n    node '%s': [0-9.e-]+ m, [0-9.e-]+ degrees\n" % name)
        for name in "abcd":
            self.assertRegex(text, r"\n    angle of joint '%s': -?[0-9.e-]+ rad \(-?[0-9.e-]+ degrees\), to -?[0-9.e-]+ rad\n" % name)
        self.assertIn("\n  1 degree of freedom\n", text)
        self.assertIn("z, rx, ry of joint 'd'", text)
        self.assertIn("angle of joint 'a'", self.output(BAR, "--check"))

    def test_a_long_list_of_what_moved_is_cut(self):
        count = 13
        model = "nodes:\n" + "".join("  n%d: {position: [%d, 0, 0]}\n" % (k, k) for k in range(count)) + "elements:\n"
        model += "".join("  e%d: {type: rigid_body, node: n%d, mass: 1, inertia: [1, 1, 1]}\n" % (k, k) for k in range(count))
        model += "joints:\n  h: {type: hinge, nodes: [ground, n0], axis: [0, 0, 1], start: 0.5}\n"
        model += "".join("  r%d: {type: rigid, nodes: [n%d, n%d]}\n" % (k, k, k + 1) for k in range(count - 1))
        text = self.output(model + "analysis: [{type: assembly}]\n")
        self.assertEqual(text.count("    node 'n"), 10)
        # 24 sin(0.25) at 12 m from the hinge
        self.assertIn("node 'n12' by 5.94 m; largest rotation 0.5 rad\n    node 'n12': 5.94 m, 28.6 degrees\n", text)
        self.assertIn("\n    and 3 more nodes by less\n", text)
        self.assertIn("\n    angle of joint 'h': 0.5 rad (28.6 degrees), to 0.5 rad\n", text)

    def test_every_analysis_starts_from_parts_that_fit(self):
        spring = BAR.replace(LAST, LAST.replace("}\n", ", stiffness: 200, damping: 1}\n", 1))
        for analysis in ("static", "dynamic, duration: 0.01, step: 1e-3", "dynamic, duration: 0.01, step: 1e-3, start: equilibrium"):
            text = self.output(spring.replace("{type: assembly}", "{type: %s}" % analysis))
            self.assertIn("assembly moved node '", text)
            self.assertIn("angle of joint 'a'", text)

    def test_kept_things_do_not_move(self):
        fits = "crank: {position: [0.1299038105676658, 0.075, 0], rotation_vector: [0, 0, 0.5235987755982988]}"
        drawn = "crank: {position: [0.1, 0.08, 0.02], rotation_vector: [0.1, -0.2, 0.9]}"
        text = self.output(self.keep("[crank]").replace(drawn, fits))
        self.assertNotIn("node 'crank'", text)
        self.assertIn("    node 'rocker'", text)
        for what in ("[a.angle]", "[{joint: a, coordinate: angle}]", "[{joint: a}]"):
            for options in ((), ("--check",)):
                text = self.output(self.keep(what), *options)
                self.assertNotIn("angle of joint 'a'", text)
                self.assertIn("angle of joint 'd'", text)

    def test_wrong_names_of_what_is_kept(self):
        self.refuse(self.keep("[cranc]"), "model.yaml:", "keep[1]", "there is no node 'cranc'", "did you mean 'crank'")
        self.refuse(self.keep("[a.angel]"), "keep[1]", "joint 'a' has no coordinate 'angel'", "did you mean 'angle'")
        self.refuse(self.keep("[{joint: e}]"), "there is no 'e' among the joints")
        self.refuse(self.keep("[{joint: a, coordinate: x}]"), "joint 'a' has no coordinate 'x'")
        self.refuse(self.keep("[{joint: a, angle: 1}]"), "'angle'")
        self.refuse(self.keep("[crank, a.angle, crank]"), "keep[3]", "twice")
        self.refuse(self.keep("[a.angle, {joint: a}]"), "keep[2]", "twice")
        self.refuse(BAR.replace("{type: assembly}", "{type: assembly, kept: [crank]}"), "'kept' is not a key", "'keep'")

    def test_kept_things_in_the_way(self):
        self.refuse(self.keep("[crank, rocker]"), "cannot be put together", "kept, and in the way: ", "node 'rocker'", status=2)

    def test_a_loop_that_cannot_close(self):
        self.refuse(BAR.replace("[[1, 0, 0], [-0.35, 0, 0]]", "[[2.05, 0, 0], [-0.35, 0, 0]]"),
                    "joint 'd' stays open by 0.15 m whatever the other parts do",
                    "it disagrees with joint 'a', joint 'b', joint 'c'", status=2)
        self.write("model.yaml", BAR.replace("[[1, 0, 0], [-0.35, 0, 0]]", "[[2.05, 0, 0], [-0.35, 0, 0]]"))
        self.expect_refusal(2, "model.yaml", "--check", says=["joint 'd' stays open by 0.15 m"])

    def test_start_values_and_drives(self):
        started = BAR.replace("joints:", "drives: {m: {joint: d, %s}}\njoints:")
        start = LAST.replace("}\n", ", start: 1.7}\n", 1)
        self.refuse((started % "angle: 1.7").replace(LAST, start), "joints.d.start", "drive 'm' prescribes the angle")
        self.assertIn("\n  start        angle of joint 'd': 1.7 rad\n",
                      self.output((started % "torque: 1").replace(LAST, start), "--check"))
        self.output((started % "torque: 1").replace(LAST, start))
        self.output((started % "rate: 1").replace(LAST, start))
        rate = LAST.replace("}\n", ", start_rate: 1}\n", 1)
        for law in ("angle: t", "rate: 1"):
            self.refuse((started % law).replace(LAST, rate), "joints.d.start_rate", "drive 'm' prescribes the")
        self.refuse(BAR.replace(LAST, LAST.replace("}\n", ", start_rate: 1, locked: {to: 1}}\n", 1)), "joints.d.start_rate",
                    "locked")
        self.refuse(BAR.replace(LAST, LAST.replace("}\n", ", start: {angel: 1}}\n", 1)), "joints.d.start")

    def test_places_of_joints(self):
        self.refuse(BAR.replace("at: [[1, 0, 0], [-0.35, 0, 0]]", "at: [[1, 0, 0], [-0.35, 0, 0]], position: [1, 0, 0]"),
                    "joints.d.at", "give one of them")
        self.refuse(BAR.replace("at: [[1, 0, 0], [-0.35, 0, 0]]", "at: [1, 0, 0]"), "joints.d.at",
                    "the joint's point in the axes of the first node and of the second")

    def test_arms_of_joints_without_a_place(self):
        line = "  joint 'second': without `position` or `at` it is attached at node 'b'; an arm of 0.054 m bridges it to node 'a'\n"
        for options in ((), ("--check",)):
            text = self.output(ARMS, *options)
            self.assertIn(line, text)
            for name in ("first", "third", "fourth"):
                self.assertNotIn("joint '%s': without" % name, text)
        chain = "nodes:\n" + "".join("  n%d: {position: [%d, 0, 0]}\n" % (k, k) for k in range(10)) + "elements:\n"
        chain += "".join("  e%d: {type: rigid_body, node: n%d, mass: 1, inertia: [1, 1, 1]}\n" % (k, k) for k in range(10))
        chain += "joints:\n" + "".join("  j%d: {type: spherical, nodes: [n%d, n%d]}\n" % (k, k, k + 1) for k in range(9))
        chain += "analysis: [{type: dynamic, duration: 0.001, step: 1e-3}]\n"
        text = self.output(chain)
        self.assertEqual(text.count("without `position`"), 5)
        self.assertIn("\n  and likewise 4 more joints (--check lists all)\n", text)
        self.assertEqual(self.output(chain, "--check").count("without `position`"), 9)


if __name__ == "__main__":
    unittest.main()
