#include "mechanism/drawing/drawing.hpp"

namespace bielle::mechanism {

void Drawing::begin(const std::string& entry, const std::string& type, bool shaped) {
  entry_ = entry;
  type_ = type;
  shaped_ = shaped;
}

void Drawing::add(DrawnItem item) {
  if (item.entry.empty()) item.entry = entry_;
  if (item.type.empty()) item.type = type_;
  items_.push_back(std::move(item));
}

void Drawing::add_between(const std::string& shape, const DrawnPlace& first, const DrawnPlace& second,
                          std::vector<std::pair<std::string, DrawnValue>> values) {
  add({.shape = shape, .places = {first, second}, .values = std::move(values)});
}

}  // namespace bielle::mechanism
