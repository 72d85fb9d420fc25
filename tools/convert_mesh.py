#!/usr/bin/python3
"""convert_mesh.py INPUT OUTPUT.msh: a mesh of solid cells of another program becomes gmsh's MSH 4.1.
convert_mesh.py --materials INPUT OUTPUT.json: its materials, in its own units, and the groups that have them.
convert_mesh.py --ties INPUT OUTPUT.json: its ties to one node (RBE2, RBE3, couplings) and its point masses, with the numbers
of their nodes in OUTPUT.msh.

Reads .inp (Abaqus, CalculiX), .bdf .nas (Nastran), .med (Salome), .vtu .vtk .mesh and all other formats of meshio;
keeps coordinates unchanged, and named sets as physical groups (node sets: the boundary faces whose nodes are all in the
set). bielle-reduce calls it by itself for such files; call it to see the result of the conversion.
"""

import json

from bielle_tools import messages

messages.require("numpy", "meshio")

from bielle_tools.decks import materials as deck_materials, ties as deck_ties, foreign_mesh  # noqa: E402
from bielle_tools.mesh import msh_file, solid_mesh  # noqa: E402


def write_json(option, source, target):
    """Writes the materials or the ties and point masses of a deck."""
    if option == "--materials":
        found = deck_materials.read_materials(source)
        contents = {"materials": found.materials, "regions": found.regions}
    else:
        found = deck_ties.read_ties(source)
        contents = {"ties": found.ties, "masses": found.masses}
    with open(target, "w", encoding="utf-8") as file:
        json.dump(contents, file, indent=1)
    for text in found.notes:
        messages.note(f"{source}: {text}")


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return
    if len(arguments) == 3 and arguments[0] in ("--materials", "--ties"):
        write_json(*arguments)
        return
    if len(arguments) != 2 or not arguments[1].endswith(".msh"):
        raise messages.InputError("two arguments are needed: INPUT OUTPUT.msh")
    source, target = arguments
    mesh = foreign_mesh.with_path(source, lambda: solid_mesh.solid_mesh(foreign_mesh.read_foreign(source)))
    msh_file.write_msh(mesh, target)
    for text in mesh.notes:
        messages.note(f"{source}: {text}")
    counts = ", ".join(f"{len(cells)} {kind}" for kind, cells in mesh.cells.items())
    print(f"{target}: {messages.counted(len(mesh.points), 'point')}, {counts}")
    for title, groups in (("surfaces", mesh.surfaces), ("volumes", mesh.volumes)):
        print(f"  {title}: " + (", ".join(sorted(groups)) or "none named"))


if __name__ == "__main__":
    messages.run("convert_mesh.py", main)
