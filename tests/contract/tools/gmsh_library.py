"""Reads a mesh file with gmsh's own library, as bielle-reduce does, through its C interface (Debian has no module)."""

import ctypes
import ctypes.util
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t

import numpy as np

_NAMES = {2: "triangle", 4: "tetra", 9: "triangle6", 11: "tetra10"}


class GmshFile:
    """points (p,3); cells {type: (n,k) rows of points}; groups {(dimension, name): {type: (m,k)}}."""

    def __init__(self, path):
        self.library = ctypes.CDLL(ctypes.util.find_library("gmsh"))
        self._call("Initialize", 0, None, 1)
        try:
            self._call("OptionSetNumber", c_char_p(b"General.Terminal"), c_double(0))
            self._call("Open", c_char_p(path.encode()))
            self._read()
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
        self.cells = self._elements(-1, -1)
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
            cells[kind] = np.array([self.rows[label] for label in labels]).reshape(n_tags[index], -1)
        return cells
