#include "reduce/common/input/unit.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <udunits2.h>

#include "reduce/common/error.hpp"
#include "reduce/common/shortened.hpp"

namespace bielle {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};

/// The units that UDUNITS knows, with usual spellings that it lacks. Reading its files takes 10 ms, so that only files
/// with units read them.
class UnitSystem {
 public:
  /// Returns the instance. It is never freed, because values may be read while the program ends.
  static const UnitSystem& instance() {
    static const UnitSystem& system = *new UnitSystem;
    return system;
  }

  /// @returns null if this is no unit
  Unit parse(const std::string& text) const { return Unit(ut_parse(system_, text.c_str(), UT_UTF8)); }

 private:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    if (!system_) throw InputError("UDUNITS cannot read its table of units; is libudunits2-data installed?");
    constexpr const char* spellings[][2] = {{"deg", "degree"},  {"rev", "turn"},        {"Nm", "N m"},
                                            {"kNm", "kN m"},    {"MNm", "MN m"},        {"Nmm", "N mm"},
                                            {"Ns", "N s"},      {"kWh", "kW h"},        {"Wh", "W h"},
                                            {"inches", "inch"}, {"revolution", "turn"}, {"revolutions", "turn"}};
    for (const auto& [name, meaning] : spellings) {
      const Unit unit = parse(meaning);
      ut_map_name_to_unit(name, UT_UTF8, unit.get());
    }
  }
  ut_system* system_ = nullptr;
};

/// Returns the lock of UDUNITS, which is not safe for threads.
std::mutex& mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

/// Tells whether two units have the same dimension. UDUNITS takes the radian for the number 1, and converts a unit to
/// its reciprocal (Hz to s): here they have different dimensions.
bool same_dimension(const Unit& first, const Unit& second) {
  const Unit quotient(ut_divide(first.get(), second.get()));
  char text[256] = "";
  if (!quotient || !ut_is_dimensionless(quotient.get())) return false;
  if (ut_format(quotient.get(), text, sizeof text, UT_ASCII | UT_DEFINITION) < 0) return false;
  return std::string_view(text).find("rad") == std::string_view::npos;
}

/// @returns the converted value, or nothing if the unit has another dimension
std::optional<double> convert(double value, const Unit& unit, const std::string& expected) {
  const Unit wanted = UnitSystem::instance().parse(expected);
  if (!wanted || !same_dimension(unit, wanted)) return {};
  const std::unique_ptr<cv_converter, FreeConverter> converter(ut_get_converter(unit.get(), wanted.get()));
  if (!converter) return {};
  return cv_convert_double(converter.get(), value);
}

/// Returns the product of base units that has the dimension of a unit, "m.s-2".
std::string base_of(const Unit& unit) {
  char text[256] = "";
  ut_format(unit.get(), text, sizeof text, UT_ASCII | UT_DEFINITION);
  const std::string definition = text;  // "1000 m.s-2", "K @ 273.15", "0.01"
  const std::string without_origin = definition.substr(0, definition.find(" @ "));
  const std::size_t factor = without_origin.find_first_not_of("0123456789.eE+-");
  if (factor == std::string::npos) return "1";
  return without_origin[factor] == ' ' ? without_origin.substr(factor + 1) : without_origin;
}

/// Reads the finite number at the beginning of a text and removes it from the text; returns nothing if there is none.
std::optional<double> leading_number(std::string_view& text) {
  const char *begin = text.data() + (text.starts_with('+') ? 1 : 0), *end = text.data() + text.size();
  double number = 0;
  const auto [stopped, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || !std::isfinite(number)) return {};
  text.remove_prefix(static_cast<std::size_t>(stopped - text.data()));
  return number;
}

}  // namespace

std::optional<double> plain_number(std::string_view text) {
  const auto number = leading_number(text);
  return number && text.empty() ? number : std::nullopt;
}

std::optional<Quantity> quantity_of(std::string_view text) {
  std::string_view rest = text;
  const auto number = leading_number(rest);
  if (!number) return {};
  Quantity quantity{*number, {}};
  if (!rest.starts_with(' ')) return {};
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  while (rest.ends_with(' ')) rest.remove_suffix(1);
  if (rest.empty()) return {};
  const auto first = static_cast<unsigned char>(rest.front());
  const bool begins_unit = std::isalpha(first) || first == '%' || first >= 0x80 || rest.starts_with("1/");
  if (!begins_unit) return {};
  quantity.unit = rest;
  return quantity;
}

double to_si(const Quantity& quantity, const std::string& units) {
  const std::lock_guard lock(mutex());
  const std::string written = shortened(quantity.unit);
  const Unit unit = UnitSystem::instance().parse(quantity.unit);
  if (units.empty()) throw InputError(fmt::format("expected a number without a unit, found the unit '{}'", written));
  if (!unit)
    throw InputError(
        fmt::format("'{}' is no unit{}", written, units == "any" ? "" : fmt::format("; expected one of {}", units)));
  const std::string expected = units == "any" ? base_of(unit) : units;
  for (std::size_t begin = 0; begin <= expected.size();) {
    const std::size_t end = std::min(expected.find(" or ", begin), expected.size());
    if (const auto value = convert(quantity.value, unit, expected.substr(begin, end - begin))) return *value;
    begin = end + 4;
  }
  throw InputError(
      fmt::format("expected a value in {}, found one in '{}', which measures something else", units, written));
}

}  // namespace bielle
