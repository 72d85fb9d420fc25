// `from` of an interface: ties of the Nastran, Abaqus or CalculiX file that is the body's geometry.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/mesh_request.hpp"
#include "reduce/reduction/options.hpp"

namespace bielle {
class YamlValue;
}

namespace bielle::reduce {

/// A tie of a deck: an RBE2, an RBE3, a coupling, a rigid body.
struct DeckTie {
  std::string name;     ///< "RBE3 6002", "coupling END"
  std::string refusal;  ///< the reason why it can be no interface; empty: it can, and the members below are set
  Tie tie = Tie::rigid;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< position of its reference node [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< axes of its reference node
  std::array<bool, 6> kept = {};                           ///< directions that it ties
  std::string surface;                                     ///< the surface group that it ties; empty: nodes
  std::vector<std::size_t> nodes = {};                     ///< numbers of its nodes in the converted mesh
  std::vector<double> weights = {};                        ///< one for each of `nodes`
};

/// Returns the ties of a file, none of a file that is no deck.
/// @param length_unit  unit of the file; absent: m
/// @param notes  gets the reader's notes @throws InputError with the reader's sentence
std::vector<DeckTie> deck_ties(const std::string& path, const std::optional<std::string>& length_unit,
                               std::vector<std::string>& notes);

/// The ties as lines for the terminal, which `--list` prints; empty if there are none.
std::string describe(const std::vector<DeckTie>& ties);

/// The ties of a body's geometry. They are read when the first interface asks for one.
class DeckTieReader {
 public:
  /// Makes an interface of a tie. The object refers to `mesh`.
  explicit DeckTieReader(MeshRequest& mesh) : mesh_(mesh) {}

  /// Sets group, tie, position, rotation and directions of an interface, and requests its nodes or its surface.
  /// @param from  the key that names the tie
  /// @throws InputError at the key for an unknown tie (the nearest name), one that can be no interface, or one that
  ///         another interface has
  void read(const YamlValue& from, InterfaceRequest& interface);

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  const DeckTie& find(const YamlValue& from);
  MeshRequest& mesh_;
  std::optional<std::vector<DeckTie>> ties_;
  std::map<std::string, std::string> user_of_;  ///< tie -> interface
  std::vector<std::string> notes_;
};

}  // namespace bielle::reduce
