"""Names of Nastran's matrices, and the part that each plays in a MatrixSet."""

from ..messages import InputError, did_you_mean

ROLES = {
    "stiffness": ("KAAX", "KAA", "KXX", "KGG", "K2GG", "K2PP", "KFF", "KLL"),
    "mass": ("MAAX", "MAA", "MXX", "MGG", "M2GG", "M2PP", "MFF", "MLL"),
    "damping": ("BAAX", "BAA", "BXX", "BXX1", "BGG", "B2GG", "B2PP"),
    "geometric_stiffness": ("KGGD", "KDGG", "KDAAX", "KDAA"),
    "shapes": ("MUG1",),
    "stress": ("MGS1",),
}
STRUCTURAL = ("K4AAX", "K4AA", "K4XX", "K4XX1", "K4GG")  # structural damping
NEEDED = ("stiffness", "mass")


def matrices_by_role(found, mass, options, path):
    """The matrices that play a part: {"stiffness": matrix, ...}.

    @param found: matrices of the file by name @param mass: those of the file of `--mass`; empty: none is given
    @raises InputError with the nearest name for one that is missing, and for one that is complex"""
    chosen = {}
    for role in ROLES:
        names, file = (mass, options.mass) if role == "mass" and mass else (found, path)
        name = _name_of(role, names, options, file)
        if name:
            chosen[role] = names[name]
            if chosen[role].complex:
                raise InputError(f"'{file}': the {_told(role)} {name} is complex; only real matrices describe a body (structural damping "
                                 "has to be left out)")
    return chosen


def _name_of(role, names, options, file):
    """Name of a matrix, the name that `--names` gives first; None: there is none, nor is it needed."""
    wanted = options.names.get(role, "").upper()
    if wanted and wanted not in names:
        raise InputError(f"'{file}': there is no matrix '{wanted}', which --names gives for the {_told(role)}{did_you_mean(wanted, list(names))}")
    name = wanted or next((name for name in ROLES[role] if name in names), None)
    if not name and role in NEEDED:
        elsewhere = ", --mass FILE another file" if role == "mass" else ""
        raise InputError(f"'{file}': there is no {role} matrix ({', '.join(ROLES[role])}){did_you_mean(ROLES[role][0], list(names))}; "
                         f"--names {role}=NAME names one{elsewhere}")
    return name


def left_out(found, chosen):
    """Notes on the matrices of a file that play no part. @param chosen: the others by role"""
    unused = [name for name, matrix in found.items() if matrix not in chosen.values()]
    structural = [name for name in unused if name in STRUCTURAL]
    others = [name for name in unused if name not in STRUCTURAL]
    return [f"left out: {told} {', '.join(names)}" for told, names in
            (("the structural damping", structural), ("the matrices" if len(others) > 1 else "the matrix", others)) if names]


def _told(role):
    return role.replace("_", " ")
