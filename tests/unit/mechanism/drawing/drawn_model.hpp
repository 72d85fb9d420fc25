// The drawing of a model given as text, for tests: items by entry, and their places as drawn.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/results/model_drawing.hpp"

namespace bielle::test {

using mechanism::DrawnItem;
using mechanism::DrawnPlace;
using mechanism::Frame;
using mechanism::Vector3;

class DrawnModel {
 public:
  explicit DrawnModel(const std::string& text, const std::string& name = "model.yaml")
      : file_(mechanism::read_mechanism_text(text, name)), drawing_(mechanism::draw_model(file_.model)) {}

  /// Returns the items of an entry with this shape.
  std::vector<const DrawnItem*> all(const std::string& entry, const std::string& shape) const {
    std::vector<const DrawnItem*> found;
    for (const DrawnItem& item : drawing_.items())
      if (item.entry == entry && item.shape == shape) found.push_back(&item);
    return found;
  }
  const DrawnItem& one(const std::string& entry, const std::string& shape) const {
    CAPTURE(entry, shape);
    const auto found = all(entry, shape);
    REQUIRE(found.size() == 1);
    return *found.front();
  }
  bool has(const std::string& entry, const std::string& shape) const { return !all(entry, shape).empty(); }
  /// Returns the place in inertial components as drawn.
  Frame at(const DrawnPlace& place) const { return file_.model.node(place.node).frame * place.frame; }
  Frame at(const DrawnItem& item, std::size_t place = 0) const { return at(item.places.at(place)); }
  const mechanism::MechanismFile& file() const { return file_; }

 private:
  mechanism::MechanismFile file_;
  mechanism::Drawing drawing_;
};

/// Returns a value of an item. @throws std::out_of_range, std::bad_variant_access
template <class Value>
const Value& value_of(const DrawnItem& item, const std::string& key) {
  for (const auto& [name, value] : item.values)
    if (name == key) return std::get<Value>(value);
  throw std::out_of_range("no value " + key);
}

inline double number_of(const DrawnItem& item, const std::string& key) { return value_of<double>(item, key); }
inline std::vector<double> list_of(const DrawnItem& item, const std::string& key) {
  return value_of<std::vector<double>>(item, key);
}

}  // namespace bielle::test
