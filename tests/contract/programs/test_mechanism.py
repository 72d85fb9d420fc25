"""Tests of the interface of bielle-mechanism: messages, exit statuses, and the files of a failed run."""

import os
import signal
import subprocess
import time
import unittest

import h5py

from command import PROGRAMS, CommandTest

PENDULUM = """\
mechanism: pendulum
gravity: [0, 0, -9.81]
parameters: {length: 0.5}
nodes:
  bob: {position: ["length", 0, 0]}
elements:
  bob: {type: rigid_body, node: bob, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}
joints:
  pivot: {type: hinge, nodes: [ground, bob], axis: [0, 1, 0], position: [0, 0, 0]}
analysis:
  - {type: dynamic, duration: 0.1, step: 1e-3}
"""


class Mechanism(CommandTest):
    program = "bielle-mechanism"

    def refuse(self, old, new, *says, status=1):
        self.assertIn(old, PENDULUM)
        self.write("model.yaml", PENDULUM.replace(old, new))
        return self.expect_refusal(status, "model.yaml", says=says)

    def test_what_has_no_mass_is_told_its_cure(self):
        model = PENDULUM.replace("type: rigid_body, node: bob, mass: 1, inertia: [1e-3, 1e-3, 1e-3]",
                                 "type: point_mass, node: bob, mass: 1")
        begin, end = model.index("joints:"), model.index("analysis:")
        self.write("model.yaml", model[:begin] + "loads: {twist: {node: bob, moment: [1, 0, 0]}}\n" + model[end:])
        self.expect_refusal(2, "model.yaml", says=["rotation x of node 'bob'", "no mass",
                                                   "hold it (`fixed`), join it, or give it a body with inertia"])

    def test_a_good_model_runs_and_is_summarised(self):
        self.write("model.yaml", PENDULUM)
        done = self.run_program("model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("100 steps", done.stdout)
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertEqual(results.attrs["complete"], 1)
            self.assertEqual(results["time"].shape, (101,))
            self.assertEqual(results["time"].attrs["units"], "s")
            self.assertEqual(results["nodes/bob/position"].shape, (101, 3))
            self.assertIn("mechanism: pendulum", results["input"][()].decode())

    def test_one_thing_is_counted_in_the_singular(self):
        self.write("model.yaml", PENDULUM.replace("duration: 0.1, step: 1e-3", "duration: 1e-3, step: 1e-3"))
        done = self.run_program("model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("  1 step, ", done.stdout)
        self.assertNotRegex(done.stdout, r"\b1 (steps|rows|factorisations|iterations)")

    def test_quiet_says_nothing(self):
        self.write("model.yaml", PENDULUM)
        done = self.run_program("model.yaml", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_help_and_version(self):
        for option in ("--help", "--version"):
            done = self.run_program(option)
            self.assertEqual(done.returncode, 0)
            self.assertTrue(done.stdout.strip())
        self.assertIn("manual", self.run_program("--help").stdout)

    def test_check_tells_the_mass_and_its_centre(self):
        # The masses are 2 kg at x = 1 on a held node, 1 kg in rotated axes 0.5 m above (4, 0, 0), and 3 kg of beam from
        # x = 0 to 2.
        self.write("model.yaml", """\
nodes:
  held: {position: [1, 0, 0], fixed: true}
  free: {position: [4, 0, 0], axes: {x: [0, 1, 0], y: [0, 0, 1]}}
  a: {position: [0, 0, 0], fixed: true}
  b: {position: [2, 0, 0]}
elements:
  held: {type: point_mass, node: held, mass: 2}
  free: {type: rigid_body, node: free, mass: 1, centre: [0, 0.5, 0], inertia: [1, 1, 1]}
  beam: {type: beam, nodes: [a, b], elements: 3, orientation: [0, 1, 0], section: {rectangle: [0.1, 0.02], young: 7e10, poisson: 0.3, density: 750}}
joints: {j: {type: rigid, nodes: [b, free]}}
""")
        self.assertIn("  mass         6 kg, centre at [1.5, 0, 0.0833333] m\n", self.run_program("model.yaml", "--check").stdout)
        self.write("model.yaml", "nodes: {a: {fixed: true}}\njoints: {}\n")
        self.assertNotIn("  mass  ", self.run_program("model.yaml", "--check").stdout)

    def test_unknown_option(self):
        self.expect_refusal(1, "model.yaml", "--quite", says=["--quite", "--quiet"])

    def test_missing_file(self):
        self.expect_refusal(1, "nowhere.yaml", says=["nowhere.yaml"])

    def test_unknown_section(self):
        self.refuse("joints:", "joint:", "model.yaml:8", "'joint'", "did you mean 'joints'")

    def test_unknown_key(self):
        self.refuse("mass: 1,", "mas: 1,", "model.yaml:7", "elements.bob", "'mas'", "did you mean 'mass'")

    def test_unknown_type(self):
        self.refuse("type: hinge", "type: hinje", "model.yaml:9", "did you mean 'hinge'")

    def test_joint_on_a_node_that_does_not_exist(self):
        self.refuse("nodes: [ground, bob]", "nodes: [ground, bop]", "model.yaml:9", "joints.pivot.nodes", "'bop'",
                    "did you mean 'bob'")

    def test_missing_key(self):
        self.refuse("axis: [0, 1, 0], ", "", "model.yaml:9", "axis")

    def test_a_number_out_of_range(self):
        self.refuse("mass: 1,", "mass: -1,", "model.yaml:7", "mass", "-1")
        self.refuse("step: 1e-3", "step: 0", "model.yaml:11", "step")
        self.refuse("step: 1e-3", "step: 1e-3, rho: 1.5", "model.yaml:11", "rho", "1.5")

    def test_an_inertia_that_no_body_has(self):
        self.refuse("inertia: [1e-3, 1e-3, 1e-3]", "inertia: [1e-3, 1e-3, 5e-3]", "model.yaml:7", "inertia")

    def test_broken_formula(self):
        self.refuse('"length"', '"lenght"', "model.yaml:5", "lenght")

    def test_broken_yaml(self):
        self.refuse("nodes:\n", "nodes: {\n", "model.yaml:")

    def test_duplicate_name(self):
        self.refuse("elements:\n", "elements:\n  bob: {type: point_mass, node: bob, mass: 1}\n", "model.yaml:", "bob")

    def test_settings(self):
        self.write("model.yaml", PENDULUM)
        self.expect_refusal(1, "model.yaml", "--set", "lenght=1", says=["lenght", "did you mean 'length'"])
        self.expect_refusal(1, "model.yaml", "--set", "length", says=["NAME=EXPRESSION"])
        done = self.run_program("model.yaml", "--set", "length=2*0.35", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertAlmostEqual(results["nodes/bob/position"][0, 0], 0.7, places=12)

    def test_check_describes_without_running(self):
        self.write("model.yaml", PENDULUM)
        done = self.run_program("model.yaml", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 degree of freedom", done.stdout)
        self.assertIn("joint 'pivot' (hinge)", done.stdout)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "model.h5")))

    def test_check_tells_what_bodies_beams_and_nodes_are(self):
        self.write("model.yaml", PENDULUM.replace("nodes:\n", "nodes:\n  lonely: {position: [1, 1, 1]}\n"
                                                  "  far: {position: [2, 0, 0]}\n")
                   .replace("elements:\n", "elements:\n  arm: {type: beam, nodes: [bob, far], elements: 3, section: "
                            "{EA: 7, GAy: 6, GAz: 5, GJ: 4, EIy: 3, EIz: 2, mass_per_length: 2, Jx: 1, Jy: 1, Jz: 1}}\n"))
        done = self.run_program("model.yaml", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("element 'bob' (rigid_body): mass 1 kg", done.stdout)
        self.assertIn("inertia about it xx 0.001", done.stdout)
        self.assertRegex(done.stdout, r"element 'arm' \(beam\): length [\d.]+ m, mass [\d.]+ kg, 3 elements")
        self.assertIn("EA 7, GAy 6, GAz 5 N, GJ 4, EIy 3, EIz 2 N m^2", done.stdout)
        self.assertIn("unused       node 'lonely'", done.stdout)
        self.assertIn("massless     node 'lonely'", done.stdout)
        self.assertIn("must be held (`fixed`)", done.stdout)
        self.assertNotRegex(done.stdout, "massless .*'bob'")
        self.write("rod.yaml", "nodes: {a: {position: [0, 0, 0]}}\nelements: {rod: {type: rigid_body, node: a, mass: 1, "
                   "inertia: [0, 1, 1], inertia_axes: {rotation_vector: [0, 0, pi/2]}, centre: [0.5, 0, 0]}, "
                   "push: {type: node_force, nodes: [ground, a], force: [0, 0, 1]}}\n"
                   "analysis: [{type: dynamic, duration: 1, step: 0.1}]\n")
        done = self.run_program("rod.yaml", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("massless     rotation of node 'a' about", done.stdout)
        done = self.run_program("rod.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"rotation of node 'a' about \(0, 1, 0\) in its axes: it has no mass")
        self.write("massless.yaml", "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\nelements: {beam: {type: beam, "
                   "nodes: [a, b], section: {circle: 0.1, young: 1, shear: 1}}}\n")
        done = self.run_program("massless.yaml", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("massless     node 'b'\n", done.stdout)
        self.assertIn("massless     7 inner nodes of 'beam'\n", done.stdout)
        self.assertNotIn("against one moment alone", done.stdout)
        self.assertEqual(done.stdout.count("massless"), 2)
        # The section lies off the node line: its own bending stiffness is pi/4 0.1^4 E = 1.5708e-4 E, far below EIz
        # about the line.
        self.write("massless.yaml", "nodes: {a: {fixed: true}, b: {position: [1, 0, 0]}}\nelements: {beam: {type: beam, "
                   "nodes: [a, b], section: {circle: 0.1, young: 2, shear: 1, offset: [0.3, 0]}}}\n")
        done = self.run_program("massless.yaml", "--check")
        self.assertIn("against one moment alone: GJ 0.00015708, EIy 0.00015708, EIz 0.00015708 N m^2", done.stdout)

    def test_orientations_however_large(self):
        node = "nodes:\n  turned: {position: [1, 1, 1], %s, fixed: true}\n"
        self.write("model.yaml", PENDULUM.replace("nodes:\n", node % "conformal: [1e200, 0, 0]"))
        self.assertEqual(self.run_program("model.yaml", "--quiet").returncode, 0)
        self.refuse("nodes:\n", node % "rotation_vector: [1e200, 0, 0]", "model.yaml:5", "rotation_vector", "rad")

    def test_a_beam_that_turns_too_far_names_its_element_and_the_load_factor(self):
        self.write("roll.yaml", """nodes:
  root: {fixed: true}
  tip: {position: [1, 0, 0]}
elements:
  strip: {type: beam, nodes: [root, tip], elements: 2, section: {EA: 1e3, GAy: 1e3, GAz: 1e3, GJ: 1, EIy: 1, EIz: 1}}
loads:
  roll: {node: tip, moment: [0, 0, "2*pi"]}
analysis:
  - {type: static, steps: 20}
""")
        self.expect_refusal(2, "roll.yaml", says=["load factor 0.9", "beam 'strip', element 1 of 2", "171", "`elements`"])

    def test_a_node_without_mass_is_a_failed_computation(self):
        self.refuse("nodes:\n", "nodes:\n  lonely: {position: [1, 1, 1]}\n", "lonely", "no mass", status=2)

    def test_superelement_files_that_are_no_good(self):
        rod = PENDULUM.replace("elements:\n", "elements:\n  rod: {type: superelement, file: rod.h5, nodes: {a: bob}}\n")
        self.write("model.yaml", rod)
        self.expect_refusal(1, "model.yaml", says=["rod.h5"])  # missing
        self.write("rod.h5", "this is no HDF5 file")
        self.expect_refusal(1, "model.yaml", says=["rod.h5"])
        path = os.path.join(self.folder, "rod.h5")
        with h5py.File(path, "w") as file:
            file.attrs["format"] = "bielle superelement"
            file.attrs["version"] = 99
            file.attrs["complete"] = 1
        self.expect_refusal(1, "model.yaml", says=["rod.h5", "99"])

    def test_a_run_that_fails_leaves_its_steps_readable_and_marked(self):
        # The force is not finite after half of the time.
        self.write("model.yaml", PENDULUM.replace(
            "analysis:", 'loads:\n  burst: {node: bob, force: ["1/(0.05-t)^9", 0, 0]}\nanalysis:'))
        self.expect_refusal(2, "model.yaml", says=["t = "])
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertEqual(results.attrs["complete"], 0)
            rows = results["analysis_1/time"].shape[0]
            self.assertGreater(rows, 10)
            self.assertGreaterEqual(results["analysis_1/nodes/bob/position"].shape[0], rows)

    def test_interruption_ends_after_the_step_in_hand(self):
        self.write("model.yaml", PENDULUM.replace("duration: 0.1", "duration: 1000"))
        run = subprocess.Popen([os.path.join(PROGRAMS, self.program), "model.yaml"], cwd=self.folder,
                               stderr=subprocess.PIPE, text=True)
        time.sleep(1.5)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 2)
        self.assertIn("interrupted at t = ", errors)
        with h5py.File(os.path.join(self.folder, "model.h5")) as results:
            self.assertEqual(results.attrs["complete"], 0)
            self.assertGreater(results["analysis_1/time"].shape[0], 1)


if __name__ == "__main__":
    unittest.main()
