#include "mechanism/elements/beam/airfoil_polars.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "mechanism/reading/read_rows.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::array<const char*, 3> coefficient_names{"lift", "drag", "moment"};
constexpr std::size_t polar_place = 1;  // argument number of s

}  // namespace

AirfoilPolars::Values AirfoilPolars::Station::operator()(double s, double alpha) const {
  Values values;
  for (std::size_t k = 0; k < 3; ++k) {
    PolarValue& each = values[k];
    if (const auto* table = std::get_if<Interpolation>(&coefficients[k])) {
      try {
        const Interpolation::Values found = (*table)(alpha);
        each = {found.value, found.slope};
      } catch (const ComputationError& error) {
        throw ComputationError(fmt::format("{}: angle of attack at s = {:.4g}: {} [rad]", place, s, error.what()));
      }
    } else {
      each.value = std::get<Expression>(coefficients[k]).value_and_gradient({&alpha, 1}, {&each.slope, 1});
    }
  }
  return values;
}

AirfoilPolars::Values AirfoilPolars::operator()(double s, double alpha) const {
  if (stations_.empty()) {
    Values values;
    const std::array<double, 2> arguments{alpha, s};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 2> gradient{};
      values[k].value = formulas_[k].value_and_gradient(arguments, gradient);
      values[k].slope = gradient[0];
    }
    return values;
  }
  const auto next = std::upper_bound(stations_.begin(), stations_.end(), s,
                                     [](double place, const Station& station) { return place < station.at; });
  if (next == stations_.begin()) return stations_.front()(s, alpha);
  if (next == stations_.end()) return stations_.back()(s, alpha);
  const Station& before = *std::prev(next);
  const double share = (s - before.at) / (next->at - before.at);
  Values values = before(s, alpha);
  const Values after = (*next)(s, alpha);
  for (std::size_t k = 0; k < 3; ++k) {
    values[k].value += share * (after[k].value - values[k].value);
    values[k].slope += share * (after[k].slope - values[k].slope);
  }
  return values;
}

std::vector<double> AirfoilPolars::break_points() const {
  std::vector<double> places;
  for (const Station& station : stations_) places.push_back(station.at);
  for (const Expression& formula : formulas_) {
    const std::vector<double> own = formula.break_points(polar_place);
    places.insert(places.end(), own.begin(), own.end());
  }
  return places;
}

namespace {

const KeyTable& polar_keys() {
  using namespace keys;
  static const KeyTable table{
      "a polar of an airfoil",
      "Coefficients of an airfoil at one station of a beam.",
      {{"at", number().between(0, 1), required, "Station: s, 0 at the start of the beam, 1 at its end."},
       {"table",
        {file("table of four columns"), list_of(list_of(4, number()))},
        optional,
        "Rows of alpha and the coefficients of lift, drag and moment, in place of formulas; straight lines join them. "
        "An alpha outside the table ends the computation."},
       {"angles", word({"rad", "deg"}, "a unit of angles"), otherwise("rad"), "Unit of alpha in the table."},
       {"lift", formula("-", {"alpha"}), optional, "Coefficient of lift as a formula of alpha [rad]."},
       {"drag", formula("-", {"alpha"}), otherwise("0"), "Coefficient of drag, likewise."},
       {"moment", formula("-", {"alpha"}), otherwise("0"), "Coefficient of the moment, likewise."}}};
  return table;
}

void read_polar_table(const YamlValue& entry, AirfoilPolars::Station& station) {
  for (const char* key : {"drag", "moment"})
    if (const auto formula = entry.find(key)) formula->fail("is a column of the `table`");
  const YamlValue value = entry.at("table");
  Eigen::MatrixXd rows = read_rows(value, 4, "[alpha, lift, drag, moment]");
  if (entry.at("angles").word() == "deg") rows.col(0) *= M_PI / 180;
  if (const double most = rows.col(0).cwiseAbs().maxCoeff(); most > 2 * M_PI)
    value.fail(fmt::format("has an alpha of {:.6g} rad, more than a turn: is it in degrees? (`angles: deg`)", most));
  const std::string name = value.is_sequence() ? "alpha" : value.text();
  station.place = fmt::format("{}:{}: {}", value.file(), value.line(), value.path());
  try {
    for (std::size_t k = 0; k < 3; ++k)
      station.coefficients[k] =
          Interpolation(rows.col(0), rows.col(static_cast<Eigen::Index>(k) + 1), Interpolation::Kind::linear, name);
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

AirfoilPolars::Station read_polar(const YamlValue& given) {
  const YamlValue entry = given.keyed(polar_keys());
  if (entry.has("table") == entry.has("lift")) entry.fail("a polar has either a `table`, or `lift` and other formulas");
  AirfoilPolars::Station station{entry.at("at").number(), {}, {}};
  if (entry.has("table")) {
    read_polar_table(entry, station);
    return station;
  }
  if (const auto angles = entry.find("angles")) angles->fail("belongs to a `table`; alpha of formulas is in rad");
  for (std::size_t k = 0; k < 3; ++k) station.coefficients[k] = entry.at(coefficient_names[k]).expression();
  return station;
}

}  // namespace

std::vector<Key> airfoil_polar_keys() {
  using namespace keys;
  return {{"lift", formula("-", {"alpha", "s"}), optional,
           "Coefficient of lift as a formula of alpha [rad] and s; required without `polars`."},
          {"drag", formula("-", {"alpha", "s"}), otherwise("0"), "Coefficient of drag, likewise."},
          {"moment", formula("-", {"alpha", "s"}), otherwise("0"),
           "Coefficient of the moment, likewise; positive towards larger alpha."},
          {"polars", list_of(nested(polar_keys)).items_at_least(1), optional,
           "Coefficients at stations along the beam, with ascending `at`, in place of formulas of s; between them they "
           "are interpolated linearly in s, beyond the first and the last one they are constant."}};
}

AirfoilPolars read_airfoil_polars(const YamlValue& airfoil) {
  const auto given = airfoil.find("polars");
  if (!given) {
    if (!airfoil.has("lift")) airfoil.fail("an airfoil needs `lift`, or `polars` at stations");
    std::array<Expression, 3> formulas;
    for (std::size_t k = 0; k < 3; ++k) formulas[k] = airfoil.at(coefficient_names[k]).expression();
    return AirfoilPolars(std::move(formulas));
  }
  for (const char* key : coefficient_names)
    if (const auto formula = airfoil.find(key)) formula->fail("does not go with `polars`, which have their own");
  if (given->items().empty()) given->fail("expected at least 1 station, such as {at: 0, lift: 0.5}");
  std::vector<AirfoilPolars::Station> stations;
  for (const YamlValue& item : given->items()) {
    AirfoilPolars::Station station = read_polar(item);
    if (!stations.empty() && !(station.at > stations.back().at))
      item.at("at").fail(fmt::format("expected a station after the one before it, at {:.6g}", stations.back().at));
    stations.push_back(std::move(station));
  }
  return AirfoilPolars(std::move(stations));
}

}  // namespace bielle::mechanism
