// Tests of every key of body files, and of the messages about wrong ones.
#include <set>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/input/key_words.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::reduce;
using bielle::test::message_of;
using Catch::Contains;

namespace {

// A small body file, in which tests replace single lines.
std::string body(const std::string& from = "", const std::string& to = "") {
  std::string text =
      "body: rod\n"                                                                // 1
      "geometry: conrod.geo\n"                                                     // 2
      "length_unit: mm\n"                                                          // 3
      "mesh: {size: 3e-3, order: 2}\n"                                             // 4
      "materials:\n"                                                               // 5
      "  steel: {young: 210e9, poisson: 0.3, density: 7850}\n"                     // 6
      "regions: {rod: steel}\n"                                                    // 7
      "interfaces:\n"                                                              // 8
      "  big_end: {surface: bore_big, tie: rigid}\n"                               // 9
      "  small_end: {surface: bore_small, tie: average, position: [0.2, 0, 0]}\n"  // 10
      "modes: {count: 20}\n"                                                       // 11
      "damping: {ratio: 0.01}\n"                                                   // 12
      "loads:\n"                                                                   // 13
      "  gas: {surface: crown, pressure: 1e5}\n"                                   // 14
      "recovery: {displacement: all, stress: surface}\n";                          // 15
  if (!from.empty()) {
    const std::size_t place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
  }
  return text;
}

BodyFile read(const std::string& from = "", const std::string& to = "") {
  return parse_body_file(body(from, to), "models/rod.yaml");
}

// Returns the message without the name of the file.
std::string message(const std::string& from, const std::string& to) {
  const std::string text = message_of<InputError>([&] { read(from, to); });
  return text.starts_with("models/rod.yaml:") ? text.substr(16) : text;
}

void check(const std::string& from, const std::string& to, const std::string& expected) {
  CAPTURE(to);
  CHECK_THAT(message(from, to), Catch::StartsWith(expected));
}

}  // namespace

TEST_CASE("a body file becomes a request for a mesh and the options of a reduction") {
  const BodyFile file = read();
  CHECK(file.mesh.path == "models/conrod.geo");
  CHECK(file.mesh.subject == "geometry");
  CHECK(file.mesh.length_unit == "mm");
  CHECK(file.mesh.size == 3e-3);
  CHECK(file.mesh.order == 2);
  REQUIRE(file.mesh.volumes.size() == 1);
  CHECK(file.mesh.volumes[0].group == "rod");
  CHECK(file.mesh.volumes[0].subject == "regions.rod");
  REQUIRE(file.mesh.surfaces.size() == 3);
  CHECK(file.mesh.surfaces[0].group == "bore_big");
  CHECK(file.mesh.surfaces[2].subject == "loads.gas.surface");

  const ReductionOptions& options = file.options;
  CHECK(options.name == "rod");
  CHECK(options.input_text == body());
  CHECK(options.regions == std::map<std::string, std::string>{{"rod", "steel"}});
  CHECK(options.materials.at("steel").density == 7850);
  CHECK(options.materials.at("steel").elasticity(3, 3) == Approx(210e9 / 2.6));
  REQUIRE(options.interfaces.size() == 2);
  CHECK(options.interfaces[0].name == "big_end");
  CHECK(options.interfaces[0].group == "bore_big");
  CHECK(options.interfaces[0].tie == Tie::rigid);
  CHECK_FALSE(options.interfaces[0].position.has_value());
  CHECK(options.interfaces[0].kept == std::array<bool, 6>{true, true, true, true, true, true});
  CHECK(options.interfaces[0].subject == "interfaces.big_end");
  CHECK(options.interfaces[1].tie == Tie::average);
  CHECK(options.interfaces[1].position == Eigen::Vector3d(0.2, 0, 0));
  CHECK(options.modes.count == 20);
  CHECK_FALSE(options.modes.below.has_value());
  CHECK(options.damping_ratios == std::vector<double>{0.01});
  CHECK_FALSE(options.rayleigh.has_value());
  REQUIRE(options.loads.size() == 1);
  CHECK(options.loads[0].pressure == 1e5);
  CHECK(options.loads[0].group == "crown");
  CHECK(options.displacement_recovery == RecoveryExtent::all);
  CHECK(options.stress_recovery == RecoveryExtent::surface);
}

TEST_CASE("optional keys may be left out") {
  const BodyFile file = parse_body_file(
      "body: bar\ngeometry: /data/bar.msh\nmaterials: {steel: {young: 210e9, poisson: 0.3, density: 7850}}\n"
      "regions: {all: steel}\ninterfaces: {end: {surface: end}}\nmodes: {below: \"5*1000\"}\n",
      "bar.yaml");
  CHECK(file.mesh.path == "/data/bar.msh");
  CHECK_FALSE(file.mesh.length_unit.has_value());
  CHECK_FALSE(file.mesh.size.has_value());
  CHECK_FALSE(file.mesh.order.has_value());
  CHECK(file.options.interfaces[0].tie == Tie::rigid);
  CHECK_FALSE(file.options.interfaces[0].position.has_value());
  CHECK(file.options.modes.below == 5000);
  CHECK_FALSE(file.options.modes.count.has_value());
  CHECK(file.options.damping_ratios.empty());
}

TEST_CASE("surfaces are selected by shape") {
  const BodyFile file = read("big_end: {surface: bore_big, tie: rigid}",
                             "big_end: {surface: {cylinder: {point: [1, 2, 3], axis: [0, 0, 2], radius: 0.024}}}");
  CHECK(file.options.interfaces[0].group == "interfaces.big_end");
  CHECK(file.options.interfaces[0].tie == Tie::rigid);
  const auto cylinder = std::get<ShapeSelector>(file.mesh.surfaces[0].selectors.front()).cylinder.value();
  CHECK(cylinder.point == Eigen::Vector3d(1, 2, 3));
  CHECK(cylinder.axis == Eigen::Vector3d(0, 0, 1));
  CHECK(cylinder.radius == 0.024);
  const BodyFile two =
      read("gas: {surface: crown,",
           "gas: {surface: [{plane: {point: [0, 0, 1], normal: [1, 0, 0]}}, {box: [[1, 1, 1], [0, 2, 0]]}, crown],");
  CHECK(two.options.loads[0].group == "loads.gas");
  REQUIRE(two.mesh.surfaces[2].selectors.size() == 3);
  CHECK(std::get<ShapeSelector>(two.mesh.surfaces[2].selectors[0]).plane->normal == Eigen::Vector3d(1, 0, 0));
  CHECK(std::get<ShapeSelector>(two.mesh.surfaces[2].selectors[1]).box->low == Eigen::Vector3d(0, 1, 0));
  CHECK(std::get<ShapeSelector>(two.mesh.surfaces[2].selectors[1]).box->high == Eigen::Vector3d(1, 2, 1));
  CHECK(std::get<std::string>(two.mesh.surfaces[2].selectors[2]) == "crown");
  const BodyFile both = read("surface: bore_big,",
                             "surface: {plane: {point: [0, 0, 1], normal: [1, 0, 0]}, box: [[0, 0, 0], [1, 1, 1]]},");
  const auto common = std::get<ShapeSelector>(both.mesh.surfaces[0].selectors.front());
  CHECK((common.plane && common.box && !common.cylinder));
  // Shapes in lower-level keys are checked too.
  check("surface: bore_big,", "surface: {cylinder: {point: [1, 2, 3], axis: [0, 0, 2], raduis: 1}},",
        "9: interfaces.big_end.surface.cylinder: 'raduis' is not a key of a cylinder; did you mean 'radius'?");
  check("surface: bore_big,", "surface: {cylinder: {point: [1, 2, 3], axis: [0, 0, 0], radius: 1}},",
        "9: interfaces.big_end.surface.cylinder.axis: ");
  check("surface: bore_big,", "surface: {cylinder: {point: [1, 2, 3], axis: [0, 0, 1], radius: -1}},",
        "9: interfaces.big_end.surface.cylinder.radius: expected a number greater than 0");
  check("surface: bore_big,", "surface: {cylnder: {}},",
        "9: interfaces.big_end.surface: 'cylnder' is not a key of a surface given by its shape; did you mean "
        "'cylinder'?");
  check("surface: bore_big,", "surface: {box: [[0, 0, 0]]},",
        "9: interfaces.big_end.surface.box: expected two opposite corners");
  check("surface: bore_big,", "surface: [],", "9: interfaces.big_end.surface: expected at least one surface");
  check("surface: bore_big,", "surface: {},", "9: interfaces.big_end.surface: expected a shape");
}

TEST_CASE("interfaces keep directions, may have axes of their own, and may be free") {
  const BodyFile some = read("tie: rigid", "directions: [x, rz], rotation_vector: [0, 0, \"pi/2\"]");
  CHECK(some.options.interfaces[0].kept == std::array<bool, 6>{true, false, false, false, false, true});
  CHECK((some.options.interfaces[0].rotation - Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).matrix())
            .norm() < 1e-15);
  const BodyFile axes = read("tie: rigid", "axes: {x: [0, 2, 0], y: [-1, 1, 0]}");
  CHECK((axes.options.interfaces[0].rotation - Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).matrix())
            .norm() < 1e-15);
  const BodyFile free = read("tie: rigid", "tie: free");
  CHECK(free.options.interfaces[0].tie == Tie::free);
  CHECK(free.options.interfaces[0].kept == std::array<bool, 6>{true, true, true, false, false, false});

  check("tie: rigid", "tie: rigd", "9: interfaces.big_end.tie: 'rigd' is not a tie; did you mean 'rigid'?");
  check("tie: rigid", "directions: [x, tx]", "9: interfaces.big_end.directions[2]: 'tx' is not a direction");
  check("tie: rigid", "directions: [x, x]", "9: interfaces.big_end.directions[2]: 'x' stands here twice");
  check("tie: rigid", "directions: []", "9: interfaces.big_end.directions: expected at least one direction");
  check("tie: rigid", "directions: x", "9: interfaces.big_end.directions: expected a list");
  check("tie: rigid", "tie: free, directions: [x, rx]",
        "9: interfaces.big_end.directions[2]: the nodes of a free interface have no rotations");
  check("tie: rigid", "tie: free, position: [0, 0, 0]",
        "9: interfaces.big_end.position: a free interface is each of its nodes where it is");
  check("tie: rigid", "axes: {x: [1, 0, 0], y: [2, 0, 0]}",
        "9: interfaces.big_end.axes: expected two directions that are not parallel");
  check("tie: rigid", "axes: {x: [1, 0, 0], y: [0, 1, 0]}, rotation_vector: [0, 0, 1]",
        "9: interfaces.big_end: expected either axes or rotation_vector");
  check("tie: rigid", "positon: [0, 0, 0]",
        "9: interfaces.big_end: 'positon' is not a key of an interface; did you mean 'position'?");
  check("surface: bore_big, tie: rigid", "tie: rigid", "9: interfaces.big_end: the key 'surface' is missing");
  check("big_end:", "big/end:", "9: interfaces.big/end: expected a name without '/'");
}

TEST_CASE("modes are chosen by number, by frequency or by both") {
  CHECK(read("count: 20", "count: 0").options.modes.count == 0);
  const BodyFile both = read("count: 20", "count: 20, below: 3e3");
  CHECK(both.options.modes.count == 20);
  CHECK(both.options.modes.below == 3000);
  CHECK(both.options.modes.method == EigenMethod::automatic);
  CHECK(read("count: 20", "count: 20, method: auto").options.modes.method == EigenMethod::automatic);
  CHECK(read("count: 20", "count: 20, method: arpack").options.modes.method == EigenMethod::arpack);
  CHECK(read("count: 20", "count: 20, method: block_lanczos").options.modes.method == EigenMethod::block_lanczos);
  check("count: 20", "count: 20, method: lanczos", "11: modes.method: 'lanczos' is not a method for modes");
  check("count: 20", "count: -1", "11: modes.count: expected a number of at least 0, found -1");
  check("count: 20", "count: 2.5", "11: modes.count: expected a whole number, found 2.5");
  check("count: 20", "below: 0", "11: modes.below: expected a number greater than 0");
  check("{count: 20}", "{}", "11: modes: expected how many modes: count, or below [Hz], or both");
  check("modes: {count: 20}\n", "", "1: the key 'modes' is missing");
}

TEST_CASE("damping is one ratio, one per mode, or Rayleigh's two numbers") {
  CHECK(read("ratio: 0.01", "ratio: [0.01, 0.02, 0]").options.damping_ratios == std::vector<double>{0.01, 0.02, 0});
  const BodyFile rayleigh = read("ratio: 0.01", "rayleigh: [1.5, 2e-6]");
  CHECK(rayleigh.options.rayleigh == std::array<double, 2>{1.5, 2e-6});
  CHECK(rayleigh.options.damping_ratios.empty());
  check("ratio: 0.01", "ratio: -0.01", "12: damping.ratio: expected a number of at least 0");
  check("ratio: 0.01", "ratio: []", "12: damping.ratio: expected a number or a list of numbers");
  check("ratio: 0.01", "rayleigh: [1]", "12: damping.rayleigh: expected [alpha, beta]");
  check("ratio: 0.01", "rayleigh: [1, 1], ratio: 0.1", "12: damping: expected either ratio or rayleigh");
  check("ratio: 0.01", "ration: 0.01", "12: damping: 'ration' is not a key of the damping; did you mean 'ratio'?");
}

TEST_CASE("loads are a pressure, a traction or a force") {
  CHECK(read("pressure: 1e5", "traction: [0, 0, 2]").options.loads[0].traction == Eigen::Vector3d(0, 0, 2));
  CHECK(read("pressure: 1e5", "force: [0, 3, 0]").options.loads[0].force == Eigen::Vector3d(0, 3, 0));
  check("pressure: 1e5", "pressure: 1e5, force: [0, 3, 0]", "14: loads.gas: expected exactly one of pressure");
  check(", pressure: 1e5", "", "14: loads.gas: expected exactly one of pressure");
  check("pressure: 1e5", "pressure: 0", "14: loads.gas.pressure: a pattern of zero pressure loads nothing");
  check("pressure: 1e5", "force: [0, 0, 0]", "14: loads.gas.force: a pattern of zero force loads nothing");
  check("pressure: 1e5", "force: [0, 3]", "14: loads.gas.force: ");
}

TEST_CASE("points are places or means of surfaces, and may request residual vectors") {
  const auto with = [](const std::string& points) { return read("loads:\n", "points: {" + points + "}\nloads:\n"); };
  const BodyFile file = with(
      "sensor: {at: [1, 2, 3]}, pad: {group: crown, position: [0, 0, 1], residual: [x, z, ry]}, "
      "pin: {at: [0, 0, 0], residual: true}, flat: {group: {plane: {point: [0, 0, 1], normal: [1, 0, 0]}}}");
  const std::vector<PointRequest>& points = file.options.points;
  REQUIRE(points.size() == 4);
  CHECK(points[0].name == "sensor");
  CHECK(points[0].group.empty());
  CHECK(points[0].position == Eigen::Vector3d(1, 2, 3));
  CHECK(points[0].residual == std::array<bool, 6>{});
  CHECK(points[0].subject == "points.sensor");
  CHECK(points[1].group == "crown");
  CHECK(points[1].position == Eigen::Vector3d(0, 0, 1));
  CHECK(points[1].residual == std::array<bool, 6>{true, false, true, false, true, false});
  CHECK(points[2].residual == std::array<bool, 6>{true, true, true, true, true, true});
  CHECK(points[3].group == "points.flat");
  CHECK_FALSE(points[3].position.has_value());
  REQUIRE(file.mesh.surfaces.size() == 5);
  CHECK(file.mesh.surfaces[3].subject == "points.pad.group");
  CHECK(read("order: 2}\n", "order: 2, sizes: {pad: 1e-3}}\npoints: {pad: {group: crown}}\n")
            .mesh.sizes.at("crown")
            .size == 1e-3);
  CHECK(read("pressure: 1e5", "pressure: 1e5, residual: true").options.loads[0].residual);
  CHECK_FALSE(read().options.loads[0].residual);

  const auto refused = [](const std::string& point, const std::string& expected) {
    check("loads:\n", "points: {pin: " + point + "}\nloads:\n", expected);
  };
  refused("{}", "13: points.pin: expected either `group`, a surface whose mean the point follows, or `at`");
  refused("{at: [0, 0, 0], group: crown}", "13: points.pin: expected either `group`");
  refused("{at: [0, 0]}", "13: points.pin.at: ");
  refused("{at: [0, 0, 0], position: [0, 0, 0]}", "13: points.pin.position: `at` is its position: remove this key");
  refused("{at: [0, 0, 0], residul: true}",
          "13: points.pin: 'residul' is not a key of a point; did you mean 'residual'?");
  refused("{at: [0, 0, 0], residual: some}", "13: points.pin.residual: expected true or false");
  refused("{at: [0, 0, 0], residual: [x, xr]}", "13: points.pin.residual[2]: 'xr' is not a direction");
  refused("{at: [0, 0, 0], residual: [x, x]}", "13: points.pin.residual[2]: 'x' stands here twice");
  refused("{at: [0, 0, 0], residual: []}", "13: points.pin.residual: expected at least one direction");
  check("pressure: 1e5", "pressure: 1e5, residual: 2", "14: loads.gas.residual: expected true or false");
  check("gas: {surface", "g/as: {surface", "14: loads.g/as: expected a name without '/'");
}

TEST_CASE("recovery selects displacements and stress") {
  const BodyFile file = read("{displacement: all, stress: surface}", "{displacement: surface, stress: none}");
  CHECK(file.options.displacement_recovery == RecoveryExtent::surface);
  CHECK(file.options.stress_recovery == RecoveryExtent::none);
  check("displacement: all, stress: surface", "displacement: surface, stress: all",
        "15: recovery: 'stress: all' needs 'displacement: all'");
  check("stress: surface", "stress: some", "15: recovery.stress: 'some' is not an extent of recovery");
  check("stress: surface", "strain: surface", "15: recovery.strain: strain follows from stress and material");
}

TEST_CASE("mesh sizes are given by group, interface or load") {
  const BodyFile file = read("order: 2", "order: 1, sizes: {big_end: 1e-3, gas: 2e-3, web: 4e-3}");
  CHECK(file.mesh.order == 1);
  CHECK(file.mesh.sizes.at("bore_big").size == 1e-3);
  CHECK(file.mesh.sizes.at("crown").size == 2e-3);
  CHECK(file.mesh.sizes.at("web").size == 4e-3);
  CHECK(file.mesh.sizes.at("web").subject == "mesh.sizes.web");
  check("order: 2", "order: 3", "4: mesh.order: expected a number between 1 and 2, found 3");
  check("size: 3e-3", "size: 0", "4: mesh.size: expected a number greater than 0");
  check("order: 2", "ordre: 2", "4: mesh: 'ordre' is not a key of the mesh; did you mean 'order'?");
  check("order: 2", "sizes: {big_end: 1e-3, bore_big: 2e-3}",
        "4: mesh.sizes.bore_big: the surface of 'bore_big' has a size by the name 'big_end' already");
}

TEST_CASE("regions name materials that exist") {
  check("{rod: steel}", "{rod: stel}", "7: regions.rod: there is no material 'stel'; did you mean 'steel'?");
  check("{rod: steel}", "{rod: steel, all: steel}", "7: regions: 'all' is the whole body");
  check("{rod: steel}", "{}", "7: regions: expected at least one region");
  check("regions: {rod: steel}\n", "", "1: the key 'regions' is missing");
}

TEST_CASE("unknown keys, missing ones and invalid numbers are refused") {
  check("interfaces:", "interfacs:", "8: 'interfacs' is not a key of a body file; did you mean 'interfaces'?");
  check("body: rod\n", "", "1: the key 'body' is missing");
  check("geometry: conrod.geo\n", "", "1: the key 'geometry' is missing");
  check(
      "interfaces:\n  big_end: {surface: bore_big, tie: rigid}\n  small_end: {surface: bore_small, tie: average, "
      "position: [0.2, 0, 0]}\n",
      "", "1: the key 'interfaces' is missing");
  check("young: 210e9", "young: stiff", "6: materials.steel.young: ");
  CHECK(message_of<InputError>([] { read_body_file("/nowhere/rod.yaml"); }) ==
        "/nowhere/rod.yaml: there is no such file");
}

TEST_CASE("values have units: lengths, angles, pressures, frequencies and damping") {
  CHECK(read("size: 3e-3", "size: 3 mm").mesh.size == Approx(3e-3));
  CHECK(read("order: 2", "order: 2, sizes: {big_end: 20 um}").mesh.sizes.at("bore_big").size == Approx(2e-5));
  CHECK(read("pressure: 1e5", "pressure: 80 bar").options.loads[0].pressure == Approx(8e6));
  CHECK(read("pressure: 1e5", "traction: [0, 0, 2 MPa]").options.loads[0].traction->z() == Approx(2e6));
  CHECK(read("pressure: 1e5", "force: [0, 3 kN, 0]").options.loads[0].force->y() == Approx(3000));
  CHECK(read("count: 20", "below: 3 kHz").options.modes.below == Approx(3000));
  CHECK(read("ratio: 0.01", "rayleigh: [2 1/s, 3 ms]").options.rayleigh->at(1) == Approx(3e-3));
  const BodyFile turned = read("tie: rigid", "position: [12 mm, 0, 0], rotation_vector: [0, 0, 90 deg]");
  CHECK(turned.options.interfaces[0].position->x() == Approx(0.012));
  CHECK(turned.options.interfaces[0].rotation(1, 0) == Approx(1));
  const auto cylinder = [](const std::string& radius) {
    return "surface: {cylinder: {point: [1 mm, 0, 0], axis: [0, 0, 1], radius: " + radius + "}},";
  };
  const BodyFile bore = read("surface: bore_big,", cylinder("24 mm"));
  const auto shape = std::get<ShapeSelector>(bore.mesh.surfaces[0].selectors.front()).cylinder.value();
  CHECK(shape.radius == Approx(0.024));
  CHECK(shape.point.x() == Approx(1e-3));
  CHECK(read("loads:\n", "points: {pin: {at: [0, 0, 5 mm]}}\nloads:\n").options.points[0].position->z() ==
        Approx(5e-3));

  const auto wrong = [](const std::string& unit, const std::string& found) {
    return "expected a value in " + unit + ", found one in '" + found + "', which measures something else";
  };
  check("size: 3e-3", "size: 3 kg", "4: mesh.size: " + wrong("m", "kg"));
  check("size: 3e-3", "size: -3 mm", "4: mesh.size: expected a number greater than 0, found -0.003");
  check("pressure: 1e5", "pressure: 80 mm", "14: loads.gas.pressure: " + wrong("Pa", "mm"));
  check("count: 20", "below: 3000 rpm", "11: modes.below: " + wrong("Hz", "rpm"));
  check("ratio: 0.01", "rayleigh: [2, 3 Hz]", "12: damping.rayleigh[2]: " + wrong("s", "Hz"));
  check("ratio: 0.01", "ratio: 1 %", "12: damping.ratio: expected a number without a unit, found the unit '%'");
  check("tie: rigid", "position: [12 deg, 0, 0]", "9: interfaces.big_end.position[1]: " + wrong("m", "deg"));
  check("surface: bore_big,", cylinder("24 s"), "9: interfaces.big_end.surface.cylinder.radius: " + wrong("m", "s"));
  check("loads:\n", "points: {pin: {at: [0, 0, 5 N]}}\nloads:\n", "13: points.pin.at[3]: " + wrong("m", "N"));
}

TEST_CASE("the unit of the geometry is a word, and scales the geometry alone") {
  CHECK(read("length_unit: mm", "length_unit: in").mesh.size == 3e-3);
  check("length_unit: mm", "length_unit: mn",
        "3: length_unit: 'mn' is not a unit of length; expected one of 'm', 'mm'");
}

TEST_CASE("keys without values are empty maps, and values other than maps are refused") {
  CHECK(read("{displacement: all, stress: surface}", "").options.stress_recovery == RecoveryExtent::surface);
  check("{ratio: 0.01}", "", "12: damping: expected either ratio or rayleigh");
  check("{size: 3e-3, order: 2}", "3e-3", "4: mesh: expected the mesh as keys with values");
  check("{surface: bore_big, tie: rigid}", "bore_big", "9: interfaces.big_end: expected an interface as keys");
}

TEST_CASE("each key of a body file is in one table, with a sentence") {
  std::set<std::string> names;
  for (const KeyTable* table : tables_below(body_file_keys())) {
    CAPTURE(table->of);
    CHECK(names.insert(table->of).second);
    CHECK_THAT(table->about, Catch::EndsWith("."));
    for (const Key& key : table->keys) {
      CAPTURE(key.name);
      CHECK_THAT(key.about, Catch::EndsWith("."));
    }
  }
  for (const char* name : {"an interface", "a load", "the mesh", "an orthotropic material", "an arc", "a cylinder"})
    CHECK(names.contains(name));
}

TEST_CASE("numbers may use parameters of the file, and parameters those above them") {
  const BodyFile file = read("body: rod\n", "body: rod\nparameters: {mm: 1e-3, fine: 2*mm}\n");
  CHECK(file.mesh.size == 3e-3);
  std::string text = body("size: 3e-3", "size: \"fine\"");
  text = "parameters: {mm: 1e-3, fine: \"2*mm\"}\n" + text;
  CHECK(parse_body_file(text, "rod.yaml").mesh.size == Approx(2e-3));
  text = "parameters: {fine: 2 mm}\n" + body("size: 3e-3", "size: fine");
  CHECK(parse_body_file(text, "rod.yaml").mesh.size == Approx(2e-3));
}

TEST_CASE("Masses are read with every key") {
  const BodyFile file =
      read("recovery:",
           "masses:\n"
           "  motor: {surface: crown, mass: 2 t, position: [1, 2, 3], inertia: [2, 3, 4], axes: {x: [0, 1, "
           "0], y: [0, 0, 1]}}\n"
           "  bolt: {at: [0.1, 0, 0], mass: 0.2}\n"
           "  paint: {surface: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, per_area: 0.5}\n"
           "lumped: true\n"
           "recovery:");
  const ReductionOptions& options = file.options;
  REQUIRE(options.masses.size() == 2);
  CHECK(options.masses[0].group == "crown");
  CHECK(options.masses[0].mass == 2000);
  CHECK(*options.masses[0].position == Eigen::Vector3d(1, 2, 3));
  CHECK(options.masses[0].inertia.isApprox(Eigen::Matrix3d(Eigen::Vector3d(4, 2, 3).asDiagonal()), 1e-15));
  CHECK(*options.masses[1].place == Eigen::Vector3d(0.1, 0, 0));
  CHECK(options.masses[1].inertia.isZero(0));
  CHECK_FALSE(options.masses[1].position);
  REQUIRE(options.coatings.size() == 1);
  CHECK(options.coatings[0].group == "masses.paint");
  CHECK(options.coatings[0].mass_per_area == 0.5);
  CHECK(options.lumped);
  CHECK_FALSE(read().options.lumped);
}

TEST_CASE("Wrong masses are refused with the expected value") {
  const auto refusal = [](const std::string& mass) {
    return message("recovery:", "masses:\n  motor: " + mass + "\nrecovery:");
  };
  CHECK_THAT(refusal("{mass: 1}"), Contains("16: masses.motor: expected either `surface`"));
  CHECK_THAT(refusal("{mass: 1, surface: crown, at: [0, 0, 0]}"), Contains("expected either `surface`"));
  CHECK_THAT(refusal("{surface: crown}"), Contains("mass"));
  CHECK_THAT(refusal("{surface: crown, mass: 0}"), Contains("masses.motor.mass: "));
  CHECK_THAT(refusal("{surface: crown, mass: -1}"), Contains("masses.motor.mass: "));
  CHECK_THAT(refusal("{surface: crown, mass: 1 m}"), Contains("masses.motor.mass: "));
  CHECK_THAT(refusal("{surface: crown, mas: 1}"), Contains("did you mean 'mass'"));
  CHECK_THAT(refusal("{surface: crown, mass: 1, axes: {x: [1, 0, 0], y: [0, 1, 0]}}"),
             Contains("masses.motor.axes: they are the axes of `inertia`, which is not given"));
  CHECK_THAT(refusal("{surface: crown, mass: 1, inertia: [1, 1, 3]}"), Contains("no body has this inertia"));
  CHECK_THAT(refusal("{surface: crown, mass: 1, inertia: [0, 0, 0]}"), Contains("must be positive definite"));
  CHECK_THAT(refusal("{surface: crown, mass: 1, inertia: 3}"), Contains("masses.motor.inertia: "));
  CHECK_THAT(refusal("{surface: crown, mass: 1, inertia: [[1, 1, 0], [0, 1, 0], [0, 0, 1]]}"), Contains("symmetric"));
  CHECK_THAT(refusal("{surface: crown, per_area: 1, mass: 1}"), Contains("masses.motor.mass: `per_area` spreads mass"));
  CHECK_THAT(refusal("{at: [0, 0, 0], per_area: 1}"), Contains("masses.motor.at: `per_area` spreads mass"));
  CHECK_THAT(refusal("{surface: crown, per_area: 0}"), Contains("masses.motor.per_area: "));
  CHECK_THAT(refusal("3"), Contains("masses.motor: "));
  CHECK_THAT(message("recovery:", "lumped: 2\nrecovery:"), Contains("15: lumped: expected true or false"));
}
