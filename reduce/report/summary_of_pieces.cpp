#include "reduce/report/summary_of_pieces.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/percent.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

constexpr Eigen::Index shown_frequencies = 6;
constexpr double no_difference = 1e-5;  // changes below this are smaller than the effect of neglected modes

std::string points_in(const Superelement& piece) {
  std::vector<std::string> names;
  for (const auto& [name, point] : piece.points) names.push_back(name);
  return names.empty() ? "" : fmt::format(", points {}", fmt::join(names, ", "));
}

std::string pieces_of(const CutBody& body) {
  std::string result;
  for (const Superelement& piece : body.pieces) {
    std::vector<std::string> names;
    for (const Interface& interface : piece.interfaces) names.push_back(interface.name);
    constexpr std::size_t most = 8;  // free ties have one for each node
    const std::string more = names.size() > most ? fmt::format(" ... and {} more", names.size() - most) : "";
    names.resize(std::min(names.size(), most));
    const std::string residual =
        piece.residual_vectors > 0 ? fmt::format(", {} of residual vectors", piece.residual_vectors) : "";
    result += fmt::format("  {}: mass {:.6g} kg, {}, {} of modes{}, interfaces {}{}{}\n", piece.name, piece.total_mass,
                          counted(piece.size(), "coordinate"), piece.fixed_boundary_modes(), residual,
                          fmt::join(names, ", "), more, points_in(piece));
  }
  return result;
}

/// Tells whether a cut lies in its plane, within the accuracy of a mesh generator's coordinates.
bool lies_in_plane(const CutSurface& cut) { return cut.distance <= 1e-6 * std::sqrt(cut.area); }

std::string cuts_of(const CutBody& body) {
  std::string result;
  for (const CutSurface& cut : body.cuts) {
    result += fmt::format("  {}: between pieces {} and {}, at {}, area {:.6g} m^2, {}\n", cut.name, cut.pieces[0] + 1,
                          cut.pieces[1] + 1, place_name(cut.position), cut.area,
                          lies_in_plane(cut) ? std::string("in its plane")
                                             : fmt::format("along faces of elements, up to {} from its plane",
                                                           length_name(cut.distance)));
  }
  return result;
}

/// "0.3", two digits of the change in percent
std::string change(double ratio) { return percent_number(std::abs(ratio - 1)); }

std::string stiffness_effect(const std::vector<double>& ratios) {
  if (ratios.empty()) return "";
  const auto more_or_less = [](double ratio) { return ratio > 1 ? "stiffer" : "softer"; };
  const double least = ratios.front(), most = ratios.back();
  const bool one_way = std::string(more_or_less(least)) == more_or_less(most);
  return fmt::format("between its interfaces the body in pieces is {}{} to {} % {}, depending on the load\n",
                     change(least), one_way ? "" : fmt::format(" % {}", more_or_less(least)), change(most),
                     more_or_less(most));
}

}  // namespace

std::string describe_effect(const CutBody& body) {
  const Eigen::VectorXd& uncut = body.effect.uncut_frequencies;
  const Eigen::Index shown = std::min({uncut.size(), body.free_frequencies.size(), shown_frequencies});
  if (shown == 0) return stiffness_effect(body.effect.stiffness_ratios);
  const double ratio = body.free_frequencies(0) / uncut(0);
  std::string result =
      std::abs(ratio - 1) < no_difference
          ? fmt::format("the cuts leave the first free frequency as it is, {:.6g} Hz", uncut(0))
          : fmt::format("the cuts {} the first free frequency by {} %, from {:.6g} to {:.6g} Hz",
                        ratio > 1 ? "raise" : "lower", change(ratio), uncut(0), body.free_frequencies(0));
  if (shown > 1) result += "; the next by";
  for (Eigen::Index k = 1; k < shown; ++k) {
    const double each = body.free_frequencies(k) / uncut(k);
    result += fmt::format("{} {}{}", k == 1 ? "" : ",", each < 1 ? "-" : "+", change(each));
  }
  return result + (shown > 1 ? " %\n" : "\n") + stiffness_effect(body.effect.stiffness_ratios);
}

std::string describe(const CutBody& body) {
  double mass = 0;
  for (const Superelement& piece : body.pieces) mass += piece.total_mass;
  std::string result = fmt::format("{}: {}, mass {:.6g} kg\n{}cuts\n{}", body.name.empty() ? "body" : body.name,
                                   counted(body.pieces.size(), "piece"), mass, pieces_of(body), cuts_of(body));
  result += "free-free frequencies of all pieces together [Hz]:";
  const Eigen::Index shown = std::min<Eigen::Index>(body.free_frequencies.size(), 12);
  for (Eigen::Index k = 0; k < shown; ++k) result += fmt::format(" {:.6g}", body.free_frequencies(k));
  return result + (shown < body.free_frequencies.size() ? " ...\n" : "\n") + describe_effect(body);
}

}  // namespace bielle::reduce
