#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/superelement/named_points.hpp"
#include "reduce/superelement/superelement.hpp"
#include "reduce/superelement/superelement_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using bielle::test::message_of;
using bielle::test::TemporaryFolder;
using Catch::Matchers::Contains;
using Eigen::MatrixXd;

namespace {

MatrixXd symmetric(Eigen::Index n) {
  const MatrixXd a = MatrixXd::Random(n, n);
  return a * a.transpose() + MatrixXd::Identity(n, n);
}

/// Returns a body with all parts filled: two interfaces with 6 and 4 kept directions and 3 modes, n = 13.
Superelement sample() {
  std::srand(7);
  const Eigen::Index n = 13, m = 3, p = 5;
  Superelement body;
  body.name = "Kurbel Ø";
  body.created_by = "bielle-reduce 1.0";
  body.input = "body: crank\n";
  Interface free, held;
  free.name = "big_end";
  free.position = {1, 2, 3};
  held.name = "small_end";
  held.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  held.kept = {true, true, false, true, false, true};
  body.interfaces = {free, held};
  body.stiffness = symmetric(n);
  body.mass = symmetric(n);
  body.frequencies = (body.stiffness.diagonal().tail(m).array() / body.mass.diagonal().tail(m).array()).sqrt() /
                     (2 * std::numbers::pi);
  body.damping = symmetric(n);
  for (std::size_t k = 0; k < 6; ++k) {
    body.inertia_components[k] = k < 3 ? symmetric(n) : MatrixXd(MatrixXd::Random(n, n));
    body.spin_stiffness[k] = symmetric(n);
  }
  for (int k = 0; k < 10; ++k) body.load_stiffness.push_back(symmetric(n));
  body.effective_mass = MatrixXd::Random(m, 6);
  body.total_mass = 2.5;
  body.centre = {0.1, 0.2, 0.3};
  body.inertia = symmetric(3);
  for (auto& force : body.loads["gas / crown 50%"].force) force = Eigen::Matrix3Xd::Random(3, n);
  body.residual_vectors = 1;
  body.points["pad. left"] = {{4, 5, 6}, MatrixXd::Random(6, n), {true, false, true, false, true, false}};
  body.points["tip"] = {{7, 8, 9}, MatrixXd::Random(6, n), {}};
  body.mesh.points = Eigen::Matrix3Xd::Random(3, p);
  body.mesh.cells[4].resize(4, 2);
  body.mesh.cells[4] << 0, 1, 1, 2, 2, 3, 3, 4;
  body.mesh.groups["bore. big"] = {0, 2};
  body.mesh.groups["none"] = {};
  body.displacement_recovery = MatrixXd::Random(3 * p, n);
  body.stress_nodes = {1, 4};
  body.stress_recovery = MatrixXd::Random(12, n);
  body.stress_origin.materials = {{"steel", symmetric(6)}, {"rubber", symmetric(6)}};
  body.stress_origin.material_of = {1, 0};
  body.stress_origin.groups = {{"web. thin", {0}}, {"hub", {0, 1}}};
  body.checks = {{"mass error", 1e-9}, {"rigid/energy", 3}};
  return body;
}

/// Returns the smallest superelement, with one interface and no modes.
Superelement smallest() {
  Superelement body;
  body.interfaces.resize(1);
  body.interfaces[0].name = "hub";
  body.stiffness = MatrixXd::Zero(6, 6);
  body.mass = symmetric(6);
  body.damping = MatrixXd::Zero(6, 6);
  for (MatrixXd& component : body.inertia_components) component = MatrixXd::Zero(6, 6);
  body.effective_mass.resize(0, 6);
  body.total_mass = 1;
  return body;
}

std::string written(const TemporaryFolder& folder, const Superelement& body) {
  write_superelement(body, folder / "body.h5");
  return folder / "body.h5";
}

/// Returns the reason why a sample whose file was changed is refused.
std::string why_refused(const std::function<void(Hdf5File&)>& damage) {
  const TemporaryFolder folder;
  const std::string path = written(folder, sample());
  {
    Hdf5File file = Hdf5File::open_to_extend(path);
    damage(file);
  }
  return message_of<InputError>([&] { read_superelement(path); });
}

void replace(Hdf5File& file, const std::string& dataset, const MatrixXd& values) {
  file.remove(dataset);
  file.write(dataset, values, "-");
}

}  // namespace

TEST_CASE("A superelement is read as it was written") {
  const TemporaryFolder folder;
  const Superelement a = sample(), b = read_superelement(written(folder, a));
  CHECK(b.name == a.name);
  CHECK(b.created_by == a.created_by);
  CHECK(b.input == a.input);
  REQUIRE(b.interfaces.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(b.interfaces[i].name == a.interfaces[i].name);
    CHECK(b.interfaces[i].position == a.interfaces[i].position);
    CHECK(b.interfaces[i].rotation == a.interfaces[i].rotation);
    CHECK(b.interfaces[i].kept == a.interfaces[i].kept);
  }
  CHECK(b.frequencies == a.frequencies);
  CHECK(b.stiffness == a.stiffness);
  CHECK(b.mass == a.mass);
  CHECK(b.damping == a.damping);
  CHECK(b.inertia_components == a.inertia_components);
  CHECK(b.spin_stiffness == a.spin_stiffness);
  CHECK(b.load_stiffness == a.load_stiffness);
  CHECK(b.effective_mass == a.effective_mass);
  CHECK(b.total_mass == a.total_mass);
  CHECK(b.centre == a.centre);
  CHECK(b.inertia == a.inertia);
  REQUIRE(b.loads.count("gas / crown 50%") == 1);
  CHECK(b.loads.at("gas / crown 50%").force == a.loads.at("gas / crown 50%").force);
  CHECK(b.residual_vectors == 1);
  REQUIRE(b.points.size() == 2);
  for (const char* name : {"pad. left", "tip"}) {
    CHECK(b.points.at(name).position == a.points.at(name).position);
    CHECK(b.points.at(name).shapes == a.points.at(name).shapes);
    CHECK(b.points.at(name).residual == a.points.at(name).residual);
  }
  CHECK(b.mesh.points == a.mesh.points);
  CHECK(b.mesh.cells == a.mesh.cells);
  CHECK(b.mesh.groups == a.mesh.groups);
  CHECK(b.displacement_recovery == a.displacement_recovery);
  CHECK(b.stress_recovery == a.stress_recovery);
  CHECK(b.stress_nodes == a.stress_nodes);
  REQUIRE(b.stress_origin.materials.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(b.stress_origin.materials[k].name == a.stress_origin.materials[k].name);
    CHECK(b.stress_origin.materials[k].elasticity == a.stress_origin.materials[k].elasticity);
  }
  CHECK(b.stress_origin.material_of == a.stress_origin.material_of);
  CHECK(b.stress_origin.groups == a.stress_origin.groups);
  CHECK(b.checks == a.checks);
  CHECK(b.size() == 13);
  CHECK(b.interface_directions() == 10);
}

TEST_CASE("Missing parts of a superelement are empty") {
  const TemporaryFolder folder;
  const Superelement b = read_superelement(written(folder, smallest()));
  CHECK(b.modes() == 0);
  CHECK(b.residual_vectors == 0);
  CHECK(b.points.empty());
  CHECK(b.spin_stiffness[0].size() == 0);
  CHECK(b.load_stiffness.empty());
  CHECK(b.displacement_recovery.size() == 0);
  CHECK(b.stress_recovery.size() == 0);
  CHECK(b.mesh.points.cols() == 0);
}

TEST_CASE("The file has the documented layout") {
  const TemporaryFolder folder;
  const Superelement body = sample();
  const Hdf5File file = Hdf5File::open(written(folder, body));
  CHECK(file.read_text_attribute("/", "format") == "bielle superelement");
  CHECK(file.read_integer_attribute("/", "version") == 2);
  CHECK(file.read_integer_attribute("/", "complete") == 1);
  CHECK(file.read_text("/input") == body.input);
  CHECK(file.shape("/interface/dofs") == Shape{2, 6});
  CHECK(file.shape("/interface/rotations") == Shape{2, 3, 3});
  CHECK(file.read("/interface/rotations")[9 + 1] == body.interfaces[1].rotation(0, 1));
  CHECK(file.shape("/reduced/inertia_components") == Shape{6, 13, 13});
  CHECK(file.read("/reduced/inertia_components")[(4 * 13 + 2) * 13 + 7] == body.inertia_components[4](2, 7));
  CHECK(file.shape("/reduced/geometric_stiffness/load") == Shape{10, 13, 13});
  CHECK(file.read_names("/reduced/coordinates")[8] == "small_end rx");
  CHECK(file.read_names("/reduced/coordinate_units")[8] == "rad");
  CHECK(file.read_names("/reduced/coordinates")[11] == "mode 2");
  CHECK(file.read_names("/reduced/coordinates")[12] == "residual vector 1");
  CHECK(file.read_integer_attribute("/modes", "residual_vectors") == 1);
  CHECK(file.shape("/points/pad%2E left/position") == Shape{3});
  CHECK(file.shape("/points/pad%2E left/shapes") == Shape{6, 13});
  CHECK(file.read_integers("/points/pad%2E left/residual") == std::vector<std::int64_t>{1, 0, 1, 0, 1, 0});
  CHECK(file.shape("/modes/effective_mass") == Shape{3, 6});
  CHECK(file.shape("/loads/gas %2F crown 50%25") == Shape{3, 3, 13});
  CHECK(file.shape("/mesh/points") == Shape{5, 3});
  CHECK(file.read_integers("/mesh/cells/4") == std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4});
  CHECK(file.shape("/recovery/displacement") == Shape{15, 13});
  CHECK(file.shape("/recovery/stress") == Shape{12, 13});
  for (const char* dataset : {"/reduced/stiffness", "/mesh/points", "/checks/mass error", "/recovery/stress_nodes"})
    CHECK_FALSE(file.units(dataset).empty());
}

TEST_CASE("The origin of stress is optional, and wrong ones are refused") {
  const TemporaryFolder folder;
  Superelement body = sample();
  body.stress_origin = {};
  CHECK(read_superelement(written(folder, body)).stress_origin.materials.empty());
  CHECK_THAT(why_refused([](Hdf5File& file) {
               file.remove("/recovery/stress_materials");
               file.write("/recovery/stress_materials", std::vector<std::int64_t>{0, 2}, {2}, "-");
             }),
             Contains("/recovery/stress_materials: names materials that are not in /recovery/materials"));
  CHECK_THAT(why_refused([](Hdf5File& file) {
               file.remove("/recovery/stress_groups/hub");
               file.write("/recovery/stress_groups/hub", std::vector<std::int64_t>{2}, {1}, "-");
             }),
             Contains("/recovery/stress_groups/hub: names places that are not in /recovery/stress_nodes"));
}

TEST_CASE("Only a complete file replaces an earlier one") {
  const TemporaryFolder folder;
  const std::string path = written(folder, sample());
  Superelement wrong = sample();
  wrong.mass(3, 4) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_of<ComputationError>([&] { write_superelement(wrong, path); }),
             Contains("not written, since /reduced/mass: holds numbers that are not finite"));
  CHECK(read_superelement(path).mass == sample().mass);
  CHECK_FALSE(std::filesystem::exists(path + ".partial"));
  CHECK_THAT(message_of<ComputationError>([&] { write_superelement(sample(), folder / "no/folder/body.h5"); }),
             Contains("cannot be created"));
}

TEST_CASE("A file that is missing, damaged or of another kind is refused with the reason") {
  const TemporaryFolder folder;
  const auto why = [](const std::string& path) { return message_of<InputError>([&] { read_superelement(path); }); };
  CHECK_THAT(why(folder / "none.h5"), Contains("none.h5: there is no such file"));
  CHECK_THAT(why(folder.file("text.h5", "body: crank\n")), Contains("is no HDF5 file"));
  Hdf5File::create(folder / "other.h5").write("/x", 1.0, "m");
  CHECK_THAT(why(folder / "other.h5"), Contains("is no superelement of bielle-reduce"));
  const std::string path = written(folder, sample());
  for (const double part : {0.05, 0.5, 0.99}) {
    std::filesystem::copy_file(path, folder / "cut.h5", std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(
        folder / "cut.h5", static_cast<std::uintmax_t>(part * static_cast<double>(std::filesystem::file_size(path))));
    CHECK_THAT(why(folder / "cut.h5"), Contains("truncated, damaged"));
  }
}

TEST_CASE("If the bytes are as written, only the parts for a motion are read; otherwise all checks are made") {
  const TemporaryFolder folder;
  const Superelement a = sample();
  const std::string path = written(folder, a);
  const Superelement b = read_parts_of_motion(Hdf5File::open(path));
  CHECK(b.stiffness == a.stiffness);
  CHECK(b.load_stiffness == a.load_stiffness);
  CHECK(b.inertia_components == a.inertia_components);
  CHECK(b.frequencies == a.frequencies);
  CHECK(b.loads.size() == a.loads.size());
  CHECK(b.interfaces.size() == a.interfaces.size());
  CHECK(b.total_mass == a.total_mass);
  CHECK(b.displacement_recovery.size() == 0);
  CHECK(b.mesh.points.size() == 0);

  // The extension removes the sum of the bytes, so that the file is read completely, with the recovery.
  Hdf5File::open_to_extend(path).write_attribute("/", "name", a.name);
  CHECK(read_parts_of_motion(Hdf5File::open(path)).displacement_recovery == a.displacement_recovery);
  {
    Hdf5File file = Hdf5File::open_to_extend(path);
    replace(file, "/recovery/displacement", 2 * a.displacement_recovery);
  }
  CHECK_THAT(message_of<InputError>([&] { read_parts_of_motion(Hdf5File::open(path)); }),
             Contains("its numbers are not those that were written"));
}

TEST_CASE("An incomplete file, or one of another version, is refused with advice") {
  CHECK_THAT(why_refused([](Hdf5File& file) { file.write_attribute("/", "complete", std::int64_t{0}); }),
             Contains("was never completed; run bielle-reduce again"));
  CHECK_THAT(why_refused([](Hdf5File& file) { file.write_attribute("/", "version", std::int64_t{1}); }),
             Contains("has version 1 of the file format, but this program reads version 2"));
  CHECK_THAT(why_refused([](Hdf5File& file) { file.write_attribute("/", "format", std::string("bielle results")); }),
             Contains("is no superelement"));
}

TEST_CASE("Datasets that are missing or have wrong shapes are named") {
  CHECK_THAT(why_refused([](Hdf5File& file) { file.remove("/reduced/mass"); }),
             Contains("/reduced/mass: is not in this file"));
  CHECK_THAT(why_refused([](Hdf5File& file) { replace(file, "/reduced/mass", symmetric(12)); }),
             Contains("/reduced/mass: expected 13 x 13 numbers, found 12 x 12"));
  CHECK_THAT(why_refused([](Hdf5File& file) { replace(file, "/reduced/stiffness", symmetric(12)); }),
             Contains("/reduced/inertia_components: expected the shape (6, 12, 12), found (6, 13, 13)"));
  CHECK_THAT(why_refused([](Hdf5File& file) { replace(file, "/interface/positions", MatrixXd::Zero(2, 2)); }),
             Contains("/interface/positions: expected the shape (2, 3), found (2, 2)"));
  CHECK_THAT(why_refused([](Hdf5File& file) { replace(file, "/recovery/displacement", MatrixXd::Zero(12, 13)); }),
             Contains("/recovery/displacement: expected 15 x 13"));
  CHECK_THAT(why_refused([](Hdf5File& file) { replace(file, "/mesh/points", MatrixXd::Zero(3, 3)); }),
             Contains("names nodes that are not in the mesh"));
}

TEST_CASE("Points are read without the rest of the file, and wrong ones are refused") {
  const TemporaryFolder folder;
  const auto points = read_points_of_file(written(folder, sample()));
  REQUIRE(points.size() == 2);
  CHECK(points.at("tip").group == "/");
  CHECK(points.at("tip").point.shapes == sample().points.at("tip").shapes);
  CHECK(read_points_of_file(written(folder, smallest())).empty());

  const auto why_not = [](const std::string& dataset, const MatrixXd& values) {
    return why_refused([&](Hdf5File& file) { replace(file, "/points/tip/" + dataset, values); });
  };
  CHECK_THAT(why_not("shapes", MatrixXd::Zero(6, 12)),
             Contains("/points/tip/shapes: expected 6 x 13 numbers, found 6 x 12"));
  CHECK_THAT(why_not("shapes", MatrixXd::Zero(5, 13)), Contains("/points/tip/shapes: expected six rows"));
  CHECK_THAT(why_not("shapes", MatrixXd::Constant(6, 13, std::nan(""))),
             Contains("/points/tip/shapes: holds numbers that are not finite"));
  CHECK_THAT(why_refused([](Hdf5File& file) {
               file.remove("/points/tip/position");
               file.write("/points/tip/position", Eigen::VectorXd(Eigen::VectorXd::Zero(2)), "m");
             }),
             Contains("/points/tip/position: expected three numbers"));
  CHECK_THAT(why_refused([](Hdf5File& file) {
               file.remove("/points/tip/residual");
               file.write("/points/tip/residual", std::vector<std::int64_t>{0, 0, 0, 0, 0, 2}, {6}, "-");
             }),
             Contains("/points/tip/residual: expected six times 0 or 1"));
  CHECK_THAT(why_refused([](Hdf5File& file) { file.remove("/points/tip/residual"); }),
             Contains("/points/tip/residual: is not in this file"));
  CHECK_THAT(why_refused([](Hdf5File& file) { file.write_attribute("/modes", "residual_vectors", std::int64_t{4}); }),
             Contains("of 3 modes, 4 cannot be residual vectors"));
}

TEST_CASE("The file may contain the numbers by which a run judges a body") {
  const TemporaryFolder folder;
  Superelement body = sample();
  const Superelement without = read_superelement(written(folder, body));
  CHECK(without.strains.size() == 0);
  CHECK(without.inertia_answer.whole.size() == 0);
  body.strains = Eigen::MatrixXd::Random(12, body.size());
  body.inertia_answer = {Eigen::MatrixXd::Random(12, 12), Eigen::MatrixXd::Random(12, 12)};
  const std::string path = written(folder, body);
  const Superelement back = read_superelement(path);
  CHECK(back.strains == body.strains);
  CHECK(back.inertia_answer.whole == body.inertia_answer.whole);
  CHECK(back.inertia_answer.missing == body.inertia_answer.missing);
  const auto refused_with = [&](const std::function<void(Hdf5File&)>& damage) {
    write_superelement(body, path);
    Hdf5File file = Hdf5File::open_to_extend(path);
    damage(file);
    file.close();
    return message_of<InputError>([&] { read_superelement(path); });
  };
  CHECK_THAT(refused_with([](Hdf5File& file) { file.remove("/reduced/inertia_answer/missing"); }),
             Contains("/reduced/inertia_answer/missing: is not in this file"));
  CHECK_THAT(refused_with([](Hdf5File& file) {
               file.remove("/reduced/inertia_answer/whole");
               file.write("/reduced/inertia_answer/whole", Eigen::MatrixXd(Eigen::MatrixXd::Zero(6, 6)), "-");
             }),
             Contains("/reduced/inertia_answer/whole"));
  CHECK_THAT(refused_with([](Hdf5File& file) {
               file.remove("/reduced/strain");
               file.write("/reduced/strain", Eigen::MatrixXd(Eigen::MatrixXd::Zero(12, 1)), "-");
             }),
             Contains("/reduced/strain"));
}

TEST_CASE("The file may contain the judgement of a superelement") {
  const TemporaryFolder folder;
  Superelement body = sample();
  CHECK_FALSE(read_superelement(written(folder, body)).adequacy);
  Adequacy found;
  found.frequencies = Eigen::Vector3d(100, 200, 300);
  found.mode_error = Eigen::Vector3d(0.001, 0.01, 0.1);
  found.mode_mac = Eigen::Vector3d(0.9999, 0.999, 0.9);
  found.mesh_error = Eigen::Vector2d(0.002, 0.003);
  found.tie_error = Eigen::Vector2d(0.02, 0.03);
  found.stress_error = Eigen::VectorXd::Constant(10, 0.05);
  found.worst_place = {1, 2, 3};
  found.inertia_answer = {0.5, 0.9, 1};
  found.next_mode = 400;
  found.wanted = 250;
  found.order = 1;
  found.one_element_thick = 0.7;
  found.least_jacobian = 0.02;
  found.rigid_ties = {"big_end", "small_end"};
  body.adequacy = found;
  const std::string path = written(folder, body);
  const std::optional<Adequacy> back = read_superelement(path).adequacy;
  REQUIRE(back);
  CHECK(back->frequencies == found.frequencies);
  CHECK(back->mode_error == found.mode_error);
  CHECK(back->mode_mac == found.mode_mac);
  CHECK(back->mesh_error == found.mesh_error);
  CHECK(back->tie_error == found.tie_error);
  CHECK(back->stress_error == found.stress_error);
  CHECK(back->worst_place == found.worst_place);
  CHECK(back->inertia_answer == found.inertia_answer);
  CHECK(back->next_mode == 400);
  CHECK(back->wanted == 250);
  CHECK(back->order == 1);
  CHECK(back->one_element_thick == 0.7);
  CHECK(back->least_jacobian == 0.02);
  CHECK(back->rigid_ties == found.rigid_ties);
  const auto refused_with = [&](const std::function<void(Hdf5File&)>& damage) {
    write_superelement(body, path);
    Hdf5File file = Hdf5File::open_to_extend(path);
    damage(file);
    file.close();
    return message_of<InputError>([&] { read_superelement(path); });
  };
  CHECK_THAT(refused_with([](Hdf5File& file) { file.remove("/adequacy/mode_error"); }),
             Contains("/adequacy/mode_error: expected one number for each of free_frequencies"));
  CHECK_THAT(refused_with([](Hdf5File& file) {
               file.remove("/adequacy/mode_mac");
               file.write("/adequacy/mode_mac", Eigen::VectorXd(Eigen::Vector2d(1, 1)), "-");
             }),
             Contains("/adequacy/mode_mac: expected one number for each of free_frequencies"));
  CHECK_THAT(refused_with([](Hdf5File& file) {
               file.remove("/adequacy/next_mode");
               file.write("/adequacy/next_mode", 500.0, "Hz");
             }),
             Contains("its numbers are not those that were written"));
}

TEST_CASE("Impossible values are refused") {
  const auto stiffness_with = [](Eigen::Index i, Eigen::Index j, double value) {
    return [=](Hdf5File& file) {
      MatrixXd matrix = file.read_matrix("/reduced/stiffness");
      matrix(i, j) = value;
      replace(file, "/reduced/stiffness", matrix);
    };
  };
  CHECK_THAT(why_refused(stiffness_with(2, 5, 1e3)),
             Contains("/reduced/stiffness: is not symmetric: entries (6, 3) and (3, 6)"));
  CHECK_THAT(why_refused(stiffness_with(2, 2, std::nan(""))),
             Contains("/reduced/stiffness: holds numbers that are not finite"));
  CHECK_THAT(why_refused([](Hdf5File& file) {
               file.remove("/mass_properties/mass");
               file.write("/mass_properties/mass", -1.0, "kg");
             }),
             Contains("/mass_properties/mass: expected a positive number, found -1"));
  Superelement body = sample();
  body.interfaces[1].name = "big_end";
  CHECK_THAT(message_of<ComputationError>([&] { write_superelement(body, "unused.h5"); }),
             Contains("the name 'big_end' stands there twice"));
  body = sample();
  body.interfaces[1].rotation *= 2;
  CHECK_THAT(message_of<ComputationError>([&] { write_superelement(body, "unused.h5"); }),
             Contains("that of 'small_end' is no rotation matrix"));
  body = sample();
  body.interfaces[1].kept[2] = true;
  CHECK_THAT(message_of<ComputationError>([&] { write_superelement(body, "unused.h5"); }),
             Contains("expected 14 rows for 11 interface directions and 3 modes, found 13"));
}
