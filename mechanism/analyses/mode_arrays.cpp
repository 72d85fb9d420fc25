#include "mechanism/analyses/mode_arrays.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

ModeParts mode_parts(const Model& model, const ModesReport& report) {
  ModeParts parts;
  std::map<Entry, Eigen::Index> place;
  std::vector<Eigen::Index> part_of;
  constexpr Eigen::Index none = -1;
  for (const Member& member : model.members()) {
    Declaration declaration;
    member.component->declare(declaration);
    if (declaration.passive) {
      part_of.push_back(none);
      continue;
    }
    const auto [found, added] = place.emplace(member.entry, static_cast<Eigen::Index>(parts.names.size()));
    if (added) parts.names.push_back(fmt::format("{} '{}'", section_noun(member.entry.section), member.entry.name));
    part_of.push_back(found->second);
  }
  const auto rows = static_cast<Eigen::Index>(parts.names.size()), modes = report.energies.kinetic.cols();
  parts.kinetic = parts.potential = MatrixX::Zero(rows, modes);
  for (std::size_t m = 0; m < part_of.size(); ++m) {
    if (part_of[m] == none) continue;
    parts.kinetic.row(part_of[m]) += report.energies.kinetic.row(static_cast<Eigen::Index>(m));
    parts.potential.row(part_of[m]) += report.energies.potential.row(static_cast<Eigen::Index>(m));
  }
  parts.share = parts.kinetic.cwiseAbs() + parts.potential.cwiseAbs();
  for (Eigen::Index k = 0; k < modes; ++k)
    if (const double sum = parts.share.col(k).sum(); sum > 0) parts.share.col(k) /= sum;
  return parts;
}

namespace {

class ModeWriter {
 public:
  ModeWriter(Session& session, const ModesReport& report)
      : session_(session), report_(report), modes_(report.found.modes), count_(report.found.modes.size()) {}

  void write_numbers() {
    write_each("frequency", "Hz", "|s| / 2 pi", [](const Mode& mode) { return mode.frequency(); });
    write_each("damped_frequency", "Hz", "|Im s| / 2 pi", [](const Mode& mode) { return mode.damped_frequency(); });
    write_each("damping_ratio", "-", "-Re s / |s|; 0 of rigid modes",
               [](const Mode& mode) { return mode.damping_ratio(); });
    write_each(
        "uncertainty", "1/s",
        "of the eigenvalue, by rounding of the equations; of rigid modes: what is slower is no different; 0: not known",
        [](const Mode& mode) { return mode.uncertainty; });
    write_each("residual", "-", "error of the eigenpair as a state of the inverted operator, relative",
               [](const Mode& mode) { return mode.residual; });
    std::vector<double> eigenvalues;
    std::vector<std::string> kinds;
    for (const Mode& mode : modes_) {
      eigenvalues.insert(eigenvalues.end(), {mode.s.real(), mode.s.imag()});
      kinds.emplace_back(mode_kind_name(mode.kind));
    }
    session_.write({"eigen/eigenvalue", {count_, 2}, eigenvalues, "1/s", "s of exp(s t): real and imaginary part"});
    session_.write(ResultNames{"eigen/kind", kinds});
  }

  void write_parts(const ModeParts& parts) {
    session_.write(ResultNames{"eigen/parts", parts.names});
    const auto write_matrix = [&](const char* name, const MatrixX& of_parts, const char* units, const char* what) {
      session_.write({fmt::format("eigen/{}", name),
                      {count_, parts.names.size()},
                      {of_parts.data(), of_parts.data() + of_parts.size()},
                      units,
                      what});
    };
    write_matrix("kinetic_energy", parts.kinetic, "J",
                 "of each part, mean over a period at the amplitude of the shape");
    write_matrix("potential_energy", parts.potential, "J",
                 "of each part, likewise; with what its forces and reactions do as they turn: may be negative");
    write_matrix("energy_share", parts.share, "-", "of each part in the sum of kinetic and |potential| energies");
  }

  void write_shapes() {
    const System& system = session_.system();
    const State& state = report_.about.state;
    const std::size_t nodes = state.nodes.size(),
                      unknowns = static_cast<std::size_t>(system.size() - system.multipliers());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < unknowns; ++i) names.push_back(system.unknown_name(static_cast<int>(i)));
    session_.write(ResultNames{"eigen/unknowns", names});
    names.clear();
    std::vector<double> positions, orientations, shapes, displacements, rotations;
    for (std::size_t k = 0; k < nodes; ++k) {
      names.push_back(session_.model().node(static_cast<int>(k)).name);
      positions.insert(positions.end(), state.nodes[k].x.begin(), state.nodes[k].x.end());
      const Eigen::Vector4d quaternion = quaternion_of(state.nodes[k].R);
      orientations.insert(orientations.end(), quaternion.begin(), quaternion.end());
    }
    session_.write(ResultNames{"eigen/nodes", names});
    const auto append = [](std::vector<double>& to, const auto& numbers) {
      for (const std::complex<double> number : numbers.reshaped()) to.insert(to.end(), {number.real(), number.imag()});
    };
    for (const Mode& mode : modes_) {
      append(shapes, mode.u);
      const NodeShapes of_nodes = node_shapes(system, state, mode);
      append(displacements, of_nodes.displacement);
      append(rotations, of_nodes.rotation);
    }
    session_.write(
        {"eigen/position", {nodes, 3}, positions, "m", "of the nodes in the state that the modes are about"});
    session_.write({"eigen/orientation", {nodes, 4}, orientations, "-", "of the nodes there: unit quaternion w x y z"});
    session_.write({"eigen/shapes",
                    {count_, unknowns, 2},
                    shapes,
                    "-",
                    "increments of the unknowns, each in its units: real and imaginary part"});
    session_.write(
        {"eigen/displacement", {count_, nodes, 3, 2}, displacements, "m", "of the nodes, inertial components"});
    session_.write({"eigen/rotation",
                    {count_, nodes, 3, 2},
                    rotations,
                    "rad",
                    "rotation vectors of the nodes, inertial components"});
  }

 private:
  template <class Number>
  void write_each(const char* name, const char* units, const char* what, const Number& number) {
    std::vector<double> values;
    for (const Mode& mode : modes_) values.push_back(number(mode));
    session_.write({fmt::format("eigen/{}", name), {count_}, values, units, what});
  }

  Session& session_;
  const ModesReport& report_;
  const std::vector<Mode>& modes_;
  std::size_t count_;
};

}  // namespace

void write_modes(Session& session, const ModesReport& report, const ModeParts& parts, bool shapes) {
  ModeWriter writer(session, report);
  writer.write_numbers();
  if (report.found.modes.empty()) return;
  writer.write_parts(parts);
  if (shapes) writer.write_shapes();
}

}  // namespace bielle::mechanism
