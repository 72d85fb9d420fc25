"""Frequencies of the NREL 5 MW turbine at rest and in rotation."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study
from harness.turbine import turbine

# Table 9-1, column ADAMS, without the tower's second mode side to side (see the problem's model).
ADAMS = {"tower": [0.3164, 0.3195], "drivetrain": [0.6094], "flap": [0.6296, 0.6686, 0.7019], "edge": [1.0740, 1.0877],
         "flap_2": [1.6507, 1.8558, 1.9601], "tower_2": [2.8590]}
PLACES = {"tower": [0, 1], "drivetrain": [2], "flap": [3, 4, 5], "edge": [6, 7], "flap_2": [8, 9, 10], "tower_2": [12]}
OPENFAST = [0.3140, 0.9650, 1.2163]  # side to side, edgewise backwards and forwards


def at_rest(elements):
    """Frequencies in the equilibrium under gravity, the blades at rest, over those of ADAMS, by kind."""
    session = bielle.read(turbine(48 // elements)).session()
    session.statics()
    found = np.array(session.modes(count=14)["eigen/damped_frequency"])
    return {kind: found[PLACES[kind]] / ADAMS[kind] for kind in ADAMS}


def turning(elements):
    """Frequencies at 6.97 rpm with a soft yaw drive, over those of OpenFAST."""
    session = bielle.read(turbine(48 // elements, yaw_stiffness=1e6)).session()
    results = session.modes(count=12, rotation={"joint": "shaft", "rate": 0.7301, "state": "mean"})
    found = np.array(results["eigen/damped_frequency"])
    # The first mode is that of the yaw drive. Edgewise modes are those next to their reference, 0.1 Hz from all others.
    whirls = [found[np.argmin(abs(found - each))] for each in OPENFAST[1:]]
    return {"openfast": np.array([found[1], *whirls]) / OPENFAST}


NREL = "NREL/TP-500-38060, table 9-1, ADAMS"
OC3 = "two standard deviations of the codes in phase I of OC3 (J. Jonkman, W. Musial, NREL/TP-5000-48191, 2010): "
PROBLEM = Problem(
    title="The NREL 5 MW turbine",
    subject="Beams in motion",
    source="J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW reference wind turbine for offshore "
           "system development, NREL/TP-500-38060 (2009)",
    model="Beams for the tower and three blades with cone, on a tilted shaft; a nacelle on its yaw spring, the "
          "drivetrain with a locked generator. At rest under gravity: 12 of the 13 modes of table 9-1. ADAMS has "
          "finite elements as here; FAST has assumed modes without torsion of the tower, and differs from ADAMS by 6 % "
          "in the first and 17 % in the second flapwise mode with yaw. The tower's second mode side to side (ADAMS "
          "2.941 Hz) is left out: two modes, of 2.72 and 2.98 Hz, have this motion here, with bending of the blades. "
          "The nacelle's inertia about two axes is not published. In rotation: OpenFAST at 6.97 rpm in wind, with a "
          "free yaw bearing. Edgewise whirls are coupled with flapwise ones there, which the wind damps by 20 to 40 %, "
          "themselves by 2 to 3 %.",
    long=True,
    studies=[
        Study("Frequencies at rest over those of ADAMS", at_rest, [6, 12, 24, 48], [
            Quantity("tower", "tower, side to side and fore-aft", "-", [1] * 2, source=NREL, tolerance=0.05,
                     reason=OC3 + "3.5 % for each of two modes"),
            Quantity("drivetrain", "drivetrain", "-", [1], source=NREL, tolerance=0.02,
                     reason="FAST and ADAMS differ by 1.8 %"),
            Quantity("flap", "flapwise: yaw, pitch, collective", "-", [1] * 3, source=NREL, tolerance=0.04,
                     reason="FAST and ADAMS differ by 6 % in the first; " + OC3 + "4 % for each"),
            Quantity("edge", "edgewise: pitch, yaw", "-", [1] * 2, source=NREL, tolerance=0.02,
                     reason="1 % for each: masses of the blade differ by 0.7 %, ADAMS divides it into rigid parts"),
            Quantity("flap_2", "second flapwise: yaw, pitch, collective", "-", [1] * 3, source=NREL, tolerance=0.05,
                     reason="FAST and ADAMS differ by 17, 4 and 3 %"),
            Quantity("tower_2", "tower, second fore-aft", "-", [1], source=NREL, tolerance=0.02,
                     reason="FAST and ADAMS differ by 1.4 %; the nacelle's unknown inertia changes it by 1 %"),
        ], parameter="beams of a blade", by="elements"),
        Study("Frequencies in rotation", turning, [12], [
            Quantity("openfast", "side to side, edgewise whirls at 6.97 rpm", "-", [1] * 3,
                     source="state matrices of OpenFAST 2.5 in multiblade coordinates, mean of three azimuths (example "
                            "linearization_outputs of OpenFAST/openfast_toolbox)", tolerance=0.035,
                     reason="2 % for each of three modes: those at rest differ by 1 to 2 % between the codes"),
        ], parameter="beams of a blade", by=""),
    ])
