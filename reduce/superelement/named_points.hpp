// The points of a body that its body file names, in the superelement's file (reduce/superelement/README.md).
#pragma once

#include <map>
#include <string>

#include "reduce/superelement/superelement.hpp"

namespace bielle {

class Hdf5File;

/// Into the group that the file has entered.
void write_named_points(const std::map<std::string, NamedPoint>& points, Hdf5File& file);

/// From the group that the file has entered; none in files without them. @throws InputError
std::map<std::string, NamedPoint> read_named_points(const Hdf5File& file);

/// A point in a file of a whole body or of one in pieces.
struct PointInFile {
  NamedPoint point;
  std::string group;  ///< of its superelement in the file, as SuperelementPlace has it
};

/// All points of a file, without the rest of the superelements. @throws InputError
std::map<std::string, PointInFile> read_points_of_file(const std::string& path);

}  // namespace bielle
