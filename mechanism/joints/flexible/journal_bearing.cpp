#include "mechanism/joints/flexible/journal_bearing.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/joints/actions/joint_actions.hpp"

namespace bielle::mechanism {

JournalBearingLaw::JournalBearingLaw(const JournalGeometry& geometry, bool finite, Cavitation cavitation)
    : geometry_(geometry),
      finite_(finite),
      cavitation_(cavitation),
      film_(finite ? geometry.length / geometry.diameter : 0, cavitation) {}

// With u = B/|B|, w = u', a = e.u/c and d = e.w/c:
//   da = u.de/c + d (w.dB)/|B|,   dd = w.de/c - a (w.dB)/|B|
BearingLaw::Force JournalBearingLaw::calc(const Vector6& e, const Vector6& v) const {
  const double c = geometry_.clearance, speed = v[5];
  const double k = geometry_.viscosity * 0.5 * geometry_.diameter * std::pow(geometry_.length / c, 3) / 2;
  const Vector2 place = e.head<2>(), B = 2 * v.head<2>() + speed * Vector2(place.y(), -place.x());
  const double size = B.norm(), radial = place.norm();
  const Vector2 u = size > 0 ? Vector2(B / size) : radial > 0 ? Vector2(place / radial) : Vector2(Vector2::UnitX());
  const Vector2 w(-u.y(), u.x());
  Matrix2 axes, quarter, turned;
  axes << u, w;
  quarter << 0, -1, 1, 0;
  turned << w.dot(place) / c, 0, -u.dot(place) / c, 0;
  const JournalFilm::Shape shape = film_.shape(u.dot(place) / c, w.dot(place) / c);
  const Matrix2 by_B =
      shape.W[0] * Matrix2::Identity() + shape.W[1] * quarter + axes * shape.gradient * turned.col(0) * w.transpose();
  Force force;
  force.N.head<2>() = k * size * axes * shape.W;
  force.by_e.topLeftCorner<2, 2>() = k * (size / c * axes * shape.gradient * axes.transpose() - speed * by_B * quarter);
  force.by_v.topLeftCorner<2, 2>() = 2 * k * by_B;
  force.by_v.col(5).head<2>() = k * by_B * Vector2(place.y(), -place.x());
  return force;
}

std::string JournalBearingLaw::refusal(const Vector6& e) const {
  const double share = e.head<2>().norm() / geometry_.clearance;
  if (share < 1) return {};
  return fmt::format(
      "the journal is at {:.4g} of the clearance: it touches the bush and there is no film. Its load or its step is "
      "too large",
      share);
}

std::vector<std::string> JournalBearingLaw::describe() const {
  return {fmt::format("film of {:.6g} Pa s, radial clearance {:.6g} m, diameter {:.6g} m, length {:.6g} m, {}{}",
                      geometry_.viscosity, geometry_.clearance, geometry_.diameter, geometry_.length,
                      finite_ ? "finite length" : "short bearing",
                      finite_ && cavitation_ == Cavitation::reynolds ? ", Reynolds' condition at the edges" : "")};
}

const KeyTable& journal_bearing_keys() {
  using namespace keys;
  static const KeyTable table{
      "a journal_bearing", "A journal in the oil film of its bush.",
      joined({joint_frame_keys(AxisNeed::required),
              {{"diameter", number("m").positive(), required, "Diameter of the journal."},
               {"length", number("m").positive(), required, "Length of the bush."},
               {"clearance", number("m").positive(), required,
                "Radial clearance: half the difference of the diameters of bush and journal."},
               {"viscosity", number("Pa s").positive(), required, "Dynamic viscosity of the oil."},
               {"model", word({"short", "finite"}, "a `model` of the film"), otherwise("finite"),
                "Film of `finite` length, or of a `short` bearing, whose length is less than about half its "
                "diameter."},
               {"cavitation", word({"half", "reynolds"}, "a condition of `cavitation`"), otherwise("half"),
                "Pressure on `half` of the circumference (Guembel), or no negative pressure, and no slope of the "
                "pressure at the edges of the film (`reynolds`: Swift, Stieber), for lengths up to 2 diameters. Short "
                "bearings are the same with both."}},
              joint_action_keys(Moves::both)})};
  return table;
}

void read_journal_bearing(const std::string& name, const YamlValue& entry, Model& model) {
  JournalGeometry geometry;
  geometry.diameter = entry.at("diameter").number();
  geometry.length = entry.at("length").number();
  geometry.clearance = entry.at("clearance").number();
  geometry.viscosity = entry.at("viscosity").number();
  constexpr double thick = 0.05;  // lubrication theory neglects the curvature of the film
  if (geometry.clearance > thick * geometry.diameter)
    entry.at("clearance")
        .fail(fmt::format("a film of more than {} of the diameter is no film, expected about 0.001 of it", thick));
  constexpr double longest = 10;
  if (geometry.length > longest * geometry.diameter)
    entry.at("length").fail(fmt::format("expected at most {} diameters", longest));
  const bool finite = entry.at("model").word() == "finite";
  const Cavitation cavitation = entry.at("cavitation").word() == "reynolds" ? Cavitation::reynolds : Cavitation::half;
  constexpr double longest_ruptured = 2;  // in longer ones the pressure reaches around the shaft
  if (finite && cavitation == Cavitation::reynolds && geometry.length > longest_ruptured * geometry.diameter)
    entry.at("length").fail(fmt::format(
        "expected at most {} diameters with `cavitation: reynolds`: in a longer bearing the pressure reaches "
        "around the shaft and depends on the place of the oil supply, which the film does not have. Take "
        "`cavitation: half`",
        longest_ruptured));
  auto made =
      std::make_unique<ShaftBearing>("journal_bearing", name, read_joint_frames(entry, model, AxisNeed::required),
                                     std::make_shared<JournalBearingLaw>(geometry, finite, cavitation), model);
  ShaftBearing& bearing = *made;
  model.add(std::move(made), Entry{Section::joints, name});
  read_joint_actions(entry, bearing, model);
}

}  // namespace bielle::mechanism
