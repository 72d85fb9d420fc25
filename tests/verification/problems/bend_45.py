"""The 45-degree bend of Bathe and Bolourchi."""

import bielle
from harness import Problem, Quantity, Study, vector

SECTIONS = {"polar": "{EA: 1e7, GAy: 5e6, GAz: 5e6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}",
            "own": "{rectangle: [1, 1], young: 1e7, poisson: 0}"}
SHOOTING = "geometrically exact rod by shooting (tests/references/bend_45.py)"


def bend(section, bending, load):
    """Study.compute for a section and a form of bending."""
    def compute(elements):
        session = bielle.read(f"""
nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: ['100 - 50*sqrt(2)', '50*sqrt(2)', 0]}}}}
elements: {{arc: {{type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], bending: {bending},
                  elements: {elements}, section: {SECTIONS[section]}}}}}
loads: {{p: {{node: tip, force: [0, 0, {load}]}}}}
""").session()
        session.statics(steps=4, record=False)
        return {"tip": session["nodes/tip/position"]}
    return compute


def tip(section, load, tolerance, order, reason, order_reason=""):
    return [Quantity("tip", f"place of the tip under {load}", "length of the source",
                     **vector("bend_45", f"{section}.{load}", components="xyz"), source=SHOOTING,
                     tolerance=tolerance, order=order, reason=reason, order_within=0.25 if order == 4 else 0.1,
                     order_reason=order_reason)]


PROBLEM = Problem(
    title="45-degree bend",
    subject="Beams at rest",
    source="K.-J. Bathe, S. Bolourchi, Large displacement analysis of three-dimensional beam structures, IJNME 14 "
           "(1979) 961",
    model="An arc of radius 100 and 45 degrees in the plane x-y, section 1 x 1, E = 1e7, nu = 0, clamped at the "
          "origin; a dead load along z at its tip, 600 in four steps. "
          "Published tips spread from (15.5, 46.8, 53.7) to (15.9, 47.2, 53.4) with the mesh and the torsion "
          "constant, so that the exact rod is the reference: once with "
          "the polar GJ = EI, once with Saint-Venant's 0.1406 G.",
    quick=True,
    studies=[
        Study("Torsion constant of Saint-Venant", bend("own", "residual", 600), [16, 32, 64], tip(
            "own", 600, 1e-4, 2,
            "a curvature of pi/400 + M/EI = 0.03 in elements of 1.2: (0.03 x 1.2)^2/48 of the length 78 is 2e-3; "
            "bending: residual takes most of it"),
            parameter="elements", by="elements"),
        Study("Polar torsion constant", bend("polar", "residual", 600), [4, 8, 16], tip(
            "polar", 600, 1e-4, 4,
            "fourth order: (5/80)^4 of the length 78 is 1e-3, and only the change of curvature counts",
            "bending and torsion are equally stiff: the error of second order vanishes with the residual flexibility"),
              parameter="elements", by="elements"),
        Study("Elements of constant strain", bend("polar", "constant", 600), [16, 32, 64], tip(
            "polar", 600, 1e-2, 2, "second order: (0.03 x 1.2)^2/48 of the length 78 is 2e-3"), parameter="elements",
              by="elements"),
    ])
