#include "mechanism/elements/superelement/recovery/recovered_outputs.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/elements/superelement/recovery/stress_tiles.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

// -- requested outputs

std::size_t RecoveredOutputs::take(const OutputField& description) {
  descriptions_.push_back(description);
  const std::size_t offset = size_;
  size_ += description.size();
  return offset;
}

void RecoveredOutputs::load_stress(const Superelement& body) {
  if (!stress_) stress_ = std::make_shared<const StressRecovery>(body);
}

void RecoveredOutputs::add_field(const std::string& name, const Superelement& body) {
  const RecoveredField field(name);
  if (field.of_stress()) {
    load_stress(body);
    field.check(*stress_, body.name);
    of_stress_.push_back({field, take(field.description(stress_->nodes.size()))});
    return;
  }
  if (body.displacement_recovery.rows() == 0)
    throw InputError(
        fmt::format("the superelement '{0}' holds nothing to recover {1} from; reduce it with `recovery: {{{1}: all}}`",
                    body.name, name));
  displacement_ = body.displacement_recovery;
  of_displacement_.push_back({field, take(field.description(static_cast<std::size_t>(displacement_.rows() / 3)))});
}

void RecoveredOutputs::add_point(const std::string& field, const std::string& name, const MeshPlace& place,
                                 const Superelement& body) {
  const RecoveredField made(field);
  load_stress(body);
  made.check(*stress_, body.name);
  StressRecovery one = stress_->alone(place.node ? stress_->place_of(*place.node) : stress_->nearest(place.point));
  const std::string where = fmt::format("node {} at [{:.6g}, {:.6g}, {:.6g}] m of the mesh", one.nodes[0],
                                        one.points(0, 0), one.points(1, 0), one.points(2, 0));
  const OutputField whole = made.description(1);
  const std::string components = field == "strain" ? "xx yy zz and engineering shears yz xz xy" : "xx yy zz yz xz xy";
  const OutputField description = {fmt::format("{}_at_{}", field, name),
                                   {made.components()},
                                   whole.units,
                                   fmt::format("{}, body axes, at {}", components, where)};
  facts_.emplace_back(description.name, where);
  points_.push_back({made, take(description), std::move(one)});
}

void RecoveredOutputs::add_quantity(const std::string& name, const Superelement& body) {
  std::vector<std::string> names;
  for (const auto& [known, quantity] : body.quantities) names.push_back(known);
  const auto found = body.quantities.find(name);
  if (found == body.quantities.end())
    throw InputError(
        names.empty()
            ? fmt::format("the superelement '{}' holds no quantities of another program: a body file reads them by "
                          "`matrices: {{quantities: ..}}`",
                          body.name)
            : fmt::format("'{}' is no quantity of '{}'{}", name, body.name, did_you_mean(name, names)));
  const RecoveredQuantity& quantity = found->second;
  const OutputField description = {
      name, {quantity.rows.size()}, quantity.all_units(), fmt::format("{}", fmt::join(quantity.rows, ", "))};
  quantities_.push_back({take(description), quantity.matrix});
}

// -- writing

void RecoveredOutputs::write(const FrameBlock& coordinates, std::span<double* const> values, std::size_t begin) const {
  const auto at = [&](int frame, std::size_t offset) {
    return values[static_cast<std::size_t>(frame)] + begin + offset;
  };
  if (!of_displacement_.empty()) write_displacement(coordinates, values, begin);
  if (!of_stress_.empty())
    for_each_stress(*stress_, coordinates, [&](int row, int frame, const double* s) {
      for (const Field& each : of_stress_)
        each.field.derive(*stress_, row, s,
                          at(frame, each.offset + static_cast<std::size_t>(row) * each.field.components()));
    });
  for (const Quantity& quantity : quantities_)
    for (int frame = 0; frame < coordinates.frames(); ++frame)
      Eigen::Map<VectorX>(at(frame, quantity.offset), quantity.matrix.rows()).noalias() =
          quantity.matrix * coordinates.of(frame);
  for (const Point& point : points_)
    for_each_stress(point.stress, coordinates, [&](int row, int frame, const double* s) {
      point.field.derive(point.stress, row, s, at(frame, point.offset));
    });
}

void RecoveredOutputs::write_displacement(const FrameBlock& coordinates, std::span<double* const> values,
                                          std::size_t begin) const {
  constexpr Eigen::Index tile = 96;
  const Eigen::Index rows = displacement_.rows();
  const std::size_t offset = begin + of_displacement_.front().offset;
  const int threads = recovery_threads(rows, displacement_.cols(), coordinates.frames());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (Eigen::Index first = 0; first < rows; first += tile) {
    alignas(64) std::array<double, tile * frames_abreast> u;
    const Eigen::Index count = std::min(tile, rows - first);
    for (int g = 0; g < coordinates.groups(); ++g) {
      multiply_rows(displacement_, first, count, coordinates.group(g), u.data());
      for (int f = 0, frame = g * frames_abreast; f < frames_abreast && frame < coordinates.frames(); ++f, ++frame) {
        double* to = values[static_cast<std::size_t>(frame)] + offset + first;
        for (Eigen::Index r = 0; r < count; ++r) to[r] = u[static_cast<std::size_t>(frames_abreast * r + f)];
      }
    }
  }
}

}  // namespace bielle::mechanism
