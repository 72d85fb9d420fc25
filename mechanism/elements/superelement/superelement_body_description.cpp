// Words and picture of a superelement in a mechanism.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/drawing/drawing.hpp"
#include "mechanism/elements/superelement/superelement_body.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/counted.hpp"
#include "reduce/common/direction_words.hpp"

namespace bielle::mechanism {

namespace {

std::string compliance_at(const std::array<bool, 6>& residual) {
  std::vector<std::string> exact;
  for (std::size_t k = 0; k < 6; ++k)
    if (residual[k]) exact.emplace_back(direction_words[k]);
  if (exact.empty()) return "its compliance is that of interfaces and modes";
  if (exact.size() == 6) return "its static compliance is exact, by residual vectors";
  return fmt::format("its static compliance is exact in {}, by residual vectors", fmt::join(exact, ", "));
}

}  // namespace

std::string SuperelementBody::describe_modes() const {
  std::string modes = counted(frequencies_.size(), "mode");
  if (frequencies_.size() > 0)
    modes +=
        fmt::format(" ({:.4g} to {:.4g} Hz with fixed interfaces)", frequencies_.minCoeff(), frequencies_.maxCoeff());
  if (residual_vectors_ > 0) modes += " and " + counted(residual_vectors_, "residual vector");
  return modes;
}

void SuperelementBody::describe_piece(Description& description) const {
  description.add_sum("mass", matrices_->mass, "kg");
  description.add_each("file of", "piece", file_.path);
  description.add_line(fmt::format("piece '{}': mass {:.6g} kg, {}", name(), matrices_->mass, describe_modes()));
  describe_attachments(description);
}

void SuperelementBody::describe(const LocalState& /*state*/, Description& description) const {
  if (file_.group != "/") return describe_piece(description);
  description.add("file " + file_.path);
  description.add(fmt::format("mass {:.6g} kg", matrices_->mass));
  description.add(fmt::format("centre {} m in the mesh's axes", format_vector(matrices_->centre)));
  description.add(counted(interfaces_.size(), "interface"));
  description.add(describe_modes());
  describe_attachments(description);
}

void SuperelementBody::describe_attachments(Description& description) const {
  if (matrices_->prestress_rows() == 0)
    description.add_line(
        "no geometric stiffness of interface loads in the file: no stiffening under tension, no buckling");
  else
    description.add_line(
        "its own strains are small: errors below 0.1 % up to 0.2 rad between interfaces; cut into pieces what bends "
        "more");
  constexpr std::size_t most = 12;  // free ties have an interface for each node of a surface
  for (std::size_t k = 0; k < std::min(interfaces_.size(), most); ++k)
    description.add_line(fmt::format("interface '{}' on node {}", interfaces_[k], description.node(nodes_[k])));
  if (interfaces_.size() > most) description.add_line(fmt::format("and {} more", interfaces_.size() - most));
  for (const Point& point : points_)
    description.add_line(
        fmt::format("point '{}' at {} m: {}", point.name, format_vector(point.place.X), compliance_at(point.residual)));
  for (const Load& load : loads_)
    description.add_line(fmt::format("load '{}' times {}, {}; it bends the body, and does not stiffen it",
                                     matrices_->pattern_names[load.pattern], load.factor.text(),
                                     load.follows ? "turning with the body" : "fixed in space"));
  for (const auto& [what, where] : recovered_.facts()) description.add_line(what + ": " + where);
  if (!peaks_.empty()) description.add_line(fmt::format("peaks over all steps: {}", fmt::join(peaks_, ", ")));
}

void SuperelementBody::draw(Drawing& drawing) const {
  std::vector<std::pair<std::string, DrawnValue>> values = {{"element", results_path({Section::elements, name()})}};
  for (const auto& [attribute, value] : attributes_)
    if (attribute == "file" || attribute == "group") values.emplace_back(attribute, value);
  drawing.add({.shape = "superelement", .values = std::move(values)});
}

}  // namespace bielle::mechanism
