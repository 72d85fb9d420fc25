#include "mechanism/model/description.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bielle::mechanism {

std::string format_vector(const Vector3& v) {
  const auto clean = [](double x) { return std::abs(x) < 1e-14 ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", clean(v.x()), clean(v.y()), clean(v.z()));
}

void Description::add(std::string fact) { facts_.push_back({std::move(fact), {}, 0, false}); }

void Description::add_sum(const std::string& name, double value, const std::string& units) {
  const auto [place, added] = sums_.try_emplace(name, facts_.size());
  if (added) facts_.push_back({name, units, 0, true});
  facts_[place->second].sum += value;
}

void Description::add_line(std::string line) { lines_.push_back(std::move(line)); }

void Description::add_each(const std::string& subject, const std::string& part, const std::string& text) {
  Each& each = each_.try_emplace(subject, Each{subject, part, text, {}}).first->second;
  ++each.count;
  each.alike = each.alike && text == each.first;
  each.last = text;
}

std::vector<std::string> Description::lines() const {
  std::vector<std::string> all(1);
  for (const Fact& fact : facts_) {
    if (!all[0].empty()) all[0] += ", ";
    all[0] += fact.is_sum ? fmt::format("{} {:.6g} {}", fact.text, fact.sum, fact.units) : fact.text;
  }
  for (const auto& [subject, each] : each_) {
    const auto line = [&, &what = each](const char* which, const std::string& text) {
      return fmt::format("{} {} {}: {}", what.subject, which, what.part, text);
    };
    if (each.alike) {
      all.push_back(line(each.count == 1 ? "the" : "each", each.first));
      continue;
    }
    all.push_back(line("the first", each.first));
    all.push_back(line("the last", each.last));
  }
  all.insert(all.end(), lines_.begin(), lines_.end());
  return all;
}

}  // namespace bielle::mechanism
