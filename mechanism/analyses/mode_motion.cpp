#include "mechanism/analyses/mode_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/solvers/linearised/mode_parts.hpp"
#include "mechanism/solvers/linearised/whirl.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

using Complex = std::complex<double>;

constexpr double deforms = 0.1;  // energy of deformation over kinetic energy of a part that is not named as rigid

/// Returns the sum of squares of the components of nodes' motions along a unit vector.
double along(const Eigen::Matrix3Xcd& motion, const std::vector<int>& nodes, const Vector3& direction) {
  double sum = 0;
  for (const int node : nodes) sum += std::norm(direction.cast<Complex>().dot(motion.col(node)));
  return sum;
}

double along(const Eigen::Matrix3Xcd& motion, const ModeGroup& group, const Vector3& direction) {
  double sum = 0;
  for (const std::vector<int>& nodes : group.nodes) sum += along(motion, nodes, direction);
  return sum;
}

double size(const Eigen::Matrix3Xcd& motion, const std::vector<int>& nodes) {
  double sum = 0;
  for (const int node : nodes) sum += motion.col(node).squaredNorm();
  return sum;
}

double size(const Eigen::Matrix3Xcd& motion, const ModeGroup& group) {
  double sum = 0;
  for (const std::vector<int>& nodes : group.nodes) sum += size(motion, nodes);
  return sum;
}

/// Returns the direction (0, 1 or 2) whose share of the motion is large enough for a word; none if the motion is mixed.
std::optional<std::size_t> main_direction(const Vector3& squares) {
  Eigen::Index most = 0;
  const double largest = squares.maxCoeff(&most), sum = squares.sum();
  if (!(sum > 0) || largest < mode_share * sum) return std::nullopt;
  return static_cast<std::size_t>(most);
}

/// Returns the squares of the motion of the nodes along the axes of each node.
Vector3 in_own_axes(const Eigen::Matrix3Xcd& motion, const ModeGroup& group, const State& state) {
  Vector3 squares = Vector3::Zero();
  for (const std::vector<int>& nodes : group.nodes)
    for (const int node : nodes)
      squares += (state.nodes[static_cast<std::size_t>(node)].R.transpose().cast<Complex>() * motion.col(node))
                     .cwiseAbs2()
                     .eval();
  return squares;
}

/// Tells whether the axes of all nodes are nearly the inertial ones.
bool stands_as_inertial(const ModeGroup& group, const State& state) {
  constexpr double nearly = 0.1;  // rad
  for (const std::vector<int>& nodes : group.nodes)
    for (const int node : nodes)
      if ((state.nodes[static_cast<std::size_t>(node)].R - Matrix3::Identity()).norm() > std::sqrt(2.0) * nearly)
        return false;
  return true;
}

}  // namespace

struct MotionWords::Amplitudes {
  NodeShapes shapes;
  std::size_t number;
  Eigen::Index mode;
};

MotionWords::MotionWords(const System& system, const ModesReport& report)
    : system_(system), report_(report), state_(report.about.state) {
  if (report.turning) {
    axis_ = std::copysign(1.0, report.turning->rate) * report.turning_axis;
    const Periodicity periodicity = report.turning->periodicity;
    whirls_ = periodicity == Periodicity::multiblade || periodicity == Periodicity::periodic;
    return;
  }
  if (!report.steadiness || !report.steadiness->steady_in(report.axes)) return;
  Vector3 fastest = Vector3::Zero();
  for (const NodeState& node : state_.nodes)
    if (node.Omega.norm() > fastest.norm() * (1 + 1e-9)) fastest = node.R * node.Omega;
  if (fastest.isZero(0)) return;
  axis_ = fastest.normalized();
  whirls_ = report.axes == ModeAxes::inertial;
}

ModeMotion MotionWords::operator()(const ModeGroup& group, std::size_t mode) const {
  const Amplitudes amplitudes{node_shapes(system_, state_, report_.found.modes[mode]), mode,
                              static_cast<Eigen::Index>(mode)};
  const Eigen::Index k = amplitudes.mode;
  const double strain = group.extension[k] + group.torsion[k] + group.bending_y[k] + group.bending_z[k];
  return strain > deforms * group.kinetic[k] ? deformation(group, amplitudes) : rigid_motion(group, amplitudes);
}

bool MotionWords::turns(const ModeGroup& group) const {
  if (axis_.isZero(0)) return false;
  double fastest = 0;
  for (const NodeState& node : state_.nodes) fastest = std::max(fastest, node.Omega.norm());
  constexpr double as_fast = 0.5;
  for (const std::vector<int>& nodes : group.nodes)
    for (const int node : nodes) {
      const auto k = static_cast<std::size_t>(node);
      const bool turns = report_.turning ? report_.turning_nodes[k] != 0
                                         : (state_.nodes[k].R * state_.nodes[k].Omega).dot(axis_) > as_fast * fastest;
      if (!turns) return false;
    }
  return true;
}

std::vector<Blade> MotionWords::blades_of(const ModeGroup& group) const {
  return turns(group) ? blades_around(axis_, group, state_) : std::vector<Blade>();
}

/// Returns the axes in columns: fore-aft (along the axis), side-side, vertical. The vertical is opposite to gravity;
/// without gravity it is along a beam.
std::optional<Matrix3> MotionWords::standing_axes(const ModeGroup& group) const {
  if (!report_.turning) return std::nullopt;
  Vector3 up = -report_.about.environment.gravity;
  if (up.isZero(0) && group.flexible && group.nodes.front().size() > 1 && !turns(group))
    up = state_.nodes[static_cast<std::size_t>(group.nodes.front().back())].x -
         state_.nodes[static_cast<std::size_t>(group.nodes.front().front())].x;
  if (up.isZero(0)) return std::nullopt;
  Matrix3 axes;
  axes.col(2) = up.normalized();
  axes.col(0) = axis_ - axes.col(2) * axes.col(2).dot(axis_);
  const double across = axes.col(0).norm();
  // Side-side is not defined if the axis is nearer to the vertical than to the horizontal.
  constexpr double least = 0.7;
  if (across < least) return std::nullopt;
  axes.col(0) /= across;
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

ModeMotion MotionWords::deformation(const ModeGroup& group, const Amplitudes& amplitudes) const {
  const Eigen::Index k = amplitudes.mode;
  const double y = group.bending_y[k], z = group.bending_z[k], bending = y + z;
  const auto kind = main_direction(Vector3(group.extension[k], group.torsion[k], bending));
  const std::vector<Blade> blades = blades_of(group);
  const bool round = group.flap[k] + group.edge[k] < (1 - mode_share) * bending;
  const auto with_pattern = [&](const char* family, const std::string& motion) {
    return blades.empty()
               ? ModeMotion{family, motion, ""}
               : ModeMotion{family, motion, pattern_of(blades, group, amplitudes), static_cast<int>(blades.size())};
  };
  if (!kind) return with_pattern("", "");
  if (*kind == 0) return with_pattern("extension", "extension");
  if (*kind == 1) return with_pattern("torsion", "torsion");
  const Eigen::Matrix3Xcd& moved = amplitudes.shapes.displacement;
  if (!blades.empty()) {
    if (group.flap[k] >= mode_share * bending) return with_pattern("bending", "flap");
    if (group.edge[k] >= mode_share * bending) return with_pattern("bending", "edge");
    const double out = along(moved, group, axis_), whole = size(moved, group);
    if (round) {
      if (out >= mode_share * whole) return with_pattern("bending", "out-of-plane bending");
      if (whole - out >= mode_share * whole) return with_pattern("bending", "in-plane bending");
    }
    return with_pattern("bending", "bending");
  }
  if (!turns(group)) {
    if (const auto axes = standing_axes(group)) {
      static constexpr std::array<const char*, 3> words{"fore-aft", "side-side", "vertical bending"};
      const Vector3 squares(along(moved, group, axes->col(0)), along(moved, group, axes->col(1)),
                            along(moved, group, axes->col(2)));
      if (const auto direction = main_direction(squares)) return {"bending", words[*direction], ""};
    }
  } else if (whirls_) {
    return {"bending", "bending", whirl(amplitudes.number)};
  }
  if (!round && y >= mode_share * bending) return {"bending", "bending about y", ""};
  if (!round && z >= mode_share * bending) return {"bending", "bending about z", ""};
  return {"bending", "bending", whirl(amplitudes.number)};
}

ModeMotion MotionWords::rigid_motion(const ModeGroup& group, const Amplitudes& amplitudes) const {
  const Eigen::Index k = amplitudes.mode;
  const Eigen::Matrix3Xcd& moved = amplitudes.shapes.displacement;
  const Eigen::Matrix3Xcd& turned = amplitudes.shapes.rotation;
  const double turning = group.turning[k] / group.kinetic[k];
  const bool rotates = turning >= mode_share, moves = turning <= 1 - mode_share;
  if (const std::vector<Blade> blades = blades_of(group); !blades.empty()) {
    const double out = along(moved, group, axis_), whole = size(moved, group);
    const char* motion = !moves                              ? ""
                         : out >= mode_share * whole         ? "out of plane"
                         : whole - out >= mode_share * whole ? "in plane"
                                                             : "";
    return {"", motion, pattern_of(blades, group, amplitudes), static_cast<int>(blades.size())};
  }
  if (turns(group)) {
    const Eigen::Matrix3Xcd& motion = rotates ? turned : moved;
    const double about = along(motion, group, axis_), whole = size(motion, group);
    const bool is_about = about >= mode_share * whole, is_across = whole - about >= mode_share * whole;
    if (rotates && is_about) return {"", "about the axis", ""};
    if (moves && is_about) return {"", "along the axis", ""};
    const char* across = !is_across ? "" : rotates ? "tilting" : moves ? "across the axis" : "";
    return {"", across, whirl(amplitudes.number)};
  }
  if (group.deformation[k] <= deforms * group.kinetic[k])
    if (std::string joint = about_joint(group, amplitudes); !joint.empty()) return {"", std::move(joint), ""};
  if (!rotates && !moves) return {"", "", whirl(amplitudes.number)};
  const Eigen::Matrix3Xcd& motion = rotates ? turned : moved;
  if (const auto axes = standing_axes(group)) {
    static constexpr std::array<const char*, 3> moving{"fore-aft", "side-side", "vertical"},
        rotating{"roll", "nod", "yaw"};
    const Vector3 squares(along(motion, group, axes->col(0)), along(motion, group, axes->col(1)),
                          along(motion, group, axes->col(2)));
    const auto direction = main_direction(squares);
    if (direction) return {"", rotates ? rotating[*direction] : moving[*direction], ""};
    return {"", "", whirl(amplitudes.number)};
  }
  const auto direction = main_direction(in_own_axes(motion, group, state_));
  if (!direction) return {"", "", whirl(amplitudes.number)};
  return {"",
          fmt::format("{} {}{}", rotates ? "about" : "along", stands_as_inertial(group, state_) ? "" : "its ",
                      "xyz"[*direction]),
          ""};
}

/// Returns words such as "about pivot" if the single coordinate of this joint is the whole motion of each entry that
/// moves, because the other node of the joint is at rest. Returns an empty text if there is no such joint.
std::string MotionWords::about_joint(const ModeGroup& group, const Amplitudes& amplitudes) const {
  const NodeShapes& shapes = amplitudes.shapes;
  const double length = model_extent(state_);
  const auto motion = [&](int node) {
    return shapes.displacement.col(node).norm() + length * shapes.rotation.col(node).norm();
  };
  constexpr double rests = 1e-6;
  constexpr int but_one = 5;  // constraints of a joint with one coordinate
  std::vector<double> sizes;
  for (const std::vector<int>& nodes : group.nodes) {
    double& size = sizes.emplace_back(0);
    for (const int node : nodes) size = std::max(size, motion(node));
  }
  const double least = rests * *std::max_element(sizes.begin(), sizes.end());
  const bool alone = std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > least; }) == 1;
  std::string words;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (sizes[k] <= least) continue;
    const std::vector<int>& nodes = group.nodes[k];
    std::string found;
    for (std::size_t m = 0; m < system_.slots().size() && found.empty(); ++m) {
      const Slots& slots = system_.slots()[m];
      const Member& member = system_.model().members()[m];
      if (member.entry.section != Section::joints || slots.nodes.size() != 2 || slots.multipliers < but_one) continue;
      for (const std::size_t end : {0U, 1U}) {
        const int own = slots.nodes[end], other = slots.nodes[1 - end];
        if (std::find(nodes.begin(), nodes.end(), own) == nodes.end() || motion(other) > rests * motion(own)) continue;
        const std::vector<StartCoordinate> coordinates = start_coordinates_of(*member.component);
        if (coordinates.size() != 1) continue;
        const std::string& joint = member.entry.name;
        found = fmt::format("{} {}", coordinates[0].units == "rad" ? "about" : "along",
                            alone ? joint : short_name(with_stars(joint)));
      }
    }
    if (found.empty() || (!words.empty() && words != found)) return {};
    words = found;
  }
  return words;
}

std::string MotionWords::whirl(std::size_t mode) const {
  if (!whirls_ || !(report_.found.modes[mode].s.imag() > 0)) return {};
  double sense = NAN;
  if (report_.turning)
    sense = report_.turning_whirl(system_, mode);
  else if (const auto found = whirl_of(system_, state_, report_.equations->M, report_.found.modes[mode], axis_))
    sense = *found;
  constexpr double least = 2 * mode_share - 1;  // least difference of the shares of the two senses
  return sense >= least ? "forward" : sense <= -least ? "backward" : "";
}

/// Compares the amplitudes of the blades at the node that moves most.
std::string MotionWords::pattern_of(const std::vector<Blade>& blades, const ModeGroup& group,
                                    const Amplitudes& amplitudes) const {
  if (!report_.turning || !(report_.found.modes[amplitudes.number].s.imag() > 0)) return {};
  const Eigen::Matrix3Xcd& moved = amplitudes.shapes.displacement;
  std::size_t place = 0;
  double most = 0;
  for (std::size_t i = 0; i < blades.front().nodes.size(); ++i) {
    double sum = 0;
    for (const Blade& blade : blades) sum += moved.col(blade.nodes[i]).squaredNorm();
    if (sum > most * (1 + 1e-9)) {
      most = sum;
      place = i;
    }
  }
  const bool out_of_plane = along(moved, group, axis_) >= 0.5 * size(moved, group);
  std::vector<BladeAmplitude> found;
  for (const Blade& blade : blades) {
    const Vector3 direction = out_of_plane ? axis_ : Vector3(axis_.cross(blade.radial));
    found.push_back({blade.radial, direction.cast<Complex>().dot(moved.col(blade.nodes[place]))});
  }
  const bool rests = report_.turning->periodicity == Periodicity::negligible;
  return blade_pattern(found, axis_, out_of_plane, whirls_, rests ? standing_axes(group) : std::nullopt);
}

}  // namespace bielle::mechanism
