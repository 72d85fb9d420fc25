#include "mechanism/laws/read_elastic_law.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/reading/read_file.hpp"
#include "reduce/common/files/table_file.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"

namespace bielle::mechanism {
namespace {

constexpr double rounding_of_files = 1e-6;  ///< matrices come from other programs with some seven digits

/// Returns the forms of a resistance: six numbers along and about x, y, z, or a matrix.
KeyForms forms_of_resistance(const std::string& along, const std::string& about, const std::string& of_matrix) {
  using namespace keys;
  const KeyForms force{number(along).non_negative()}, moment{number(about).non_negative()};
  KeyForms forms = forms_of_matrix(6, of_matrix);
  forms.insert(forms.begin(), tuple({force, force, force, moment, moment, moment}));
  return forms;
}

KeyForms forms_of_stiffness() { return forms_of_resistance("N/m", "N m/rad", "N/m or N or N/rad or N m/rad"); }

const KeyTable& branch_keys() {
  using namespace keys;
  static const KeyTable table{
      "a branch",
      "A spring in series with a damper, for hysteresis and relaxation.",
      {{"stiffness", forms_of_stiffness(), optional, "Stiffness of the spring."},
       {"factor", number().non_negative(), optional,
        "Share of the stiffness of the whole, in place of `stiffness`; with 0 there is no branch."},
       {"time", number("s").non_negative(), required, "Relaxation time of the damper; with 0 there is no branch."}}};
  return table;
}

const KeyTable& curve_keys() {
  using namespace keys;
  static const KeyTable table{"a curve",
                              "A force that was measured.",
                              {{"table", file("table of two columns"), required,
                                "Displacements and forces, with straight lines between them, which go straight on "
                                "beyond the ends. They need not be symmetric."}}};
  return table;
}

const KeyTable& bushing_film_keys() {
  using namespace keys;
  static const KeyTable table{
      "a film of a bushing",
      "Coefficients of a seal, a film or a magnetic bearing over a speed.",
      {{"speed", state_formula("rad/s", {"t"}), required,
        "Speed over which the coefficients are given: a measure of something else than the bushing, such as the rate "
        "of "
        "the shaft's angle, or a formula of t and measures."},
       {"table", file("table of nine columns"), optional,
        "Ascending speeds [rad/s]; stiffness xx, xy, yx, yy [N/m]; damping xx, xy, yx, yy [N s/m]. Straight lines "
        "between the speeds, constant beyond them."},
       {"matrices", file("table of 73 columns"), optional,
        "The same for all six directions: speeds, 36 numbers of the stiffness along and about x, y, z by rows, 36 of "
        "the damping."}}};
  return table;
}

const KeyTable& curves_keys() {
  using namespace keys;
  const auto along = [](const char* name, const char* unit, const char* about) {
    return Key{name,
               {state_formula(unit, {"q", "v", "t"}).non_negative(), file("table of two columns"), nested(curve_keys)},
               optional,
               about};
  };
  static const KeyTable table{"`curves`, which names directions",
                              "Forces that are added to the rest of the law, by directions.",
                              {along("x", "N/m", "Force along x over its displacement."),
                               along("y", "N/m", "Force along y over its displacement."),
                               along("z", "N/m", "Force along z over its displacement."),
                               along("rx", "N m/rad", "Moment about x over its rotation."),
                               along("ry", "N m/rad", "Moment about y over its rotation."),
                               along("rz", "N m/rad", "Moment about z over its rotation.")}};
  return table;
}

/// Reads six numbers, the diagonal, or a matrix.
MatrixX read_diagonal_or_matrix(const YamlValue& value) {
  if (value.is_map()) return read_square_matrix(value, 6);
  if (!value.is_sequence() || value.size() != 6)
    value.fail("expected six numbers, along and about x, y, z, or a 6x6 matrix by rows");
  if (value.at(std::size_t{0}).is_sequence()) return read_square_matrix(value, 6);
  return value.vector().asDiagonal();
}

Matrix6 read_stiffness(const YamlValue& value, bool symmetric = true) {
  MatrixX K = read_diagonal_or_matrix(value);
  if (symmetric) make_symmetric(value, K);
  check_semidefinite(value, 0.5 * (K + K.transpose()),
                     "a spring that pushes away from its free position; give such a force by `curves`");
  return K;
}

Matrix6 read_damping(const YamlValue& value, const Matrix6& K) {
  if (value.is_scalar()) {
    if (K.isZero(0)) value.fail("one number is a time that multiplies the `stiffness`, which is missing");
    return value.number() * K;
  }
  const MatrixX D = read_diagonal_or_matrix(value);
  check_semidefinite(value, 0.5 * (D + D.transpose()), "a damper that drives the motion");
  return D;
}

/// Returns whether a text is a file name, with the ending of a table; other text is a formula.
bool names_table(const YamlValue& value) {
  if (!value.is_scalar() || value.is_null()) return false;
  const std::string text = value.text();
  for (const std::string ending : {".csv", ".txt", ".dat"})
    if (text.size() > ending.size() && text.ends_with(ending)) return true;
  return false;
}

/// @returns whether it is a table, which is added to the law
bool read_curve(const YamlValue& value, std::size_t k, ElasticLaw& law) {
  if (!value.is_map() && !names_table(value)) return false;
  law.curves[k] = read_named_file(value.is_map() ? value.keyed(curve_keys()).at("table") : value,
                                  [](const std::string& path) { return ForceCurve::from_file(path); });
  return true;
}

MaxwellBranch read_branch(const YamlValue& given, const Matrix6& K) {
  const YamlValue entry = given.keyed(branch_keys());
  MaxwellBranch branch;
  if (entry.has("stiffness") == entry.has("factor"))
    entry.fail("a branch takes either its `stiffness` or a `factor` of that of the whole");
  if (const auto factor = entry.find("factor")) {
    if (K.isZero(0)) factor->fail("multiplies the `stiffness`, which is missing");
    branch.K = 0.5 * factor->number() * (K + K.transpose());
  } else {
    branch.K = read_stiffness(entry.at("stiffness"));
  }
  branch.time = entry.at("time").number();
  return branch;
}

}  // namespace

const KeyTable& matrix_keys() {
  using namespace keys;
  static const KeyTable table{"a matrix",
                              "A matrix that another program has written.",
                              {{"file", file("table of numbers"), required, "Numbers of the matrix, by rows."}}};
  return table;
}

KeyForms forms_of_matrix(std::size_t rows, const std::string& unit) {
  return {keys::matrix(rows, rows, unit), keys::nested(matrix_keys)};
}

MatrixX read_square_matrix(const YamlValue& value, Eigen::Index rows) {
  if (!value.is_map()) return value.matrix(rows, rows);
  const YamlValue file = value.keyed(matrix_keys()).at("file");
  const MatrixX A = read_named_file(file, [&](const std::string& path) { return MatrixX(read_table(path, rows)); });
  if (A.rows() != rows) file.fail(fmt::format("has {} rows: expected {} of {} numbers", A.rows(), rows, rows));
  return A;
}

void make_symmetric(const YamlValue& value, MatrixX& A) {
  const double largest = A.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (std::abs(A(i, j) - A(j, i)) > rounding_of_files * std::max(std::abs(A(i, j)), std::abs(A(j, i))) &&
          std::abs(A(i, j) - A(j, i)) > 1e-12 * largest)
        value.fail(fmt::format("is not symmetric: {:.9g} in row {}, column {}, and {:.9g} in row {}, column {}",
                               A(i, j), i + 1, j + 1, A(j, i), j + 1, i + 1));
  A = (0.5 * (A + A.transpose())).eval();
}

void check_semidefinite(const YamlValue& value, const MatrixX& A, const char* what) {
  const Eigen::Index n = A.rows();
  Eigen::VectorXd scale(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (A(k, k) < 0 || (A(k, k) == 0 && !A.row(k).isZero(0)))
      value.fail(fmt::format("is not positive semidefinite ({:.6g} in row {} of the diagonal): that is {}", A(k, k),
                             k + 1, what));
    scale[k] = A(k, k) > 0 ? 1 / std::sqrt(A(k, k)) : 0;
  }
  const MatrixX scaled = scale.asDiagonal() * A * scale.asDiagonal();
  if (!scaled.allFinite()) value.fail("has entries of incompatible sizes");
  const double least = symmetric_eigenpairs(scaled).values[0];
  if (least < -rounding_of_files)
    value.fail(
        fmt::format("is not positive semidefinite (an eigenvalue of {:.6g} where the diagonal is scaled to 1): "
                    "that is {}",
                    least, what));
}

std::vector<Key> keys_of_elastic_law() {
  using namespace keys;
  KeyForms damping = forms_of_resistance("N s/m", "N m s/rad", "N s/m or N s or N s/rad or N m s/rad");
  damping.insert(damping.begin(), number("s").non_negative());
  const KeyForms force{number("N")}, moment{number("N m")};
  return {{"stiffness", forms_of_stiffness(), optional,
           "Stiffness along and about x, y, z, or a symmetric matrix by rows without negative eigenvalues."},
          {"unsymmetric", boolean(), otherwise("false"),
           "Whether the matrix of the stiffness may be unsymmetric: cross-coupled terms, which drive or brake a whirl. "
           "Its symmetric part has no negative eigenvalue."},
          {"damping", std::move(damping), optional,
           "Damping along and about x, y, z, or a matrix whose symmetric part has no negative eigenvalue, or a time "
           "that multiplies the stiffness."},
          {"preload", tuple({force, force, force, moment, moment, moment}), otherwise("[0, 0, 0, 0, 0, 0]"),
           "Forces and moments that resist at zero coordinates."},
          {"curves", nested(curves_keys), optional,
           "Forces that are added to the rest, by directions: tables of displacement and force, or formulas of the "
           "displacement q, its rate v, the time t and measures."},
          {"film", nested(bushing_film_keys), optional,
           "Stiffness and damping over a speed that a measure gives, in addition to the others; they may be "
           "unsymmetric."},
          {"maxwell", list_of(nested(branch_keys)).items_at_least(1), optional,
           "Branches of a spring and a damper in series, for hysteresis and relaxation. As drawn, and in statics, they "
           "carry no force."}};
}

ElasticFormulas read_elastic_law(const YamlValue& entry, ElasticLaw& law) {
  ElasticFormulas formulas;
  const auto stiffness = entry.find("stiffness"), damping = entry.find("damping"), preload = entry.find("preload"),
             curves = entry.find("curves"), film = entry.find("film"), maxwell = entry.find("maxwell");
  if (const auto unsymmetric = entry.find("unsymmetric"); unsymmetric && !stiffness)
    unsymmetric->fail("applies to the `stiffness`, which is missing");
  if (stiffness) law.K = read_stiffness(*stiffness, !entry.at("unsymmetric").boolean());
  if (damping) law.D = read_damping(*damping, law.K);
  if (preload) {
    const Eigen::VectorXd forces = preload->vector();
    if (forces.size() != 6) preload->fail("expected six numbers: forces along x, y, z [N], moments about them [N m]");
    law.preload = forces;
  }
  if (curves) {
    const YamlValue named = curves->keyed(curves_keys());
    for (std::size_t k = 0; k < law.size(); ++k)
      if (const auto curve = named.find(law.measure_name(k)); curve && !read_curve(*curve, k, law))
        formulas.curves.push_back({k, *curve});
  }
  if (film) {
    const YamlValue given = film->keyed(bushing_film_keys());
    formulas.film_speed = given.at("speed");
    law.film = SpeedFilm{read_film_coefficients(given, static_cast<Eigen::Index>(law.size())), {}};
  }
  if (maxwell) {
    const auto branches = maxwell->items();
    if (branches.empty()) maxwell->fail("expected at least one branch {stiffness or factor, time}");
    // A branch with zero relaxation time has no force, and is omitted.
    for (const YamlValue& each : branches)
      if (const MaxwellBranch branch = read_branch(each, law.K); branch.time > 0) law.add(branch);
  }
  if (!stiffness && !damping && !curves && !film && !maxwell)
    entry.fail("expected `stiffness`, `damping`, `curves`, `film` or `maxwell`: nothing else joins the nodes");
  const bool curved = !formulas.curves.empty() || std::any_of(law.curves.begin(), law.curves.end(),
                                                              [](const auto& curve) { return curve.has_value(); });
  const bool branched = std::any_of(law.branches().begin(), law.branches().end(),
                                    [](const MaxwellBranch& branch) { return !branch.K.isZero(0); });
  if (law.K.isZero(0) && law.D.isZero(0) && !curved && !film && !branched)
    (stiffness ? *stiffness
     : damping ? *damping
               : entry)
        .fail("does nothing: all of its stiffness and damping is zero");
  return formulas;
}

}  // namespace bielle::mechanism
