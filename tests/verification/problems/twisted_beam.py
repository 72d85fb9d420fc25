"""The pretwisted beam of MacNeal and Harder."""

import bielle
from harness import Problem, Quantity, Study, vector


def beam(elements):
    """Deflections along y and z under forces of 1e-6 along y and z, over the force; root width along z."""
    found = []
    for force in ([0, 1e-6, 0], [0, 0, 1e-6]):
        session = bielle.read({
            "nodes": {"root": {"position": [0, 0, 0], "fixed": True}, "tip": {"position": [12, 0, 0]}},
            "elements": {"beam": {"type": "beam", "nodes": ["root", "tip"], "elements": elements,
                                  "orientation": [0, 1, 0], "twist": "pi/2",
                                  "section": {"rectangle": [0.32, 1.1], "young": 29e6, "poisson": 0.22,
                                              "shear_factors": [5 / 6, 5 / 6]}}},
            "loads": {"p": {"node": "tip", "force": force}}}).session()
        session.statics(record=False, newton={"tolerance": 1e-12})
        found.append(session["nodes/tip/position"][1:] / 1e-6)
    return {"own": [found[0][0], found[1][1]], "cross": abs(found[0][1]), "symmetry": found[0][1] - found[1][0]}


PUBLISHED = "R. MacNeal, R. Harder, Finite Elem. Anal. Des. 1 (1985) 3, table 7: 5.424e-3 and 1.754e-3"
PROBLEM = Problem(
    title="Pretwisted beam",
    subject="Beams at rest",
    source="R. MacNeal, R. Harder, A proposed standard set of problems to test finite element accuracy, Finite Elem. "
           "Anal. Des. 1 (1985) 3",
    model="A cantilever of length 12, section 1.1 x 0.32, twisted by 90 degrees, E = 29e6, nu = 0.22, under unit "
          "loads at its tip. One twisted beam.",
    quick=True,
    studies=[
        Study("Deflections of the tip", beam, [2, 4, 8, 16], [
            Quantity("own", "deflections along the loads y, z", "in", **vector("twisted_beam", "shear.y", "shear.z"),
                     tolerance=1e-8,
                     source="linear pretwisted rod, by quadrature (tests/references/twisted_beam.py)",
                     reason="the linear stiffness of twisted elements is exact: 2e-6 of the deflection for rounding "
                            "and for bending under 1e-6"),
            Quantity("symmetry", "difference of the two cross deflections", "in", 0.0, source="Maxwell and Betti",
                     tolerance=1e-8, reason="likewise"),
        ], parameter="elements", by="elements"),
        Study("Published targets", beam, [16], [
            Quantity("own", "deflections along the loads y, z", "in", [5.424e-3, 1.754e-3], source=PUBLISHED,
                     tolerance=1.5e-3, relative=True, known_to=5e-6,
                     reason="the targets are those of a beam model, exact ones are 5.4293e-3 and 1.7496e-3, "
                            "1.2e-3 away"),
        ], parameter="elements", by=""),
    ])
