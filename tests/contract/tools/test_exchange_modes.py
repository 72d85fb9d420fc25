"""Compares bodies in a floating frame, MBDyn's modal joint and Exudyn's reduced body, with a second reader and with
sums over points."""

import re
import unittest

import h5py
import numpy as np

from exchange_bodies import Exchange, cloud_body, rigid_of, turned
from bielle_tools.exchange import formats
from bielle_tools.exchange.free_modes import free_modes, moments, rigid_moments
from bielle_tools.exchange.inertia_moments import components_of, moments_of, moments_of_points
from bielle_tools.exchange.matrix_set import sparse
from bielle_tools.messages import InputError


def wedge(x):
    """Returns x~ with x~ y = x cross y."""
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def mbdyn_records(path):
    """Returns the numbers after each `** RECORD GROUP n`. It reads line by line, as MBDyn does."""
    with open(path, encoding="utf-8") as file:
        parts = re.split(r"^\*\* RECORD GROUP (\d+).*$", file.read(), flags=re.MULTILINE)[1:]
    records = {}
    for group, text in zip(parts[::2], parts[1::2]):
        words = " ".join(line for line in text.splitlines() if not line.startswith("**")).split()
        records[int(group)] = words if group in ("1", "2") else np.array([float(word) for word in words])
    return records


class Modes(Exchange):
    def relation(self, body, found):
        """Returns L with y = L x, and asserts that the motions of all points and nodes are those of the body."""
        def motions(matrices):
            at = np.zeros((len(body.numbers), 3, matrices.size))
            for row, (node, component) in enumerate(zip(matrices.unknown_nodes, matrices.unknown_components)):
                if node >= 0 and component < 3:
                    at[node, component, row] = 1
            return at

        old = np.concatenate([motions(body).reshape(-1, body.size), body.shapes.displacement])
        order = [np.flatnonzero((np.abs(found.shapes.points - x) < 1e-12).all(axis=1))[0] for x in body.shapes.points]
        inner = found.shapes.displacement.reshape(-1, 3, found.size)[order]
        new = np.concatenate([motions(found).reshape(-1, found.size), inner.reshape(-1, found.size)])
        L = np.linalg.lstsq(new, old, rcond=None)[0]
        np.testing.assert_allclose(new @ L, old, rtol=0, atol=1e-10 * np.abs(old).max())
        return L

    def check_same_body(self, body, found, damping=True):
        """Asserts that the energies of all motions, and S_kl, are those of the body."""
        L = self.relation(body, found)
        pairs = [(getattr(found, name).toarray(), getattr(body, name).toarray()) for name in ("stiffness", "mass", "damping")[:2 + damping]]
        pairs += zip(found.inertia_components, body.inertia_components)
        for new, old in pairs:
            np.testing.assert_allclose(L.T @ new @ L, old, rtol=0, atol=1e-10 * np.abs(old).max())
        for name in ("mass", "centre", "inertia"):
            np.testing.assert_allclose(getattr(found.mass_properties, name), getattr(body.mass_properties, name), rtol=1e-11, atol=1e-11)


class Inertia(unittest.TestCase):
    def test_moments_of_components_are_sums_over_points(self):
        body = cloud_body()
        free = free_modes(body)
        shapes, masses, points = body.shapes.displacement.reshape(-1, 3, body.size) @ free.modes, body.shapes.masses, body.shapes.points
        found = moments_of(body.inertia_components, free.rigid, free.modes)
        product = sum(m * np.einsum("aj,l->jal", phi, x) for m, phi, x in zip(masses, shapes, points))
        square = sum(m * np.einsum("kj,li->klji", phi, phi) for m, phi in zip(masses, shapes))
        second = sum(m * np.outer(x, x) for m, x in zip(masses, points))
        for got, expected in ((found.mass, masses.sum()), (found.first, masses @ points), (found.second, second), (found.product, product),
                              (found.linear, np.einsum("p,paj->ja", masses, shapes)), (found.square, square)):
            # Shapes are mass-normalised, and masses are about 1; the linear moments of free modes are zero.
            np.testing.assert_allclose(got, expected, rtol=0, atol=1e-11 * max(1, np.abs(expected).max()))
        same = moments_of_points(points, masses, shapes)
        np.testing.assert_allclose(same.square, square, atol=1e-12)
        # The conversion back gives S_kl of rigid motions and modes.
        basis = np.concatenate([free.rigid, free.modes], axis=1)
        for got, expected in zip(components_of(found), body.inertia_components):
            np.testing.assert_allclose(got, basis.T @ expected @ basis, rtol=0, atol=1e-11 * np.abs(got).max())

    def test_mass_properties_of_the_matrix_alone(self):
        body = cloud_body()
        given, body.mass_properties = body.mass_properties, None
        found = rigid_moments(free_modes(body))
        np.testing.assert_allclose(found.mass, given.mass, rtol=1e-12)
        np.testing.assert_allclose(found.centre, given.centre, atol=1e-12)

    def test_a_displacement_field_needs_no_components(self):
        """Returns full matrices whose masses are equal in all directions."""
        body = cloud_body(nodes=4, scalars=0, components=3)
        random = np.random.default_rng(5)
        half = random.normal(size=(4, 4))
        body.mass = sparse(np.kron(half @ half.T + np.eye(4), np.eye(3)))
        body.inertia_components = body.mass_properties = body.shapes = None
        free = free_modes(body)
        found, scalar = moments(free), half @ half.T + np.eye(4)
        np.testing.assert_allclose(found.second, body.positions.T @ scalar @ body.positions, atol=1e-11)
        np.testing.assert_allclose(found.first, scalar.sum(axis=0) @ body.positions, atol=1e-12)
        body.mass = sparse(body.mass.toarray() + np.diag(np.arange(12)))
        self.assertIsNone(moments(free_modes(body)))

    def test_a_held_body_is_refused(self):
        body = cloud_body()
        body.stiffness = sparse(body.stiffness.toarray() + np.eye(body.size) * 1e4)
        with self.assertRaisesRegex(InputError, "a rigid motion of the body has forces of"):
            free_modes(body)


class Mbdyn(Modes):
    def test_round_trip(self):
        body = cloud_body()
        found = self.read_back("mbdyn", body, self.path("a.fem"), interfaces=[3, 10])
        np.testing.assert_array_equal(found.numbers, body.numbers)
        self.check_same_body(body, found)
        self.assertEqual(formats.format_of(self.path("a.fem")), "mbdyn")

    def test_the_manual(self):
        """Compares every group with its definition as a sum over the points of the body."""
        body = cloud_body(nodes=2, scalars=2)
        formats.module_of("mbdyn").write(body, self.path("a.fem"), self.options())
        records = mbdyn_records(self.path("a.fem"))
        nodes, modes, *rest = (int(word) for word in records[1][1:])
        self.assertEqual((nodes, modes, rest), (14, 8, [0, 0, 0]))
        x = np.column_stack([records[group] for group in (5, 6, 7)])
        np.testing.assert_array_equal(x, np.concatenate([body.positions, body.shapes.points]))
        phi = records[8].reshape(modes, nodes, 6)
        np.testing.assert_array_equal(phi[:, 2:, 3:], 0)
        masses = np.concatenate([[0, 0], body.shapes.masses])
        M = np.einsum("p,jpa,kpa->jk", masses, phi[..., :3], phi[..., :3])
        np.testing.assert_allclose(records[9].reshape(modes, modes), M, rtol=0, atol=1e-11)
        self.assertLess(np.abs(M - np.eye(modes)).max(), 1e-11)
        # Free modes have neither momentum nor angular momentum, which are invariants 3 and 4.
        np.testing.assert_allclose(records[14].reshape(3, modes), np.einsum("p,jpa->aj", masses, phi[..., :3]), atol=1e-10)
        np.testing.assert_allclose(records[15].reshape(3, modes), np.einsum("p,jpa->aj", masses, np.cross(x, phi[..., :3])), atol=1e-10)
        self.assertLess(max(np.abs(records[14]).max(), np.abs(records[15]).max()), 1e-10)
        eighth, ninth, fifth = np.zeros((modes, 3, 3)), np.zeros((modes, modes, 3, 3)), np.zeros((modes, modes, 3))
        for m, place, shape in zip(masses, x, phi[..., :3].transpose(1, 0, 2)):
            for j in range(modes):
                eighth[j] -= m * wedge(place) @ wedge(shape[j])
                for k in range(modes):
                    ninth[j, k] += m * wedge(shape[j]) @ wedge(shape[k])
                    fifth[j, k] += m * np.cross(shape[j], shape[k])
        np.testing.assert_allclose(records[16].reshape(3, modes, 3), eighth.transpose(1, 0, 2), atol=1e-11)
        np.testing.assert_allclose(records[17].reshape(3, modes, modes), fifth.transpose(2, 0, 1), atol=1e-11)
        np.testing.assert_allclose(records[18].reshape(3, modes, modes, 3), ninth.transpose(2, 0, 1, 3), atol=1e-11)
        mass, centre, inertia = records[12][0], records[12][1:4], records[12][4:].reshape(3, 3)
        np.testing.assert_allclose([mass, *centre, *inertia.ravel()],
                                   [body.mass_properties.mass, *body.mass_properties.centre, *body.mass_properties.inertia.ravel()], atol=1e-12)

    def test_lumped_masses(self):
        """Tests a file with group 11 in place of the inertia: masses at nodes, including that of an interface, with
        rotary inertia."""
        body = cloud_body(nodes=1, scalars=6, damping=False)
        formats.module_of("mbdyn").write(body, self.path("a.fem"), self.options())
        with open(self.path("a.fem"), encoding="utf-8") as file:
            text = file.read()
        before, _, _ = text.partition("**\n** RECORD GROUP 12")
        table = "\n".join(f"{m:.17g} {m:.17g} {m:.17g} 0 0 0" for m in [0, *body.shapes.masses])
        path = self.write("b.fem", f"{before}**\n** RECORD GROUP 11, DIAGONAL OF LUMPED MASS MATRIX\n{table}\n")
        found = self.read("mbdyn", path, interfaces=[3])
        self.assertIsNone(found.inertia_components)
        L = self.relation(body, found)
        np.testing.assert_allclose(L.T @ found.mass.toarray() @ L, body.mass.toarray(), rtol=0, atol=1e-10 * np.abs(body.mass).max())
        # The masses of the points, including those of the interface, give the mass matrix again.
        by_axis = found.shapes.displacement.reshape(-1, 3, found.size)
        again = np.einsum("p,pai,paj->ij", found.shapes.masses, by_axis, by_axis)
        np.testing.assert_allclose(again, found.mass.toarray(), rtol=0, atol=1e-10 * np.abs(again).max())

    def test_without_invariants(self):
        body = cloud_body()
        body.inertia_components, body.shapes.masses = None, None
        found = self.read_back("mbdyn", body, self.path("a.fem"), interfaces=[3, 10])
        self.assertIn("the file tells no coupling of the shapes with rigid motions", found.notes[0])
        L = self.relation(body, found)
        np.testing.assert_allclose(L.T @ found.mass.toarray() @ L, body.mass.toarray(), rtol=0, atol=1e-10 * np.abs(body.mass).max())

    def test_refusals(self):
        formats.module_of("mbdyn").write(cloud_body(), self.path("a.fem"), self.options())
        with open(self.path("a.fem"), encoding="utf-8") as file:
            text = file.read()
        end = text.index("** RECORD GROUP 10")
        for changed, told in ((text[:end], "RECORD GROUP 10 is missing"), (text[:-60], "RECORD GROUP 18 has"), ("", "RECORD GROUP 1 is missing"),
                              (text.replace("GROUP 5", "GROUP 55"), "there is no RECORD GROUP 55"), (text.replace("GROUP 5", "GROUP 6"), "a second RECORD GROUP 6"),
                              (text.replace("REV0 14 9", "REV0 14 9.5"), "expected a revision and five counts"), (text.replace("REV0 14", "REV0 999999999"), "RECORD GROUP 2 has 14"),
                              (text.replace("3 10 11", "3 3 11"), "names a node twice"), (text.replace("e+00", "x+00", 1), "expected a number")):
            with self.subTest(told):
                self.refuse("mbdyn", self.write("b.fem", changed), told, interfaces=[3, 10])
        self.refuse("mbdyn", self.path("a.fem"), "14 nodes are more than 9 shapes can move: name those")
        self.refuse("mbdyn", self.path("a.fem"), "do not follow from 6 rigid motions and 9 shapes", interfaces=[3, 10, 11])
        self.refuse("mbdyn", self.path("a.fem"), "there is no node 99", interfaces=[99])
        named = self.read("mbdyn", self.write("c.fem", text.replace("\n3 10 11", "\nhub tip 11")), interfaces=[1, 2])
        self.assertIn("nodes have names that are no numbers", named.notes[0])
        crlf = self.read("mbdyn", self.write("d.fem", text.replace("\n", "\r\n").replace("e+00", "D+00")), interfaces=[3, 10])
        self.same(crlf, self.read("mbdyn", self.path("a.fem"), interfaces=[3, 10]))


class Exudyn(Modes):
    def test_round_trip(self):
        body = cloud_body(nodes=2, scalars=6, damping=False)
        found = self.read_back("exudyn", body, self.path("a.npz"), interfaces=[1, 2, 3])
        self.assertEqual(formats.format_of(self.path("a.npz")), "exudyn")
        np.testing.assert_array_equal(found.positions, body.shapes.points[:3])
        free = found.shapes.displacement.reshape(-1, 3, found.size)
        at = np.zeros((3, 3, found.size))
        at[found.unknown_nodes[found.unknown_nodes >= 0], found.unknown_components[found.unknown_nodes >= 0],
           np.flatnonzero(found.unknown_nodes >= 0)] = 1
        new = np.concatenate([at, free]).reshape(-1, found.size)
        L = np.linalg.lstsq(new, body.shapes.displacement, rcond=None)[0]
        np.testing.assert_allclose(new @ L, body.shapes.displacement, atol=1e-10)
        for got, old in [(found.stiffness.toarray(), body.stiffness.toarray()), (found.mass.toarray(), body.mass.toarray()),
                         *zip(found.inertia_components, body.inertia_components)]:
            np.testing.assert_allclose(L.T @ got @ L, old, rtol=0, atol=1e-10 * np.abs(old).max())

    def test_hdf5_with_stress(self):
        """Tests the same body in HDF5, as SaveDictToHDF5 writes it, with stress modes (p,6m)."""
        body = cloud_body(nodes=2, scalars=6, damping=False)
        random = np.random.default_rng(6)
        rigid = np.concatenate([rigid_of(body.positions), np.zeros((body.scalars, 6))])
        elastic = np.eye(body.size) - rigid @ np.linalg.pinv(rigid)
        body.shapes.stress, body.shapes.stress_points = random.normal(size=(72, body.size)) @ elastic, np.arange(12)
        found = self.read_back("exudyn", body, self.path("a.hdf5"), interfaces=[1, 2, 3])
        plain = self.read_back("exudyn", body, self.path("a.npz"), interfaces=[1, 2, 3])
        self.same(found, plain, damping=False)
        self.assertEqual(list(found.shapes.stress_points), list(range(9)))
        np.testing.assert_array_equal(plain.shapes.stress, found.shapes.stress)
        self.assertEqual(list(plain.shapes.stress_points), list(range(9)))
        with h5py.File(self.path("a.hdf5")) as file:
            kinds = {name: member.attrs["datatype"] for name, member in file.items()}
            stress, modes = file["postProcessingModes/matrix"][()], file["modeBasis"][()].reshape(12, 3, -1)
        self.assertEqual((kinds["type"], kinds["modeBasis"], kinds["totalMass"], kinds["postProcessingModes"]), ("str", "ndarray", "float", "dict"))
        # A mode of the file, in the unknowns that were read, has the stress of the file at the remaining points.
        for k in range(modes.shape[2]):
            target = np.concatenate([modes[:3, :, k].ravel(), modes[3:, :, k].ravel()])
            at = np.zeros((9, found.size))
            for row, (node, component) in enumerate(zip(found.unknown_nodes, found.unknown_components)):
                if node >= 0:
                    at[3 * node + component, row] = 1
            y = np.linalg.lstsq(np.concatenate([at, found.shapes.displacement]), target, rcond=None)[0]
            np.testing.assert_allclose(found.shapes.stress @ y, stress.reshape(12, -1, 6)[3:, k].ravel(), atol=1e-8 * np.abs(stress).max())
        with h5py.File(self.path("a.hdf5"), "a") as file:
            del file["postProcessingModes/outputVariableType"]
            file["postProcessingModes/outputVariableType"] = 1 << 28  # strain
        self.assertIsNone(self.read("exudyn", self.path("a.hdf5"), interfaces=[1, 2, 3]).shapes.stress)
        with open(self.path("a.hdf5"), "r+b") as file:
            file.truncate(3000)
        self.refuse("exudyn", self.path("a.hdf5"), "is no readable HDF5 file", interfaces=[1, 2, 3])

    def test_the_definitions(self):
        """Returns every key by the products of Exudyn's FEM.py, with the matrix of point masses."""
        body = turned_shapes(cloud_body(damping=False))
        formats.module_of("exudyn").write(body, self.path("a.npz"), self.options())
        with np.load(self.path("a.npz"), allow_pickle=False) as file:
            keys = {name: file[name] for name in file.files if name != "postProcessingModes"}
        psi, x = keys["modeBasis"], keys["xRef"]
        M = np.diag(np.repeat(body.shapes.masses, 3))
        Phit = np.tile(np.eye(3), (len(x) // 3, 1))
        tilde = np.concatenate([wedge(place) for place in x.reshape(-1, 3)])
        Psitilde = np.concatenate([np.concatenate([wedge(at) for at in row.T], axis=1) for row in psi.reshape(-1, 3, psi.shape[1])])
        expected = {"massMatrixReduced": psi.T @ M @ psi, "inertiaLocal": tilde.T @ M @ tilde, "Mtt": Phit.T @ M @ Phit,
                    "totalMass": body.shapes.masses.sum(), "chiU": Phit.T @ M @ x / body.shapes.masses.sum(),
                    "mPsiTildePsi": Psitilde.T @ M @ psi, "mPsiTildePsiTilde": Psitilde.T @ M @ Psitilde, "mPhitTPsi": Phit.T @ M @ psi,
                    "mPhitTPsiTilde": Phit.T @ M @ Psitilde, "mXRefTildePsi": tilde.T @ M @ psi, "mXRefTildePsiTilde": tilde.T @ M @ Psitilde}
        expected["chiUtilde"] = wedge(expected["chiU"])
        for name, value in expected.items():
            np.testing.assert_allclose(keys[name], value, rtol=0, atol=1e-11 * max(1, np.abs(value).max()), err_msg=name)
        modes = psi.shape[1]
        np.testing.assert_array_equal(keys["infoList"], [modes, len(x) // 3, 3, 4, 7, 7 + modes])
        known = set(expected) | {"modeBasis", "trigList", "stiffnessMatrixReduced", "infoList", "rigidBodyNodeType", "xRef", "fileVersion", "type"}
        self.assertEqual(set(keys), known)

    def test_refusals(self):
        formats.module_of("exudyn").write(cloud_body(damping=False), self.path("a.npz"), self.options())
        with np.load(self.path("a.npz"), allow_pickle=False) as file:
            keys = {name: file[name] for name in file.files if name != "postProcessingModes"}
        for changed, told in (({"xRef": np.ones(5)}, "'xRef' has the shape (5,), expected (36,)"), ({"chiU": None}, "the array 'chiU' of Exudyn's"),
                              ({"Mtt": np.zeros((3, 3))}, "the mass is 0"), ({"mPhitTPsi": np.full((3, 9), np.nan)}, "with finite numbers")):
            np.savez(self.path("b.npz"), **{name: value for name, value in (keys | changed).items() if value is not None})
            with self.subTest(told):
                self.refuse("exudyn", self.path("b.npz"), told, interfaces=[1])
        np.savez(self.path("c.npz"), massMatrix=1, massMatrixReduced=1)
        self.refuse("exudyn", self.path("c.npz"), "holds Exudyn's FEMinterface")
        body = cloud_body(damping=False)
        body.inertia_components, body.shapes.masses = None, None
        with self.assertRaisesRegex(InputError, "the inertia inside the body is not known"):
            formats.module_of("exudyn").write(body, self.path("d.npz"), self.options())


def turned_shapes(body):
    """Returns the body with nodes in their own axes, and shapes and S_kl in their unknowns."""
    result = turned(cloud_body())
    T = np.zeros((body.size, body.size))
    for column, unit in enumerate(np.eye(body.size)):
        T[:, column] = unit
        node, component = body.unknown_nodes[column], body.unknown_components[column]
        if node >= 0:
            T[:, column] = 0
            rows = np.flatnonzero((body.unknown_nodes == node) & (body.unknown_components // 3 == component // 3))
            T[rows, column] = result.axes[node][:, component % 3]
    result.damping = None
    result.shapes = type(body.shapes)(body.shapes.numbers, body.shapes.points, body.shapes.displacement @ T, None, body.shapes.masses)
    result.inertia_components = np.array([T.T @ each @ T for each in body.inertia_components])
    return result


if __name__ == "__main__":
    unittest.main()
