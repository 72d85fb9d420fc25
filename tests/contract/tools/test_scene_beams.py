"""Tests of beams in scenes: sections at nodes whose axes differ from those of the section."""

import unittest

import numpy as np

import box_mesh  # noqa: F401  (sets the path of the tools)
from bielle_tools.messages import InputError  # noqa: E402
from bielle_tools.results.quaternions import conjugate, from_axes, product  # noqa: E402
from bielle_tools.results.rotations import rotation_matrices  # noqa: E402
from bielle_tools.scene.beams import beam_motion, turns_of  # noqa: E402

ROWS = 4


class Recorded:
    """Returns results of one beam."""

    def __init__(self, position, rotation):
        self.values = {"elements/beam/position": position, "elements/beam/rotation": rotation}

    def has(self, place):
        return place in self.values

    def rows(self, place):
        return self.values[place]

    def shape(self, place):
        return self.values[place].shape


def sections(position, rotation, turns=None):
    """Returns the drawn axes of the sections (rows,stations,3,3)."""
    poses, _ = beam_motion(Recorded(position, rotation), "elements/beam", turns)
    return rotation_matrices(poses(np.arange(len(position)))[:, :, 3:7])


def about_z(angles):
    """Returns quaternions (...,4) of rotations about z [rad]."""
    half = 0.5 * np.asarray(angles)
    return np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=-1)


class Sections(unittest.TestCase):
    def arc(self, stations, angle, ends):
        """A circular arc in the plane x y rotates about z; its end nodes have the axes `ends`. The section axes are
        along the arc, towards the centre, and z. @returns positions, recorded rotations, rotations of the section"""
        s = np.linspace(0, angle, stations)
        x = np.column_stack([np.cos(s), np.sin(s), 0 * s])
        tangent = np.column_stack([-np.sin(s), np.cos(s), 0 * s])
        section = from_axes(tangent, -x, np.tile([0.0, 0, 1], (stations, 1)))
        recorded = section.copy()
        recorded[[0, -1]] = ends
        turns = about_z(0.7 * np.arange(ROWS))
        R = rotation_matrices(turns)
        return x @ R.transpose(0, 2, 1), product(turns[:, None], recorded[None]), product(turns[:, None], section[None])

    def check(self, stations, angle, tolerance):
        for ends in (np.array([1.0, 0, 0, 0]), np.array([0.5, -0.5, 0.5, 0.5])):
            x, recorded, section = self.arc(stations, angle, ends)
            self.assertLess(np.abs(sections(x, recorded) - rotation_matrices(section)).max(), tolerance, ends)

    def test_the_section_continues_that_of_the_inner_nodes(self):
        for stations in (5, 9):
            self.check(stations, 1.0, 1e-12)

    def test_with_few_inner_nodes_the_curvature_is_left_out(self):
        self.check(3, 1e-3, 1e-3)
        self.check(4, 1e-3, 1e-3)

    def test_without_inner_nodes_the_section_is_across_the_beam(self):
        turns = about_z(0.7 * np.arange(ROWS))
        R = rotation_matrices(turns)
        for ends in (np.array([1.0, 0, 0, 0]), np.array([0.5, -0.5, 0.5, 0.5])):
            for direction in ([0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0], [1, 2, -3]):
                x = np.array([[0.0, 0, 0], direction]) @ R.transpose(0, 2, 1)
                found = sections(x, product(turns[:, None], np.array([[ends, ends]])))
                tangent = R @ (np.array(direction) / np.linalg.norm(direction))
                np.testing.assert_allclose(found[..., 0], np.stack([tangent] * 2, axis=1), atol=1e-12)
                np.testing.assert_allclose(found @ found.swapaxes(-1, -2), np.broadcast_to(np.eye(3), found.shape), atol=1e-12)

    def test_turns_of_the_drawing_give_the_sections_at_the_ends(self):
        ends = np.array([[0.5, -0.5, 0.5, 0.5], [0.0, 0.6, 0.0, 0.8]])
        for stations in (2, 3, 5):
            x, recorded, section = self.arc(stations, 1.0, ends)
            # Quaternions need not have unit length.
            turns = turns_of({"entry": "elements/beam", "turn": (3 * product(conjugate(ends), section[0, [0, -1]])).tolist()})
            self.assertLess(np.abs(sections(x, recorded, turns) - rotation_matrices(section)).max(), 1e-12, stations)

    def test_damaged_turns_are_told(self):
        self.assertIsNone(turns_of({"entry": "elements/beam"}))
        for turn in ("x", [[1, 0, 0, 0]], [[1, 0, 0, 0], [0, 0, 0, 0]], [[1, 0, 0, 0], [1, 0, 0]], [[1, 0, 0, 0], [None, 0, 0, 0]], {"a": 1}, 7):
            with self.assertRaisesRegex(InputError, "'turn' of 'elements/beam' in the drawing is damaged: two quaternions are expected"):
                turns_of({"entry": "elements/beam", "turn": turn})

    def test_rows_that_are_no_numbers_stay_so(self):
        x, recorded, section = self.arc(5, 1.0, np.array([1.0, 0, 0, 0]))
        recorded[0] = np.nan
        found = sections(x, recorded)
        self.assertTrue(np.isnan(found[0]).all())
        np.testing.assert_allclose(found[1:], rotation_matrices(section[1:]), atol=1e-12)


if __name__ == "__main__":
    unittest.main()
