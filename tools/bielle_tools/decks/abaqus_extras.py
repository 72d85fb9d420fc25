"""Functions that report the contents of an Abaqus or CalculiX file besides its mesh.

A superelement takes its materials and interfaces from the body file. No part of the input is ignored without a message:
materials are reported as lines of a body file, masses and orientations as left out. (abaqus_ties reports couplings.)
"""

from dataclasses import dataclass

from ..messages import InputError, counted
from .abaqus_lines import number

# Keywords of constraints and of stiffness or mass, with their names in messages.
TOLD = {
    "EQUATION": "the nodes stay apart",
    "EMBEDDED ELEMENT": "the elements stay apart",
    "SHELL TO SOLID COUPLING": "the surfaces stay apart", "CONTACT PAIR": "the surfaces stay apart", "PRE-TENSION SECTION": "there is no tension",
    "MASS": "`masses: from_file` puts it on the body", "ROTARY INERTIA": "`masses: from_file` puts it on the body",
    "NONSTRUCTURAL MASS": "raise the density", "SPRING": "give the mechanism a spring there", "DASHPOT": "give the mechanism a damper there",
    "SHELL SECTION": "shells are surfaces without stiffness here", "MEMBRANE SECTION": "membranes are surfaces without stiffness here",
    "BEAM SECTION": "beams are left out", "ORIENTATION": "materials have no directions here: only isotropic ones are right",
    "TRANSFORM": "results have the axes of the mesh", "INITIAL CONDITIONS": "the body is free of stress", "DISTRIBUTION": "nothing varies",
}
MATERIAL = ("ELASTIC", "DENSITY", "PLASTIC", "HYPERELASTIC", "EXPANSION", "DAMPING", "USER MATERIAL")


@dataclass
class Section:
    set: str
    material: str
    oriented: bool
    turned: bool = False  # whether its instance has been turned


class Extras:
    def __init__(self):
        self.told = {}       # keyword -> count
        self.materials = {}  # name -> lines of properties
        self.sections = []   # Section
        self.material = None

    def keyword(self, keyword, options, rows):
        if keyword == "MATERIAL":
            self.material = options.get("NAME", "?")
            self.materials.setdefault(self.material, {})
        elif keyword in MATERIAL and self.material is not None:
            self.materials[self.material][keyword] = (options, rows)
        elif keyword == "SOLID SECTION":
            self.sections.append(Section(options.get("ELSET", "?"), options.get("MATERIAL", "?"), "ORIENTATION" in options))
        elif keyword in TOLD:
            self.told[keyword] = self.told.get(keyword, 0) + 1

    def join(self, other, renamed, turned):
        """Adds the contents of a part. @param renamed: the name in the body of a set; turned: whether the part has been turned"""
        for keyword, count in other.told.items():
            self.told[keyword] = self.told.get(keyword, 0) + count
        self.materials.update(other.materials)
        self.sections += [Section(renamed(each.set), each.material, each.oriented, each.turned or turned) for each in other.sections]

    def notes(self):
        notes = [f"left out: {counted(count, '*' + keyword, '*' + keyword)}: {TOLD[keyword]}" for keyword, count in self.told.items()]
        users = {}
        for section in self.sections:
            users.setdefault(section.material.upper(), []).append(section.set + (" (with an orientation, which is left out)" if section.oriented else ""))
        for name, properties in self.materials.items():
            regions = ", ".join(users.get(name.upper(), [])) or "no section"
            notes.append(f"material '{name}' of {regions} is, in the file's units (the body file wants SI, or `materials: from_file`), {name.lower()}: {_properties(properties)}")
        if len(users) > 1:
            notes.append("several materials: name them for their regions in the body file: "
                         + ", ".join(f"{section.set}: {section.material.lower()}" for section in self.sections))
        return notes


def _properties(properties):
    values, rest = [], []
    for keyword, (options, rows) in properties.items():
        numbers = [word.strip() for row in rows for word in row.split(",") if word.strip()]
        kind = options.get("TYPE", "ISOTROPIC").upper()
        if keyword == "ELASTIC" and kind in ("ISOTROPIC", "ISO"):
            values += [f"{key}: {_number(word)}" for key, word in zip(("young", "poisson"), numbers)]
        elif keyword == "DENSITY" and numbers:
            values.append(f"density: {_number(numbers[0])}")
        else:
            rest.append(f"*{keyword}" + (f", TYPE={kind}" if "TYPE" in options else ""))
    return "{" + ", ".join(values) + "}" + (f"; not in this line: {', '.join(rest)}" if rest else "")


def _number(word):
    try:
        return f"{number(word):g}"
    except ValueError:
        raise InputError(f"a material has '{word}' where a number belongs") from None
