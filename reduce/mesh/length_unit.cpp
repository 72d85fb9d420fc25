#include "reduce/mesh/length_unit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

struct Unit {
  const char* name;
  double metres;
};

constexpr std::array<Unit, 7> units = {
    {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};

bool same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(a); }

// The statements "#12=(...)" of a STEP file in which `keyword` stands, without white space and the semicolon.
std::vector<std::string> statements_with(const std::string& text, const std::string& keyword) {
  std::vector<std::string> statements;
  std::size_t end = 0;
  for (std::size_t found = text.find(keyword); found != std::string::npos; found = text.find(keyword, end)) {
    const std::size_t before = text.rfind(';', found);
    end = std::min(text.find(';', found), text.size());
    std::string statement;
    for (std::size_t i = before == std::string::npos ? 0 : before + 1; i < end; ++i)
      if (!std::isspace(static_cast<unsigned char>(text[i]))) statement += text[i];
    if (statement.starts_with('#')) statements.push_back(statement);
  }
  return statements;
}

// "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))", "#1=(CONVERSION_BASED_UNIT('INCH',#2)LENGTH_UNIT()...)"
std::optional<double> declared_unit(const std::string& statement) {
  using Word = std::pair<const char*, double>;
  static constexpr std::array<Word, 12> words = {{{"SI_UNIT($,.METRE.)", 1},
                                                  {"SI_UNIT(.MILLI.,.METRE.)", 1e-3},
                                                  {"SI_UNIT(.CENTI.,.METRE.)", 1e-2},
                                                  {"SI_UNIT(.DECI.,.METRE.)", 1e-1},
                                                  {"SI_UNIT(.MICRO.,.METRE.)", 1e-6},
                                                  {"SI_UNIT(.KILO.,.METRE.)", 1e3},
                                                  {"CONVERSION_BASED_UNIT('INCH'", 0.0254},
                                                  {"CONVERSION_BASED_UNIT('inch'", 0.0254},
                                                  {"CONVERSION_BASED_UNIT('FOOT'", 0.3048},
                                                  {"CONVERSION_BASED_UNIT('foot'", 0.3048},
                                                  {"CONVERSION_BASED_UNIT('MILLIMETRE'", 1e-3},
                                                  {"CONVERSION_BASED_UNIT('METRE'", 1}}};
  for (const auto& [word, metres] : words)
    if (statement.find(word) != std::string::npos) return metres;
  return {};
}

}  // namespace

double metres_per(const std::string& unit) {
  std::vector<std::string> names;
  for (const Unit& known : units) {
    if (unit == known.name) return known.metres;
    names.emplace_back(known.name);
  }
  throw InputError(fmt::format("'{}' is not a unit of length{}", unit, did_you_mean(unit, names)));
}

std::string unit_name(double metres) {
  for (const Unit& known : units)
    if (same(known.metres, metres)) return known.name;
  return fmt::format("{:g} m", metres);
}

std::optional<double> step_length_unit(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  // A conversion-based unit (inch) is defined by an SI unit of length, which must not count: only units that a context
  // assigns do.
  std::string assigned;
  for (const std::string& context : statements_with(text, "GLOBAL_UNIT_ASSIGNED_CONTEXT")) assigned += context;
  std::optional<double> unit;
  for (const std::string& statement : statements_with(text, "LENGTH_UNIT")) {
    const std::string name = statement.substr(0, statement.find('='));
    if (assigned.find(name + ",") == std::string::npos && assigned.find(name + ")") == std::string::npos) continue;
    const std::optional<double> declared = declared_unit(statement);
    if (!declared || (unit && !same(*unit, *declared))) return {};
    unit = declared;
  }
  return unit;
}

}  // namespace bielle::reduce
