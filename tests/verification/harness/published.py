"""The published collections from which problems are taken, and their parts that are left out, with the reason."""

from dataclasses import dataclass

THESIS = "A. Cardona, An Integrated Approach to Mechanism Analysis, thesis, Liege 1989"


@dataclass(frozen=True)
class Part:
    """A part of a collection. problems: names of problem files, empty if it is left out; remark: sentences about it."""

    name: str
    problems: tuple[str, ...]
    remark: str = ""


COLLECTIONS = {
    "IFToMM library of computational benchmark problems": [
        Part("A01 Simple pendulum", ("simple_pendulum",), "The library asks for a drift of the energy below 5e-5 J."),
        Part("A02 N four-bars", ("four_bar_loops",),
             "40 loops in the library, 2 in its restatement for OpenSim; the tolerance is ours."),
        Part("A03 Andrews' squeezing mechanism", ("squeezer",), "The tolerance of the balance of energy is ours."),
        Part("A04 Bricard's mechanism", ("bricard",), "The tolerance is ours."),
        Part("A05 Stiff flyball governor", ("flyball_governor",), "The tolerance is ours."),
        Part("A06 to A08", (), "No definition with numbers was found under these numbers; the library's later problems "
                               "have names only."),
        Part("Spatial rigid slider-crank mechanism", ("spatial_slider_crank",)),
    ],
    THESIS: [
        Part("ch. 2: rigid body and beam", ("heavy_top", "torque_free_body", "elastica", "bend_45", "spin_up"),
             "The subject of the chapter; no number of its examples is compared."),
        Part("ch. 3: joints", ("shaft_joints", "bricard", "spatial_slider_crank", "rolling_disk"), "As for ch. 2."),
        Part("ch. 4: superelements", ("superelement_cantilever", "superelement_rotating", "superelement_bending",
                                      "superelement_crank", "superelement_torsion"), "As for ch. 2."),
        Part("ch. 5: hydraulic actuator", ("hydraulic_cylinder",), "As for ch. 2."),
        Part("ch. 6: integration in time", ("integrators",), "As for ch. 2."),
    ],
    "NAFEMS": [
        Part("FV2, FV4, FV5", ("nafems_beams",)),
        Part("FV32", ("nafems_membrane",)),
        Part("FV52", ("nafems_thick_plate",), "On whole edges, where exact elasticity has a solution."),
        Part("LE10", ("nafems_thick_ellipse",)),
        Part("LE11", (), "It needs thermal strains, which Bielle does not have."),
    ],
    "Beams": [
        Part("Princeton beam, 45-degree bend, spin-up", ("princeton_beam", "bend_45", "spin_up")),
        Part("Flexible slider-crank", ("flexible_slider_crank", "superelement_crank")),
    ],
    "Results of ADAMS": [
        Part("NREL 5 MW turbine, table 9-1", ("turbine",),
             "The only published ADAMS numbers that were found with all data of the model."),
    ],
    "Hydraulics": [
        Part("Cylinders", ("hydraulic_cylinder",)), Part("Orifices, valves, accumulators", ("hydraulic_lines",)),
        Part("Pipes", ("water_hammer",)),
    ],
    "Friction": [
        Part("Stick-slip", ("stick_slip",)), Part("Coulomb, viscous, LuGre", ("friction_laws",)),
        Part("Capstan", ("rope_friction",)), Part("Clutch and brake", ("clutches",)),
    ],
}
