"""Tests of tools on meshes of all types of cells: shape functions and integrals, ParaView and pictures, decks for
CalculiX, formats of meshio."""

import os
import types
import unittest
import xml.etree.ElementTree as ElementTree

import h5py
import matplotlib.pyplot  # noqa: F401  (loaded once for all runs of the tools)
import numpy as np

import synthetic_results as synthetic
from box_mesh import REPOSITORY
from cell_decks import SIDE, VOLUME, Box
from gmsh_library import GmshFile
from python_tool import run_python_tool  # box_mesh sets the path
from test_convert_cells import MIXTURE, SHAPES, CellConverter, area, cell_set

from bielle_tools.bodies import calculix_file
from bielle_tools.mesh import cell_integrals
from bielle_tools.mesh.cells import BY_GMSH, CELLS, FLATS, SOLIDS, boundary_faces, permutation, solid_faces
from bielle_tools.mesh.meshio_library import meshio_library
from shares import share_of_tests as load_tests  # noqa: E402,F401

meshio = meshio_library()

# Corners, from 0, at the ends of the edges of VTK's mid-side nodes (vtkQuadraticHexahedron and its like).
VTK = {"tetra10": "01 12 20 03 13 23", "hexahedron20": "01 12 23 30 45 56 67 74 04 15 26 37", "wedge15": "01 12 20 34 45 53 03 14 25",
       "pyramid13": "01 12 23 30 04 14 24 34"}


def converted(case, kinds, order):
    """Returns the box as convert_mesh.py and gmsh read it."""
    return case.convert("box.inp", Box(kinds, order).abaqus())


class ShapeFunctions(unittest.TestCase):
    def test_functions_are_one_at_their_nodes_and_add_up_to_one(self):
        for kind, cell in CELLS.items():
            places = cell.reference * (1 - 1e-12)  # the functions of a pyramid are not defined at its apex
            N = np.array([cell_integrals.shape_functions(kind, x) for x in places])
            np.testing.assert_allclose(N, np.eye(cell.nodes), atol=1e-9, err_msg=kind)
            x = cell.reference.mean(axis=0) + 0.05
            self.assertAlmostEqual(cell_integrals.shape_functions(kind, x).sum(), 1, places=14)
            np.testing.assert_allclose(cell_integrals.shape_functions(kind, x) @ cell.reference, x, atol=1e-14)
            dN = cell_integrals.shape_gradients(kind, x)
            np.testing.assert_allclose(cell.reference.T @ dN, np.eye(cell.dimension), atol=1e-14)

    def test_second_order_contains_quadratic_functions(self):
        for kind in (kind for kind, cell in CELLS.items() if cell.order == 2):
            cell = CELLS[kind]
            x = cell.reference.mean(axis=0) + 0.07
            for a in range(cell.dimension):
                for b in range(cell.dimension):
                    found = cell_integrals.shape_functions(kind, x) @ (cell.reference[:, a] * cell.reference[:, b])
                    self.assertAlmostEqual(found, x[a] * x[b], places=13, msg=kind)

    def test_orders_are_those_of_meshio(self):
        from meshio.gmsh.common import _gmsh_to_meshio_order, _meshio_to_gmsh_order
        for kind, cell in CELLS.items():
            numbers = np.arange(cell.nodes)
            self.assertEqual(_meshio_to_gmsh_order(kind, numbers[None])[0].tolist(), permutation(kind, "vtk", "gmsh"))
            self.assertEqual(_gmsh_to_meshio_order(kind, numbers[None])[0].tolist(), permutation(kind, "gmsh", "vtk"))

    def test_volumes_masses_and_areas(self):
        for kind in SOLIDS:
            cell = CELLS[kind]
            turn = np.array([[1.0, 0.2, 0.1], [0.0, 1.3, 0.3], [0.1, 0.0, 0.8]])
            points, cells = cell.reference @ turn.T, {kind: np.arange(cell.nodes)[None]}
            wanted = {"tetra": 1 / 6, "hexahedron": 8, "wedge": 1, "pyramid": 4 / 3}[cell.shape] * np.linalg.det(turn)
            self.assertAlmostEqual(cell_integrals.volumes(points, cells)[kind][0], wanted, places=12)
            M = cell_integrals.scalar_mass(points, cells, {kind: np.array([3.0])})
            self.assertAlmostEqual(M.sum(), 3 * wanted, places=11)
            self.assertGreater(np.linalg.eigvalsh(M.toarray()).min(), 0)
            faces = boundary_faces(solid_faces(cells))
            ones = cell_integrals.surface_integrals(points, faces, lambda x: np.ones(len(x)))
            self.assertAlmostEqual(ones.sum(), area(points, faces), places=11)
        # The mass matrix of a cube of 8 nodes is rho V/216 times 8, 4, 2 or 1, depending on the number of different
        # coordinates.
        reference = CELLS["hexahedron"].reference
        apart = (reference[:, None] != reference[None]).sum(axis=2)
        M = cell_integrals.scalar_mass(reference, {"hexahedron": np.arange(8)[None]}, {"hexahedron": np.array([1.0])}).toarray()
        np.testing.assert_allclose(M, 8 * 8 / 216 * 0.5 ** apart, atol=1e-14)


class InPictures(CellConverter):
    def write_body(self, mesh):
        """Writes a superelement of the mesh that is stretched along x, as in synthetic_results."""
        numbers = {cell.name: str(number) for number, cell in BY_GMSH.items()}
        with h5py.File(self.path("box.h5"), "w") as file:
            file.attrs.update({"format": "bielle superelement", "version": 1, "name": "box", "complete": True})
            synthetic.put(file, "mesh/points", mesh.points, "m")
            for kind, cells in mesh.cells.items():
                synthetic.put(file, f"mesh/cells/{numbers[kind]}", cells, "")
            u = np.zeros((len(mesh.points), 3, 2))
            u[:, 0, 1] = mesh.points[:, 0]
            synthetic.put(file, "recovery/displacement", u.reshape(-1, 2), "m")
            sigma = np.zeros((len(mesh.points), 6, 2))
            sigma[:, 0, 1] = synthetic.YOUNG
            synthetic.put(file, "recovery/stress", sigma.reshape(-1, 2), "Pa")
        synthetic.write_results(self.path("run.h5"), "box.h5")

    def show(self, tool, *arguments):
        done = run_python_tool(os.path.join(REPOSITORY, "tools", tool), [self.path("run.h5"), *arguments],
                               environment={**os.environ, "DISPLAY": ""})
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_paraview_gets_vtk_order(self):
        from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

        for kinds in ((shape,) * 3 for shape in SHAPES):
            for order in (1, 2):
                self.write_body(converted(self, kinds, order))
                self.show("bielle-paraview", "--frames", "2", "--volume")
                mesh = meshio.read(self.path("run/rod_0000.vtu"))
                for block in mesh.cells:
                    for k, edge in enumerate(VTK.get(block.type, "").split()):
                        ends = block.data[:, [int(c) for c in edge]]
                        middle = block.data[:, CELLS[block.type].corners + k]
                        np.testing.assert_allclose(mesh.points[middle], mesh.points[ends].mean(axis=1), atol=1e-12)
                reader, sizes = vtkXMLUnstructuredGridReader(), vtkCellSizeFilter()
                reader.SetFileName(self.path("run/rod_0000.vtu"))
                sizes.SetInputConnection(reader.GetOutputPort())
                sizes.Update()
                volumes = sizes.GetOutput().GetCellData().GetArray("Volume")
                total = sum(abs(volumes.GetValue(k)) for k in range(volumes.GetNumberOfTuples()))
                self.assertAlmostEqual(total / VOLUME, 1, delta=1e-6, msg=f"{kinds} {order}")

    def test_surfaces_and_pictures_of_a_mixture(self):
        for order in (1, 2):
            self.write_body(converted(self, MIXTURE, order))
            self.show("bielle-paraview", "--frames", "2")
            mesh = meshio.read(self.path("run/rod_0000.vtu"))
            faces = {block.type: block.data for block in mesh.cells}
            self.assertEqual(set(faces), [{"triangle", "quad"}, {"triangle6", "quad8"}][order - 1])
            self.assertAlmostEqual(area(mesh.points, faces), 2 * (0.6 * 0.2 + 0.6 * 0.1 + SIDE), places=9)
            self.show("bielle-animate", "-o", self.path("run.png"), "--frames", "2")
            self.assertGreater(os.path.getsize(self.path("run.png")), 5000)


class OtherFormats(CellConverter):
    def test_meshes_of_meshio(self):
        """Tests VTK files of each type, and MED, which has other node orders."""
        for shape in SHAPES:
            for order in (1, 2):
                expected = converted(self, (shape,) * 3, order)
                cells = [(kind, block[:, permutation(kind, "gmsh", "vtk")]) for kind, block in expected.cells.items() if kind in SOLIDS]
                for name in ("box.vtu", "box.vtk", "box.med"):
                    meshio.Mesh(expected.points, cells).write(self.path(name))
                    done = self.run_tool(name)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    mesh = GmshFile(self.path("out.msh"))
                    self.check(mesh, 1e-9, VOLUME)
                    self.assertEqual(cell_set(mesh), cell_set(expected))


class CasesForCalculiX(CellConverter):
    def case(self, mesh):
        cells = {kind: block[:, permutation(kind, "gmsh", "vtk")] for kind, block in mesh.cells.items()}
        materials = types.SimpleNamespace(names=["steel"], young=[2e11], poisson=[0.3], densities=[7800.0],
                                          number={kind: np.zeros(len(block), int) for kind, block in cells.items()})
        return types.SimpleNamespace(element="rod", points=mesh.points, materials=materials, surfaces=[],
                                     body=types.SimpleNamespace(cells=cells))

    def test_the_mesh_of_a_case_is_the_one_of_the_body(self):
        for shape in ("tetra", "hexahedron", "wedge"):
            for order in (1, 2):
                mesh = converted(self, (shape,) * 3, order)
                calculix_file.write_case(self.path("case.inp"), self.case(mesh), [], "run.h5")
                with open(self.path("case.inp"), encoding="utf-8") as file:
                    text = file.read()
                self.assertLessEqual(max(line.count(",") for line in text.splitlines() if not line.startswith("*")), 16)
                found = self.convert("case.inp", text)
                self.assertEqual([each for each in cell_set(found) if each[0] in SOLIDS], cell_set(mesh))

    def test_cells_that_calculix_does_not_have(self):
        from bielle_tools.messages import InputError
        with self.assertRaisesRegex(InputError, "72 pyramids of 5 nodes, which CalculiX does not know"):
            calculix_file.write_case(self.path("case.inp"), self.case(converted(self, ("pyramid",) * 3, 1)), [], "run.h5")


class Table(unittest.TestCase):
    def test_faces_close_and_point_outwards(self):
        for kind in SOLIDS:
            cell = CELLS[kind]
            for flat, nodes in cell.faces:
                x = cell.reference[list(nodes)]
                self.assertIn(flat, FLATS)
                normal = np.cross(x[1] - x[0], x[2] - x[0])
                self.assertGreater(normal @ (x[0] - cell.reference.mean(axis=0)), 0)
                if len(nodes) > CELLS[flat].corners:  # places of the face's own reference cell
                    weights = CELLS[flat].reference
                    N = np.array([cell_integrals.shape_functions(CELLS[flat].shape, place) for place in weights])
                    np.testing.assert_allclose(N @ x[:CELLS[flat].corners], x, atol=1e-15)

    def test_mirrored_cells_have_their_nodes_in_the_middle(self):
        for kind, cell in CELLS.items():
            mirrored = cell.reference[list(cell.mirrored)]
            for k, edge in enumerate(cell.middles, cell.corners):
                np.testing.assert_allclose(mirrored[k], mirrored[list(edge)].mean(axis=0), err_msg=kind)


if __name__ == "__main__":
    unittest.main()
