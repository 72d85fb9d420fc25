#include "reduce/report/summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/direction_words.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index shown_modes = 40, shown_free = 12, shown_interfaces = 20;
constexpr std::size_t shown_points = 20;

/// Returns a place in words. Rounding errors relative to the largest component are shown as zero.
std::string place(const Eigen::Vector3d& x) {
  const double least = 1e-12 * x.cwiseAbs().maxCoeff();
  const auto clean = [&](double value) { return std::abs(value) < least ? 0.0 : value; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", clean(x.x()), clean(x.y()), clean(x.z()));
}

std::string directions(const std::array<bool, 6>& chosen) {
  std::string result;
  for (int axis = 0; axis < 6; ++axis) {
    if (chosen[axis]) {
      result += fmt::format("{}{}", result.empty() ? "" : " ", direction_words[axis]);
    }
  }
  return result;
}

std::string interfaces_of(const Superelement& body) {
  std::size_t width = 0;
  for (const Interface& interface : body.interfaces) {
    width = std::max(width, interface.name.size());
  }
  std::string result = "interfaces\n";
  Eigen::Index shown = 0;
  for (const Interface& interface : body.interfaces) {
    if (shown++ == shown_interfaces) {
      result += fmt::format("  ... and {} more\n", body.interfaces.size() - shown_interfaces);
      break;
    }
    result += fmt::format("  {:{}}  at {} m, {}\n", interface.name, width, place(interface.position),
                          directions(interface.kept));
  }
  return result;
}

std::string mass_of(const Superelement& body) {
  const Eigen::Matrix3d& j = body.inertia;
  return fmt::format(
      "mass {:.6g} kg, centre {} m\ninertia about the centre: xx {:.6g}, yy {:.6g}, zz {:.6g}, xy {:.6g}, xz {:.6g}, "
      "yz "
      "{:.6g} kg m^2\n",
      body.total_mass, place(body.centre), j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2));
}

std::string residual_vectors_of(const Superelement& body) {
  if (body.residual_vectors == 0) {
    return "";
  }
  const Eigen::VectorXd frequencies = body.frequencies.tail(body.residual_vectors);
  return fmt::format("{}, with pseudo-frequencies of {:.6g} to {:.6g} Hz\n",
                     counted(body.residual_vectors, "residual vector"), frequencies.minCoeff(), frequencies.maxCoeff());
}

std::string modes_of(const Superelement& body) {
  const Eigen::Index modes = body.fixed_boundary_modes();
  if (body.modes() == 0) {
    return "no fixed-boundary modes: the body deforms as its interfaces move it\n";
  }
  const Eigen::Vector3d j = body.inertia.diagonal();
  Eigen::RowVectorXd whole(6);
  whole << Eigen::RowVector3d::Constant(body.total_mass), j.transpose();
  const auto row = [&](const std::string& name, const std::string& frequency, const Eigen::RowVectorXd& mass) {
    std::string line = fmt::format("  {:>4} {:>12}", name, frequency);
    for (int k = 0; k < 6; ++k) {
      line += fmt::format("{:8.2f}", 100 * mass(k) / whole(k));
    }
    return line + "\n";
  };
  if (modes == 0) {
    return "no fixed-boundary modes\n";
  }
  std::string result = fmt::format(
      "fixed-boundary modes and their effective mass, in % of the body's mass and inertia about its centre\n"
      "  mode         [Hz]       x       y       z      rx      ry      rz\n");
  for (Eigen::Index k = 0; k < std::min(modes, shown_modes); ++k) {
    result += row(fmt::format("{}", k + 1), fmt::format("{:.6g}", body.frequencies(k)), body.effective_mass.row(k));
  }
  if (modes > shown_modes) {
    result += fmt::format("  ... and {} more, up to {:.6g} Hz\n", modes - shown_modes, body.frequencies(modes - 1));
  }
  return result + row("sum", "", body.effective_mass.topRows(modes).colwise().sum());
}

std::string free_of(const Superelement& body) {
  const Eigen::VectorXd frequencies = free_frequencies(body);
  if (frequencies.size() == 0) {
    return "";
  }
  std::string result = "free-free frequencies of the reduced body [Hz]:";
  for (Eigen::Index k = 0; k < std::min(frequencies.size(), shown_free); ++k) {
    result += fmt::format(" {:.6g}", frequencies(k));
  }
  return result + (frequencies.size() > shown_free ? " ...\n" : "\n");
}

std::string points_of(const Superelement& body) {
  if (body.points.empty()) {
    return "";
  }
  std::size_t width = 0, shown = 0;
  for (const auto& [name, point] : body.points) {
    width = std::max(width, name.size());
  }
  std::string result = "points\n";
  for (const auto& [name, point] : body.points) {
    if (shown++ == shown_points) {
      return result + fmt::format("  ... and {} more\n", body.points.size() - shown_points);
    }
    const std::string residual = directions(point.residual);
    result += fmt::format("  {:{}}  at {} m{}\n", name, width, place(point.position),
                          residual.empty() ? "" : ", residual vectors for " + residual);
  }
  return result;
}

/// Block Lanczos takes 0.57 to 0.67 of ARPACK's time, as measured (tests/performance/README.md). The other method is
/// recommended if it would save more than a quarter of the whole time. ARPACK never saves that much.
std::string other_method(const std::string& method, double modes, double total) {
  constexpr double saved = 0.35, worth_saying = 0.25;
  if (method != "ARPACK" || saved * modes <= worth_saying * total) return "";
  return "; 'method: block_lanczos' would probably take a third less";
}

std::string extras_of(const Superelement& body) {
  std::string result;
  if (const auto share = body.checks.find("unknown_inertia_share"); share != body.checks.end() && share->second > 0.005)
    result += fmt::format(
        "the inertia of large rotations is an estimate: of the kinetic energy of a free mode up to {:.0f} % "
        "has no known direction, and its gyroscopic terms are left out\n",
        100 * share->second);
  std::string patterns;
  for (const auto& [name, pattern] : body.loads) {
    patterns += fmt::format("{}{}", patterns.empty() ? "load patterns: " : ", ", name);
  }
  result += patterns.empty() ? "" : patterns + "\n";
  result += body.displacement_recovery.size() > 0
                ? fmt::format("displacements can be recovered at {}", counted(body.mesh.points.cols(), "point"))
                : std::string("displacements cannot be recovered");
  result += body.stress_recovery.size() > 0 ? fmt::format(", stresses at {}\n", body.stress_nodes.size())
                                            : std::string(", stresses cannot\n");
  return result;
}

}  // namespace

std::string describe(const Superelement& body) {
  const Eigen::Index modes = body.fixed_boundary_modes();
  const std::string kinds = body.residual_vectors == 0
                                ? fmt::format("{} of interfaces and {} of modes", body.interface_directions(), modes)
                                : fmt::format("{} of interfaces, {} of modes and {} of residual vectors",
                                              body.interface_directions(), modes, body.residual_vectors);
  return fmt::format("{}: {}, {}\n", body.name.empty() ? "body" : body.name, counted(body.size(), "coordinate"),
                     kinds) +
         interfaces_of(body) + points_of(body) + mass_of(body) + modes_of(body) + residual_vectors_of(body) +
         free_of(body) + extras_of(body);
}

std::string describe(const std::vector<Check>& checks) {
  std::string result = "checks of the arithmetic (the verdict says whether the reduction is good enough)\n";
  for (const Check& check : checks) {
    result += fmt::format("  {}  {:8.1e} (at most {:.0e})  {}\n", check.passed() ? "passed" : "FAILED", check.value,
                          check.limit, check.meaning);
  }
  return result;
}

std::string describe(const ReductionReport& report, const std::vector<PhaseReport>& phases) {
  std::string result;
  if (report.factor.unknowns > 0) {
    result += fmt::format(
        "factorisation: {}, {} in the factor ({:.0f} MB), {:.3g} GFLOP at {:.3g} GFLOP/s, ordering {:.2f} s, "
        "numbers {:.2f} s\n",
        counted(report.factor.unknowns, "unknown"), counted(report.factor.nonzeros, "number"),
        report.factor.memory_MB(), 1e-9 * report.factor.flops, report.factor.speed(), report.factor.ordering_seconds,
        report.factor.factorisation_seconds);
  }
  double total = 0, modes = 0;
  for (const PhaseReport& phase : phases) {
    total += phase.seconds;
    if (phase.name == "fixed-boundary modes") modes += phase.seconds;
  }
  if (!report.method.empty() && report.solves > 0)
    result += fmt::format("modes by {}: {} in {}{}\n", report.method, counted(report.solves, "solution"),
                          counted(report.sweeps, "sweep"), other_method(report.method, modes, total));
  for (const PhaseReport& phase : phases)
    result += fmt::format("  {:24} {:9.2f} s {:9.0f} MB\n", phase.name, phase.seconds, phase.peak_memory_MB);
  return result + fmt::format("  {:24} {:9.2f} s\n", "all", total);
}

}  // namespace bielle::reduce
