#include "reduce/summary.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::reduce {
namespace {

std::string format_vector(const Eigen::Vector3d& v) {
  // Rounding residue beside the largest component reads as zero.
  const double least = 1e-12 * v.cwiseAbs().maxCoeff();
  const auto clean = [&](double x) { return std::abs(x) < least ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", clean(v.x()), clean(v.y()), clean(v.z()));
}

std::string format_kept(const Interface& interface) {
  constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
  if (std::all_of(interface.kept.begin(), interface.kept.end(), [](bool kept) { return kept; }))
    return "all directions";
  std::string text;
  for (std::size_t k = 0; k < 6; ++k)
    if (interface.kept[k]) text += text.empty() ? names[k] : fmt::format(" {}", names[k]);
  return text;
}

std::string format_modes(const Superelement& body) {
  if (body.modes() == 0) return "  no fixed-boundary modes\n";
  std::string text = "  fixed-boundary modes [Hz], effective mass in x y z [%]\n";
  for (Eigen::Index k = 0; k < body.modes(); ++k) {
    const Eigen::Vector3d share = 100 * body.effective_mass.row(k).head<3>() / body.total_mass;
    text += fmt::format("    {:>3} {:>12.6g}   {:6.2f} {:6.2f} {:6.2f}\n", k + 1, body.frequencies[k], share.x(),
                        share.y(), share.z());
  }
  return text;
}

}  // namespace

std::string format_superelement(const Superelement& body, const std::vector<Check>& checks) {
  constexpr std::size_t shown = 12;
  std::string text = fmt::format("{}\n  {} generalised coordinates: {} of interfaces, {} modal amplitudes\n", body.name,
                                 body.size(), body.interface_directions(), body.modes());
  for (std::size_t k = 0; k < std::min(shown, body.interfaces.size()); ++k) {
    const Interface& interface = body.interfaces[k];
    text += fmt::format("  interface '{}' at {} m, {}\n", interface.name, format_vector(interface.position),
                        format_kept(interface));
  }
  if (body.interfaces.size() > shown) text += fmt::format("  and {} interfaces more\n", body.interfaces.size() - shown);
  text += fmt::format(
      "  mass    {:.8g} kg\n  centre  {} m\n  inertia about the centre [kg m^2]\n    xx {:.6g}  yy {:.6g}  zz {:.6g}  "
      "yz {:.3g}  xz {:.3g}  xy {:.3g}\n",
      body.total_mass, format_vector(body.centre), body.inertia(0, 0), body.inertia(1, 1), body.inertia(2, 2),
      body.inertia(1, 2), body.inertia(0, 2), body.inertia(0, 1));
  text += format_modes(body);
  const Eigen::VectorXd free = free_frequencies(body);
  text += "  free reduced body [Hz]:";
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(6, free.size()); ++k) text += fmt::format(" {:.6g}", free[k]);
  text += "\n  checks\n";
  for (const Check& check : checks)
    text += fmt::format("    {} {:<28} {:9.2e} (limit {:.0e})  {}\n", check.passed() ? "ok    " : "FAILED", check.name,
                        check.value, check.limit, check.meaning);
  for (const auto& [name, pattern] : body.loads) {
    (void)pattern;
    text += fmt::format("  load pattern '{}'\n", name);
  }
  return text;
}

std::string format_cost(const ReductionReport& report, const std::vector<PhaseReport>& phases) {
  std::string text = fmt::format("  mesh    {} points, {} cells; {} unknowns inside\n", report.points, report.cells,
                                 report.factor.unknowns);
  text += fmt::format("  factor  {:.3g} entries, {:.3g} flops at {:.1f} GFLOP/s; {} solutions for the modes\n",
                      static_cast<double>(report.factor.nonzeros), report.factor.flops, report.factor.speed(),
                      report.solves);
  double total = 0;
  for (const PhaseReport& phase : phases) {
    text +=
        fmt::format("  {:<28} {:8.2f} s   peak memory {:6.0f} MB\n", phase.name, phase.seconds, phase.peak_memory_MB);
    total += phase.seconds;
  }
  return text + fmt::format("  {:<28} {:8.2f} s\n", "together", total);
}

}  // namespace bielle::reduce
