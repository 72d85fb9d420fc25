// Packs numbers, texts, lists and matrices into one string of bytes and unpacks them, both by the same function:
//     void exchange(Packing& packing, Mesh& mesh) { packing(mesh.points); .. }
// The format is for exchange between processes of the same program only.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace bielle {

class Packing {
 public:
  Packing() = default;  ///< to pack
  explicit Packing(std::string bytes) : bytes_(std::move(bytes)), unpacking_(true) {}

  const std::string& bytes() const { return bytes_; }

  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void operator()(Number& value) { raw(&value, sizeof value); }
  void operator()(std::string& text) {
    text.resize(size(text.size()));
    raw(text.data(), text.size());
  }
  template <class Item>
  void operator()(std::vector<Item>& items) {
    items.resize(size(items.size()));
    for (Item& item : items) (*this)(item);
  }
  template <class Scalar, int rows, int columns>
  void operator()(Eigen::Matrix<Scalar, rows, columns>& matrix) {
    const auto height = static_cast<Eigen::Index>(size(static_cast<std::size_t>(matrix.rows())));
    const auto width = static_cast<Eigen::Index>(size(static_cast<std::size_t>(matrix.cols())));
    matrix.resize(height, width);
    raw(matrix.data(), sizeof(Scalar) * static_cast<std::size_t>(matrix.size()));
  }
  template <class Key, class Value>
  void operator()(std::map<Key, Value>& map) {
    const std::size_t count = size(map.size());
    if (!unpacking_) {
      for (auto& [key, value] : map) {
        Key name = key;
        (*this)(name);
        (*this)(value);
      }
      return;
    }
    for (std::size_t k = 0; k < count; ++k) {
      Key key{};
      (*this)(key);
      (*this)(map[key]);
    }
  }
  /// Every other type has a function `exchange` in its namespace.
  template <class Part>
  requires std::is_class_v<Part>
  void operator()(Part& part) { exchange(*this, part); }

 private:
  std::size_t size(std::size_t value) {
    std::uint64_t number = value;
    (*this)(number);
    return number;
  }
  void raw(void* data, std::size_t count) {
    if (!unpacking_) {
      bytes_.append(static_cast<const char*>(data), count);
      return;
    }
    if (count > bytes_.size() - next_) throw std::logic_error("fewer bytes were packed than are asked for");
    if (count > 0) std::memcpy(data, bytes_.data() + next_, count);
    next_ += count;
  }
  std::string bytes_;
  std::size_t next_ = 0;
  bool unpacking_ = false;
};

}  // namespace bielle
