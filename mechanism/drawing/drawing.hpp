// A drawing is gathered from the components of a mechanism, each of which adds its own items (Component::draw).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/drawing/drawn_item.hpp"

namespace bielle::mechanism {

/// Returns the components as a value of an item.
inline std::vector<double> numbers_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

class Drawing {
 public:
  /// Sets the entry that the items added next belong to.
  /// @param entry  section and name, "joints/main" @param type  as in the file, "hinge"
  /// @param shaped  whether the user has given it shapes
  void begin(const std::string& entry, const std::string& type, bool shaped = false);
  /// Returns whether the user has given shapes to the entry: its component then adds only the items that these shapes
  /// do not show.
  bool shaped() const { return shaped_; }

  /// Adds an item. Its entry and type are those of begin, unless it has its own.
  void add(DrawnItem item);
  /// Adds an item of two ends: "bar", "coil", "jack".
  void add_between(const std::string& shape, const DrawnPlace& first, const DrawnPlace& second,
                   std::vector<std::pair<std::string, DrawnValue>> values = {});
  const std::vector<DrawnItem>& items() const { return items_; }

 private:
  std::string entry_, type_;
  bool shaped_ = false;
  std::vector<DrawnItem> items_;
};

}  // namespace bielle::mechanism
