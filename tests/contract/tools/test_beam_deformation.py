"""Tests of the magnified deformation of beams: helices with random strains, rigid motions, an arc, a cantilever, the
page."""

import os
import subprocess
import unittest

import numpy as np

import page_driver
from box_mesh import InFolder

from bielle_tools.results import Results  # box_mesh sets the path
from bielle_tools.results.quaternions import product, rotated
from bielle_tools.scene import make_scene
from bielle_tools.scene.beam_deformation import exponential, logarithm, magnified, undeformed_motion
from bielle_tools.view import build_page

PROGRAMS = os.environ["BIELLE_PROGRAMS"]
LENGTH, RADIUS, YOUNG, FORCE = 1.0, 0.02, 210e9, 200.0
MODEL = f"""
nodes: {{a: {{position: [0, 0, 0]}}, b: {{position: [{LENGTH}, 0, 0]}}}}
elements: {{bar: {{type: beam, nodes: [a, b], elements: 8, section: {{circle: {RADIUS}, young: {YOUNG}, poisson: 0.3, density: 7850}}}}}}
joints: {{pin: {{type: hinge, nodes: [ground, a], axis: [0, 1, 0]}}}}
drives: {{turn: {{joint: pin, angle: 0.7}}}}
loads: {{push: {{node: b, force: [0, 0, {FORCE}], follower: true}}}}
analysis: [{{type: static, steps: 2}}]
"""


def screw(v, d, doublings=12):
    """Returns position and rotation after a motion with the constant velocities d, v in its own axes, as a composition
    of 4096 equal small steps (midpoint rule)."""
    parts = 2**doublings
    x, q = rotated(exponential(v / parts / 2), d / parts), exponential(v / parts)
    for _ in range(doublings):
        x, q = x + rotated(q, x), product(q, q)
    return x, q


def chain(strains, initial, h):
    """Returns the stations of a beam with constant strains (n,6) of its elements, and with (1, 0, 0, initial curvature)
    without strain."""
    x, q = [np.zeros(3)], [np.array([1.0, 0, 0, 0])]
    for strain in strains:
        d, turn = screw(h * (initial + strain[3:]), h * (np.array([1.0, 0, 0]) + strain[:3]))
        x.append(x[-1] + rotated(q[-1], d))
        q.append(product(q[-1], turn))
    return np.array(x), np.array(q)


def moved(x, q, turn, shift):
    return rotated(turn, x) + shift, product(turn, q)


class Deformations(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(6)
        self.turn, self.shift = exponential(random.normal(size=3)), random.normal(size=3)
        self.random = random

    def test_logarithm_and_exponential(self):
        v = self.random.normal(size=(200, 3))
        v *= (self.random.uniform(0, np.pi, 200) / np.linalg.norm(v, axis=1))[:, None]
        np.testing.assert_allclose(logarithm(exponential(v)), v, atol=1e-13)
        np.testing.assert_allclose(logarithm(-exponential(v)), v, atol=1e-13)
        tiny = np.array([[0, 0, 0], [1e-14, 0, 0], [0, 1e-7, 1e-9]])
        np.testing.assert_allclose(logarithm(exponential(tiny)), tiny, rtol=1e-9)

    def test_a_rigid_motion_of_a_curved_beam_is_not_magnified(self):
        x, q = chain(np.zeros((5, 6)), np.array([0.3, 1.0, -2.0]), 0.2)
        places = [moved(x, q, *motion) for motion in ((exponential(np.zeros(3)), np.zeros(3)), (self.turn, self.shift), (exponential(np.array([0, 3.1, 0])), 5 * self.shift))]
        x, q = (np.stack(each) for each in zip(*places))
        rest = undeformed_motion(x, q, np.zeros((3, 5, 6)))(np.arange(3))
        poses = np.concatenate([x, q, np.ones((3, 6, 1))], axis=2)
        found = magnified(poses, rest, 100.0)
        np.testing.assert_allclose(found[..., :3], x, atol=1e-9)  # a hundred times the rounding of the small steps
        np.testing.assert_allclose(np.abs((found[..., 3:7] * q).sum(axis=-1)), 1, atol=1e-12)

    def test_recorded_strain_gives_the_undeformed_beam(self):
        """Three elements of a helix have random strains from the first row, so that the results do not contain the beam
        without strain."""
        initial, h = np.array([0.5, -1.0, 2.0]), 0.3
        strain = 0.2 * self.random.normal(size=(3, 6))
        x, q = moved(*chain(strain, initial, h), self.turn, self.shift)
        rest = undeformed_motion(x[None], q[None], strain[None])([0])[0]
        U, Q = chain(np.zeros((3, 6)), initial, h)
        turn = product(rest[0, 3:7], Q[0] * [1, -1, -1, -1])
        # The tolerance is the error of the small steps of the test.
        np.testing.assert_allclose(rest[:, :3] - rest[0, :3], rotated(turn, U - U[0]), atol=1e-7)
        np.testing.assert_allclose(np.abs((product(turn, Q) * rest[:, 3:7]).sum(axis=1)), 1, atol=1e-12)
        poses = np.concatenate([x, q, np.ones((4, 1))], axis=1)
        np.testing.assert_allclose(magnified(poses, rest, 1.0)[:, :3], x, atol=1e-14)
        np.testing.assert_allclose(magnified(poses, rest, 0.0)[:, :7], rest[:, :7], atol=1e-14)

    def test_the_fit_is_the_nearest_rigid_motion(self):
        """No small motion of the undeformed beam reduces the sum of squares, and the picture rotates with the
        mechanism."""
        strain = np.tile([0.0, 0, 0, 0.3, 0.5, -0.4], (4, 1))
        x, q = chain(strain, np.zeros(3), 0.25)
        rest = undeformed_motion(x[None], q[None], strain[None])([0])[0]
        arm = ((rest[:, :3] - rest[:, :3].mean(axis=0)) ** 2).sum(axis=1).mean()

        def misfit(turn, shift):
            centre = rest[:, :3].mean(axis=0)
            y, r = rotated(turn, rest[:, :3] - centre) + centre + shift, product(turn, rest[:, 3:7])
            return ((y - x) ** 2).sum() + arm * 8 * (1 - (r * q).sum(axis=1) ** 2).sum()  # |R - S|^2 = 8 (1 - (p . q)^2)

        least = misfit(np.array([1.0, 0, 0, 0]), 0)
        for k in range(3):
            for sign in (-1, 1):
                self.assertGreater(misfit(exponential(sign * 1e-3 * np.eye(3)[k]), 0), least)
                self.assertGreater(misfit(np.array([1.0, 0, 0, 0]), sign * 1e-3 * np.eye(3)[k]), least)
        y, r = moved(x, q, self.turn, self.shift)
        other = undeformed_motion(y[None], r[None], strain[None])([0])[0]
        np.testing.assert_allclose(other[:, :3], moved(rest[:, :3], rest[:, 3:7], self.turn, self.shift)[0], atol=1e-12)

    def test_ten_times_a_small_curvature(self):
        strain = np.zeros((10, 6))
        strain[:, 5] = 1e-4
        x, q = chain(strain, np.zeros(3), 0.1)
        rest = undeformed_motion(x[None], q[None], strain[None])([0])[0]
        found = magnified(np.concatenate([x, q, np.ones((11, 1))], axis=1), rest, 10.0)
        np.testing.assert_allclose(np.diff(found[:, 1], 2), 10 * 1e-4 * 0.1 ** 2, rtol=1e-6)

    def test_unknown_rows_stay_unknown(self):
        x, q = chain(np.zeros((2, 6)), np.zeros(3), 0.5)
        x, q, strain = np.stack([np.nan * x, x]), np.stack([q, q]), np.zeros((2, 2, 6))
        rest = undeformed_motion(x, q, strain)([0, 1])
        self.assertTrue(np.isnan(rest[0]).all() and np.isfinite(rest[1]).all())
        self.assertIsNone(undeformed_motion(np.nan * x, q, strain))


class OfAModel(InFolder):
    def scene(self):
        self.write("model.yaml", MODEL)
        subprocess.run([os.path.join(PROGRAMS, "bielle-mechanism"), "model.yaml", "-o", "run.h5", "--quiet"], cwd=self.folder, check=True, timeout=60)
        results = Results(self.path("run.h5"))
        self.addCleanup(results.file.close)
        scene = make_scene(results)
        part, = [part for part in scene.parts if part.rest]
        return scene, part

    def test_a_cantilever(self):
        """Second differences are those of F x^2 (3 L - x)/(6 E I) along the normal of the beam at rest; rigid motions
        have none."""
        scene, part = self.scene()
        rest, poses = part.rest([1])[0], scene.poses(part, [1])[0]
        x = np.linspace(0, LENGTH, 9)
        np.testing.assert_allclose(rest[:, :3] - rest[0, :3], np.outer(x, rest[-1, :3] - rest[0, :3]), atol=1e-6)
        self.assertAlmostEqual(np.linalg.norm(rest[-1, :3] - rest[0, :3]), LENGTH, places=6)
        found = np.diff(((magnified(poses, rest, 50.0) - rest)[:, :3] @ rotated(rest[0, 3:7], [0, 0, 1.0])), 2)
        exact = 50 * np.diff(FORCE * x ** 2 * (3 * LENGTH - x) / (6 * YOUNG * np.pi * RADIUS ** 4 / 4), 2)
        np.testing.assert_allclose(found, exact, atol=0.01 * np.abs(exact).max())


@unittest.skipIf(page_driver.WHY_NOT, page_driver.WHY_NOT)
class InThePage(OfAModel, page_driver.Pages):
    def test_the_page_magnifies_as_the_pictures_do(self):
        scene, part = self.scene()
        text, _ = build_page([self.path("run.h5")])
        self.open(self.write("page.html", text))
        poses = "return bielle.shown.tracks.rests.size ? [...bielle.shown.tracks.rests.keys()].map(t => [...bielle.real([0, 1, 2].map(k => bielle.shown.tracks.poses[8 * t + k])), " \
                "...bielle.shown.tracks.poses.subarray(8 * t + 4, 8 * t + 8)]) : []"
        for factor in (1, 30):
            found = np.array(self.run_script(f"bielle.settings.magnify = {factor}; bielle.player.go(1); {poses}"))
            exact = magnified(scene.poses(part, [1]), part.rest([1]), factor)[0]
            self.assertEqual(found.shape, (9, 7))
            np.testing.assert_allclose(found[:, :3], exact[:, :3], atol=1e-4 * factor)
            np.testing.assert_allclose(np.abs((found[:, 3:] * exact[:, 3:7]).sum(axis=1)), 1, atol=1e-6 * factor)
        self.assertTrue(self.run_script("return document.getElementById('options').textContent.includes('deformation')"))
        self.no_errors()


if __name__ == "__main__":
    unittest.main()
