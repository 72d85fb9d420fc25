// The points that a body file names, in the superelement's file (reduce/superelement/README.md).
#pragma once

#include <map>
#include <string>

#include "reduce/superelement/superelement.hpp"

namespace bielle {

class Hdf5File;

/// Writes into the group that the file has entered.
void write_named_points(const std::map<std::string, NamedPoint>& points, Hdf5File& file);

/// Reads from the group that the file has entered; the result is empty for files without points. @throws InputError
std::map<std::string, NamedPoint> read_named_points(const Hdf5File& file);

/// A point in a file of a whole body or of a cut body.
struct PointInFile {
  NamedPoint point;
  std::string group;  ///< group of its superelement in the file, as in SuperelementPlace
};

/// Reads all points of a file, without the rest of the superelements. @throws InputError
std::map<std::string, PointInFile> read_points_of_file(const std::string& path);

}  // namespace bielle
