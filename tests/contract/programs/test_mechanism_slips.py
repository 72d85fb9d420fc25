"""Tests of mistakes of users of bielle-mechanism: units, degrees, jumps, duplicate names, unconnected parts."""

import os
import unittest

from command import CommandTest
from shares import share_of_tests as load_tests  # noqa: E402,F401

BEAM = """\
gravity: [0, 0, -9.81]
nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}
elements: {m: {type: beam, nodes: [a, b], section: {circle: 0.02, young: 210e9, poisson: 0.3, density: 7850}}}
analysis: [{type: static}]
"""

CRANK = """\
gravity: [0, 0, -9.81]
nodes:
  c: {position: [0.5, 0, 0]}
  d: {position: [0.5, 0, 0]}
elements:
  c: {type: rigid_body, node: c, also: [d], mass: 1, inertia: [0.1, 0.1, 0.1]}
joints: {h: {type: hinge, nodes: [ground, c], axis: [0, 1, 0], position: [0, 0, 0]}}
drives: {m: {joint: h, angle: "0.5*t"}}
analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]
"""


class Slips(CommandTest):
    program = "bielle-mechanism"

    def run_changed(self, model, old="", new=""):
        self.assertIn(old, model)
        self.write("model.yaml", model.replace(old, new))
        return self.run_program("model.yaml")

    def warnings(self, model, old="", new=""):
        """Returns the warnings of a run that continues nevertheless."""
        done = self.run_changed(model, old, new)
        self.assertEqual(done.returncode, 0, done.stderr)
        return "\n".join(line for line in done.stderr.splitlines() if "warning: " in line)

    def refuse(self, model, old, new, *says):
        self.assertIn(old, model)
        self.write("model.yaml", model.replace(old, new))
        return self.expect_refusal(1, "model.yaml", says=says)

    def test_what_is_plausible_is_not_warned(self):
        self.assertEqual(self.warnings(BEAM), "")
        self.assertEqual(self.warnings(CRANK), "")
        self.assertEqual(self.warnings(CRANK, '"0.5*t"', '"100*t"'), "")  # turns far
        self.assertEqual(self.warnings(CRANK, '"0.5*t"', '"ramp(t, 0.002, 0.005)"'), "")
        self.assertEqual(self.warnings(CRANK, '"0.5*t"', '"step(t, 0.002, 0.005)"'), "")

    def test_moduli_and_densities_in_other_units(self):
        text = self.run_changed(BEAM, "210e9", "210e3").stderr  # the beam sags so far that the run fails as well
        self.assertIn("model.yaml:3: elements.m.section.young: is 210000 meant? Solids have 1e6", text)
        self.assertIn("steel has 210e9", text)
        self.assertIn("section.density: is 7.85e-09 meant?", self.warnings(BEAM, "7850", "7.85e-9"))
        self.assertIn("model.yaml:1: gravity: is 9810 meant? Lengths are in metres", self.warnings(BEAM, "9.81", "9810"))

    def test_play_of_gears_in_other_units(self):
        wheels = """\
nodes: {a: {}, b: {position: [0.1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  p: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  q: {type: hinge, nodes: [ground, b], axis: [0, 0, 1]}
  g: COUPLING
analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]
"""
        for coupling, plausible, wrong, says in (
                ("{type: gear, joints: [p, q], ratio: -1, stiffness: 1e4, backlash: 0.01}", "0.01", "1", "1e-4 to 1e-2 rad"),
                ("{type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: [0.05, 0.05], stiffness: 1e6, backlash: 1e-4}", "1e-4", "0.1",
                 "Teeth have a play of 1e-5 to 1e-3 m")):
            model = wheels.replace("COUPLING", coupling)
            self.assertNotIn("meant?", self.warnings(model))
            text = self.warnings(model, "backlash: " + plausible, "backlash: " + wrong)
            self.assertIn(f"model.yaml:8: joints.g.backlash: is {wrong} meant?", text)
            self.assertIn(says, text)

    def test_a_radius_in_millimetres(self):
        self.assertIn("model.yaml:3: elements.m.section: is it meant? It is as stiff as one of some 20 m in size, and the beam "
                      "is 1 m long", self.warnings(BEAM, "0.02", "20"))

    def test_orientations_in_degrees(self):
        self.assertIn("nodes.c.bryant: is 90 meant? Angles are in radians",
                      self.warnings(CRANK, "c: {position: [0.5, 0, 0]}", "c: {position: [0.5, 0, 0], bryant: [90, 0, 0]}"))

    def test_start_values_in_degrees(self):
        joint = "axis: [0, 1, 0], position: [0, 0, 0]"
        free = CRANK.replace('drives: {m: {joint: h, angle: "0.5*t"}}\n', "")
        for start, turns in (("90", "14.3 turns"), ("-30", "-4.77 turns")):
            text = self.warnings(free, joint, f"{joint}, start: {start}")
            self.assertIn(f"model.yaml:7: joints.h.start: is {start} rad meant, {turns}? An angle in degrees is written "
                          f"`{start} deg`", text)
        for start in ("90 deg", "6", "4*pi", "12.5", "-720 deg"):
            self.assertEqual(self.warnings(free, joint, f"{joint}, start: {start}"), "")
        slide = free.replace("hinge", "prismatic")
        self.assertNotIn("deg", self.warnings(slide, joint, f"{joint}, start: 90"))

    def test_densities_of_solids_in_other_units(self):
        body = BEAM.replace("{m: {type: beam, nodes: [a, b], section: {circle: 0.02, young: 210e9, poisson: 0.3, density: 7850}}}",
                            "{m: {type: rigid_body, node: a, solid: {sphere: 0.1, density: 7850}}}")
        self.assertEqual(self.warnings(body), "")
        for density in ("7.8", "7.8e-9", "7.8e6"):
            self.assertIn("model.yaml:3: elements.m.solid.density: is", self.warnings(body, "7850", density))

    def test_a_failure_within_a_formula_or_polar_is_placed_once(self):
        wheels = """\
nodes: {a: {}, b: {position: [0.1, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  p: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  q: {type: hinge, nodes: [ground, b], axis: [0, 0, 1]}
  g: {type: gear_mesh, nodes: [a, b], axes: [0, 0, 1], radii: [0.05, 0.05], stiffness: "1/phi"}
analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]
"""
        blade = """\
nodes: {a: {fixed: true}, b: {position: [2, 0, 0]}}
elements:
  blade: {type: beam, nodes: [a, b], elements: 2, orientation: [0, 1, 0], section: {rectangle: [0.3, 0.02], young: 7e10, poisson: 0.3, density: 1000},
    airfoil: {chord: "1/s", lift: 1}}
analysis: [{type: static}]
"""
        for model, line, says in ((wheels, 8, "joints.g.stiffness: formula '1/phi' at phi = 0, phi_2 = 0: division by zero"),
                                  (blade, 4, "elements.blade.airfoil.chord: formula '1/s' at s = 0: division by zero")):
            error = self.refuse(model, "", "", f"model.yaml:{line}: {says}")
            self.assertEqual(error.stderr.count("model.yaml"), 1)

    def test_an_angle_of_attack_outside_a_polar_names_its_place(self):
        self.write("model.yaml", """\
nodes: {a: {fixed: true}, b: {position: [2, 0, 0]}}
elements:
  blade: {type: beam, nodes: [a, b], elements: 2, orientation: [0, 1, 0], section: {rectangle: [0.3, 0.02], young: 7e10, poisson: 0.3, density: 1000},
    airfoil: {chord: 0.4, twist: 0.03, wind: [0, 10, 0], polars: [{at: 0.2, table: [[-0.01, 1, 0, 0], [0.01, 1, 0, 0]]}]}}
analysis: [{type: static}]
""")
        self.expect_refusal(2, "model.yaml", says=("model.yaml:4: elements.blade.airfoil.polars[1].table: angle of attack at s = 0.",
                                                   "is outside the table 'alpha', which runs from -0.01 to 0.01 [rad]"))

    def test_drives_and_motions_that_jump(self):
        text = self.warnings(CRANK, '"0.5*t"', '"0.5*pulse(t, 0.002, 1)"')
        self.assertIn("drives.m.angle: the angle jumps by 0.5 at t = 0.002 s", text)
        text = self.warnings(BEAM.replace("type: static", "type: dynamic, duration: 0.01, step: 1e-3"), "a: {fixed: true}",
                           'a: {fixed: [y, z, rx, ry, rz], motion: {x: "1e-3*if(t < 0.005, 0, 1)"}}')
        self.assertIn("nodes.a.motion.x: the prescribed motion jumps by 0.001 at t = 0.005 s", text)
        # A sine after a whole turn is zero up to rounding.
        self.assertNotIn("jumps", self.warnings(CRANK, '"0.5*t"', '"0.5*sin(2*pi*step(t, 0.001, 0.004))"'))

    def test_steps_without_end(self):
        self.refuse(CRANK, "step: 1e-3", "step: 1e-25", "model.yaml:9: analysis[1].step", "1e+23 steps; expected at most 1e+09")

    def test_names_that_stand_in_a_list_twice(self):
        self.refuse(BEAM, "fixed: true", "fixed: [x, y, x]", "nodes.a.fixed[3]: 'x' stands in this list twice")
        self.refuse(CRANK, "also: [d]", "also: [d, d]", "elements.c.also[2]: node 'd' is carried by node 'c' already")

    def test_numbers_beyond_anything(self):
        self.refuse(BEAM, "-9.81", "1e300", "model.yaml:1: gravity: expected accelerations in m/s^2")
        self.refuse(BEAM, "0.02", '"1e200*1e90"', "model.yaml:3: elements.m.section.circle: ", "is larger than anything can be computed with")

    def test_loads_beyond_anything_are_named(self):
        load = "loads:\n  push: {node: NODE, force: [0, 0, FORCE]}\nanalysis:"
        for model, node in ((BEAM, "b"), (CRANK, "c")):
            loaded = model.replace("analysis:", load.replace("NODE", node))
            place = f"model.yaml:{loaded[:loaded.index('push')].count(chr(10)) + 1}: loads.push.force[3]: "
            self.refuse(loaded, "FORCE", "1e300", place + "formula '1e300': 1e+300 is larger than anything can be computed with")
            self.write("model.yaml", loaded.replace("FORCE", "1e30"))
            self.assertIn(f"warning: {place}is 1e+30 meant? Forces are in newtons", self.run_program("model.yaml").stderr)
        self.write("model.yaml", loaded.replace("FORCE", '"1e300*step(t, 0, 0.005)"'))
        self.expect_refusal(2, "model.yaml", says=[place + "formula '1e300*step(t, 0, 0.005)' at t = ", "is larger than anything"])
        self.refuse(CRANK, 'angle: "0.5*t"', "torque: 1e300", "drives.m.torque: formula '1e300': 1e+300 is larger")
        beam = BEAM.replace("section:", "distributed: {force: [0, 0, 1e300]}, section:")
        self.refuse(beam, "1e300", "-1e300", "elements.m.distributed.force[3]: formula '-1e300': -1e+300 is larger")

    def test_inertias_and_masses_in_other_units(self):
        # A steel bar of 1 kg and 0.1 m has 8.3e-4 kg m^2.
        self.assertIn("model.yaml:6: elements.c.inertia: is this meant? 1 kg with so much inertia reaches over some 101 m; "
                      "inertias are in kg m^2", self.warnings(CRANK, "[0.1, 0.1, 0.1]", "[10, 833, 833]"))
        self.assertEqual(self.warnings(CRANK, "[0.1, 0.1, 0.1]", "[1e-5, 8.3e-4, 8.3e-4]"), "")
        self.assertEqual(self.warnings(CRANK, "[0.1, 0.1, 0.1]", "[0, 30, 30]"), "")  # a rod of 19 m
        solid = "solid: {box: [0.1, 0.02, 0.02], density: 7850}"
        self.assertEqual(self.warnings(CRANK, "mass: 1, inertia: [0.1, 0.1, 0.1]", solid), "")
        self.assertIn("elements.c.solid: are 3.14e+08 kg meant? Lengths are in metres",
                      self.warnings(CRANK, "mass: 1, inertia: [0.1, 0.1, 0.1]", solid.replace("[0.1, 0.02, 0.02]", "[100, 20, 20]")))

    def test_positions_in_millimetres(self):
        links = """\
gravity: [0, 0, -9.81]
nodes: {c: {position: [LENGTH, 0, 0]}, d: {position: [FAR, 0, 0]}}
elements:
  c: {type: rigid_body, node: c, mass: 1, inertia: [1e-5, 8.3e-4, 8.3e-4]}
  d: {type: rigid_body, node: d, mass: 1, inertia: [1e-5, 8.3e-4, 8.3e-4]}
joints:
  g: {type: hinge, nodes: [ground, c], axis: [0, 1, 0], position: [0, 0, 0]}
  h: {type: hinge, nodes: [c, d], axis: [0, 1, 0], position: [PIN, 0, 0]}
analysis: [{type: dynamic, duration: 0.01, step: 1e-3}]
"""
        def lengths(half):
            return links.replace("LENGTH", f"{half}").replace("PIN", f"{2 * half}").replace("FAR", f"{3 * half}")

        self.assertIn("model.yaml:4: elements.c: its joints are 100 m apart, and its inertia is that of a body of 0.1 m: is that "
                      "meant? Positions are in metres", self.warnings(lengths(50)))
        self.assertEqual(self.warnings(lengths(0.05)), "")
        # One body of usual proportions suppresses the warning.
        self.assertEqual(self.warnings(lengths(50), "mass: 1, inertia: [1e-5, 8.3e-4, 8.3e-4]}\n  d",
                                     "mass: 1000, inertia: [1, 8e5, 8e5]}\n  d"), "")

    def test_no_example_is_warned(self):
        folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "mechanism", "examples")
        # These types need superelements, and have separate tests.
        flexible = {"crane.yaml", "four_bar.yaml", "robot_from_step.yaml", "slider_crank.yaml"}
        for name in sorted(os.listdir(folder)):
            if name.endswith(".yaml") and name not in flexible:
                done = self.run_program(os.path.join(folder, name), "--check")
                self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    def test_a_long_formula_is_not_printed_whole(self):
        for term in ("sqrt(t-1)", "foo(t-1)"):
            formula = "+".join([term] * 3000)
            self.write("model.yaml", CRANK + f'loads: {{p: {{node: c, force: ["{formula}", 0, 0]}}}}\n')
            done = self.run_program("model.yaml")
            self.assertIn(done.returncode, (1, 2))
            self.assertLess(len(done.stderr), 1000)
            self.assertIn(" ... ", done.stderr)

    def test_a_part_that_is_joined_to_nothing(self):
        lost = "nodes:\n  lost: {position: [3, 0, 0]}"
        model = CRANK.replace("\nnodes:", "\n" + lost).replace(
            "\nelements:", "\nelements:\n  lost: {type: rigid_body, node: lost, mass: 1, inertia: [0.1, 0.1, 0.1]}")
        done = self.run_changed(model)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("\n  joined to nothing that is held: the part of node 'lost'\n", done.stdout)
        self.assertNotIn("joined to nothing", self.run_changed(CRANK).stdout)
        # A free body is probably intended.
        flying = model.replace("nodes: [ground, c]", "nodes: [lost, c]")
        self.assertNotIn("joined to nothing", self.run_changed(flying).stdout)


if __name__ == "__main__":
    unittest.main()
