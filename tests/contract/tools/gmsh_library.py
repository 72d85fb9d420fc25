"""Reads a mesh file with gmsh's library through its C interface, as bielle-reduce does (Debian has no Python
module)."""

import ctypes
import ctypes.util
import functools
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t

import numpy as np

_NAMES = {2: "triangle", 3: "quad", 4: "tetra", 5: "hexahedron", 6: "wedge", 7: "pyramid", 9: "triangle6", 10: "quad9", 11: "tetra10",
          12: "hexahedron27", 16: "quad8", 17: "hexahedron20", 18: "wedge15", 19: "pyramid13"}


@functools.cache
def _library():
    """Finds the library by ldconfig, once."""
    return ctypes.CDLL(ctypes.util.find_library("gmsh"))


class GmshFile:
    """points (p,3); cells {type: (n,k) rows of points}; numbers {type: (n)} of gmsh's elements;
    groups {(dimension, name): {type: (m,k)}}; reference {type: (k,d)}: gmsh's
    own places of the nodes in its reference cell; volumes {type: (n)}: gmsh's integrals, of the sign of its determinants."""

    def __init__(self, path):
        self.library = _library()
        self._call("Initialize", 0, None, 1)
        try:
            self._call("OptionSetNumber", c_char_p(b"General.Terminal"), c_double(0))
            self._call("Open", c_char_p(path.encode()))
            self._read()
            self.reference, self.volumes = {}, {}
            for number, kind in _NAMES.items():
                if kind in self.cells:
                    self._ask_about(number, kind)
        finally:
            self._call("Finalize")

    def _call(self, name, *arguments):
        error = c_int()
        getattr(self.library, "gmsh" + name)(*arguments, byref(error))
        if error.value:
            raise RuntimeError(f"gmsh{name} failed with {error.value}")

    def _read(self):
        tags, coordinates, parametric = POINTER(c_size_t)(), POINTER(c_double)(), POINTER(c_double)()
        n, m, k = c_size_t(), c_size_t(), c_size_t()
        self._call("ModelMeshGetNodes", byref(tags), byref(n), byref(coordinates), byref(m), byref(parametric), byref(k),
                   c_int(-1), c_int(-1), c_int(0), c_int(0))
        labels = np.array(tags[:n.value])
        self.points = np.array(coordinates[:m.value]).reshape(-1, 3)
        self.rows = dict(zip(labels.tolist(), range(len(labels))))
        self.numbers = {}
        self.cells = self._elements(-1, -1)
        numbers = dict(self.numbers)
        self.groups = {}
        pairs, count = POINTER(c_int)(), c_size_t()
        self._call("ModelGetPhysicalGroups", byref(pairs), byref(count), c_int(-1))
        for dimension, tag in np.array(pairs[:count.value]).reshape(-1, 2).tolist():
            name = c_char_p()
            self._call("ModelGetPhysicalName", c_int(dimension), c_int(tag), byref(name))
            entities, number = POINTER(c_int)(), c_size_t()
            self._call("ModelGetEntitiesForPhysicalGroup", c_int(dimension), c_int(tag), byref(entities), byref(number))
            group = {}
            for entity in entities[:number.value]:
                for kind, cells in self._elements(dimension, entity).items():
                    group[kind] = np.concatenate([group[kind], cells]) if kind in group else cells
            self.groups[dimension, name.value.decode()] = group
        self.numbers = numbers

    def _elements(self, dimension, entity):
        types, n_types = POINTER(c_int)(), c_size_t()
        tags, n_tags, n_rows = POINTER(POINTER(c_size_t))(), POINTER(c_size_t)(), c_size_t()
        nodes, n_nodes, n_lists = POINTER(POINTER(c_size_t))(), POINTER(c_size_t)(), c_size_t()
        self._call("ModelMeshGetElements", byref(types), byref(n_types), byref(tags), byref(n_tags), byref(n_rows),
                   byref(nodes), byref(n_nodes), byref(n_lists), c_int(dimension), c_int(entity))
        cells = {}
        for index in range(n_types.value):
            kind = _NAMES[types[index]]
            labels = nodes[index][:n_nodes[index]]
            self.numbers[kind] = np.array(tags[index][:n_tags[index]])
            cells[kind] = np.array([self.rows[label] for label in labels]).reshape(n_tags[index], -1)
        return cells

    def _ask_about(self, number, kind):
        name, places = c_char_p(), POINTER(c_double)()
        dimension, order, nodes, primary, n = c_int(), c_int(), c_int(), c_int(), c_size_t()
        self._call("ModelMeshGetElementProperties", c_int(number), byref(name), byref(dimension), byref(order), byref(nodes),
                   byref(places), byref(n), byref(primary))
        self.reference[kind] = np.array(places[:n.value]).reshape(nodes.value, -1)
        if dimension.value < 3:
            return
        points, weights, n_points, n_weights = POINTER(c_double)(), POINTER(c_double)(), c_size_t(), c_size_t()
        self._call("ModelMeshGetIntegrationPoints", c_int(number), c_char_p(b"Gauss4"), byref(points), byref(n_points), byref(weights),
                   byref(n_weights))
        jacobians, determinants, x = POINTER(c_double)(), POINTER(c_double)(), POINTER(c_double)()
        n_j, n_d, n_x = c_size_t(), c_size_t(), c_size_t()
        self._call("ModelMeshGetJacobians", c_int(number), points, n_points, byref(jacobians), byref(n_j), byref(determinants), byref(n_d),
                   byref(x), byref(n_x), c_int(-1), c_size_t(0), c_size_t(1))
        weights = np.array(weights[:n_weights.value])
        determinants = np.array(determinants[:n_d.value]).reshape(-1, len(weights))
        self.least_determinant = min(getattr(self, "least_determinant", np.inf), determinants.min())
        self.volumes[kind] = determinants @ weights
