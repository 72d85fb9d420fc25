"""Campbell diagram of the NREL 5 MW turbine from rest to its rated speed."""

import bielle
import numpy as np
from harness import Problem, Quantity, Study
from harness.turbine import table, turbine

LINES = ("side_to_side", "fore_aft", "flap_backward", "drivetrain", "flap_lower", "flap_upper", "edge_backward",
         "edge_forward")  # ascending at the last speed
USED = [0, 4, 8, 12, 15]  # rows of the table, below the veering of the edgewise and flapwise whirls near 11 rpm
PUBLISHED = table("nrel_5mw_campbell.csv")
SPEEDS = PUBLISHED["rpm"][USED] * np.pi / 30  # [rad/s]
READ = {name: PUBLISHED[name][USED] for name in LINES}
ALL = len(USED)


def swept(elements):
    """Frequencies of the lines at the speeds over the published ones, and the splits of whirls by twice the speed.

    A line is the mode of one number of the diagram, which the program follows by its shape; its name is found by its
    place among the others at the last speed. The two upper flapwise lines veer near 2 rpm, where they are taken in
    the order of their frequencies.
    """
    session = bielle.read(turbine(48 // elements)).session()
    results = session.campbell([0.0, *SPEEDS.tolist()], rotation={"joint": "shaft", "state": "mean"},
                               modes=len(LINES))
    given = np.array([int(np.argmin(abs(np.array(results["campbell/speed"]) - each))) for each in SPEEDS])
    frequency = np.array(results["campbell/damped_frequency"])[given]
    line = {name: frequency[:, k] for name, k in zip(LINES, np.argsort(frequency[-1]))}
    pair = np.sort([line["flap_lower"], line["flap_upper"]], axis=0)
    line["flap_lower"], line["flap_upper"] = pair
    ratio = {name: line[name] / READ[name] for name in LINES}
    split = [(line[f"{kind}"][-1] - line[f"{back}"][-1]) / (SPEEDS[-1] / np.pi)
             for kind, back in (("edge_forward", "edge_backward"), ("flap_upper", "flap_backward"))]
    return {"tower": np.concatenate([ratio["side_to_side"], ratio["fore_aft"]]), "drivetrain": ratio["drivetrain"],
            "flap": np.concatenate([ratio["flap_backward"], ratio["flap_lower"], ratio["flap_upper"]]),
            "edge": np.concatenate([ratio["edge_backward"], ratio["edge_forward"]]), "split": split}


def published_split(forward, backward):
    """Distance of two whirls at the last speed over twice the speed."""
    return float((READ[forward][-1] - READ[backward][-1]) / (SPEEDS[-1] / np.pi))


ACDC = ("structural Campbell diagram of OpenFAST in the documentation of OpenFAST/acdc (docs/content/docs/about/"
        "campbell-diagram.png, 2024), read to 0.002 Hz")
PROBLEM = Problem(
    title="Campbell diagram of the NREL 5 MW turbine",
    subject="Beams in motion",
    source="J. Jonkman, S. Butterfield, W. Musial, G. Scott, Definition of a 5-MW reference wind turbine for offshore "
           "system development, NREL/TP-500-38060 (2009); ACDC, Automated Campbell Diagram Code, National Renewable "
           "Energy Laboratory",
    model="The turbine at rest and at five speeds up to 10 rpm, its generator locked: eight modes, each followed by "
          "its shape. The drivetrain crosses the backward flapwise whirl at 3 rpm. At 11.5 rpm the backward edgewise "
          "whirl meets the forward flapwise one and mixes with it. The reference has assumed modes of blades and tower (ElastoDyn), without "
          "torsion.",
    long=True,
    studies=[Study("Frequencies over those of OpenFAST", swept, [12, 16], [
        Quantity("tower", "tower, side to side and fore-aft", "-", [1] * (2 * ALL), source=ACDC,
                 tolerance=0.035 * np.sqrt(2 * ALL),
                 reason="3.5 % for each: two standard deviations of the codes in phase I of OC3 (J. Jonkman, W. "
                        "Musial, NREL/TP-5000-48191, 2010)"),
        Quantity("drivetrain", "drivetrain", "-", [1] * ALL, source=ACDC, tolerance=0.02 * np.sqrt(ALL),
                 reason="2 % for each: FAST and ADAMS differ by 1.8 % at rest"),
        Quantity("flap", "flapwise: backward, collective, forward", "-", [1] * (3 * ALL), source=ACDC,
                 tolerance=0.04 * np.sqrt(3 * ALL),
                 reason="4 % for each: the codes of OC3; FAST and ADAMS differ by 6 % in the first at rest"),
        Quantity("edge", "edgewise: backward, forward", "-", [1] * (2 * ALL), source=ACDC,
                 tolerance=0.02 * np.sqrt(2 * ALL), reason="2 % for each: those at rest differ by 1 % between the codes"),
        Quantity("split", "distance of edgewise and flapwise whirls over twice the speed", "-",
                 [published_split("edge_forward", "edge_backward"), published_split("flap_upper", "flap_backward")],
                 source=ACDC, tolerance=0.05, known_to=0.01,
                 reason="two readings of 0.002 Hz are 0.01; 2 % of a frequency of 0.9 Hz is 0.05 of twice the speed, "
                        "for one of the four"),
    ], parameter="beams of a blade", by="elements")])
