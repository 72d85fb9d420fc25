// Whole datasets of Hdf5File.
#include <algorithm>
#include <charconv>

#include "reduce/common/files/hdf5_handle.hpp"

namespace bielle {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Calls action(first, rows) for blocks of rows of at most 4 MB, so that a large matrix is not held twice.
template <class Action>
void for_row_blocks(Eigen::Index rows, Eigen::Index columns, Action&& action) {
  if (columns == 0) return;
  const Eigen::Index most = std::max<Eigen::Index>(1, (Eigen::Index{1} << 19) / columns);
  for (Eigen::Index first = 0; first < rows; first += most) action(first, std::min(most, rows - first));
}

/// Returns the part of a 2-d dataset's space that holds some of its rows.
Hdf5Id rows_of(hid_t dataset, Eigen::Index first, Eigen::Index rows) {
  Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  hsize_t start[2] = {0, 0}, count[2] = {0, 0};
  H5Sget_simple_extent_dims(space, count, nullptr);
  start[0] = static_cast<hsize_t>(first);
  count[0] = static_cast<hsize_t>(rows);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
  return space;
}

}  // namespace

std::string link_name(const std::string& name) {
  std::string result;
  for (const char c : name) result += c == '/' ? "%2F" : c == '%' ? "%25" : c == '.' ? "%2E" : std::string(1, c);
  return result;
}

std::string name_of_link(const std::string& link) {
  std::string result;
  for (std::size_t i = 0; i < link.size(); ++i) {
    int code = 0;
    if (link[i] == '%' && i + 2 < link.size() &&
        std::from_chars(&link[i + 1], &link[i + 3], code, 16).ptr == &link[i + 3]) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += link[i];
    }
  }
  return result;
}

void Hdf5File::write(const std::string& dataset, std::span<const double> values, const Shape& shape,
                     const std::string& units, const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, values.data(), values.size(), shape, units,
                        description);
}

void Hdf5File::write(const std::string& dataset, std::span<const std::int64_t> values, const Shape& shape,
                     const std::string& units, const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_INT64, H5T_STD_I64LE, values.data(), values.size(), shape, units,
                        description);
}

void Hdf5File::write_floats(const std::string& dataset, std::span<const float> values, const Shape& shape,
                            const std::string& units, const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_FLOAT, H5T_IEEE_F32LE, values.data(), values.size(), shape, units,
                        description);
}

void Hdf5File::write_indices(const std::string& dataset, std::span<const std::int32_t> values, const Shape& shape,
                             const std::string& description) {
  handle_->write_values(dataset, H5T_NATIVE_INT32, H5T_STD_I32LE, values.data(), values.size(), shape, "-",
                        description);
}

void Hdf5File::write(const std::string& dataset, const Eigen::MatrixXd& matrix, const std::string& units,
                     const std::string& description) {
  const Shape shape{static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
  const Hdf5Id made = handle_->make_dataset(dataset, H5T_IEEE_F64LE, shape, units, description);
  for_row_blocks(matrix.rows(), matrix.cols(), [&](Eigen::Index first, Eigen::Index rows) {
    const RowMajor block = matrix.middleRows(first, rows);
    const Hdf5Id space = rows_of(made, first, rows), memory = hdf5_space({static_cast<std::size_t>(rows), shape[1]});
    handle_->checked(H5Dwrite(made, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, block.data()), dataset,
                     "cannot be written; is the disk full?");
  });
}

void Hdf5File::write(const std::string& dataset, const Eigen::VectorXd& vector, const std::string& units,
                     const std::string& description) {
  const auto size = static_cast<std::size_t>(vector.size());
  write(dataset, {vector.data(), size}, {size}, units, description);
}

void Hdf5File::write(const std::string& dataset, double value, const std::string& units,
                     const std::string& description) {
  write(dataset, {&value, 1}, {}, units, description);
}

void Hdf5File::write_text(const std::string& dataset, const std::string& text) {
  const char* pointer = text.c_str();
  const Hdf5Id type = hdf5_text_type();
  handle_->write_values(dataset, type, type, &pointer, 1, {}, "-", "", text_transfer_properties(1));
}

void Hdf5File::write_names(const std::string& dataset, const std::vector<std::string>& names) {
  std::vector<const char*> pointers;
  pointers.reserve(names.size());
  for (const std::string& name : names) pointers.push_back(name.c_str());
  const Hdf5Id type = hdf5_text_type();
  handle_->write_values(dataset, type, type, pointers.data(), pointers.size(), {names.size()}, "-", "",
                        text_transfer_properties(names.size()));
}

bool Hdf5File::has(const std::string& object) const { return handle_->has(object); }

bool Hdf5File::is_group(const std::string& object) const {
  const Hdf5Id opened = handle_->open_object(object);
  return H5Iget_type(opened) == H5I_GROUP;
}

bool Hdf5File::is_text(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset), type(H5Dget_type(opened), H5Tclose);
  return H5Tget_class(type) == H5T_STRING;
}

bool Hdf5File::grows(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset), space(H5Dget_space(opened), H5Sclose);
  std::array<hsize_t, H5S_MAX_RANK> size{}, most{};
  const int rank = H5Sget_simple_extent_dims(space, size.data(), most.data());
  return rank > 0 && most[0] == H5S_UNLIMITED;
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  const Hdf5Id opened(H5Gopen2(handle_->file, handle_->at(group).c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.valid()) handle_->fail(group, "is no group of this file");
  const Hdf5Id properties(H5Gget_create_plist(opened), H5Pclose);
  unsigned order = 0;
  H5Pget_link_creation_order(properties, &order);
  std::vector<std::string> names;
  const auto add_name = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const H5_index_t index = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  handle_->checked(H5Literate(opened, index, H5_ITER_INC, nullptr, add_name, &names), group, "cannot be listed");
  return names;
}

Shape Hdf5File::shape(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset);
  return handle_->shape(opened, dataset);
}

std::string Hdf5File::units(const std::string& dataset) const { return read_text_attribute(dataset, "units"); }

std::vector<double> Hdf5File::read(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_FLOAT);
  std::vector<double> values(handle_->stored_count(opened, dataset));
  if (!values.empty())
    handle_->checked(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset,
                     "cannot be read: the file is damaged");
  return values;
}

std::vector<double> Hdf5File::read_rows(const std::string& dataset, std::size_t first, std::size_t count) const {
  const Hdf5Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_FLOAT);
  const Shape size = handle_->shape(opened, dataset);
  if (size.empty() || first + count > size[0]) handle_->fail(dataset, "has too few rows");
  std::vector<hsize_t> start(size.size(), 0), block(size.begin(), size.end());
  start[0] = first;
  block[0] = count;
  std::size_t numbers = count;
  for (std::size_t k = 1; k < size.size(); ++k) numbers *= size[k];
  std::vector<double> values(numbers);
  if (values.empty()) return values;
  const Hdf5Id memory(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose);
  const Hdf5Id space(H5Dget_space(opened), H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr);
  handle_->checked(H5Dread(opened, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()), dataset,
                   "cannot be read: the file is damaged");
  return values;
}

std::vector<std::int64_t> Hdf5File::read_integers(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_INTEGER);
  std::vector<std::int64_t> values(handle_->stored_count(opened, dataset));
  if (!values.empty())
    handle_->checked(H5Dread(opened, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset,
                     "cannot be read: the file is damaged");
  return values;
}

Eigen::MatrixXd Hdf5File::read_matrix(const std::string& dataset) const {
  const Hdf5Id opened = handle_->open_dataset(dataset);
  handle_->check_class(opened, dataset, H5T_FLOAT);
  const Shape size = handle_->shape(opened, dataset);
  if (size.size() != 2) handle_->fail(dataset, "expected a matrix, found the shape " + to_string(size));
  handle_->stored_count(opened, dataset);
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(size[0]), static_cast<Eigen::Index>(size[1]));
  for_row_blocks(matrix.rows(), matrix.cols(), [&](Eigen::Index first, Eigen::Index rows) {
    RowMajor block(rows, matrix.cols());
    const Hdf5Id space = rows_of(opened, first, rows), memory = hdf5_space({static_cast<std::size_t>(rows), size[1]});
    handle_->checked(H5Dread(opened, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, block.data()), dataset,
                     "cannot be read: the file is damaged");
    matrix.middleRows(first, rows) = block;
  });
  return matrix;
}

Eigen::VectorXd Hdf5File::read_vector(const std::string& dataset) const {
  const Shape size = shape(dataset);
  if (size.size() != 1) handle_->fail(dataset, "expected a list of numbers, found the shape " + to_string(size));
  const std::vector<double> values = read(dataset);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double Hdf5File::read_number(const std::string& dataset) const {
  const std::vector<double> values = read(dataset);
  if (values.size() != 1) handle_->fail(dataset, fmt::format("expected one number, found {}", values.size()));
  return values[0];
}

std::string Hdf5File::read_text(const std::string& dataset) const {
  const std::vector<std::string> texts = handle_->read_strings(dataset);
  if (texts.size() != 1) handle_->fail(dataset, fmt::format("expected one text, found {}", texts.size()));
  return texts[0];
}

std::vector<std::string> Hdf5File::read_names(const std::string& dataset) const {
  return handle_->read_strings(dataset);
}

}  // namespace bielle
