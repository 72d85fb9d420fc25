#include "reduce/report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/percent.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

constexpr double good_modes = 0.01, good_mesh = 0.02;  // allowed relative errors of a frequency because of omitted
                                                       // modes and because of the mesh
constexpr double good_stress = 0.15;                   // relative, energy norm, under most loads
constexpr double small_stiffening = 0.02, good_cuts = 0.02;
constexpr double thin = 0.2;           // share of the surface
constexpr double badly_shaped = 0.05;  // scaled Jacobian
constexpr const char* second_order = "mesh: {order: 2}, or elements of order 2 in the file if it is a mesh";
constexpr double beyond_wanted = 2.2;  // modes up to twice a frequency keep its error below 1 %

struct Findings {
  std::vector<std::string> faults;   // a few words each, for the first line
  std::vector<std::string> lines;    // sentences
  std::vector<std::string> changes;  // keys of the body file, the most important first
};

/// "857.4 Hz", "11880 Hz"
std::string hertz(double frequency) {
  return frequency < 1000 ? fmt::format("{:.4g} Hz", frequency) : fmt::format("{:.0f} Hz", frequency);
}

/// "0.042 %", "3.1 %", "14 %": two digits; estimates are not meaningful below 0.01 %.
std::string as_percent(double part) { return percent(std::max(part, 1e-4)); }

std::string in_percent(double least, double most) {
  const std::string low = as_percent(least), high = as_percent(most);
  return low == high ? low : fmt::format("{} to {}", low.substr(0, low.size() - 2), high);
}

/// Rounds a requested frequency up to three digits.
std::string rounded_up(double frequency) {
  const double unit = std::pow(10, std::floor(std::log10(frequency)) - 1);
  return fmt::format("{:.6g}", unit * std::ceil(frequency / unit));
}

/// The range of frequencies in which an error is small.
struct Range {
  Eigen::Index good = 0;  // number of frequencies in the range, the lowest ones
  bool open = false;      // all examined frequencies are good: the range has no known end
  double limit = 0;       // [Hz]; 0: not even the first
  double first_bad = std::numeric_limits<double>::infinity();  // the first frequency with a large error [Hz]

  /// Tells whether a body that is wanted up to a frequency (0: not specified) does not reach it.
  bool falls_short(double wanted) const { return !open && (good == 0 || first_bad <= wanted); }
};

Range range_of(const Adequacy& found, const Eigen::VectorXd& errors, double most) {
  Range range;
  range.good = std::find_if(errors.begin(), errors.end(), [&](double e) { return e > most; }) - errors.begin();
  range.open = range.good == errors.size();
  if (range.good > 0) range.limit = found.frequencies(range.good - 1);
  if (!range.open) range.first_bad = found.frequencies(range.good) / (1 + errors(range.good));
  return range;
}

/// Returns a MAC with four digits, rounded down, so that the report does not promise more than was found.
double rounded_down(double assurance) { return std::floor(1e4 * assurance) / 1e4; }

/// Returns the limit of the modes that would bring a frequency within bounds.
std::string wider_modes(const Adequacy& found, double frequency) {
  return fmt::format("modes: {{below: {}}}",
                     rounded_up(std::max(beyond_wanted * frequency, 1.1 * std::max(found.next_mode, found.wanted))));
}

void judge_modes(const Superelement& body, const Adequacy& found, Findings& findings) {
  const Range range = range_of(found, found.mode_error, good_modes);
  std::string line;
  if (range.good > 0)
    line = fmt::format("free-free frequencies up to {} are at most {} too high, since modes are left out",
                       hertz(range.limit), as_percent(found.mode_error.head(range.good).maxCoeff()));
  if (!range.open) {
    const double bad = found.frequencies(range.good), error = found.mode_error(range.good);
    line += range.good > 0 ? fmt::format("; the next, {}, is {} too high", hertz(bad), as_percent(error))
                           : fmt::format("the first free-free frequency, {}, is {} too high, since modes are left out",
                                         hertz(bad), as_percent(error));
  }
  if (found.mode_mac.size() > 0 && range.good > 0)
    line += fmt::format("; the shapes of the good ones agree with a MAC of at least {:.4f}",
                        rounded_down(found.mode_mac.head(range.good).minCoeff()));
  if (found.next_mode > 0) line += fmt::format("; the first mode left out is at {}", hertz(found.next_mode));
  findings.lines.emplace_back("modes: " + line);
  if (body.fixed_boundary_modes() == 0 || !range.falls_short(found.wanted)) return;
  findings.faults.emplace_back(range.good > 0
                                   ? fmt::format("too few modes for the {} of modes.below", hertz(found.wanted))
                                   : std::string("too few modes"));
  findings.changes.emplace_back(wider_modes(found, std::max(range.first_bad, found.wanted)));
}

/// Returns the share of the modes in the held body's answer to its rotation about an axis of the body.
double answer_to_spin(const InertiaAnswer& answer, int axis) {
  // omega x (omega x x) = -(x minus its part along the axis)
  Eigen::VectorXd field = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 3; ++i)
    if (i != axis) field(4 * i + 1 + i) = -1;
  const double whole = field.dot(answer.whole * field);
  return whole > 0 ? std::clamp(1 - field.dot(answer.missing * field) / whole, 0.0, 1.0) : 1;
}

void judge_inertia(const Superelement& body, const Adequacy& found, Findings& findings) {
  if (body.modes() == 0) return;
  const auto whole = [](double share) { return std::round(100 * share); };
  const InertiaAnswer& answer = body.inertia_answer;
  const std::string spins =
      answer.whole.size() == 0
          ? ""
          : fmt::format("; spinning about them by {:.0f}, {:.0f} and {:.0f} %", whole(answer_to_spin(answer, 0)),
                        whole(answer_to_spin(answer, 1)), whole(answer_to_spin(answer, 2)));
  findings.lines.emplace_back(fmt::format(
      "inertia: under accelerations along x, y, z the body, held at its interfaces, deflects by {:.0f}, {:.0f} and "
      "{:.0f} % of the deflection of the mesh{}",
      whole(found.inertia_answer.x()), whole(found.inertia_answer.y()), whole(found.inertia_answer.z()), spins));
}

double median(const Eigen::VectorXd& numbers) {
  std::vector<double> sorted(numbers.begin(), numbers.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  return sorted[sorted.size() / 2];
}

void judge_mesh(const Adequacy& found, Findings& findings) {
  std::vector<std::string> parts;
  const Range range = range_of(found, found.mesh_error, good_mesh);
  const bool coarse_for_modes = range.falls_short(found.wanted);
  const bool coarse_for_stress = found.stress_error.size() > 0 && median(found.stress_error) > good_stress;
  const Eigen::Index meshed = found.mesh_error.size();
  if (meshed > 0)
    parts.push_back(
        fmt::format("the mesh makes the first free-free frequency about {} too high", as_percent(found.mesh_error(0))));
  if (meshed > 1)
    parts.back() += fmt::format(", those up to {} up to {}", hertz(found.frequencies(meshed - 1)),
                                as_percent(found.mesh_error.maxCoeff()));
  if (found.stress_error.size() > 0)
    parts.push_back(fmt::format("stress under loads on the interfaces is off by about {} (energy norm), most at {}",
                                in_percent(found.stress_error.minCoeff(), found.stress_error.maxCoeff()),
                                place_name(found.worst_place)));
  if (!parts.empty()) findings.lines.emplace_back(fmt::format("mesh: {}", fmt::join(parts, "; ")));
  if (found.order == 1)
    findings.lines.emplace_back(
        "elements: of order 1 (tet4, wedge6 or pyramid5), which are too stiff, in bending by far");
  if (found.one_element_thick > thin)
    findings.lines.emplace_back(
        fmt::format("walls: below {:.0f} % of its surface the body is one element thick, "
                    "which hides errors of the mesh, in torsion above all",
                    100 * found.one_element_thick));
  if (found.least_jacobian < badly_shaped)
    findings.lines.emplace_back(
        fmt::format("elements: the worst is nearly flat (scaled Jacobian {:.1g}): stress next to "
                    "it is not to be trusted",
                    found.least_jacobian));
  if (coarse_for_modes || coarse_for_stress) {
    findings.faults.emplace_back(coarse_for_modes ? "a mesh that is too stiff" : "a mesh too coarse for stress");
    findings.changes.emplace_back(found.order == 1 ? second_order : "mesh: {size: ..}, half of what it is");
  } else if (found.order == 1) {
    findings.faults.emplace_back("elements of order 1");
    findings.changes.emplace_back(second_order);
  }
}

void judge_ties(const Adequacy& found, Findings& findings) {
  if (found.rigid_ties.empty() || found.tie_error.size() == 0) return;
  const double most = found.tie_error.maxCoeff();
  constexpr std::size_t shown = 6;
  std::vector<std::string> names(
      found.rigid_ties.begin(),
      found.rigid_ties.begin() + static_cast<std::ptrdiff_t>(std::min(shown, found.rigid_ties.size())));
  if (found.rigid_ties.size() > shown) names.emplace_back("...");
  findings.lines.emplace_back(
      fmt::format("ties: rigid ones ({}) hold frequencies up to {} at least {} higher than 'tie: average' would{}",
                  fmt::join(names, ", "), hertz(found.frequencies(found.tie_error.size() - 1)),
                  in_percent(found.tie_error.minCoeff(), most),
                  most > small_stiffening ? ", which is right only where something stiff backs the surface" : ""));
}

std::string first_line(const Adequacy& found, const Findings& findings) {
  if (!findings.faults.empty()) return fmt::format("not good yet: {}", fmt::join(findings.faults, ", "));
  if (found.frequencies.size() == 0) return "a rigid body: nothing of it can deform";
  const Range modes = range_of(found, found.mode_error, good_modes),
              mesh = range_of(found, found.mesh_error, good_mesh);
  double limit = modes.limit;
  if (!mesh.open) limit = std::min(limit, mesh.limit);
  if (found.next_mode > 0) limit = std::min(limit, found.next_mode);
  if (limit == 0) return "good for statics alone: no modes are kept";
  return fmt::format("good up to {}{}{}", hertz(limit), modes.open && mesh.open ? " at least" : "",
                     found.one_element_thick > thin ? ", if one element through its walls is enough" : "");
}

std::string text(const std::string& first, const Findings& findings) {
  std::string result = fmt::format("verdict: {}\n", first);
  for (const std::string& line : findings.lines) result += fmt::format("  {}\n", line);
  if (!findings.changes.empty()) result += fmt::format("  change first: {}\n", fmt::join(findings.changes, "; then "));
  return result;
}

/// Returns the stresses of all pieces together; frequencies of single pieces have no meaning for the body.
Adequacy mesh_of_pieces(const CutBody& body) {
  Adequacy all;
  double worst = -1;
  for (const Superelement& piece : body.pieces) {
    const Adequacy& one = *piece.adequacy;
    const Eigen::Index before = all.stress_error.size();
    all.stress_error.conservativeResize(before + one.stress_error.size());
    all.stress_error.tail(one.stress_error.size()) = one.stress_error;
    all.order = one.order;
    all.one_element_thick = std::max(all.one_element_thick, one.one_element_thick);
    all.least_jacobian = std::min(all.least_jacobian, one.least_jacobian);
    if (one.stress_error.size() == 0 || one.stress_error.maxCoeff() <= worst) continue;
    worst = one.stress_error.maxCoeff();
    all.worst_place = one.worst_place;
  }
  return all;
}

/// Compares the frequencies of the pieces together with the uncut body's.
void judge_cuts(const CutBody& body, Findings& findings) {
  const Eigen::VectorXd& uncut = body.effect.uncut_frequencies;
  if (uncut.size() == 0 || body.free_frequencies.size() == 0) return;
  const double rise = body.free_frequencies(0) / uncut(0) - 1;
  findings.lines.emplace_back(fmt::format("cuts: the first free-free frequency is {} {} than in one piece",
                                          as_percent(std::abs(rise)), rise > 0 ? "higher" : "lower"));
  if (std::abs(rise) <= good_cuts) return;
  findings.faults.emplace_back("cuts that change the body");
  findings.changes.emplace_back("pieces: fewer cuts, or another tie; modes of the pieces: more of them");
}

}  // namespace

std::string verdict(const CutBody& body) {
  for (const Superelement& piece : body.pieces)
    if (!piece.adequacy) return "";
  Findings findings;
  judge_cuts(body, findings);
  judge_mesh(mesh_of_pieces(body), findings);
  return text(findings.faults.empty() ? std::string("good, as far as mesh and cuts go")
                                      : fmt::format("not good yet: {}", fmt::join(findings.faults, ", ")),
              findings);
}

std::string verdict(const Superelement& body) {
  if (!body.adequacy) return "";
  const Adequacy& found = *body.adequacy;
  Findings findings;
  if (found.frequencies.size() > 0) judge_modes(body, found, findings);
  judge_inertia(body, found, findings);
  judge_mesh(found, findings);
  judge_ties(found, findings);
  return text(first_line(found, findings), findings);
}

}  // namespace bielle::reduce
