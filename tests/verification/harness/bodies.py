"""Solids that bielle-reduce meshes and reduces, in the folder of the problem's process."""

import os
import subprocess

import yaml

STEEL = {"young": 210e9, "poisson": 0.3, "density": 7800}


def box(length, width, height):
    """A gmsh geometry: a bar along x from the origin, its axis in the middle, with the faces `root` and `tip`."""
    return f"""SetFactory("OpenCASCADE");
Box(1) = {{0, {-width / 2}, {-height / 2}, {length}, {width}, {height}}};
Physical Volume("body") = {{1}};
e = {min(width, height) / 100};
Physical Surface("root") = Surface In BoundingBox {{-e, {-width}, {-height}, e, {width}, {height}}};
Physical Surface("tip") = Surface In BoundingBox {{{length} - e, {-width}, {-height}, {length} + e, {width}, {height}}};
"""


def cylinder(length, radius):
    """The same for a round bar."""
    return box(length, 2 * radius, 2 * radius).replace(
        f"Box(1) = {{0, {-radius}, {-radius}, {length}, {2 * radius}, {2 * radius}}};",
        f"Cylinder(1) = {{0, 0, 0, {length}, 0, 0, {radius}}};")


def grid(divisions):
    """Lines of a geometry of `box` that make it a grid of hexahedra, as many along x, y, z."""
    lines = ["Transfinite Curve {1:12} = 2;"]
    for axis, count in zip("xyz", divisions):
        lines.append(f"For k In {{1:12}}\n  b() = BoundingBox Curve {{k}};\n  If (b({'xyz'.index(axis) + 3}) - "
                     f"b({'xyz'.index(axis)}) > 1e-5)\n"
                     f"    Transfinite Curve {{k}} = {count + 1};\n  EndIf\nEndFor")
    return "\n".join(lines) + "\nTransfinite Surface {1:6};\nRecombine Surface {1:6};\nTransfinite Volume {1};\n"


def reduced(name, geometry, **keys):
    """Path of the superelement of a body, of STEEL unless `materials` has another `steel`.
    @param geometry  text for gmsh, with the volume `body` @param keys  of the body file
    @raises RuntimeError with the message of bielle-reduce"""
    with open(f"{name}.geo", "w", encoding="utf-8") as file:
        file.write(geometry)
    body = {"body": name, "geometry": f"{name}.geo", "materials": {"steel": STEEL}, "regions": {"body": "steel"},
            **keys}
    with open(f"{name}.yaml", "w", encoding="utf-8") as file:
        yaml.safe_dump(body, file, sort_keys=False)
    program = os.path.join(os.environ["BIELLE_BIN"], "bielle-reduce")
    run = subprocess.run([program, f"{name}.yaml", "-o", f"{name}.h5", "--threads", "1", "--quiet"],
                         capture_output=True, text=True, check=False)
    if run.returncode:
        raise RuntimeError(run.stderr.strip() or f"bielle-reduce ended with {run.returncode}")
    return os.path.abspath(f"{name}.h5")
