"""A deep and a shallow arch under a load at the crown."""

import bielle
from harness import Problem, Quantity, Study, row

DEEP = """
parameters: {{half: 215*pi/360}}
nodes:
  left: {{position: [-100*sin(half), 100*cos(half), 0], fixed: true}}
  load: {{position: [0, 100, 0]}}
  right: {{position: [100*sin(half), 100*cos(half), 0], fixed: [x, y, z, rx, ry]}}
elements:
  a: {{type: beam, nodes: [left, load], arc_centre: [0, 0, 0], elements: {0}, orientation: [0, 1, 0], section: {1}}}
  b: {{type: beam, nodes: [load, right], arc_centre: [0, 0, 0], elements: {0}, orientation: [0, 1, 0], section: {1}}}
loads: {{p: {{node: load, force: [0, -100, 0]}}}}
"""
SHALLOW = """
nodes:
  left: {{position: [-50, 0, 0], fixed: [x, y, z, rx, ry]}}
  load: {{position: [0, 5, 0]}}
  right: {{position: [50, 0, 0], fixed: [x, y, z, rx, ry]}}
elements:
  a: {{type: beam, nodes: [left, load], arc_through: ['-252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0], elements: {0},
       orientation: [0, 1, 0], section: {1}}}
  b: {{type: beam, nodes: [load, right], arc_through: ['252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0], elements: {0},
       orientation: [0, 1, 0], section: {1}}}
loads: {{p: {{node: load, force: [0, -80, 0]}}}}
"""
DEEP_SECTION = "{EA: 1e8, GAy: 5e7, GAz: 5e7, GJ: 1e6, EIy: 1e6, EIz: 1e6}"
# It is stiff out of the plane, where it would buckle first.
SHALLOW_SECTION = "{EA: 1e6, GAy: 1e6*5/6/2.6, GAz: 1e6*5/6/2.6, GJ: 1e8, EIy: 1e8, EIz: 1e6/12}"
SHOOTING = "Reissner's rod by shooting (tests/references/frames_and_arches.py)"


def deep(elements):
    session = bielle.read(DEEP.format(elements, DEEP_SECTION)).session()
    results = session.statics(arc_length={"until": {"node": "load", "displacement": -120, "direction": "y"}})
    limits = results.numbers["limit_points"]
    return {"limit": 100 * limits[0] if limits else float("nan")}


def shallow(elements):
    session = bielle.read(SHALLOW.format(elements, SHALLOW_SECTION)).session()
    critical = session.statics(steps=24).numbers["critical_points"]
    return {"sideways": 80 * critical[0] if critical else float("nan")}


PROBLEM = Problem(
    title="Deep and shallow arch",
    subject="Beams at rest",
    source="D. DaDeppo, R. Schmidt, Instability of clamped-hinged circular arches subjected to a point load, J. Appl. "
           "Mech. 42 (1975) 923: 8.97 EI/R^2",
    model="A circular arch of 215 degrees, R = 100, EI = 1e6, EA = 1e8, GA = 5e7, one end clamped, one hinged, dead "
          "load at the crown, followed by arc length past its "
          "limit load. A hinged shallow arch of span 100 and rise 5, E = 1e6, A = 1, I = 1/12, nu = 0.3, shear factor "
          "5/6, which leaves its symmetric path to the side before it snaps through. "
          "Curved beams.",
    studies=[
        Study("Limit load of the deep arch", deep, [20, 40, 80], [
            Quantity("limit", "limit load", "load", **row("frames_and_arches", "deep.first.P"), source=SHOOTING,
                     tolerance=1e-5, relative=True, order=4, order_within=0.25,
                     order_reason="plane bending governs, whose error of second order the residual flexibility of the "
                                  "elements removes; that of stretch and shear is 1e-8",
                     reason="curvature up to 0.06 in elements of 2.3: (0.14)^2/48 = 4e-4 would be of second order, "
                            "its square 2e-7 of fourth"),
        ], parameter="elements of each half", by="elements"),
        Study("Bifurcation of the shallow arch", shallow, [32, 64, 128], [
            Quantity("sideways", "critical load to the side", "load", **row("frames_and_arches",
                                                                            "shallow_shear.sideways.P"),
                     source=SHOOTING, tolerance=1e-6, relative=True, order=2,
                     order_within=0.15,
                     reason="the angle of 0.4 rad in 128 elements: (0.2/128)^2/12 = 2e-7 and the accuracy of the "
                            "bifurcation, 1e-6 of a step of 1/24"),
        ], parameter="elements of each half", by="elements"),
    ])
