// `from` of interfaces and masses: ties and point masses of the Nastran, Abaqus or CalculiX file that is the body's
// geometry.
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
  std::string name;       ///< "RBE3 6002", "coupling END"
  std::string refusal;    ///< the reason why it can be no interface; empty: it can, and the members below are set
  std::string reference;  ///< label of its reference node in the file
  Tie tie = Tie::rigid;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< position of its reference node [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< axes of its reference node
  std::array<bool, 6> kept = {};                           ///< directions that it ties
  std::string surface;                                     ///< the surface group that it ties; empty: nodes
  std::vector<std::size_t> nodes = {};                     ///< numbers of its nodes in the converted mesh
  std::vector<double> weights = {};                        ///< one for each of `nodes`
};

/// A point mass of a deck: a CONM2, a *MASS or a *ROTARY INERTIA.
struct DeckMass {
  std::string name;                                    ///< "CONM2 7001"
  std::string refusal;                                 ///< the reason why it cannot be used; empty: it can, as follows
  double mass = 0;                                     ///< in the file's unit of mass
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< its centre [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();   ///< about its centre, in the file's unit of mass times m^2
  std::string tie;                                     ///< name of the tie that carries it; or
  std::optional<Eigen::Vector3d> place = {};           ///< node of the solid that carries it [m]
  /// Tells whether it has mass or inertia. A mass without either needs neither tie nor place.
  bool has_effect() const { return mass != 0 || !inertia.isZero(0); }
};

/// The ties and point masses of a file. Both lists are empty if the file is no deck.
struct Deck {
  std::vector<DeckTie> ties;
  std::vector<DeckMass> masses;
};

/// @param length_unit  unit of the file; absent: m
/// @param notes  gets the reader's notes @throws InputError with the reader's sentence
Deck read_deck(const std::string& path, const std::optional<std::string>& length_unit, std::vector<std::string>& notes);

/// Returns the ties and masses as lines for the terminal, which `--list` prints; empty if there are none.
std::string describe(const Deck& deck);

/// The deck of a body's geometry. It is read when the first interface or mass asks for it.
class DeckReader {
 public:
  /// Makes interfaces and masses. The object refers to `mesh`.
  explicit DeckReader(MeshRequest& mesh) : mesh_(mesh) {}

  /// Sets group, tie, position, rotation and directions of an interface, and requests its nodes or its surface.
  /// @param from  the key that names the tie
  /// @throws InputError at the key for an unknown tie (the nearest name), one that can be no interface, or one that
  ///         another interface has
  void read(const YamlValue& from, InterfaceRequest& interface);

  /// Returns the mass that a key names, with a request for the nodes, the surface or the place that carries it.
  /// @param name  the name that it gets @param kilograms  per unit of the file
  /// @throws InputError at the key, as `read`, and for values that no body can have
  MassRequest read_mass(const YamlValue& from, const std::string& name, double kilograms);

  /// Returns all masses that have an effect, by their own names.
  /// @param key  the key `masses`, which stands in messages @throws InputError as `read_mass`
  std::vector<MassRequest> read_masses(const YamlValue& key, double kilograms);

  /// Returns the notes of the reader, and sentences about interfaces that were the same node in the file.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  const Deck& deck(const YamlValue& key);
  const DeckTie& find(const YamlValue& from);
  const std::vector<DeckMass>& read_any(const YamlValue& key);
  MassRequest made(const DeckMass& mass, const YamlValue& key, double kilograms);
  std::string requested_nodes(const DeckTie& tie, const YamlValue& key);
  void note_common_reference(const DeckTie& tie, const std::string& interface);
  std::string file_name() const;
  MeshRequest& mesh_;
  std::optional<Deck> deck_;
  std::map<std::string, std::string> user_of_;       ///< tie -> interface
  std::map<std::string, std::string> user_of_mass_;  ///< mass of the deck -> mass of the body
  std::vector<std::string> notes_;
};

}  // namespace bielle::reduce
