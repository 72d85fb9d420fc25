"""Lee's frame past its limit points."""

import bielle
from harness import Problem, Quantity, Study, row

MODEL = """
nodes:
  base: {{position: [0, 0, 0], fixed: [x, y, z, rx, ry]}}
  corner: {{position: [0, 120, 0]}}
  load: {{position: [24, 120, 0]}}
  end: {{position: [120, 120, 0], fixed: [x, y, z, rx, ry]}}
elements:
  column: {{type: beam, nodes: [base, corner], orientation: [1, 0, 0], elements: {0}, section: {3}}}
  left: {{type: beam, nodes: [corner, load], orientation: [0, 1, 0], elements: {1}, section: {3}}}
  right: {{type: beam, nodes: [load, end], orientation: [0, 1, 0], elements: {2}, section: {3}}}
loads: {{p: {{node: load, force: [0, -1, 0]}}}}
"""
SECTION = "{EA: 4320, GAy: 4320/2.6, GAz: 4320/2.6, GJ: 1e3, EIy: 1440, EIz: 1440}"
SHOOTING = "Reissner's rod by shooting, path by arc length (tests/references/frames_and_arches.py)"
END = row("frames_and_arches", "lee.end_4.u")["reference"]


def path(elements):
    session = bielle.read(MODEL.format(elements, elements // 5, 4 * elements // 5, SECTION)).session()
    results = session.statics(arc_length={"until": {"node": "load", "displacement": END, "direction": "x"}})
    limits = results.numbers["limit_points"]
    return {"first": limits[0] if len(limits) == 2 else float("nan"),
            "second": limits[-1] if len(limits) == 2 else float("nan"), "end": results.time[-1],
            "down": 120 - results["nodes/load/position"][-1, 1]}


def quantity(name, meaning, unit, reference, tolerance, reason):
    return Quantity(name, meaning, unit, **row("frames_and_arches", reference), source=SHOOTING, tolerance=tolerance,
                    reason=reason, order=2, order_within=0.15)


PROBLEM = Problem(
    title="Lee's frame",
    subject="Beams at rest",
    source="S. Lee, F. Manuel, E. Rossow, Large deflections and stability of elastic frames, J. Eng. Mech. Div. ASCE "
           "94 (1968) 521",
    model="A column and a beam of 120 with a rigid corner, both far ends pinned, A = 6, I = 2, E = 720, nu = 0.3, a "
          "dead load on the beam at 24 from the corner. "
          "It snaps through at P = 1.85 and back at -0.94. Beams; the path by arc length until the loaded point has "
          "moved by 93.3 horizontally.",
    studies=[Study("Limit loads and a point behind them", path, [80, 160, 320], [
        quantity("first", "first limit load", "load", "lee.first.P", 1e-6,
                 "of second order with (L/80)^2: the curvature of 0.03 in elements of 0.4 gives (0.012)^2/48 = 3e-6"),
        quantity("second", "second limit load", "load", "lee.second.P", 1e-6, "likewise"),
        quantity("end", "load at a displacement of 93.265 along x", "load", "lee.end_4.P", 1e-6, "likewise"),
        quantity("down", "way down of the loaded point there", "length", "lee.end_4.v", 1e-3, "1e-5 of the length"),
    ], parameter="elements of the column", by="elements")])
