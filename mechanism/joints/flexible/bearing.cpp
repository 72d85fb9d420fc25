#include "mechanism/joints/flexible/bearing.hpp"

#include <span>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"
#include "mechanism/joints/flexible/linear_bearing_law.hpp"
#include "mechanism/laws/read_elastic_law.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the forms of a coefficient along one direction, or along two that may differ and be coupled.
KeyForms forms_of_direction(const char* unit, bool two) {
  using namespace keys;
  const KeyForm one = number(unit).non_negative();
  return two ? KeyForms{one, list_of(2, one), matrix(2, 2, unit)} : KeyForms{one};
}

/// Returns the table of one direction, or of two.
KeyTable direction_table(const char* stiffness_unit, const char* damping_unit, bool two) {
  using namespace keys;
  return {"a direction of a bearing",
          "Stiffness and damping of a bearing in one direction.",
          {{"stiffness", forms_of_direction(stiffness_unit, two), otherwise("0"),
            two ? "Stiffness; a matrix by rows may be unsymmetric." : "Stiffness."},
           {"damping", forms_of_direction(damping_unit, two), otherwise("0"),
            two ? "Damping; a matrix by rows may be unsymmetric." : "Damping."}}};
}

const KeyTable& radial_keys() {
  static const KeyTable table = direction_table("N/m", "N s/m", true);
  return table;
}

const KeyTable& axial_keys() {
  static const KeyTable table = direction_table("N/m", "N s/m", false);
  return table;
}

const KeyTable& tilting_keys() {
  static const KeyTable table = direction_table("N m/rad", "N m s/rad", true);
  return table;
}

const KeyTable& bearing_matrix_keys() {
  using namespace keys;
  static const KeyTable table{
      "matrices of a bearing",
      "Stiffness and damping of a bearing in all directions, with their couplings.",
      {{"stiffness", forms_of_matrix(5, "N/m or N or N/rad or N m/rad"), optional,
        "Stiffness along x, y, z and about x, y, by rows; it may be unsymmetric."},
       {"damping", forms_of_matrix(5, "N s/m or N s or N s/rad or N m s/rad"), optional, "Damping likewise."}}};
  return table;
}

const KeyTable& film_keys() {
  using namespace keys;
  static const KeyTable table{
      "a film of a bearing",
      "Coefficients of an oil film over the speed of the shaft.",
      {{"table", file("table of nine columns"), optional,
        "Ascending speeds of the shaft relative to the housing [rad/s], positive about the axis; stiffness xx, xy, yx, "
        "yy [N/m]; damping xx, xy, yx, yy [N s/m]. Straight lines between the speeds, constant beyond them."},
       {"matrices", file("table of 51 columns"), optional,
        "The same for all five directions: speeds, 25 numbers of the stiffness along x, y, z and about x, y by rows, "
        "25 of the damping."}}};
  return table;
}

/// Reads a coefficient of one direction or of two.
void read_coefficient(const YamlValue& given, std::span<const int> directions, Matrix6& A) {
  if (!given.is_sequence()) {
    for (const int k : directions) A(k, k) = given.number();
    return;
  }
  if (directions.size() != 2 || given.size() != 2)
    given.fail(directions.size() == 2 ? "expected a number, two along x and y of the housing, or a matrix of 2 x 2"
                                      : "expected a number");
  const int first = directions.front();
  if (given.at(std::size_t{0}).is_sequence())
    A.block<2, 2>(first, first) = given.matrix(2, 2);
  else
    A.block<2, 2>(first, first) = given.vector().asDiagonal();
}

/// Refuses damping that drives the motion in some direction.
void check_damping(const YamlValue& place, const Matrix6& D) {
  check_semidefinite(place, 0.5 * (D + D.transpose()), "a damper that drives the motion");
}

/// Reads `{stiffness, damping}` or only the stiffness, for one direction or for two.
void read_bearing_part(const YamlValue& entry, const char* key, std::span<const int> directions,
                       LinearBearingLaw& law) {
  const auto value = entry.find(key);
  if (!value) return;
  if (!value->is_map()) {
    read_coefficient(*value, directions, law.K);
    return;
  }
  if (!value->has("stiffness") && !value->has("damping")) value->fail("expected `stiffness` or `damping`");
  read_coefficient(value->at("stiffness"), directions, law.K);
  read_coefficient(value->at("damping"), directions, law.D);
  check_damping(value->at("damping"), law.D);
}

void read_matrices(const YamlValue& value, LinearBearingLaw& law) {
  const YamlValue given = value.keyed(bearing_matrix_keys());
  const auto stiffness = given.find("stiffness"), damping = given.find("damping");
  if (!stiffness && !damping) given.fail("expected `stiffness` or `damping`");
  if (stiffness) law.K.topLeftCorner<5, 5>() = read_square_matrix(*stiffness, 5);
  if (damping) law.D.topLeftCorner<5, 5>() = read_square_matrix(*damping, 5);
  if (damping) check_damping(*damping, law.D);
}

}  // namespace

const KeyTable& bearing_keys() {
  using namespace keys;
  static const KeyTable table = [] {
    const auto forms = [](const char* unit, bool two, const KeyTable& (*of)()) {
      KeyForms all = forms_of_direction(unit, two);
      all.push_back(nested(of));
      return all;
    };
    return KeyTable{
        "a bearing", "An elastic hinge, whose shaft turns freely.",
        joined(
            {joint_frame_keys(AxisNeed::required),
             {{"radial", forms("N/m", true, radial_keys), optional,
               "Radial stiffness: one number, two along x and y of the housing, or a matrix; or stiffness and "
               "damping."},
              {"axial", forms("N/m", false, axial_keys), otherwise("0"), "Axial stiffness; or stiffness and damping."},
              {"tilting", forms("N m/rad", true, tilting_keys), otherwise("0"),
               "Stiffness against tilting: one number, two about x and y of the housing, or a matrix; or stiffness "
               "and damping."},
              {"matrix", nested(bearing_matrix_keys), optional,
               "Stiffness and damping in all directions, in place of `radial`, `axial` and `tilting`."},
              {"film", nested(film_keys), optional,
               "Coefficients over the speed of the shaft, in addition to the others."}},
             joint_action_keys(Moves::both)})};
  }();
  return table;
}

void read_bearing(const std::string& name, const YamlValue& entry, Model& model) {
  auto law = std::make_shared<LinearBearingLaw>();
  constexpr int radial[] = {0, 1}, axial[] = {2}, tilting[] = {3, 4};
  const auto matrix = entry.find("matrix"), film = entry.find("film");
  if (matrix) {
    for (const char* key : {"radial", "axial", "tilting"})
      if (const auto other = entry.find(key)) other->fail("give either this or `matrix`, which has all directions");
    read_matrices(*matrix, *law);
  } else {
    if (!entry.has("radial") && !film)
      entry.fail("a bearing needs its `radial` stiffness [N/m], a `matrix` or a `film`");
    read_bearing_part(entry, "radial", radial, *law);
    read_bearing_part(entry, "axial", axial, *law);
    read_bearing_part(entry, "tilting", tilting, *law);
  }
  if (film) law->film = read_film_coefficients(film->keyed(film_keys()), 5);
  auto made = std::make_unique<ShaftBearing>("bearing", name, read_joint_frames(entry, model, AxisNeed::required),
                                             std::move(law), model);
  ShaftBearing& bearing = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  read_joint_actions(entry, bearing, model);
}

}  // namespace bielle::mechanism
