// A body that is cut into pieces: superelements that share interfaces, stored in one file. It is described in
// reduce/superelement/README.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reduce/superelement/superelement.hpp"

namespace bielle {

/// A surface between two pieces. Its interfaces have the same names, positions and axes in both.
struct CutSurface {
  std::string name;                                    ///< "cut_1"
  std::array<int, 2> pieces{};                         ///< numbers from 0
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centroid [m], body axes
  double area = 0;                                     ///< [m^2]
  double distance = 0;  ///< farthest point of the surface from the plane that was asked for [m]
};

/// Effect of the ties of the cuts on the body: they suppress its warping and its contraction.
struct CutEffect {
  Eigen::VectorXd uncut_frequencies;  ///< frequencies of the free body in one piece [Hz]; empty if it was not reduced
  /// Least and largest ratio of the stiffness of the pieces to that of the uncut body among all loads between the
  /// interfaces; empty for a single interface.
  std::vector<double> stiffness_ratios;
};

/// Pieces along the body, in the order of their connections, starting at the piece of the first interface.
struct CutBody {
  std::string name;
  std::string created_by;            ///< program and version
  std::string input;                 ///< text of the body file
  std::vector<Superelement> pieces;  ///< named "<body>.1", "<body>.2", ...
  std::vector<CutSurface> cuts;
  Eigen::VectorXd free_frequencies;  ///< frequencies of all pieces together [Hz], ascending, without rigid motions
  CutEffect effect;
};

/// Names of the interfaces that occur in more than one piece, in the order of the pieces: the shared nodes.
std::vector<std::string> shared_interfaces(const std::vector<Superelement>& pieces);

/// "/pieces/2": the group of a piece in the file. @param piece  number from 0
std::string group_of_piece(std::size_t piece);

/// Version of the layout that contains the pieces.
inline constexpr int cut_body_version = 1;

/// Writes all pieces (under a temporary name, then renamed). @throws ComputationError
void write_cut_body(const CutBody& body, const std::string& path);

/// Tells whether a file holds a cut body. The result is false for every other file, readable or not.
bool holds_pieces(const std::string& path);

/// Reads the parts of a superelement that a mechanism needs in every run (superelement_file.hpp), or nothing if the
/// file holds pieces. @throws InputError as read_superelement
std::optional<Superelement> read_whole_for_motion(const std::string& path);

/// @throws InputError as read_superelement, and if pieces that share an interface have it at different places
CutBody read_cut_body(const std::string& path);

/// C~ = beta K~ of a piece such that the first mode of the free body has the damping `ratio`. Modal damping of the
/// pieces would be wrong: a mode of the whole body, which bends each piece little, would get a fraction of it.
/// @param frequency  frequency of that mode [Hz]
Eigen::MatrixXd damping_of_piece(const Superelement& piece, double ratio, double frequency);

}  // namespace bielle
