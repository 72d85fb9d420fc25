"""Tests of recovered quantities, of stress at points, and of cells in the formats of matrices.

The tables have the layout of EXTSEOUT's punch files (pyyeti/tests/nas2cam_extseout): TYPE, ID, COMP, ROW.
"""

import dataclasses
import unittest

import numpy as np

from box_mesh import InFolder
from exchange_samples import beam, order_of, turned, with_modes
from op4_samples import binary
from bielle_tools.exchange import formats, recovery
from bielle_tools.exchange.axes import in_body_axes
from bielle_tools.exchange.deck_cells import blocks_of_cards, blocks_of_results, cells_between
from bielle_tools.exchange.units import SI, converted, read_units
from bielle_tools.exchange.words_of_keys import in_words_of_keys
from bielle_tools.decks.nastran_cards import read_cards
from bielle_tools.messages import InputError

STEEL = (210e9, 7800.0, 0.5, 0.02)
POINTS = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nASET1,123456,1,2\n"
TABLES = ("DTI     TES1    2\n        TYPE    ID      COMP    ROW     TYPE    ID      COMP    ROW\n"
          "        34      23      2       3       34      11      2       1\n        ENDREC\n"
          "DTI     TEF1    2\n        TYPE    ID      COMP    ROW\n        34      10      8       1\n        33      97      2       9\n        ENDREC\n"
          "DTI     TQG1    2\n        TYPE    ID      COMP    ROW\n        1       2       6       1\n        ENDREC\n")


def with_recovery(body, seed=8):
    """Returns a body with stress at two of its points, and with two quantities."""
    random = np.random.default_rng(seed)
    n = body.size
    shapes = dataclasses.replace(body.shapes, stress=1e9 * random.standard_normal((12, n)), stress_points=np.array([2, 0]))
    quantities = {"gauges": recovery.Quantity(["front", "rear"], ["Pa", "Pa"], 1e9 * random.standard_normal((2, n))),
                  "loads": recovery.Quantity(["pull", "bend", "share"], ["N", "N m", "-"], random.standard_normal((3, n)))}
    return dataclasses.replace(body, shapes=shapes, quantities=quantities)


class Recovery(InFolder):
    def there_and_back(self, name, body, path, within, **options):
        formats.module_of(name).write(body, self.path(path), formats.Options(format=name))
        found = formats.module_of(name).read(self.path(path), formats.Options(**options))
        found.check()
        here, there = order_of(found), order_of(body)
        self.assertEqual(list(found.shapes.numbers[found.shapes.stress_points]), sorted(body.shapes.numbers[body.shapes.stress_points]) if
                         name in ("dmig", "op4", "op4-text") else list(body.shapes.numbers[body.shapes.stress_points]))
        stress = dict(zip(found.shapes.numbers[found.shapes.stress_points], found.shapes.stress.reshape(-1, 6, found.size)))
        expected = dict(zip(body.shapes.numbers[body.shapes.stress_points], body.shapes.stress.reshape(-1, 6, body.size)))
        for number, block in expected.items():
            np.testing.assert_allclose(stress[number][:, here], block[:, there], rtol=within)
        for quantity, other in body.quantities.items():
            np.testing.assert_allclose(found.quantities[quantity].matrix[:, here], other.matrix[:, there], rtol=within)
        return found

    def body(self, turn=True):
        return with_recovery(with_modes(beam(*STEEL, turned() if turn else None)))

    def test_round_trips(self):
        """OUTPUT4 has 16 digits, in binary and in text, and DMIG has at least 11."""
        for name, path, within in (("matrices", "a.h5", 0), ("npz", "a.npz", 0), ("op4", "a.op4", 0), ("op4-text", "b.op4", 1e-15),
                                   ("dmig", "a.pch", 1e-10)):
            with self.subTest(name):
                body = self.body()
                body.quantities["loads"].matrix[2] = 0  # DMIG has no card for a row of zeros
                found = self.there_and_back(name, body, path, within)
                np.testing.assert_allclose(found.shapes.displacement[:, order_of(found)], body.shapes.displacement[:, order_of(body)], rtol=1e-9)
                self.assertEqual(list(found.quantities), ["gauges", "loads"])
                self.assertEqual(found.quantities["loads"].rows, ["pull", "bend", "share"])
                self.assertEqual(found.quantities["loads"].units, ["N", "N m", "-"])

    def test_names_in_comments(self):
        """A request has precedence. Comments that do not fit are ignored, and a deck without comments omits the
        matrix."""
        for name, path, deck in (("op4", "a.op4", "a-nodes.bdf"), ("dmig", "a.pch", "a.pch")):
            formats.module_of(name).write(self.body(), self.path(path), formats.Options(format=name))
            with open(self.path(deck), encoding="ascii") as file:
                text = file.read()

            def read(changed, **asked):
                self.write(deck, changed)
                requests = {quantity: recovery.Request(*request) for quantity, request in asked.items()}
                return formats.module_of(name).read(self.path(path), formats.Options(quantities=requests))

            with self.subTest(name):
                found = read(text, pull=("OTM2", "force"))
                self.assertEqual((list(found.quantities), found.quantities["pull"].units), (["pull", "gauges"], ["N"] * 3))
                self.assertEqual(found.quantities["pull"].rows, ["pull", "bend", "share"])
                lacking = read(text.replace("$ row 3: share [-]\n", ""))
                self.assertEqual(lacking.quantities["loads"].rows, ["row_1", "row_2", "row_3"])
                self.assertIn("comments of the deck name 2 rows of OTM2, which has 3", " ".join(lacking.notes))
                for changed in (text.replace("$ OTM2: loads", "$ OTM2: my loads"), text.replace("[N m]", "[lb]"), text.replace(": bend", ": pull")):
                    self.assertNotIn("share", str(read(changed).quantities))
                bare = read("\n".join(line for line in text.splitlines() if not line.startswith("$")) + "\n")
                self.assertEqual(bare.quantities, {})
                self.assertIn("left out: the matrices OTM1, OTM2", " ".join(bare.notes))

    def test_units(self):
        """Tests that the same motion recovers the same stress, force and moment in every system of units."""
        body = self.body(turn=False)
        there = converted(body, SI, read_units("mm-t-s", "--to-units"))
        motion = np.random.default_rng(2).standard_normal(body.size)
        # The unit of an amplitude is such that its modal mass is that of the file; kilograms and metres become tonnes
        # and millimetres.
        scale = np.where((body.unknown_nodes >= 0) & (body.unknown_components < 3), 1e3, 1.0)
        np.testing.assert_allclose(there.shapes.stress @ (scale * motion), 1e-6 * body.shapes.stress @ motion)
        for row, factor in enumerate((1, 1e3, 1)):  # N, N mm, dimensionless
            np.testing.assert_allclose(there.quantities["loads"].matrix[row] @ (scale * motion), factor * body.quantities["loads"].matrix[row] @ motion)

    def test_body_axes(self):
        body = self.body()
        found = in_body_axes(body)
        # The solution is an arbitrary motion of the rotated body.
        back = np.linalg.solve(found.stiffness.toarray()[:12, :12] + np.eye(12), np.eye(12))
        motion = np.concatenate([back[:, 0], np.zeros(body.size - 12)])
        own = motion.copy()
        own[6:9], own[9:12] = body.axes[1].T @ motion[6:9], body.axes[1].T @ motion[9:12]
        np.testing.assert_allclose(found.shapes.stress @ motion, body.shapes.stress @ own)
        np.testing.assert_allclose(found.quantities["gauges"].matrix @ motion, body.quantities["gauges"].matrix @ own)

    def matrices(self, **more):
        random = np.random.default_rng(3)
        square = np.eye(12)
        return {"KAA": square, "MAA": square, **{name: random.standard_normal((rows, 12)) for name, rows in more.items()}}

    def read_op4(self, matrices, deck, **options):
        with open(self.path("a.op4"), "wb") as file:
            file.write(binary(matrices))
        return formats.module_of("op4").read(self.path("a.op4"), formats.Options(nodes=self.write("a.bdf", deck), **options))

    def test_matrices_of_extseout(self):
        given = self.matrices(MES1=4, MEF1=10, MQG1=6)
        found = self.read_op4({**given, "MEE1": np.zeros((1, 1))}, POINTS + TABLES)
        self.assertEqual(sorted(found.quantities), ["element_force", "element_stress", "support_force"])
        stress, force = found.quantities["element_stress"], found.quantities["element_force"]
        self.assertEqual((stress.rows, set(stress.units)), (["cbar_11_1", "cbar_11_2", "cbar_23_1", "cbar_23_2"], {"Pa"}))
        np.testing.assert_array_equal(stress.matrix, given["MES1"])
        self.assertEqual(force.rows[:8], [f"cbar_10_{item}" for item in ("bend_a1", "bend_a2", "bend_b1", "bend_b2", "shear1", "shear2", "axial", "torque")])
        self.assertEqual(force.units, ["N m"] * 4 + ["N"] * 3 + ["N m"] + [recovery.UNKNOWN] * 2)
        self.assertIn("the units of 2 rows of MEF1 are not known", " ".join(found.notes))
        self.assertEqual(found.quantities["support_force"].rows, [f"node_2_{name}" for name in ("x", "y", "z", "rx", "ry", "rz")])

    def test_requests(self):
        given = self.matrices(OTM=3, MES1=4)
        found = self.read_op4(given, POINTS + TABLES, quantities={"gauges": recovery.Request("otm", "strain"), "bars": recovery.Request("MES1", "stress")})
        self.assertEqual(sorted(found.quantities), ["bars", "gauges"])
        self.assertEqual((found.quantities["gauges"].rows, found.quantities["gauges"].units), (["row_1", "row_2", "row_3"], ["m/m"] * 3))

    def test_refusals(self):
        for text, told in (("gauges", "NAME=MATRIX:KIND is expected"), ("gauges=OTM", "NAME=MATRIX:KIND is expected"),
                           ("2nd=OTM:stress", "'2nd' is no name"), ("a=O:stress,a=P:stress", "two quantities 'a'"),
                           ("a=O:stres", "there is no kind 'stres'; did you mean 'stress'")):
            with self.subTest(text), self.assertRaises(InputError) as caught:
                recovery.read_requests(text)
            self.assertIn(told, str(caught.exception))
        for matrices, deck, options, told in (
                (self.matrices(OTM=3), POINTS, {"quantities": {"a": recovery.Request("OTN", "stress")}}, "there is no matrix 'OTN', which the quantity 'a'"),
                ({**self.matrices(), "OTM": np.ones((2, 11))}, POINTS, {"quantities": {"a": recovery.Request("OTM", "stress")}},
                 "OTM has 11 columns for 12 unknowns"),
                (self.matrices(MES1=3), POINTS + TABLES, {}, "DTI: expected rows of MES1, which has 3"),
                (self.matrices(MES1=4), POINTS + TABLES.replace("11      2       1", "11      3       1"), {}, "row 3 stands twice")):
            with self.subTest(told), self.assertRaises(InputError) as caught:
                self.read_op4(matrices, deck, **options)
            self.assertIn(told, str(caught.exception))

    def test_a_quantity_that_does_not_fit(self):
        body = self.body()
        for quantity, told in ((recovery.Quantity(["a"], ["Pa"], np.zeros((2, body.size))), "has 1 row, 1 unit and a matrix of 2 x 15"),
                               (recovery.Quantity(["a", "a"], ["Pa"] * 2, np.zeros((2, body.size))), "two rows 'a'"),
                               (recovery.Quantity(["a, b"], ["Pa"], np.zeros((1, body.size))), "is no name"),
                               (recovery.Quantity(["a"], ["MPa"], np.zeros((1, body.size))), "the unit 'MPa'; did you mean 'Pa'"),
                               (recovery.Quantity(["a"], ["Pa"], np.full((1, body.size), np.nan)), "not finite")):
            with self.subTest(told), self.assertRaises(InputError) as caught:
                dataclasses.replace(body, quantities={"x": quantity}).check()
            self.assertIn(told, str(caught.exception))
        body.shapes.stress_points = np.array([0, 7])
        with self.assertRaises(InputError):
            body.check()


class Cells(InFolder):
    def test_numbers_and_orders(self):
        """In a tetrahedron of ten nodes, gmsh exchanges the last two of VTK's."""
        numbers = np.array([30, 10, 20, 40, 50, 60, 70, 80, 90, 100, 5])
        cells = cells_between([("tetra10", [[10, 20, 30, 40, 50, 60, 70, 80, 90, 100], [10, 20, 30, 40, 50, 60, 70, 80, 90, 7]])], numbers)
        self.assertEqual(list(cells), [11])
        self.assertEqual(numbers[cells[11]].tolist(), [[10, 20, 30, 40, 50, 60, 70, 80, 100, 90]])

    def test_cards(self):
        self.write("a.bdf", "CQUAD4,1,1,1,2,3,4\nCTRIA6,2,1,1,2,3,5,6\nCQUAD4,3,1,1,2,3\nCBAR,4,1,1,2\n")
        blocks = dict(blocks_of_cards(read_cards(self.path("a.bdf"))))
        self.assertEqual({kind: block.tolist() for kind, block in blocks.items()}, {"quad": [[1, 2, 3, 4]], "triangle": [[1, 2, 3]]})

    def test_results_of_calculix(self):
        """A hexahedron of twenty nodes has CalculiX' order: edges of the base, upward edges, edges of the top."""
        first = "".join(f"{k:10d}" for k in range(1, 11))
        rest = "".join(f"{k:10d}" for k in range(11, 21))
        self.write("a.frd", f"    2C\n -3\n    3C                             1\n -1         1    4    0    1\n -2{first}\n -2{rest}\n -3\n")
        (kind, block), = blocks_of_results(self.path("a.frd"))
        self.assertEqual((kind, block.tolist()), ("hexahedron20", [[*range(1, 13), *range(17, 21), *range(13, 17)]]))


class Words(unittest.TestCase):
    def test_sentences(self):
        for text, keys, options in (
                ("--mass FILE names it", "`mass: FILE` names it", "`matrices: {.., mass: FILE}` of a body file names it"),
                ("--names stiffness=NAME names one", "`names: {stiffness: NAME}` names one", "`matrices: {.., names: {stiffness: NAME}}` of a body file names one"),
                ("name fewer nodes (--interfaces)", "name fewer nodes (`interfaces`)", "name fewer nodes (`interfaces`)")):
            self.assertEqual(in_words_of_keys(text, False), keys)
            self.assertEqual(in_words_of_keys(text, True), options)
        self.assertEqual(in_words_of_keys("--units mm-t-s: x", True), "--units mm-t-s: x")
        self.assertEqual(in_words_of_keys("--units mm-t-s: x", False), "`units: mm-t-s`: x")
        self.assertEqual(in_words_of_keys("--names 'a=b': MEMBER", False), "`names: {a: b}`: MEMBER")


if __name__ == "__main__":
    unittest.main()
