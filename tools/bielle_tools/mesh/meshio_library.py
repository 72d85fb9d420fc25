"""Imports meshio, which takes a quarter of a second, only where it is needed, and completes its table of types.

meshio 5.0 reads and writes wedges of 15 and pyramids of 13 nodes, but its class of a block of cells does not know them.
"""


def meshio_library():
    """@returns the module"""
    import meshio
    from meshio import _mesh

    table = getattr(_mesh, "topological_dimension", {})
    for kind in ("wedge15", "pyramid13"):
        table.setdefault(kind, 3)
    return meshio
