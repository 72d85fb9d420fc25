"""Methods that add entries of each type to a model. Written by tools/keys from the tables of keys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


class Entries:
    """Adds entries by their types. A key that is a word of Python has a `_` behind it; None leaves a key out."""

    def add(self, section: str, name: str | None, entry: Mapping[str, Any]) -> None:
        """Adds an entry to a section."""
        raise NotImplementedError

    def rigid_body(self, name: str, *,
            node: Mapping[str, Any] | str, mass: float | str | None = None, centre: Sequence[Any] | None = None,
            inertia: Sequence[Any] | None = None, inertia_about: str | None = None,
            inertia_axes: Mapping[str, Any] | None = None, solid: Mapping[str, Any] | Sequence[Any] | None = None,
            also: Sequence[Any] | None = None, shape: Mapping[str, Any] | Sequence[Any] | None = None,
            **more: Any) -> None:
        """A rigid body on a node, by its mass and inertia or by solids.

        node: The node that moves with the body. (name of a node)
        mass: Mass, which is needed without `solid`. (number [kg] greater than 0)
        centre: Centre of mass in the axes of the node. (list of 3: number [m]; default: the node, or the centre of
        the solid)
        inertia: Inertia tensor as `[xx, yy, zz]`, `[xx, yy, zz, xy, xz, yz]` or three rows of three, which is needed
        without `solid`. (list of 3: number [kg m^2]; or list of 6: number [kg m^2]; or list of 3: list of 3: number
        [kg m^2])
        inertia_about: Point about which the inertia is given. (`centre`, `node`; default: centre)
        inertia_axes: Orientation of the axes of the inertia, relative to those of the node. (keys of `inertia_axes`;
        default: the axes of the node)
        solid: Solid, or list of solids that are added up, in place of mass and inertia. (keys of a solid; or list of
        at least 1: keys of a solid)
        also: Further nodes that the body carries rigidly. (list: name of a node)
        shape: Shape, or list of shapes, by which it is drawn; it changes no result. (keys of a shape; or list of at
        least 1: keys of a shape)
        """
        self.add("elements", name, {"type": "rigid_body", "node": node, "mass": mass, "centre": centre,
            "inertia": inertia, "inertia_about": inertia_about, "inertia_axes": inertia_axes, "solid": solid,
            "also": also, "shape": shape, **more})

    def point_mass(self, name: str, *,
            node: Mapping[str, Any] | str, mass: float | str, centre: Sequence[Any] | None = None,
            shape: Mapping[str, Any] | Sequence[Any] | None = None, **more: Any) -> None:
        """A mass without inertia about its centre.

        node: The node that moves with the mass. (name of a node)
        mass: Mass. (number [kg] of at least 0)
        centre: Place of the mass in the axes of the node. (list of 3: number [m]; default: [0, 0, 0])
        shape: Shape, or list of shapes, by which it is drawn; it changes no result. (keys of a shape; or list of at
        least 1: keys of a shape)
        """
        self.add("elements", name, {"type": "point_mass", "node": node, "mass": mass, "centre": centre,
            "shape": shape, **more})

    def beam(self, name: str, *,
            nodes: Sequence[Any], section: Mapping[str, Any] | Sequence[Any], elements: float | str | None = None,
            orientation: Sequence[Any] | None = None, twist: float | str | None = None,
            damping: float | str | None = None, bending: str | None = None, arc_centre: Sequence[Any] | None = None,
            arc_through: Sequence[Any] | None = None, distributed: Mapping[str, Any] | Sequence[Any] | None = None,
            airfoil: Mapping[str, Any] | None = None, **more: Any) -> None:
        """A straight or curved beam between two nodes, cut into elements of equal length.

        nodes: The nodes at the start and at the end. (list of 2: name of a node)
        section: Cross section, or `[start, end]` of a linear taper. (keys of a section of a shape; or keys of a
        section by constants; or keys of a section by matrices; or list of 2: keys of a section of a shape; or keys
        of a section by constants; or keys of a section by matrices)
        elements: Number of elements. (whole number between 1 and 100000; default: 8)
        orientation: Vector whose part normal to the beam is the section's y axis at the start. (list of 3: number;
        default: the inertial axis most normal to the beam)
        twist: Rotation of the section about the line, from start to end. (number [rad]; default: 0)
        damping: Kelvin-Voigt time, which multiplies the stiffness to give the damping. (number [s] of at least 0;
        default: 0)
        bending: Flexibility in bending: `residual` is exact for linear bending, `constant` has constant strains.
        (`residual`, `constant`; default: residual)
        arc_centre: Centre of a circular arc from start to end. (list of 3: number [m])
        arc_through: Point of a circular arc from start to end, in place of `arc_centre`. (list of 3: number [m])
        distributed: Load per length, or a list of such loads. (keys of a distributed load; or list of at least 1:
        keys of a distributed load)
        airfoil: Aerodynamic forces along the beam. (keys of an airfoil)
        """
        self.add("elements", name, {"type": "beam", "nodes": nodes, "section": section, "elements": elements,
            "orientation": orientation, "twist": twist, "damping": damping, "bending": bending,
            "arc_centre": arc_centre, "arc_through": arc_through, "distributed": distributed, "airfoil": airfoil,
            **more})

    def superelement(self, name: str, *,
            file: str, nodes: Mapping[str, Any] | None = None, position: Sequence[Any] | None = None,
            rotation_vector: Sequence[Any] | None = None, quaternion: Sequence[Any] | None = None,
            bryant: Sequence[Any] | None = None, euler: Sequence[Any] | None = None,
            axes: Mapping[str, Any] | None = None, matrix: Sequence[Any] | None = None,
            rodrigues: Sequence[Any] | None = None, conformal: Sequence[Any] | None = None,
            frame: Mapping[str, Any] | str | None = None, largest_error: float | str | None = None,
            damping: Mapping[str, Any] | None = None, loads: Mapping[str, Any] | None = None, **more: Any) -> None:
        """An elastic body that `bielle-reduce` has reduced to its interfaces.

        file: File of the reduced body. (file (body of bielle-reduce))
        nodes: Nodes of the interfaces; those that are not named become nodes `<element>.<interface>`. (map by
        interface: name of a node)
        position: Position of the origin. (list of 3: number [m]; default: [0, 0, 0])
        rotation_vector: Orientation: the axis of the rotation times its angle. (list of 3: number [rad])
        quaternion: Orientation: `[w, x, y, z]`, cos(angle/2) and sin(angle/2) times the axis, of any length but
        zero. (list of 4: number)
        bryant: Orientation: angles a, b, c about x, the new y and the newest z: R = Rx(a) Ry(b) Rz(c). (list of 3:
        number [rad])
        euler: Orientation: angles a, b, c about z, the new x and the newest z: R = Rz(a) Rx(b) Rz(c). (list of 3:
        number [rad])
        axes: Orientation: two of the axes; the first as given, the second made orthogonal to it. (keys of `axes`)
        matrix: Orientation: the rotation matrix R by rows, whose columns are the own axes. Rounding of its entries
        up to 1e-3 is corrected. (list of 3: list of 3: number)
        rodrigues: Orientation: tan(angle/2) times the axis. (list of 3: number)
        conformal: Orientation: 4 tan(angle/4) times the axis (Wiener-Milenkovic). (list of 3: number)
        frame: Frame of the body: the mean of the interfaces, mean axes of the mass, or that of an interface.
        (`mean`, `mean_axes`; or keys of the frame of a superelement; default: mean)
        largest_error: Relative error of the deformation, as estimated, beyond which the run ends. (number greater
        than 0)
        damping: Damping in place of the file's. (keys of the damping; default: as in the file)
        loads: Factors of the body's load patterns, as formulas of the time t. (map by load pattern: formula of t; or
        keys of a load of a superelement)
        """
        self.add("elements", name, {"type": "superelement", "file": file, "nodes": nodes, "position": position,
            "rotation_vector": rotation_vector, "quaternion": quaternion, "bryant": bryant, "euler": euler,
            "axes": axes, "matrix": matrix, "rodrigues": rodrigues, "conformal": conformal, "frame": frame,
            "largest_error": largest_error, "damping": damping, "loads": loads, **more})

    def spring_damper(self, name: str, *,
            nodes: Sequence[Any], at: Sequence[Any] | None = None, stiffness: float | str | None = None,
            damping: float | str | None = None, length: float | str | None = None, force: float | str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A spring, a damper or a force along the line between points of two nodes.

        nodes: The two nodes. (list of 2: name of a node)
        at: Points of attachment, each in the axes of its node. (list of 2: list of 3: number [m]; default: [[0, 0,
        0], [0, 0, 0]])
        stiffness: Force per elongation. (number [N/m] of at least 0)
        damping: Force per rate of the length. (number [N s/m] of at least 0)
        length: Free length of the spring. (number [m] of at least 0; default: the distance as placed)
        force: Tension as a formula of the elongation e, its rate v, the time t and measures, in place of `stiffness`
        and `damping`. (formula of e, v, t and measures [N])
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("elements", name, {"type": "spring_damper", "nodes": nodes, "at": at, "stiffness": stiffness,
            "damping": damping, "length": length, "force": force, "active": active, **more})

    def node_force(self, name: str, *,
            nodes: Sequence[Any], force: Sequence[Any] | None = None, moment: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, axes: str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """A force and a moment between two nodes.

        nodes: The two nodes: force and moment act on the second, and back on the first at the same place. (list of
        2: name of a node)
        force: Components of the force as formulas of the time t and measures. (list of 3: formula of t and measures
        [N])
        moment: Components of the moment as formulas of the time t and measures. (list of 3: formula of t and
        measures [N m])
        at: Point of application in the axes of the second node. (list of 3: number [m]; default: [0, 0, 0])
        axes: Axes of the components: those of the first node, of the second node, or inertial ones. (`first`,
        `second`, `inertial`; default: first)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("elements", name, {"type": "node_force", "nodes": nodes, "force": force, "moment": moment, "at": at,
            "axes": axes, "active": active, **more})

    def stiffness_field(self, name: str, *,
            nodes: Sequence[Any], stiffness: Mapping[str, Any] | Sequence[Any],
            damping: Mapping[str, Any] | Sequence[Any] | float | str | None = None,
            rotation_vector: Sequence[Any] | None = None, quaternion: Sequence[Any] | None = None,
            bryant: Sequence[Any] | None = None, euler: Sequence[Any] | None = None,
            axes: Mapping[str, Any] | None = None, matrix: Sequence[Any] | None = None,
            rodrigues: Sequence[Any] | None = None, conformal: Sequence[Any] | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A part between two nodes with the stiffness matrix of another program.

        nodes: The two nodes. (list of 2: name of a node)
        stiffness: Symmetric matrix in the order x y z rx ry rz of the first node, then of the second. (list of 12:
        list of 12: number [N/m or N or N/rad or N m/rad]; or keys of a matrix)
        damping: Matrix in the same order, or a time that multiplies the stiffness. (number [s] of at least 0; or
        list of 12: list of 12: number [N s/m or N s or N s/rad or N m s/rad]; or keys of a matrix)
        rotation_vector: Orientation: the axis of the rotation times its angle. (list of 3: number [rad])
        quaternion: Orientation: `[w, x, y, z]`, cos(angle/2) and sin(angle/2) times the axis, of any length but
        zero. (list of 4: number)
        bryant: Orientation: angles a, b, c about x, the new y and the newest z: R = Rx(a) Ry(b) Rz(c). (list of 3:
        number [rad])
        euler: Orientation: angles a, b, c about z, the new x and the newest z: R = Rz(a) Rx(b) Rz(c). (list of 3:
        number [rad])
        axes: Orientation: two of the axes; the first as given, the second made orthogonal to it. (keys of `axes`)
        matrix: Orientation: the rotation matrix R by rows, whose columns are the own axes. Rounding of its entries
        up to 1e-3 is corrected. (list of 3: list of 3: number)
        rodrigues: Orientation: tan(angle/2) times the axis. (list of 3: number)
        conformal: Orientation: 4 tan(angle/4) times the axis (Wiener-Milenkovic). (list of 3: number)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("elements", name, {"type": "stiffness_field", "nodes": nodes, "stiffness": stiffness,
            "damping": damping, "rotation_vector": rotation_vector, "quaternion": quaternion, "bryant": bryant,
            "euler": euler, "axes": axes, "matrix": matrix, "rodrigues": rodrigues, "conformal": conformal,
            "active": active, **more})

    def hydraulic_actuator(self, name: str, *,
            nodes: Sequence[Any], stroke: Sequence[Any], at: Sequence[Any] | None = None,
            piston_areas: Sequence[Any] | None = None, stages: Sequence[Any] | None = None,
            dead_volumes: Sequence[Any] | None = None, leakage: float | str | None = None,
            external_leakage: Sequence[Any] | None = None, friction: Mapping[str, Any] | None = None,
            end_stops: Mapping[str, Any] | None = None, ports: Sequence[Any] | None = None,
            pressures: Sequence[Any] | None = None, compliances: Sequence[Any] | None = None,
            cushions: Mapping[str, Any] | None = None, supply: Mapping[str, Any] | None = None,
            valve: Mapping[str, Any] | None = None, relief: Mapping[str, Any] | None = None,
            accumulator: Mapping[str, Any] | None = None, ambient_pressure: float | str | None = None,
            density: float | str | None = None, viscosity: float | str | None = None,
            bulk_modulus: float | str | None = None, air_fraction: float | str | None = None,
            air_exponent: float | str | None = None, vapour_pressure: float | str | None = None,
            conserves: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A cylinder between points of two nodes, in a circuit or with a circuit of its own.

        nodes: The two nodes, which chamber 1 pushes apart. (list of 2: name of a node)
        stroke: Shortest and longest distance of the points of attachment. (list of 2: number [m] greater than 0)
        at: Points of attachment, each in the axes of its node. (list of 2: list of 3: number [m]; default: [[0, 0,
        0], [0, 0, 0]])
        piston_areas: Areas on which the pressures of the chambers act, [A1, A2]: extending, and drawing in (0:
        single-acting). ([number [m^2] greater than 0, number [m^2] of at least 0]; or list of 1: number [m^2]
        greater than 0)
        stages: Stages of a telescopic cylinder in the order in which they extend, in place of `piston_areas`. (list
        of at least 1: keys of a stage)
        dead_volumes: Dead volume of each chamber, hoses included. (list of 2: number [m^3] of at least 0; or list of
        1: number [m^3] of at least 0; default: [0, 0])
        leakage: Leakage between the chambers: flow per pressure difference. (number [m^3/(s Pa)] of at least 0;
        default: 0)
        external_leakage: Leakage from each chamber to the outside: flow per pressure difference. (list of 2: number
        [m^3/(s Pa)] of at least 0; or list of 1: number [m^3/(s Pa)] of at least 0; default: [0, 0])
        friction: Friction of the seals; none without the key. (keys of the friction of an actuator)
        end_stops: Stops at both ends of the stroke, which push as stops of joints do. Without them the summary
        reports an actuator that left its stroke. (keys of the end_stops)
        ports: Places of the hydraulics to which the chambers are connected, in place of a circuit of its own: the
        keys of that circuit then do not apply, except those of chambers behind `cushions`. (list: name of a place of
        the hydraulics)
        pressures: Pressures at the start of the chambers that are volumes of its own: without `ports`, or behind
        `cushions`. By default the length is not accelerated, and the chamber that carries less is at the pressure of
        the tank. (list of 2: number [Pa]; or list of 1: number [Pa]; default: in equilibrium with the load)
        compliances: Compliance of each chamber and its hose: growth of the volume per pressure. (list of 2: number
        [m^3/Pa] of at least 0; or list of 1: number [m^3/Pa] of at least 0; default: [0, 0])
        cushions: Throttles at the ends of the stroke; none without the key. With `ports`, chambers behind them are
        volumes of their own, with `pressures` and `compliances`. (keys of the cushions)
        supply: Supply of the own circuit: a given pressure, or a pump of given flow. (keys of the supply of an
        actuator)
        valve: Servo-valve between supply, tank and chambers; three of its ports are used for a single-acting
        cylinder. (keys of a servo-valve)
        relief: Relief valve to the tank, for a pump of constant flow or for each chamber. (keys of a relief valve)
        accumulator: Accumulator at a pump of constant flow, or at chamber 1. (keys of an accumulator)
        ambient_pressure: Absolute pressure of the surroundings; with 0 all pressures are relative to the atmosphere
        (gauge). (number [Pa] of at least 0; default: 101325)
        density: Density of the fluid. (number [kg/m^3] greater than 0; default: 850)
        viscosity: Dynamic viscosity. (number [Pa s] greater than 0; default: 0.04)
        bulk_modulus: Bulk modulus of the fluid without air. (number [Pa] greater than 0; default: 1.4e9)
        air_fraction: Air that is entrained but not dissolved, as a share of the volume at 101325 Pa. (number of at
        least 0 and less than 1; default: 0)
        air_exponent: Exponent of the air's changes of state: 1 is isothermal, 1.4 adiabatic. (number between 1 and
        1.7; default: 1.2)
        vapour_pressure: Absolute vapour pressure of a fluid without air; with 0 cavities have no pressure. (number
        [Pa] between 0 and 3500; default: 1000)
        conserves: Quantity that flows conserve: the `volume`, each place at its own pressure, or the `mass`, with
        flows as volumes at 101325 Pa. (`volume`, `mass`; default: volume)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("elements", name, {"type": "hydraulic_actuator", "nodes": nodes, "stroke": stroke, "at": at,
            "piston_areas": piston_areas, "stages": stages, "dead_volumes": dead_volumes, "leakage": leakage,
            "external_leakage": external_leakage, "friction": friction, "end_stops": end_stops, "ports": ports,
            "pressures": pressures, "compliances": compliances, "cushions": cushions, "supply": supply,
            "valve": valve, "relief": relief, "accumulator": accumulator, "ambient_pressure": ambient_pressure,
            "density": density, "viscosity": viscosity, "bulk_modulus": bulk_modulus, "air_fraction": air_fraction,
            "air_exponent": air_exponent, "vapour_pressure": vapour_pressure, "conserves": conserves,
            "active": active, **more})

    def rigid(self, name: str, *,
            nodes: Sequence[Any], position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that fixes two nodes to each other.

        nodes: First and second node. (list of 2: name of a node)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "rigid", "nodes": nodes, "position": position, "at": at, "axis": axis,
            "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def hinge(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that leaves turning about an axis free.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t
        and measures [N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force;
        or map by coordinate: formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [rad]; or map by coordinate: number [rad];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N m]; or map by coordinate: number [N m]; default:
        0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [rad]; or map by coordinate:
        number [rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [rad/s]; or map by coordinate:
        number [rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "hinge", "nodes": nodes, "axis": axis, "position": position, "at": at,
            "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def prismatic(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that leaves sliding along an axis free.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m]; or map by coordinate: number
        [m])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "prismatic", "nodes": nodes, "axis": axis, "position": position, "at": at,
            "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def cylindrical(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that leaves sliding along an axis and turning about it free.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "cylindrical", "nodes": nodes, "axis": axis, "position": position,
            "at": at, "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def spherical(self, name: str, *,
            nodes: Sequence[Any], position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that holds a point and leaves turning free.

        nodes: First and second node. (list of 2: name of a node)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t
        and measures [N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force;
        or map by coordinate: formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [rad]; or map by coordinate: number [rad];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N m]; or map by coordinate: number [N m]; default:
        0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [rad]; or map by coordinate:
        number [rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [rad/s]; or map by coordinate:
        number [rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "spherical", "nodes": nodes, "position": position, "at": at, "axis": axis,
            "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def planar(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that leaves sliding across an axis and turning about it free.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "planar", "nodes": nodes, "axis": axis, "position": position, "at": at,
            "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def screw(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], pitch: float | str, position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that slides along its axis as it turns about it.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        pitch: Displacement along the axis per turn; positive if right-handed. (number [m])
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "screw", "nodes": nodes, "axis": axis, "pitch": pitch,
            "position": position, "at": at, "second_axis": second_axis, "stiffness": stiffness, "damping": damping,
            "rest": rest, "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def universal(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], second_axis: Sequence[Any],
            position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A cross between two shafts, which turns about its two arms.

        nodes: First and second node. (list of 2: name of a node)
        axis: Arm of the cross that is fixed on the first node, as drawn; or a direction in the axes of each node.
        (list of 3: number; or list of 2: list of 3: number)
        second_axis: Arm of the cross that is fixed on the second node, at right angles to `axis`; or a direction in
        the axes of each node. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t
        and measures [N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force;
        or map by coordinate: formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [rad]; or map by coordinate: number [rad];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N m]; or map by coordinate: number [N m]; default:
        0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [rad]; or map by coordinate:
        number [rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [rad/s]; or map by coordinate:
        number [rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "universal", "nodes": nodes, "axis": axis, "second_axis": second_axis,
            "position": position, "at": at, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def constant_velocity(self, name: str, *,
            nodes: Sequence[Any], position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            axes: Sequence[Any] | None = None, stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint between two shafts that turn at equal rates at any bend below 180 degrees.

        nodes: First and second node. (list of 2: name of a node)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        axes: Directions of the first and of the second shaft as drawn, in place of `axis`, of a joint that is drawn
        bent; `second_axis` is then one direction, across the first. (list of 2: list of 3: number)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t
        and measures [N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force;
        or map by coordinate: formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [rad]; or map by coordinate: number [rad];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N m]; or map by coordinate: number [N m]; default:
        0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [rad]; or map by coordinate:
        number [rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [rad/s]; or map by coordinate:
        number [rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "constant_velocity", "nodes": nodes, "position": position, "at": at,
            "axis": axis, "second_axis": second_axis, "axes": axes, "stiffness": stiffness, "damping": damping,
            "rest": rest, "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def distance(self, name: str, *,
            nodes: Sequence[Any], at: Sequence[Any] | None = None, length: float | str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A rod without mass and with a ball joint at either end.

        nodes: First and second node. (list of 2: name of a node)
        at: End points of the link, each in the axes of its node. (list of 2: list of 3: number [m]; default: [[0, 0,
        0], [0, 0, 0]])
        length: Distance of the two points, which may be a formula of t. (formula of t [m] greater than 0; default:
        the distance as drawn)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "distance", "nodes": nodes, "at": at, "length": length, "active": active,
            **more})

    def spherical_spherical(self, name: str, *,
            nodes: Sequence[Any], at: Sequence[Any] | None = None, length: float | str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A rod without mass and with a ball joint at either end.

        nodes: First and second node. (list of 2: name of a node)
        at: End points of the link, each in the axes of its node. (list of 2: list of 3: number [m]; default: [[0, 0,
        0], [0, 0, 0]])
        length: Distance of the two points, which may be a formula of t. (formula of t [m] greater than 0; default:
        the distance as drawn)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "spherical_spherical", "nodes": nodes, "at": at, "length": length,
            "active": active, **more})

    def revolute_spherical(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], at: Sequence[Any] | None = None,
            length: float | str | None = None, stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A rod without mass that hinges on the first node, with a ball joint on the second.

        nodes: First and second node. (list of 2: name of a node)
        axis: Axis of the hinge on the first node, as drawn. (list of 3: number)
        at: End points of the link, each in the axes of its node. (list of 2: list of 3: number [m]; default: [[0, 0,
        0], [0, 0, 0]])
        length: Distance of the two points. (number [m] greater than 0; default: the distance as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t
        and measures [N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force;
        or map by coordinate: formula of q, v, t and measures [N m s/rad] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [rad]; or map by coordinate: number [rad];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N m]; or map by coordinate: number [N m]; default:
        0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [rad]; or map by coordinate:
        number [rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [rad/s]; or map by coordinate:
        number [rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "revolute_spherical", "nodes": nodes, "axis": axis, "at": at,
            "length": length, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def point_on_line(self, name: str, *,
            nodes: Sequence[Any], line: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that holds a point on a line and leaves turning free.

        nodes: First and second node. (list of 2: name of a node)
        line: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m]; or map by coordinate: number
        [m])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "point_on_line", "nodes": nodes, "line": line, "position": position,
            "at": at, "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def point_on_plane(self, name: str, *,
            nodes: Sequence[Any], normal: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that holds a point in a plane and leaves turning free.

        nodes: First and second node. (list of 2: name of a node)
        normal: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m]; or map by coordinate: number
        [m])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "point_on_plane", "nodes": nodes, "normal": normal, "position": position,
            "at": at, "second_axis": second_axis, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def point_on_curve(self, name: str, *,
            nodes: Sequence[Any], curve: str, position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            curve_origin: Sequence[Any] | None = None, closed: bool | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A joint that holds a point on a curve of the first node and leaves turning free.

        nodes: First and second node. (list of 2: name of a node)
        curve: Points of the curve as drawn [m], along the axes of the joint's frame, which are the inertial ones
        unless `axis` or `second_axis` is given; a cubic spline joins them. (file (table of three columns))
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        curve_origin: Origin of these points as drawn. (list of 3: number [m]; default: the origin of the inertial
        axes)
        closed: Whether the curve returns to its first point. (true or false; default: false)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m]; or map by coordinate: number
        [m])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "point_on_curve", "nodes": nodes, "curve": curve, "position": position,
            "at": at, "axis": axis, "second_axis": second_axis, "curve_origin": curve_origin, "closed": closed,
            "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload, "stops": stops,
            "locked": locked, "clutch": clutch, "one_way": one_way, "start": start, "start_rate": start_rate,
            "friction": friction, "carries": carries, "active": active, **more})

    def slider(self, name: str, *,
            node: Mapping[str, Any] | str, beam: str, at: Sequence[Any] | None = None,
            start: float | str | None = None, ends: str | None = None, orientation: str | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start_rate: Mapping[str, Any] | float | str | None = None,
            friction: Mapping[str, Any] | None = None, carries: str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """A joint that holds a node on a beam that deforms, along which it slides.

        node: Node that slides. (name of a node)
        beam: Beam along which it slides. (name of an element)
        at: Point that slides, in the axes of the node. (list of 3: number [m]; default: [0, 0, 0])
        start: Place at the start, as a share of the beam's length. (number between 0 and 1; default: the place next
        to the point as drawn)
        ends: Behaviour at the ends of the beam. (`error`, `stop`; default: error)
        orientation: Freedom of turning; `tangent` leaves turning about the beam alone. (`free`, `tangent`; default:
        free)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "slider", "node": node, "beam": beam, "at": at, "start": start,
            "ends": ends, "orientation": orientation, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def wheel(self, name: str, *,
            nodes: Sequence[Any], normal: Sequence[Any], axis: Sequence[Any], radius: float | str,
            position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            slip: Mapping[str, Any] | str | None = None, stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A thin wheel of the second node on a plane of the first.

        nodes: Node of the plane and node of the wheel. (list of 2: name of a node)
        normal: Normal of the plane, towards the wheel, as drawn. (list of 3: number)
        axis: Axis of the wheel as drawn. (list of 3: number)
        radius: Radius of the wheel. (number [m] greater than 0)
        position: Point of the plane as drawn. (list of 3: number [m]; default: the point below the rim as drawn)
        at: Point of the plane and middle of the wheel, each in the axes of its node, in place of `position`. (list
        of 2: list of 3: number [m])
        slip: Slip of the wheel: `none` rolls, otherwise it is a tyre. (`none`; or keys of `slip`; default: none)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m] of at least 0; or keys of a law of force; or map by coordinate: formula of q, v, t and
        measures [N/m] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force; or
        map by coordinate: formula of q, v, t and measures [N s/m] of at least 0; or keys of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m]; or map by coordinate: number [m];
        default: 0)
        preload: Resisting force of the spring at `rest`. (number [N]; or map by coordinate: number [N]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m]; or map by coordinate: number
        [m])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s]; or map by coordinate:
        number [m/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "wheel", "nodes": nodes, "normal": normal, "axis": axis, "radius": radius,
            "position": position, "at": at, "slip": slip, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "friction": friction, "carries": carries, "active": active,
            **more})

    def tyre(self, name: str, *,
            nodes: Sequence[Any], normal: Sequence[Any], axis: Sequence[Any], radius: float | str,
            position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            stiffness: float | str | None = None, curve: str | None = None, damping: float | str | None = None,
            rolling_resistance: float | str | None = None, slip: Mapping[str, Any] | None = None,
            speed: float | str | None = None, road: Mapping[str, Any] | None = None, active: bool | None = None,
            **more: Any) -> None:
        """A wheel of the second node with an elastic tyre on a road of the first.

        nodes: Node of the plane and node of the wheel. (list of 2: name of a node)
        normal: Normal of the plane, towards the wheel, as drawn. (list of 3: number)
        axis: Axis of the wheel as drawn. (list of 3: number)
        radius: Radius of the wheel. (number [m] greater than 0)
        position: Point of the plane as drawn. (list of 3: number [m]; default: the point below the rim as drawn)
        at: Point of the plane and middle of the wheel, each in the axes of its node, in place of `position`. (list
        of 2: list of 3: number [m])
        stiffness: Radial stiffness. (number [N/m] greater than 0)
        curve: Deflections [m] and radial forces [N], joined by straight lines, in place of `stiffness`. (file (table
        of two columns))
        damping: Radial damping; the tyre never pulls at the road. (number [N s/m] of at least 0; default: 0)
        rolling_resistance: Force against rolling over the load. (number of at least 0; default: 0)
        slip: Forces along the road; without it the tyre has none. (keys of slip of a tyre)
        speed: Rolling speed at which rolling resistance, trail and camber force begin to act and the damping of the
        tread ends. (number [m/s] greater than 0; default: 0.1)
        road: Profile of the road; without it the road is a plane. (keys of a road)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "tyre", "nodes": nodes, "normal": normal, "axis": axis, "radius": radius,
            "position": position, "at": at, "stiffness": stiffness, "curve": curve, "damping": damping,
            "rolling_resistance": rolling_resistance, "slip": slip, "speed": speed, "road": road, "active": active,
            **more})

    def bushing(self, name: str, *,
            nodes: Sequence[Any], position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            stiffness: Mapping[str, Any] | Sequence[Any] | None = None, unsymmetric: bool | None = None,
            damping: Mapping[str, Any] | Sequence[Any] | float | str | None = None,
            preload: Sequence[Any] | None = None, curves: Mapping[str, Any] | None = None,
            film: Mapping[str, Any] | None = None, maxwell: Sequence[Any] | None = None,
            stops: Mapping[str, Any] | None = None, locked: Mapping[str, Any] | bool | float | str | None = None,
            clutch: Mapping[str, Any] | None = None, one_way: Mapping[str, Any] | None = None,
            start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, carries: str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """An elastic connection of two nodes by six stiffnesses, damping, curves, coefficients over a speed, and
        hysteresis.

        nodes: First and second node. (list of 2: name of a node)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        stiffness: Stiffness along and about x, y, z, or a symmetric matrix by rows without negative eigenvalues.
        ([number [N/m] of at least 0, number [N/m] of at least 0, number [N/m] of at least 0, number [N m/rad] of at
        least 0, number [N m/rad] of at least 0, number [N m/rad] of at least 0]; or list of 6: list of 6: number
        [N/m or N or N/rad or N m/rad]; or keys of a matrix)
        unsymmetric: Whether the matrix of the stiffness may be unsymmetric: cross-coupled terms, which drive or
        brake a whirl. Its symmetric part has no negative eigenvalue. (true or false; default: false)
        damping: Damping along and about x, y, z, or a matrix whose symmetric part has no negative eigenvalue, or a
        time that multiplies the stiffness. (number [s] of at least 0; or [number [N s/m] of at least 0, number [N
        s/m] of at least 0, number [N s/m] of at least 0, number [N m s/rad] of at least 0, number [N m s/rad] of at
        least 0, number [N m s/rad] of at least 0]; or list of 6: list of 6: number [N s/m or N s or N s/rad or N m
        s/rad]; or keys of a matrix)
        preload: Forces and moments that resist at zero coordinates. ([number [N], number [N], number [N], number [N
        m], number [N m], number [N m]]; default: [0, 0, 0, 0, 0, 0])
        curves: Forces that are added to the rest, by directions: tables of displacement and force, or formulas of
        the displacement q, its rate v, the time t and measures. (keys of `curves`, which names directions)
        film: Stiffness and damping over a speed that a measure gives, in addition to the others; they may be
        unsymmetric. (keys of a film of a bushing)
        maxwell: Branches of a spring and a damper in series, for hysteresis and relaxation. As drawn, and in
        statics, they carry no force. (list of at least 1: keys of a branch)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "bushing", "nodes": nodes, "position": position, "at": at, "axis": axis,
            "second_axis": second_axis, "stiffness": stiffness, "unsymmetric": unsymmetric, "damping": damping,
            "preload": preload, "curves": curves, "film": film, "maxwell": maxwell, "stops": stops, "locked": locked,
            "clutch": clutch, "one_way": one_way, "start": start, "start_rate": start_rate, "carries": carries,
            "active": active, **more})

    def bearing(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            radial: Mapping[str, Any] | Sequence[Any] | float | str | None = None,
            axial: Mapping[str, Any] | float | str | None = None,
            tilting: Mapping[str, Any] | Sequence[Any] | float | str | None = None,
            matrix: Mapping[str, Any] | None = None, film: Mapping[str, Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """An elastic hinge, whose shaft turns freely.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        radial: Radial stiffness: one number, two along x and y of the housing, or a matrix; or stiffness and
        damping. (number [N/m] of at least 0; or list of 2: number [N/m] of at least 0; or list of 2: list of 2:
        number [N/m]; or keys of a direction of a bearing)
        axial: Axial stiffness; or stiffness and damping. (number [N/m] of at least 0; or keys of a direction of a
        bearing; default: 0)
        tilting: Stiffness against tilting: one number, two about x and y of the housing, or a matrix; or stiffness
        and damping. (number [N m/rad] of at least 0; or list of 2: number [N m/rad] of at least 0; or list of 2:
        list of 2: number [N m/rad]; or keys of a direction of a bearing; default: 0)
        matrix: Stiffness and damping in all directions, in place of `radial`, `axial` and `tilting`. (keys of
        matrices of a bearing)
        film: Coefficients over the speed of the shaft, in addition to the others. (keys of a film of a bearing)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "bearing", "nodes": nodes, "axis": axis, "position": position, "at": at,
            "second_axis": second_axis, "radial": radial, "axial": axial, "tilting": tilting, "matrix": matrix,
            "film": film, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def ball_bearing(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], elements: float | str, pitch_diameter: float | str,
            ball_diameter: float | str, position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            second_axis: Sequence[Any] | None = None, grooves: Sequence[Any] | None = None,
            young: Sequence[Any] | float | str | None = None, poisson: Sequence[Any] | float | str | None = None,
            contact_angle: float | str | None = None, clearance: float | str | None = None,
            axial_preload: float | str | None = None, constant: float | str | None = None,
            discrete: bool | None = None, cage_angle: float | str | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A deep groove or angular contact ball bearing, by the contacts of its balls.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        elements: Number of balls. (whole number between 1 and 1000)
        pitch_diameter: Diameter of the circle of the balls. (number [m] greater than 0)
        ball_diameter: Diameter of a ball. (number [m] greater than 0)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        grooves: Radius of the grooves of the inner and the outer ring, in diameters of a ball; above 0.5. (list of
        2: number between 0.5 and 1; default: [0.52, 0.52])
        young: Young's modulus of rings and balls, or of each. (number [Pa] greater than 0; or list of 2: number [Pa]
        greater than 0; default: 2.07e11)
        poisson: Poisson's ratio likewise. (number between 0 and 0.5; or list of 2: number between 0 and 0.5;
        default: 0.3)
        contact_angle: Angle between the contact and the radial plane, below 90 degrees. With an angle the bearing
        carries the shaft along +z of its axis. (number [rad] of at least 0; default: 0)
        clearance: Diametral clearance: the radial play of the shaft; negative for an interference. (number [m];
        default: 0)
        axial_preload: Axial force on the shaft at the position as drawn, of a bearing with a contact angle. (number
        [N] of at least 0; default: 0)
        constant: Force of an element per deflection of both contacts together, to the power of the law. (number
        [N/m^1.5] greater than 0; default: from materials and radii)
        discrete: Whether single elements pass in a cage, so that the stiffness varies; otherwise they are spread
        evenly. (true or false; default: false)
        cage_angle: Azimuth of the first of discrete elements as drawn, from x about z. (number [rad]; default: 0)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "ball_bearing", "nodes": nodes, "axis": axis, "elements": elements,
            "pitch_diameter": pitch_diameter, "ball_diameter": ball_diameter, "position": position, "at": at,
            "second_axis": second_axis, "grooves": grooves, "young": young, "poisson": poisson,
            "contact_angle": contact_angle, "clearance": clearance, "axial_preload": axial_preload,
            "constant": constant, "discrete": discrete, "cage_angle": cage_angle, "stiffness": stiffness,
            "damping": damping, "rest": rest, "preload": preload, "stops": stops, "locked": locked, "clutch": clutch,
            "one_way": one_way, "start": start, "start_rate": start_rate, "friction": friction, "carries": carries,
            "active": active, **more})

    def roller_bearing(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], elements: float | str, pitch_diameter: float | str,
            roller_diameter: float | str, roller_length: float | str, position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            contact_angle: float | str | None = None, clearance: float | str | None = None,
            axial_preload: float | str | None = None, constant: float | str | None = None,
            discrete: bool | None = None, cage_angle: float | str | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A cylindrical or tapered roller bearing, by the contacts of its rollers.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        elements: Number of rollers. (whole number between 1 and 1000)
        pitch_diameter: Diameter of the circle of the rollers. (number [m] greater than 0)
        roller_diameter: Diameter of a roller. (number [m] greater than 0)
        roller_length: Length of contact of a roller. Steel rollers follow from it, by Palmgren's formula. (number
        [m] greater than 0)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        contact_angle: Angle between the contact and the radial plane, below 90 degrees. With an angle the bearing
        carries the shaft along +z of its axis. (number [rad] of at least 0; default: 0)
        clearance: Diametral clearance: the radial play of the shaft; negative for an interference. (number [m];
        default: 0)
        axial_preload: Axial force on the shaft at the position as drawn, of a bearing with a contact angle. (number
        [N] of at least 0; default: 0)
        constant: Force of an element per deflection of both contacts together, to the power of the law. (number
        [N/m^(10/9)] greater than 0; default: from materials and radii)
        discrete: Whether single elements pass in a cage, so that the stiffness varies; otherwise they are spread
        evenly. (true or false; default: false)
        cage_angle: Azimuth of the first of discrete elements as drawn, from x about z. (number [rad]; default: 0)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "roller_bearing", "nodes": nodes, "axis": axis, "elements": elements,
            "pitch_diameter": pitch_diameter, "roller_diameter": roller_diameter, "roller_length": roller_length,
            "position": position, "at": at, "second_axis": second_axis, "contact_angle": contact_angle,
            "clearance": clearance, "axial_preload": axial_preload, "constant": constant, "discrete": discrete,
            "cage_angle": cage_angle, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "friction": friction, "carries": carries, "active": active, **more})

    def journal_bearing(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], diameter: float | str, length: float | str,
            clearance: float | str, viscosity: float | str, position: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None, model: str | None = None,
            cavitation: str | None = None, stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, friction: Mapping[str, Any] | None = None,
            carries: str | None = None, active: bool | None = None, **more: Any) -> None:
        """A journal in the oil film of its bush.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        diameter: Diameter of the journal. (number [m] greater than 0)
        length: Length of the bush. (number [m] greater than 0)
        clearance: Radial clearance: half the difference of the diameters of bush and journal. (number [m] greater
        than 0)
        viscosity: Dynamic viscosity of the oil. (number [Pa s] greater than 0)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        model: Film of `finite` length, or of a `short` bearing, whose length is less than about half its diameter.
        (`short`, `finite`; default: finite)
        cavitation: Pressure on `half` of the circumference (Guembel), or no negative pressure, and no slope of the
        pressure at the edges of the film (`reynolds`: Swift, Stieber), for lengths up to 2 diameters. Short bearings
        are the same with both. (`half`, `reynolds`; default: half)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        friction: Friction of the sliding surfaces. (keys of `friction`; or map by coordinate: keys of `friction`)
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "journal_bearing", "nodes": nodes, "axis": axis, "diameter": diameter,
            "length": length, "clearance": clearance, "viscosity": viscosity, "position": position, "at": at,
            "second_axis": second_axis, "model": model, "cavitation": cavitation, "stiffness": stiffness,
            "damping": damping, "rest": rest, "preload": preload, "stops": stops, "locked": locked, "clutch": clutch,
            "one_way": one_way, "start": start, "start_rate": start_rate, "friction": friction, "carries": carries,
            "active": active, **more})

    def clearance_hinge(self, name: str, *,
            nodes: Sequence[Any], axis: Sequence[Any], radial_gap: float | str, contact: Mapping[str, Any],
            position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            second_axis: Sequence[Any] | None = None, radius: float | str | None = None,
            friction: Mapping[str, Any] | None = None, stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, carries: str | None = None,
            length: float | str | None = None, axial_gap: float | str | None = None,
            axial_contact: Mapping[str, Any] | None = None, active: bool | None = None, **more: Any) -> None:
        """A journal with play in a bush.

        nodes: First and second node. (list of 2: name of a node)
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number)
        radial_gap: Gap between journal and bush, or ball and socket: half the difference of the diameters. With 0
        contact begins at the centred position. (number [m] of at least 0)
        contact: Contact of the surfaces. (keys of a contact)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        radius: Radius of the journal or ball, at which friction acts; with 0 friction has no moment. (number [m] of
        at least 0; default: 0)
        friction: Friction of the surfaces. (keys of friction in a clearance)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        length: Length of the journal, which touches the bore at either end; this limits its tilt, and each end has a
        contact of its own. With 0 it touches in the middle alone. (number [m] of at least 0; default: 0)
        axial_gap: Axial play of the journal to either side, until its collars touch; without it the journal slides
        freely. (number [m] of at least 0)
        axial_contact: Contact of the collars. (keys of a contact; default: as `contact`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "clearance_hinge", "nodes": nodes, "axis": axis, "radial_gap": radial_gap,
            "contact": contact, "position": position, "at": at, "second_axis": second_axis, "radius": radius,
            "friction": friction, "stiffness": stiffness, "damping": damping, "rest": rest, "preload": preload,
            "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way, "start": start,
            "start_rate": start_rate, "carries": carries, "length": length, "axial_gap": axial_gap,
            "axial_contact": axial_contact, "active": active, **more})

    def clearance_spherical(self, name: str, *,
            nodes: Sequence[Any], radial_gap: float | str, contact: Mapping[str, Any],
            position: Sequence[Any] | None = None, at: Sequence[Any] | None = None,
            axis: Sequence[Any] | None = None, second_axis: Sequence[Any] | None = None,
            radius: float | str | None = None, friction: Mapping[str, Any] | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None,
            damping: Mapping[str, Any] | float | str | None = None,
            rest: Mapping[str, Any] | float | str | None = None,
            preload: Mapping[str, Any] | float | str | None = None, stops: Mapping[str, Any] | None = None,
            locked: Mapping[str, Any] | bool | float | str | None = None, clutch: Mapping[str, Any] | None = None,
            one_way: Mapping[str, Any] | None = None, start: Mapping[str, Any] | float | str | None = None,
            start_rate: Mapping[str, Any] | float | str | None = None, carries: str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A ball with play in a socket.

        nodes: First and second node. (list of 2: name of a node)
        radial_gap: Gap between journal and bush, or ball and socket: half the difference of the diameters. With 0
        contact begins at the centred position. (number [m] of at least 0)
        contact: Contact of the surfaces. (keys of a contact)
        position: Place of the joint as drawn, fixed on both nodes. (list of 3: number [m]; default: the position of
        the second node)
        at: Points in the axes of the first and of the second node, in place of `position`; the start brings the two
        together, in the directions that the joint constrains. (list of 2: list of 3: number [m])
        axis: Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each node,
        which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3: number;
        default: the inertial z axis)
        second_axis: Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each
        node, which the start makes fit if the joint constrains them. (list of 3: number; or list of 2: list of 3:
        number; default: the inertial axis most normal to z, as drawn)
        radius: Radius of the journal or ball, at which friction acts; with 0 friction has no moment. (number [m] of
        at least 0; default: 0)
        friction: Friction of the surfaces. (keys of friction in a clearance)
        stiffness: Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the
        coordinate or as a formula of q, counted from `rest`, its rate v, the time t and measures. (formula of q, v,
        t and measures [N/m or N m/rad] of at least 0; or keys of a law of force; or map by coordinate: formula of q,
        v, t and measures [N/m or N m/rad] of at least 0; or keys of a law of force)
        damping: Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of
        q, v, t and measures. (formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys of a law
        of force; or map by coordinate: formula of q, v, t and measures [N s/m or N m s/rad] of at least 0; or keys
        of a law of force)
        rest: Value of the coordinate at which the spring is free. (number [m or rad]; or map by coordinate: number
        [m or rad]; default: 0)
        preload: Resisting force of the spring at `rest`. (number [N or N m]; or map by coordinate: number [N or N
        m]; default: 0)
        stops: Ends of the way of the coordinate. (keys of `stops`; or map by coordinate: keys of `stops`)
        locked: Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for
        the whole run. (true or false; or number; or keys of `locked`; or map by coordinate: true or false; or
        number; or keys of `locked`)
        clutch: Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque.
        (keys of `clutch`; or map by coordinate: keys of `clutch`)
        one_way: One-way clutch or ratchet, which lets the coordinate move one way. (keys of `one_way`; or map by
        coordinate: keys of `one_way`)
        start: Value of the coordinate at the start of the first analysis. (number [m or rad]; or map by coordinate:
        number [m or rad])
        start_rate: Rate of the coordinate at the start of the first analysis. (number [m/s or rad/s]; or map by
        coordinate: number [m/s or rad/s])
        carries: Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates
        or the rates of its drives. (`all`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "clearance_spherical", "nodes": nodes, "radial_gap": radial_gap,
            "contact": contact, "position": position, "at": at, "axis": axis, "second_axis": second_axis,
            "radius": radius, "friction": friction, "stiffness": stiffness, "damping": damping, "rest": rest,
            "preload": preload, "stops": stops, "locked": locked, "clutch": clutch, "one_way": one_way,
            "start": start, "start_rate": start_rate, "carries": carries, "active": active, **more})

    def gear(self, name: str, *,
            joints: Sequence[Any], ratio: float | str | None = None, teeth: Sequence[Any] | None = None,
            internal: bool | None = None, factors: Sequence[Any] | None = None, stiffness: float | str | None = None,
            damping: float | str | None = None, backlash: float | str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """Coordinates of joints in a fixed ratio.

        joints: Coordinates that are coupled: angles of two joints; with `factors` any coordinates. (list of at least
        2: name of a joint; or formula of measures; or keys of a coordinate of a joint)
        ratio: Rate of the second coordinate over that of the first, with its sign; not 0. (number)
        teeth: Numbers of teeth of two wheels, in place of `ratio`. (list of 2: number greater than 0)
        internal: Whether one of two wheels with `teeth` is a ring. (true or false; default: false)
        factors: Factors of the coordinates, in place of `ratio`: the sum of factor times coordinate is zero. (list
        of at least 2: number)
        stiffness: Stiffness of the coupling, measured as an angle of the second joint (with `factors`, as their
        sum); without it the coupling is rigid. (number [N m/rad or N/m] greater than 0)
        damping: Damping of an elastic coupling, while its flanks touch. (number [N m s/rad or N s/m] of at least 0;
        default: 0)
        backlash: Play of an elastic coupling from flank to flank, measured as an angle of the second joint (with
        `factors`, as their sum); the model is drawn in its middle. (number [rad or m] of at least 0; default: 0)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "gear", "joints": joints, "ratio": ratio, "teeth": teeth,
            "internal": internal, "factors": factors, "stiffness": stiffness, "damping": damping,
            "backlash": backlash, "active": active, **more})

    def gear_mesh(self, name: str, *,
            nodes: Sequence[Any], axes: Sequence[Any], carrier: Mapping[str, Any] | str | None = None,
            radii: Sequence[Any] | None = None, position: Sequence[Any] | None = None, internal: bool | None = None,
            pressure_angle: float | str | None = None, helix_angle: float | str | None = None,
            stiffness: Mapping[str, Any] | float | str | None = None, damping: float | str | None = None,
            backlash: float | str | None = None,
            errors: Mapping[str, Any] | Sequence[Any] | float | str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """Forces between the teeth of two wheels, which load the bearings.

        nodes: Nodes of the two wheels, on their axes. (list of 2: name of a node)
        axes: Direction of both axes, or of the axis of each wheel, as drawn. (list of 3: number; or list of 2: list
        of 3: number)
        carrier: Node that carries the bearings of the wheels. (name of a node; default: ground)
        radii: Pitch radii of wheels on parallel axes. (list of 2: number [m] greater than 0)
        position: Point where the teeth meet, as drawn, in place of `radii`. (list of 3: number [m])
        internal: Whether the larger wheel is a ring with teeth inside. (true or false; default: false)
        pressure_angle: Pressure angle, less than pi/2. (number [rad] of at least 0; default: pi/9)
        helix_angle: Helix angle of the first wheel, between -pi/2 and pi/2; right-handed teeth have a positive one.
        (number [rad]; default: 0)
        stiffness: Stiffness of the teeth along their normal, also as a formula of the angles phi of the first and
        phi_2 of the second wheel; without it the pitch surfaces roll on each other exactly. (formula of phi and
        phi_2 [N/m] greater than 0; or keys of a stiffness of teeth)
        damping: Damping of elastic teeth along their normal. (number [N s/m] of at least 0; default: 0)
        backlash: Free play of elastic teeth along their normal. (number [m] of at least 0; default: 0)
        errors: Errors of the teeth along their normal, by which the second wheel is ahead when it is not loaded;
        also as a formula of the angles phi of the first and phi_2 of the second wheel. (formula of phi and phi_2
        [m]; or keys of an error of the teeth; or list: keys of an error of the teeth)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "gear_mesh", "nodes": nodes, "axes": axes, "carrier": carrier,
            "radii": radii, "position": position, "internal": internal, "pressure_angle": pressure_angle,
            "helix_angle": helix_angle, "stiffness": stiffness, "damping": damping, "backlash": backlash,
            "errors": errors, "active": active, **more})

    def differential(self, name: str, *,
            joints: Sequence[Any], ratio: float | str | None = None, stiffness: float | str | None = None,
            damping: float | str | None = None, backlash: float | str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """Angles of an input shaft and of two others that share its motion.

        joints: Angles of the input, the left and the right shaft. (list of 3: name of a joint; or formula of
        measures; or keys of a coordinate of a joint)
        ratio: Rate of the input over the mean of the other two; not 0. (number; default: 1)
        stiffness: Stiffness of the coupling, measured as an angle of the input; without it the coupling is rigid.
        (number [N m/rad] greater than 0)
        damping: Damping of an elastic coupling, while its flanks touch. (number [N m s/rad] of at least 0; default:
        0)
        backlash: Play of an elastic coupling from flank to flank, measured as an angle of the input; the model is
        drawn in its middle. (number [rad] of at least 0; default: 0)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "differential", "joints": joints, "ratio": ratio, "stiffness": stiffness,
            "damping": damping, "backlash": backlash, "active": active, **more})

    def rack_and_pinion(self, name: str, *,
            joints: Sequence[Any], radius: float | str, stiffness: float | str | None = None,
            damping: float | str | None = None, backlash: float | str | None = None, active: bool | None = None,
            **more: Any) -> None:
        """A displacement that is a radius times an angle.

        joints: Angle of the pinion and displacement of the rack. (list of 2: name of a joint; or formula of
        measures; or keys of a coordinate of a joint)
        radius: Displacement of the rack over the angle of the pinion; not 0. (number [m])
        stiffness: Stiffness of the coupling, measured as a displacement of the rack; without it the coupling is
        rigid. (number [N/m] greater than 0)
        damping: Damping of an elastic coupling, while its flanks touch. (number [N s/m] of at least 0; default: 0)
        backlash: Play of an elastic coupling from flank to flank, measured as a displacement of the rack; the model
        is drawn in its middle. (number [m] of at least 0; default: 0)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "rack_and_pinion", "joints": joints, "radius": radius,
            "stiffness": stiffness, "damping": damping, "backlash": backlash, "active": active, **more})

    def cam(self, name: str, *,
            joints: Sequence[Any], lift: str | None = None, profile: str | None = None, follower: str | None = None,
            radius: float | str | None = None, at: Sequence[Any] | None = None, normal: Sequence[Any] | None = None,
            friction: Mapping[str, Any] | None = None, active: bool | None = None, **more: Any) -> None:
        """A disk cam and its follower, by the contour of the cam or by the lift.

        joints: Angle of the camshaft and coordinate of the follower. (list of 2: name of a joint; or formula of
        measures; or keys of a coordinate of a joint)
        lift: Angles of the camshaft and coordinates of the follower; the last row is a period after the first. (file
        (table of two columns))
        profile: Angles [rad] and radii [m] of the contour, which a periodic cubic spline joins, in place of `lift`.
        (file (table of two columns))
        follower: Follower, which a `profile` needs. (`roller`, `flat`)
        radius: Radius of a roller; 0 is a knife edge. (number [m] of at least 0; default: 0)
        at: Middle of the roller, or point of the flat face, in the axes of the follower's node. (list of 3: number
        [m]; default: [0, 0, 0])
        normal: Normal of a flat face, away from the cam, as drawn; it needs one. (list of 3: number)
        friction: Friction of the contact, or of a roller on its pin. (keys of `friction`; or map by coordinate: keys
        of `friction`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "cam", "joints": joints, "lift": lift, "profile": profile,
            "follower": follower, "radius": radius, "at": at, "normal": normal, "friction": friction,
            "active": active, **more})

    def belt(self, name: str, *,
            nodes: Sequence[Any], radii: Sequence[Any], EA: float | str, axis: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, pretension: float | str | None = None,
            damping: float | str | None = None, friction: Sequence[Any] | None = None, active: bool | None = None,
            **more: Any) -> None:
        """A closed belt or chain that grips its pulleys, or slips on them with friction.

        nodes: Nodes in the order in which the rope passes them. (list of at least 2: name of a node)
        radii: Radii of the pulleys, one for each node: negative if the rope turns them backwards about `axis`, 0 for
        a point. (list: number [m])
        EA: Stiffness per strain: Young's modulus times area. (number [N] greater than 0)
        axis: Direction of the axes of all pulleys as drawn; points need none. (list of 3: number)
        at: Centres of the pulleys, each in the axes of its node; `~` is the node itself. (list: list of 3: number
        [m]; or `~`; default: the nodes)
        pretension: Tension as drawn. (number [N] of at least 0; default: 0)
        damping: Time constant of Kelvin-Voigt damping. (number [s] of at least 0; default: 0)
        friction: Coefficients of friction, one for each node; the belt grips pulleys with `~` without slip, one at
        least. (list: number of at least 0; or `~`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "belt", "nodes": nodes, "radii": radii, "EA": EA, "axis": axis, "at": at,
            "pretension": pretension, "damping": damping, "friction": friction, "active": active, **more})

    def cable(self, name: str, *,
            nodes: Sequence[Any], radii: Sequence[Any], EA: float | str, axis: Sequence[Any] | None = None,
            at: Sequence[Any] | None = None, pretension: float | str | None = None,
            damping: float | str | None = None, grips: Sequence[Any] | None = None,
            friction: Sequence[Any] | float | str | None = None, turns: Sequence[Any] | None = None,
            active: bool | None = None, **more: Any) -> None:
        """A rope from the first node to the last, over pulleys on which it slides, with friction or without.

        nodes: Nodes in the order in which the rope passes them. (list of at least 2: name of a node)
        radii: Radii of the pulleys, one for each node: negative if the rope turns them backwards about `axis`, 0 for
        a point. (list: number [m])
        EA: Stiffness per strain: Young's modulus times area. (number [N] greater than 0)
        axis: Direction of the axes of all pulleys as drawn; points need none. (list of 3: number)
        at: Centres of the pulleys, each in the axes of its node; `~` is the node itself. (list: list of 3: number
        [m]; or `~`; default: the nodes)
        pretension: Tension as drawn. (number [N] of at least 0; default: 0)
        damping: Time constant of Kelvin-Voigt damping. (number [s] of at least 0; default: 0)
        grips: Nodes of pulleys that the rope grips. (list: name of a node)
        friction: Coefficient of friction on all pulleys between the ends, or on each; the rope slides on the others
        (`~`) without friction. (number of at least 0; or list: number of at least 0; or `~`)
        turns: Whole turns round each pulley in addition to the rope as drawn; `~` is none. (list: whole number of at
        least 0; or `~`)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "cable", "nodes": nodes, "radii": radii, "EA": EA, "axis": axis, "at": at,
            "pretension": pretension, "damping": damping, "grips": grips, "friction": friction, "turns": turns,
            "active": active, **more})

    def contact(self, name: str, *,
            stiffness: float | str, shapes: Sequence[Any] | None = None, between: Sequence[Any] | None = None,
            exponent: float | str | None = None, damping: float | str | None = None,
            restitution: float | str | None = None, friction: Mapping[str, Any] | None = None,
            rolling_resistance: float | str | None = None, rolling_rate: float | str | None = None,
            active: bool | None = None, **more: Any) -> None:
        """Shapes on nodes that push each other apart when they touch.

        stiffness: Stiffness k of the force k p^n (1 + d pdot) at the depth p, in N/m^n with the `exponent` n.
        (number greater than 0)
        shapes: Shapes, every two of which may touch if they are on different nodes, unless neither can move. (list
        of at least 2: keys of a shape of a contact)
        between: Two lists of shapes, in place of `shapes`: those of one list touch those of the other alone. (list
        of 2: list of at least 1: keys of a shape of a contact)
        exponent: Exponent n of the force over the depth; 1.5 is a Hertzian contact. (number of at least 1; default:
        1.5)
        damping: Damping d of that force, with which the restitution falls with the speed. Without it and
        `restitution` impacts lose no energy. (number [s/m] of at least 0; default: 0)
        restitution: Ratio of rebound speed to impact speed of every impact, in place of `damping`: d follows from
        the speed at which a pair touches, of at least 1 mm/s, and does not change until it parts. (number greater
        than 0 and at most 1)
        friction: Friction of the surfaces. (keys of the friction of a contact)
        rolling_resistance: Arm b of a couple against rolling, b times the normal force. (number [m] of at least 0)
        rolling_rate: Angular velocity w_0 within which the couple is smooth, b N tanh(w/w_0). (number [rad/s]
        greater than 0; default: 0.01)
        active: `false`: the entry adds nothing until an action of an event activates it. (true or false; default:
        true)
        """
        self.add("joints", name, {"type": "contact", "stiffness": stiffness, "shapes": shapes, "between": between,
            "exponent": exponent, "damping": damping, "restitution": restitution, "friction": friction,
            "rolling_resistance": rolling_resistance, "rolling_rate": rolling_rate, "active": active, **more})

    def assembly(self, *,
            keep: Sequence[Any] | None = None, **more: Any) -> None:
        """Positions and velocities are made consistent, and recorded.

        keep: Nodes that stay exactly in place, and coordinates of joints, `joint.coordinate`, that keep their
        values. (list: name of a node; or name of a joint; or formula of measures; or keys of a coordinate that keeps
        its value)
        """
        self.add("analysis", None, {"type": "assembly", "keep": keep, **more})

    def static(self, *,
            steps: float | str | None = None, branch: float | str | None = None,
            arc_length: Mapping[str, Any] | None = None, newton: Mapping[str, Any] | None = None,
            **more: Any) -> None:
        """Equilibrium under the loads, which grow with the load factor.

        steps: Number of equal increments of the load factor, or `auto`. (whole number of at least 1; or `auto`;
        default: 1; `auto` with `arc_length`)
        branch: Deflection by which a load step leaves an equilibrium that becomes unstable, relative to the
        mechanism's size (or in radians). (number greater than 0 and at most 0.5)
        arc_length: Path of equilibria that is followed past limit points of the load, in place of load steps. (keys
        of `arc_length`)
        newton: Solution of the equations of a step by Newton's method. (keys of `newton`)
        """
        self.add("analysis", None, {"type": "static", "steps": steps, "branch": branch, "arc_length": arc_length,
            "newton": newton, **more})

    def dynamic(self, *,
            duration: float | str, step: float | str | None = None, tolerance: float | str | None = None,
            largest_step: float | str | None = None, scheme: str | None = None, rho: float | str | None = None,
            alpha: float | str | None = None, constraints: str | None = None,
            start: Mapping[str, Any] | str | None = None, newton: Mapping[str, Any] | None = None,
            **more: Any) -> None:
        """Motion by integration in time.

        duration: Duration of the motion. (number [s] greater than 0)
        step: Length of the steps; with `tolerance`, that of the first one. (number [s] greater than 0; default: with
        `tolerance` 1e-4 of the duration; else it is required)
        tolerance: Error of each adaptive step, relative to the size of the mechanism; without it steps are of equal
        length. (number between 0 and 1, both excluded)
        largest_step: Greatest length of adaptive steps. (number [s] greater than 0)
        scheme: Scheme of integration. (`generalized_alpha`, `hht`, `newmark`; default: generalized_alpha)
        rho: Spectral radius of `generalized_alpha` at infinite frequency; 1 is without dissipation. (number between
        0 and 1; default: 0.8)
        alpha: Parameter of `hht`; 0 is without dissipation. (number between 0 and 0.333333; default: 0.1)
        constraints: Form of the joints' constraints: `corrected` positions and, in fast turns, velocities;
        `stabilized` positions and velocities together; `position` alone. (`corrected`, `position`, `stabilized`;
        default: corrected)
        start: Positions at the start: `as_given`, or in static `equilibrium` under the loads. (`as_given`,
        `equilibrium`; or keys of a start; default: as_given)
        newton: Solution of the equations of a step by Newton's method. (keys of `newton`)
        """
        self.add("analysis", None, {"type": "dynamic", "duration": duration, "step": step, "tolerance": tolerance,
            "largest_step": largest_step, "scheme": scheme, "rho": rho, "alpha": alpha, "constraints": constraints,
            "start": start, "newton": newton, **more})

    def kinematic(self, *,
            duration: float | str, step: float | str, **more: Any) -> None:
        """Motion of rigid parts that is driven completely.

        duration: Duration of the motion. (number [s] greater than 0)
        step: Time from one position to the next. (number [s] greater than 0)
        """
        self.add("analysis", None, {"type": "kinematic", "duration": duration, "step": step, **more})

    def inverse_dynamics(self, *,
            duration: float | str, step: float | str, **more: Any) -> None:
        """Forces of a motion that is driven completely; elastic parts follow in equilibrium.

        duration: Duration of the motion. (number [s] greater than 0)
        step: Time from one position to the next. (number [s] greater than 0)
        """
        self.add("analysis", None, {"type": "inverse_dynamics", "duration": duration, "step": step, **more})

    def eigen(self, *,
            count: float | str | None = None, near: float | str | None = None, below: float | str | None = None,
            rotation: Mapping[str, Any] | None = None, shapes: bool | None = None, **more: Any) -> None:
        """Modes of small motions about the present state.

        count: Number of modes: the slowest besides rigid ones, or the nearest to `near`. (whole number of at least
        1; default: 20)
        near: Frequency around which modes are sought. (number [Hz] greater than 0)
        below: Limit of frequencies below which all modes are found. (number [Hz] greater than 0)
        rotation: Steady rotation into which the mechanism is brought first; small motions are about it. (keys of
        `rotation`)
        shapes: Whether the shapes of the modes are recorded. (true or false; default: true)
        """
        self.add("analysis", None, {"type": "eigen", "count": count, "near": near, "below": below,
            "rotation": rotation, "shapes": shapes, **more})

    def campbell(self, *,
            parameter: Any | None = None, **more: Any) -> None:
        """Modes over the speed of a rotor, each followed by its shape, and critical speeds.

        parameter: ()
        """
        self.add("analysis", None, {"type": "campbell", "parameter": parameter, **more})

    def frequency_response(self, *,
            inputs: Sequence[Any], outputs: Sequence[Any], frequencies: Mapping[str, Any] | Sequence[Any],
            modes: float | str | None = None, rotation: Mapping[str, Any] | None = None, **more: Any) -> None:
        """Harmonic responses of small motions.

        inputs: Inputs of the model, and forces or moments on nodes. (list of at least 1: name of an input; or keys
        of an input: a force on a node)
        outputs: Measures of the model, and motions of nodes. (list of at least 1: name of a measure; or keys of an
        output: what a node does)
        frequencies: The frequencies, as a list or a range. (list of at least 1: number [Hz] of at least 0; or keys
        of `frequencies`)
        modes: Number of the slowest modes over which responses are summed; without the key each frequency is solved
        directly. (whole number of at least 1)
        rotation: Steady rotation into which the mechanism is brought first; small motions are about it. (keys of
        `rotation`)
        """
        self.add("analysis", None, {"type": "frequency_response", "inputs": inputs, "outputs": outputs,
            "frequencies": frequencies, "modes": modes, "rotation": rotation, **more})

    def state_space(self, *,
            inputs: Sequence[Any], outputs: Sequence[Any], rotation: Mapping[str, Any] | None = None,
            **more: Any) -> None:
        """Small motions as matrices: E x' = A x + B u, y = C x + D u.

        inputs: Inputs of the model, and forces or moments on nodes. (list of at least 1: name of an input; or keys
        of an input: a force on a node)
        outputs: Measures of the model, and motions of nodes. (list of at least 1: name of a measure; or keys of an
        output: what a node does)
        rotation: Steady rotation into which the mechanism is brought first; small motions are about it. (keys of
        `rotation`)
        """
        self.add("analysis", None, {"type": "state_space", "inputs": inputs, "outputs": outputs,
            "rotation": rotation, **more})
