"""Writes results of an analysis `eigen` with shapes in closed form."""

import h5py
import numpy as np

OMEGA, SIGMA = 30.0, -3.0


def write_whirl(path):
    """Writes two modes: a node that moves around the x axis and oscillates about it, with the decay SIGMA, and a rigid
    mode along z."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": "bielle results", "version": 1, "complete": True, "name": "whirl"})
        file["input"] = "mechanism: whirl\n"
        group = file.create_group("analysis_1/eigen")
        shape, turn = np.zeros((2, 2, 3, 2)), np.zeros((2, 2, 3, 2))
        shape[0, 1, 1, 0], shape[0, 1, 2, 1] = 1, -1  # (0, 1, -i)
        turn[0, 1, 0, 0] = 0.3
        shape[1, 1, 2, 0] = 1
        s = np.array([[SIGMA, OMEGA], [0, 0]])
        size = np.linalg.norm(s, axis=1)
        for name, values in (("eigenvalue", s), ("frequency", size / (2 * np.pi)), ("damping_ratio", [-SIGMA / size[0], 0]),
                             ("position", [[0.0, 0, 0], [2, 0, 0]]), ("orientation", [[1.0, 0, 0, 0]] * 2),
                             ("displacement", shape), ("rotation", turn), ("shapes", np.zeros((2, 1, 2)))):
            group[name] = np.asarray(values, float)
        text = h5py.string_dtype()
        for name, values in (("kind", ["oscillating", "rigid"]), ("nodes", ["ground", "hub"]), ("unknowns", ["displacement x of node 'hub'"])):
            group.create_dataset(name, data=values, dtype=text)
        file["eigen"] = h5py.SoftLink("/analysis_1/eigen")
