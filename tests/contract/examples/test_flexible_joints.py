"""Compares mounts, bearings and play in mechanism/examples/flexible_joints.yaml with closed forms."""

import os
import unittest

import numpy as np

from example import EXAMPLES, ExampleTest



class FlexibleJoints(ExampleTest):
    model = "flexible_joints.yaml"

    def rows(self, name):
        return np.array(self.results.rows(name))

    def test_the_floor_moves_by_the_double_integral_of_its_record(self):
        t, a = np.loadtxt(os.path.join(EXAMPLES, "shake.csv"), delimiter=",").T
        v = np.concatenate([[0], np.cumsum(np.diff(t) * (a[1:] + a[:-1]) / 2)])
        x = np.concatenate([[0], np.cumsum(v[:-1] * np.diff(t) + np.diff(t) ** 2 * (2 * a[:-1] + a[1:]) / 6)])
        at = np.searchsorted(self.time, t - 1e-9)
        floor = self.rows("nodes/floor/position")[:, 0]
        for k in range(len(t)):
            # Rows are at the times of the record, except those between two rows.
            if abs(self.time[at[k]] - t[k]) < 1e-9:
                self.assertAlmostEqual(floor[at[k]], x[k], delta=1e-12)

    def test_the_mount_bears_the_machine_where_it_is_drawn(self):
        force = self.rows("joints/mount/force")
        self.assertAlmostEqual(force[0, 2], 80 * 9.81, delta=1e-6)
        self.assertLess(np.abs(self.rows("joints/mount/coordinate")[:, 2]).max(), 5e-3)

    def test_the_rotor_sinks_into_its_bearings_and_turns(self):
        q = self.rows("joints/left/coordinate")
        self.assertAlmostEqual(q[-1, 5], 40 * self.time[-1], delta=1e-6)
        radial = np.hypot(q[-1, 0], q[-1, 1])
        self.assertAlmostEqual(radial, 20 * 9.81 / 2e6, delta=1e-3 * radial)

    def test_the_arm_swings_with_the_stiffness_of_its_matrix(self):
        w = np.sqrt(12 * 100 / 0.5 ** 3 / 1)
        z = self.rows("nodes/tip/position")[:, 2]
        static = 9.81 / w ** 2
        early = self.time < 0.3
        # The scheme has a phase error of about (w h)^2/12 w t, which is 1e-3 of the amplitude.
        np.testing.assert_allclose(z[early], -static * (1 - np.cos(w * self.time[early])), atol=2e-3 * static)

    def test_the_slider_follows_the_crank_but_for_the_play(self):
        angle = self.rows("joints/main/coordinate")[:, 0]
        ideal = 0.1 * np.cos(angle) + np.sqrt(0.3 ** 2 - (0.1 * np.sin(angle)) ** 2)
        off = np.abs(self.rows("nodes/slider/position")[:, 0] - 4 - ideal)
        # This is the play and the penetration of the surfaces along the path of the slider, for a rod inclined by
        # asin(1/3).
        play = 1e-4 + self.rows("joints/wrist/penetration").max()
        self.assertLess(off.max(), play / np.sqrt(1 - 1 / 9))
        self.assertGreater(off.max(), 0.8e-4)

    def test_the_ball_stops_bouncing_and_rolls_at_the_bottom_of_its_socket(self):
        late = self.time > 0.8
        q, force = self.rows("joints/socket/coordinate")[late], self.rows("joints/socket/normal_force")[late, 0]
        self.assertTrue(np.all(force > 0))
        self.assertTrue(np.all(q[:, 2] < -1.8e-3))
        # The force is nearly the weight, since the part swings a little and spins about its own axes.
        self.assertAlmostEqual(force.mean(), 0.2 * 9.81, delta=0.05 * 0.2 * 9.81)


if __name__ == "__main__":
    unittest.main()
